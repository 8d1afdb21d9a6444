"""Settings of a check: those of ``drycut.toml`` or ``[tool.drycut]`` near the file, under those of the command line."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from parser.dialect.reader import Marks
from parser.findings.codes import CODES, Severity
from parser.findings.errors import SettingsError
from parser.program import block_words, own_marks
from parser.units import from_mm
from sim.check.engine import Demands
from sim.setup.toml.reader import load_toml, number, pair, refuse_unknown, section, truth
from sim.setup.wire import DEFAULT_WIRE, SPARK_GAP_MM, WIRE_DIAMETER_MM

if TYPE_CHECKING:
    from sim.setup.machine.machine import Machine

FILE = "drycut.toml"
_KEYS = ("machine", "start_mm", "open", "select", "ignore", "fail_on", "end_marks", "pause_marks", "wire")
_WIRE = {"diameter_mm": WIRE_DIAMETER_MM, "spark_gap_mm": SPARK_GAP_MM}


@dataclass(frozen=True, slots=True)
class CheckSettings:
    """What a file is checked with.

    Attributes
    ----------
    machine, start_mm
        Table that the program is to fit on, and its start there; the middle of the travel where `start_mm` is None.
    wire_diameter_um, spark_gap_um
        Wire; where only one is given the other is that of the usual wire.
    may_stay_open
        Whether contours may end away from their own path.
    select, ignore
        Beginnings of the codes that are shown, and of those that are not; an empty `select` is all.
    fail_on
        Least severity that makes the exit code 1.
    marks
        Further end and pause marks.
    """

    machine: "Machine | None" = None
    start_mm: tuple[float, float] | None = None
    wire_diameter_um: float | None = None
    spark_gap_um: float | None = None
    may_stay_open: bool = False
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    fail_on: Severity = Severity.ERROR
    marks: Marks = Marks()  # noqa: RUF009 - frozen

    @property
    def demands(self) -> Demands:
        """What the program is held against. SettingsError where wire and gap leave no kerf."""
        table = self.machine.table if self.machine else None
        start = self.start_mm or (table and (table.travel_x_mm / 2.0, table.travel_y_mm / 2.0))
        start_um = start and (from_mm(start[0]), from_mm(start[1]))
        return Demands(table, start_um, self._offset_um, self.may_stay_open)

    @property
    def _offset_um(self) -> float | None:
        given = {"diameter_um": self.wire_diameter_um, "spark_gap_um": self.spark_gap_um}
        known = {name: length for name, length in given.items() if length is not None}
        return replace(DEFAULT_WIRE, **known).reach_um if known else None

    def shows(self, code: str) -> bool:
        """Whether findings of a code were selected and not ignored."""
        selected = not self.select or code.startswith(self.select)
        return selected and not (self.ignore and code.startswith(self.ignore))


def settings_near(folder: Path) -> CheckSettings:
    """Settings of the nearest settings file from a folder upwards; the defaults where there is none.

    Raises FileUnreadableError or SettingsError with file and key.
    """
    return _near(folder.resolve())


def code_list(value: object, where: str) -> tuple[str, ...]:
    """Codes or their beginnings, such as ``3B2``. SettingsError for one that no code begins with."""
    if not isinstance(value, list) or not all(isinstance(code, str) for code in value):
        raise SettingsError(f"{where} is a list of codes; found {value!r}")
    codes = tuple(code.strip().upper() for code in value if code.strip())
    for code in codes:
        if not any(known.startswith(code) for known in CODES):
            raise SettingsError(f"{where}: no code begins with {code!r}; they are {_first_last()}")
    return codes


def severity(value: object, where: str) -> Severity:
    """Least severity that fails: warning or error. SettingsError otherwise."""
    if value not in (Severity.WARNING, Severity.ERROR):
        raise SettingsError(f'{where} is "warning" or "error"; found {value!r}')
    return Severity(str(value))


@cache
def _near(folder: Path) -> CheckSettings:
    for here in (folder, *folder.parents):
        if (here / FILE).is_file():
            return _read(load_toml(here / FILE), here / FILE)
        project = here / "pyproject.toml"
        tables = load_toml(project).get("tool", {}) if project.is_file() else {}
        if isinstance(tables, Mapping) and "drycut" in tables:
            return _read(section(tables, "drycut", str(project)), project)
    return CheckSettings()


def _read(content: Mapping[str, Any], file: Path) -> CheckSettings:
    where = str(file)
    refuse_unknown(content, _KEYS, where)
    wire = section(content, "wire", where)
    refuse_unknown(wire, _WIRE, f"{where}: [wire]")
    lengths = {key: from_mm(number(wire[key], _WIRE[key], f"{where}: [wire]: {key}")) for key in wire}
    settings = CheckSettings(
        machine=_machine(content, file),
        start_mm=pair(content, "start_mm", where),
        wire_diameter_um=lengths.get("diameter_mm"),
        spark_gap_um=lengths.get("spark_gap_mm"),
        may_stay_open=truth(content, "open", where),
        select=code_list(content.get("select", []), f"{where}: select"),
        ignore=code_list(content.get("ignore", []), f"{where}: ignore"),
        marks=_marks(content, where),
    )
    if "fail_on" in content:
        settings = replace(settings, fail_on=severity(content["fail_on"], f"{where}: fail_on"))
    return settings


def _machine(content: Mapping[str, Any], file: Path) -> "Machine | None":
    name = content.get("machine")
    if name is None:
        return None
    if not isinstance(name, str):
        raise SettingsError(f"{file}: machine is the name of a machine, or its .toml file; found {name!r}")
    from sim.setup.machine.machine import load_machine  # noqa: PLC0415 - most checks know no machine

    return load_machine(name, beside=file.parent)


def _marks(content: Mapping[str, Any], where: str) -> Marks:
    """Marks that neither are a word of blocks nor mean two things at once."""
    own, of_blocks = own_marks(), block_words()
    end, pause = _words(content, "end_marks", where), _words(content, "pause_marks", where)
    for key, words, other in (("end_marks", end, (*own.pause, *pause)), ("pause_marks", pause, (*own.end, *end))):
        for word in words:
            if word in of_blocks:
                raise SettingsError(f"{where}: {key}: {word!r} is a word of blocks; a mark is another")
            if word in other:
                raise SettingsError(f"{where}: {key}: {word!r} cannot both end and pause a program")
    return Marks(end, pause)


def _words(content: Mapping[str, Any], key: str, where: str) -> tuple[str, ...]:
    """Marks: words of one to four letters."""
    words = content.get(key, [])
    if not isinstance(words, list) or not all(
        isinstance(word, str) and word.isascii() and word.isalpha() and len(word) <= 4 for word in words
    ):
        raise SettingsError(f"{where}: {key} is a list of marks of up to four letters; found {words!r}")
    return tuple(word.upper() for word in words)


def _first_last() -> str:
    codes = sorted(CODES)
    return f"{codes[0]} to {codes[-1]}"
