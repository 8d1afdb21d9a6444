"""How ISO is to be written: a profile, the habits of its family, and what is chosen otherwise."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal, NamedTuple

from parser.findings.errors import SettingsError
from parser.iso.profiles.profile import Profile, profile
from parser.units import UM_PER_MM

Unit = Literal["um", "mm", "inch"]
UM_PER_INCH = 25_400.0
_UM: dict[Unit, float] = {"um": 1.0, "mm": UM_PER_MM, "inch": UM_PER_INCH}
_DECIMALS: dict[Unit, int] = {"um": 0, "mm": 3, "inch": 5}


@dataclass(frozen=True, slots=True)
class Habits:
    """How programs of a family are written; ``habits.toml`` says what each key is."""

    unit: Unit
    number_step: int
    tape: bool
    head: tuple[str, ...]
    end: str
    offset: str
    digits: int
    sets_offsets: bool
    offset_on: str
    side_alone: bool
    says_unit: bool
    starts_by: Literal["place", "rapid"]
    before_cut: tuple[str, ...]
    behind_cut: tuple[str, ...]
    arc_feed: str
    trims_zeros: bool


class IsoChoices(NamedTuple):
    """How ISO is to be written.

    Attributes
    ----------
    profile, habits
        Of the dialect.
    unit, decimals
        Of its numbers; without a point where there are no decimals.
    distance, centers
        As in `Profile`.
    number_step
        Between the N of blocks; 0 without N.
    tape
        Whether a ``%`` begins and ends it.
    """

    profile: Profile
    habits: Habits
    unit: Unit
    decimals: int
    distance: Literal["absolute", "incremental"]
    centers: Literal["from-start", "absolute"]
    number_step: int
    tape: bool

    @property
    def step_um(self) -> float:
        """Least step that its numbers are written in."""
        return round(_UM[self.unit] / 10.0**self.decimals, 9)

    @property
    def reading_unit(self) -> Unit | Literal[""]:
        """The unit that its text is to be read with: none where the text says it, or it is that of the dialect."""
        says = self.unit == "inch" or self.habits.says_unit
        return "" if says else self.unit

    def number(self, steps: int) -> str:
        """A number of steps as text."""
        if not self.decimals:
            return f"{steps}"
        whole, digits = f"{steps / 10**self.decimals:.{self.decimals}f}".split(".")
        return f"{whole}.{(digits.rstrip('0') or '0') if self.habits.trims_zeros else digits}"


def iso_choices(dialect: str, unit: Unit | None = None, decimals: int | None = None) -> IsoChoices:
    """The usual choices of a dialect by its name; with another unit, and other decimals, where they are given.

    SettingsError where the dialect has no such numbers.
    """
    of, habits = profile(dialect), _habits(dialect)
    unit = unit or habits.unit
    if unit == "um" and of.integer_um != _UM["um"]:
        raise SettingsError("unit-um-not-for-dialect", dialect=of.name)
    fine = _DECIMALS[unit] if decimals is None or unit == "um" else decimals
    return IsoChoices(of, habits, unit, fine, of.distance, of.centers, habits.number_step, habits.tape)


@cache
def _habits(name: str) -> Habits:
    """Of a profile: its own over those of ``common``."""
    values: dict[str, Any] = tomllib.loads(Path(__file__).with_name("habits.toml").read_text(encoding="utf-8"))
    own = {**values["common"], **values[name]}
    columns: dict[str, Any] = {key: tuple(value) if isinstance(value, list) else value for key, value in own.items()}
    return Habits(**columns)
