"""Settings of a scenario that options of the command line and fields of a page give in place of those of its file."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final, TypeVar, get_args

from controller.host.entries import Interpolation
from sim.setup.part import WORK
from sim.setup.toml.keys import Key
from sim.setup.toml.kinds import OneOf, Truth
from sim.setup.wire import WIRE

Whole = TypeVar("Whole", bound="DataclassInstance")
if TYPE_CHECKING:
    from _typeshed import DataclassInstance


INTERPOLATOR: Final = Key(
    "interpolator",
    OneOf(get_args(Interpolation)),
    default=None,
    get=lambda _: None,  # the machine file says it
    option="--interpolator",
)
"""In place of the machine's own, whatever else stands in its file."""
PAST_STOP: Final = Key("past_stop", Truth(), default=False, option="--past-stop")
KERF: Final = Key("kerf", Truth(), default=False, option="--kerf")
MAY_STAY_OPEN: Final = Key("open", Truth(), "may_stay_open", default=False, option="--open")


def _settable() -> Iterator[tuple[str, Key]]:
    for key in (PAST_STOP, KERF, MAY_STAY_OPEN):
        yield key.path, key
    for section in (WORK, WIRE):
        for key in section.keys:
            if key.option:
                yield ".".join(filter(None, (section.fills, key.path))), key


SETTABLE: Final = dict(_settable())
"""The keys that have an option, by where a scenario keeps their values; some have a field of the page, too."""
FIELDS: Final = {key.form: key for key in SETTABLE.values() if key.form}
"""Those that have a field of the page, by its name."""
TAPER_FIELDS: Final = ("taper_deg", "taper_side", "taper_corner", "plane_mm")
"""Fields of the page on a wire that leans; without an angle it is upright, or leans as its program says."""


def with_settings(scenario: Whole, values: Mapping[str, Any], **others: Any) -> Whole:
    """The scenario with values, as they are inside, in place of its own, by the names of their keys.

    `others` are fields of the scenario that have no such key; all are put in at once, as they may depend.
    """
    found = {path: values[key.name] for path, key in SETTABLE.items() if key.name in values}
    return _with(scenario, {**found, **others})


def _with(whole: Whole, values: Mapping[str, Any]) -> Whole:
    """A dataclass with values in place of its own, by their paths with dots; all at once, as they may depend."""
    parts: dict[str, dict[str, Any]] = {}
    for path, value in values.items():
        name, _, rest = path.partition(".")
        parts.setdefault(name, {})[rest] = value
    return replace(
        whole, **{name: of[""] if "" in of else _with(getattr(whole, name), of) for name, of in parts.items()}
    )
