"""Scenarios: a program with its machine, wire, work and what is expected of the dry run.

A folder holds ``scenario.toml`` and the program it names; a program alone is a scenario with the defaults.
"""

from dataclasses import dataclass
from pathlib import Path

from parser.encoding import printable
from parser.errors import FileUnreadableError, SettingsError
from parser.units import from_mm, mm
from sim.controller_model import interpolation
from sim.expect import Expectation, read_expectation
from sim.machine import Machine, load_machine
from sim.settings import Bound, load_toml, numbers, pair, refuse_unknown, section, text, truth
from sim.wire import DEFAULT_WIRE, SPARK_GAP_MM, WIRE_DIAMETER_MM, Wire

THICKNESS_MM = Bound(0.01, 2000.0)
_WIRE = {"diameter_mm": WIRE_DIAMETER_MM, "spark_gap_mm": SPARK_GAP_MM}
_WORK = {"thickness_mm": THICKNESS_MM}
_KEYS = ("title", "provenance", "program", "machine", "interpolator", "start_mm", "open", "wire", "work", "expect")

DEFAULT_MACHINE = "dk7740"
DEFAULT_THICKNESS_MM = 40.0


@dataclass(frozen=True, slots=True)
class Scenario:
    """One case to dry-run.

    Attributes
    ----------
    title
        Title line of pictures and tables.
    program
        Program file.
    machine, wire, thickness_mm
        What it is cut on, with and through.
    start_mm
        Place of the program's start on the table, (x, y) from the corner of the travel; the centre where None.
    provenance
        Where the program comes from.
    may_stay_open
        Whether contours may end away from their own path; else that is a finding.
    expect
        What the scenario promises of its report; checked after the run.
    """

    title: str
    program: Path
    machine: Machine
    wire: Wire = DEFAULT_WIRE
    thickness_mm: float = DEFAULT_THICKNESS_MM
    start_mm: tuple[float, float] | None = None
    provenance: str = "not given"
    may_stay_open: bool = False
    expect: tuple[Expectation, ...] = ()

    @property
    def start_um(self) -> tuple[float, float]:
        """Place of the program's start on the table, µm."""
        travel = self.machine.table.travel_x_mm / 2.0, self.machine.table.travel_y_mm / 2.0
        x, y = self.start_mm or travel
        return from_mm(x), from_mm(y)


def load_scenario(path: Path) -> Scenario:
    """Scenario of a folder with a ``scenario.toml``, or of a program file with the defaults.

    Raises FileUnreadableError or SettingsError with file and key.
    """
    try:
        is_folder = path.is_dir()
    except OSError as error:
        raise FileUnreadableError(f"{path}: cannot be read: {error.strerror or error}") from None
    if not is_folder:
        return Scenario(printable(path.name), path, load_machine(DEFAULT_MACHINE))
    file = path / "scenario.toml"
    if not file.exists():
        raise SettingsError(f"{path}: is a folder without scenario.toml; give a 3B file or a scenario folder")
    content, where = load_toml(file), str(file)
    refuse_unknown(content, _KEYS, where)
    machine = load_machine(text(content, "machine", where, default=DEFAULT_MACHINE), beside=path)
    if "interpolator" in content:
        machine = machine.stepping_by(interpolation(text(content, "interpolator", where), f"{where}: interpolator"))
    wire = numbers(section(content, "wire", where), _WIRE, f"{where}: [wire]", _wire_defaults())
    work = section(content, "work", where)
    work_numbers = numbers(work, _WORK, f"{where}: [work]", {"thickness_mm": DEFAULT_THICKNESS_MM})
    return Scenario(
        title=printable(text(content, "title", where, default=path.resolve().name)),
        program=path / text(content, "program", where, default="program.3b"),
        machine=machine,
        wire=Wire(from_mm(wire["diameter_mm"]), from_mm(wire["spark_gap_mm"])),
        start_mm=pair(content, "start_mm", where),
        provenance=text(content, "provenance", where, default="not given"),
        may_stay_open=truth(content, "open", where),
        expect=read_expectation(section(content, "expect", where), f"{where}: [expect]"),
        **work_numbers,
    )


def _wire_defaults() -> dict[str, float]:
    return {"diameter_mm": mm(DEFAULT_WIRE.diameter_um), "spark_gap_mm": mm(DEFAULT_WIRE.spark_gap_um)}
