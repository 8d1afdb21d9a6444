"""What a file is checked with."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final, Literal, Self

from parser.dialect.reader import (
    Choices,
    ChosenDialect,
    Marks,
    Registers,
    merged,
)
from parser.findings.errors import SettingsError
from parser.units import from_mm
from sim.check.path_checks import Demands
from sim.check.result import FailOn
from sim.setup.toml.keys import Key
from sim.setup.wire import DEFAULT_WIRE, DIAMETER, SPARK_GAP

if TYPE_CHECKING:
    from sim.check.kerf_offsets import Kerfs
    from sim.check.lean import LeanDemands
    from sim.setup.machine.machine import Machine
    from sim.setup.taper import TaperSettings
    from sim.setup.technology import Technology


WIRE_LENGTHS: Final[Mapping[str, Key]] = {"wire_diameter_um": DIAMETER, "spark_gap_um": SPARK_GAP}
"""Keys of the wire that a check is held against, by the fields of `CheckSettings` that have their values."""


@dataclass(frozen=True, slots=True)
class CheckSettings:
    """What a file is checked with.

    Attributes
    ----------
    machine, start_mm
        Table that the program is to fit on, and its start there; the middle of the travel where `start_mm` is None.
    wire_diameter_um, spark_gap_um
        Wire; where only one is given the other is that of the usual wire.
    technology, material, thickness_mm
        What the wire does, in which material, the only one that it knows where None, and how high the work is, which
        may be None where it knows one height.
    taper
        What is told of the lean of the wire beside the programs.
    may_stay_open
        Whether contours may end away from their own path.
    select, ignore
        Beginnings of the codes that are shown, and of those that are not; an empty `select` is all.
    ignore_here
        Beginnings of the codes that a settings file does not show of this one file.
    fail_on
        The mildest that makes the exit code 1.
    marks
        Further end and pause marks.
    dialect, unit, registers
        What is told of the programs beside their text, as `Choices` has it; without the registers of the machine.
    file
        Settings file that they come from, as it is named to people; empty where they come from none.
    by_options
        Names of those of the fields above that stand on the command line.
    """

    machine: "Machine | None" = None
    start_mm: tuple[float, float] | None = None
    wire_diameter_um: float | None = None
    spark_gap_um: float | None = None
    technology: "Technology | None" = None
    material: str | None = None
    thickness_mm: float | None = None
    taper: "TaperSettings | None" = None
    may_stay_open: bool = False
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    ignore_here: tuple[str, ...] = ()
    fail_on: FailOn = "incomplete"
    marks: Marks = Marks()  # noqa: RUF009 - frozen
    dialect: ChosenDialect = ""
    unit: str = ""
    registers: Registers = ()
    file: str = ""
    by_options: frozenset[str] = frozenset()

    @property
    def choices(self) -> Choices:
        """What the program is read with."""
        of_machine = self.machine.controller.registers if self.machine else ()
        return Choices(self.marks, self.dialect, self.unit, merged([of_machine, self.registers]))

    @classmethod
    def reading(cls, choices: Choices) -> Self:
        """The usual settings, for a program that was read with these choices."""
        return cls(marks=choices.marks, dialect=choices.dialect, unit=choices.unit, registers=choices.registers)

    @property
    def demands(self) -> Demands:
        """What the program is held against. SettingsError where wire and gap leave no kerf."""
        table = self.machine.table if self.machine else None
        start = self.start_mm or (table and (table.travel_x_mm / 2.0, table.travel_y_mm / 2.0))
        start_um = start and (from_mm(start[0]), from_mm(start[1]))
        kerfs = self._kerfs
        offset_um = self._offset_um if kerfs is None else kerfs.reach(1).um
        return Demands(table, start_um, offset_um, self.may_stay_open, kerfs=kerfs, lean=self._lean)

    @property
    def _lean(self) -> "LeanDemands | None":
        """What is known of the lean; None where nobody says how high the work is."""
        if self.thickness_mm is None:
            return None
        from sim.check.lean import LeanDemands  # noqa: PLC0415 - most checks know no height
        from sim.setup.machine.guides import Guides  # noqa: PLC0415
        from sim.setup.taper import TaperSettings  # noqa: PLC0415

        guides = None if self.machine is None else self.machine.guides
        return LeanDemands(self.taper or TaperSettings(), guides or Guides(), self.thickness_mm)

    @property
    def _kerfs(self) -> "Kerfs | None":
        """How wide the wire cuts. SettingsError where the technology does not know that, or what is known besides."""
        technology = self.technology
        if technology is None:
            if self.material is not None:
                raise SettingsError("material-without-technology", material=self.material)
            return None
        if self.spark_gap_um is not None:
            raise SettingsError("technology-tells-gap", where=technology.name, key="--gap")
        from sim.check.kerf_offsets import Kerfs  # noqa: PLC0415 - most checks know no technology
        from sim.setup.technology import passes_of  # noqa: PLC0415

        wire_um = DEFAULT_WIRE.diameter_um if self.wire_diameter_um is None else self.wire_diameter_um
        return Kerfs(0.5 * wire_um, passes_of(technology, self.material, wire_um, self.thickness_mm))

    @property
    def _offset_um(self) -> float | None:
        given = {key.path: getattr(self, field) for field, key in WIRE_LENGTHS.items()}
        known = {name: length for name, length in given.items() if length is not None}
        return replace(DEFAULT_WIRE, **known).reach_um if known else None

    def with_options(self, given: Mapping[str, Any]) -> Self:
        """The settings with fields, by their names, as the command line gives them; single registers it leaves stay."""
        registers = merged([self.registers, given.get("registers", ())])
        return replace(self, **{**given, "registers": registers}, by_options=frozenset(given))

    def silencer(self, code: str) -> Literal["", "options", "settings"]:
        """What keeps findings of a code from being shown: nothing, or options, or else settings."""
        hidden_by = {
            "select": bool(self.select) and not code.startswith(self.select),
            "ignore": code.startswith(self.ignore),
            "ignore_here": code.startswith(self.ignore_here),
        }
        keys = {key for key, hides in hidden_by.items() if hides}
        if not keys:
            return ""
        return "options" if keys & self.by_options else "settings"

    def shows(self, code: str) -> bool:
        """Whether findings of a code were selected and not ignored."""
        return not self.silencer(code)
