"""Limits of a test piece: the features that are measured, and between what they may lie (``[[feature]]``)."""

from pathlib import Path
from typing import Final, Literal, NamedTuple, get_args

from parser.findings.errors import SettingsError
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Name, Number, OneOf, Truth
from sim.setup.toml.reader import Bound, load_toml, tables

FeatureKind = Literal["circle", "width"]
KINDS: tuple[str, ...] = get_args(FeatureKind)
_SIZE_MM: Final = Bound(1e-3, 1e5)
_LIMIT_UM: Final = Bound(-1e5, 1e5)
_LENGTH_UM: Final = Bound(0.0, 1e5)


class FeatureLimits(NamedTuple):
    """A feature and its limits.

    Attributes
    ----------
    name
        As the rows of a measurement name it.
    kind
        A circle, or two parallel faces.
    nominal_mm
        Its diameter, or the distance of the faces.
    lower_um, upper_um
        How far the size may lie off that.
    form_um
        How far it may be off its form; None where nobody asks.
    across_deg
        The direction across the faces, from X counter-clockwise.
    inside
        Whether it is a hole or a slot.
    """

    name: str
    kind: FeatureKind
    nominal_mm: float
    lower_um: float
    upper_um: float
    form_um: float | None = None
    across_deg: float = 0.0
    inside: bool = False


class Limits(NamedTuple):
    """Limits of a piece, and the expanded uncertainty with which its sizes are measured, 95 %."""

    uncertainty_um: float
    features: tuple[FeatureLimits, ...]


PIECE = Section("piece", (Key("uncertainty_um", Number(_LENGTH_UM, "µm")),), form="top")
FEATURE = Section(
    "feature",
    (
        Key("name", Name()),
        Key("kind", OneOf(KINDS)),
        Key("nominal_mm", Number(_SIZE_MM, "mm")),
        Key("lower_um", Number(_LIMIT_UM, "µm")),
        Key("upper_um", Number(_LIMIT_UM, "µm")),
        Key("form_um", Number(_LENGTH_UM, "µm"), default=None),
        Key("across_deg", Number(Bound(-360.0, 360.0), "°"), default=0.0),
        Key("inside", Truth(), default=False),
    ),
    fills="features",
    form="list",
)
SECTIONS: Final = (PIECE, FEATURE)
"""Sections of a file of limits."""


def load_limits(path: Path) -> Limits:
    """Limits of a file. Raises FileUnreadableError, and SettingsError with file and key."""
    content, where = load_toml(path), str(path)
    top = PIECE.read(content, where, others=(FEATURE.name,))
    features = tuple(
        FeatureLimits(**FEATURE.read(table, f"{where}: {FEATURE.header} {at}"))
        for at, table in enumerate(tables(content, FEATURE.name, where), start=1)
    )
    if not features:
        raise SettingsError("limits-without-feature", where=where)
    names = [feature.name for feature in features]
    for feature in features:
        if feature.lower_um > feature.upper_um:
            raise SettingsError("limits-crossed", where=where, name=feature.name)
        if names.count(feature.name) > 1:
            raise SettingsError("feature-named-twice", where=where, name=feature.name)
    return Limits(features=features, **top)
