"""Scenarios: a program with its machine, wire, work and what is expected of the dry run.

A folder holds ``scenario.toml`` and the program it names; a program alone is a scenario with the defaults.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from parser.dialect.reader import (
    Choices,
    ChosenDialect,
    Registers,
    merged,
)
from parser.findings.catalogue import Bilingual, Language
from parser.findings.errors import FileUnreadableError, SettingsError, system_message
from parser.program import suffixes
from parser.text.encoding import printable
from parser.units import from_mm, mm
from sim.setup.dialect import READ_WITH, chosen_dialect
from sim.setup.expectations import EXPECT, Expectation, expect_section, read_expectation
from sim.setup.machine.guides import GUIDES, Guides, read_guides
from sim.setup.machine.machine import Machine, load_machine
from sim.setup.making import LAYER, PROGRAM, LayerWish, ToMake, read_to_make
from sim.setup.obstacles import CLAMPS, Clamp, Outline, read_clamps
from sim.setup.part import (
    DEFAULT_DENSITY_G_CM3,
    DEFAULT_THICKNESS_MM,
    DENSITY_G_CM3,
    DRAWING,
    OFFSET,
    PASS,
    SHEET,
    THICKNESS_MM,
    WORK,
    DrawingTarget,
    JobFields,
    Offset,
    OffsetPass,
    read_drawing_target,
    read_offset,
)
from sim.setup.quiz import QUIZ, Question, read_quiz
from sim.setup.settable import INTERPOLATOR, KERF, MAY_STAY_OPEN, PAST_STOP, with_settings
from sim.setup.spark import EVENT, SPARK, Event, Spark, read_events, read_spark
from sim.setup.taper import TAPER, TaperSettings, read_taper
from sim.setup.technology import (
    Choice,
    PassTechnology,
    Technology,
    assumed_pass,
    load_technology,
    material_of,
    pass_of,
    passes_at,
)
from sim.setup.toml.keys import Key, Section, WrittenSection
from sim.setup.toml.kinds import FileName, Name, Number, TablePlace, Text
from sim.setup.toml.reader import Bound, load_toml, number, section
from sim.setup.wire import DEFAULT_WIRE, LAG, LAG_KEYS, SPARK_GAP, WIRE, Wire, read_wire

MACHINE_FILE = "machine.toml"
"""Name of the machine file beside a scenario file that is written."""
TECHNOLOGY_FILE = "technology.toml"
"""The same of the technology file."""
TRACE_SPACING_UM = Bound(0.1, 1e4)
_BOUNDS = {"thickness_mm": THICKNESS_MM, "trace_spacing_um": TRACE_SPACING_UM, "density_g_cm3": DENSITY_G_CM3}
DEFAULT_MACHINE = "dk7740"
DEFAULT_TRACE_SPACING_UM = 5.0
"""On an arc of 100 µm radius the chord of it is 0.03 µm off."""


@dataclass(frozen=True, slots=True)
class Scenario:
    """One case to dry-run. SettingsError for a number out of its bounds, or a lag too large in work of this thickness.

    Attributes
    ----------
    title, title_zh
        Title line of pictures and tables, and the same in Chinese where that is another one.
    program
        Program file.
    machine, wire, thickness_mm
        What it is cut on, with and through.
    start_mm
        Place of the program's start on the table, (x, y) from the corner of the travel; the centre where None.
    provenance
        Where the program comes from.
    dialect, unit, registers
        What is told of the program beside its text, as `Choices` has it; without the registers of the machine.
    may_stay_open
        Whether contours may end away from their own path; else that is a finding.
    past_stop
        Whether the run goes on where the path leaves the travel and the table stands against its end stop; else it ends
        there.
    trace_spacing_um
        Path between two samples of the trace.
    clamps, work_um
        What stands beside the path, and the outline of the workpiece, if known; in the program's coordinates.
    offset
        What the controller adds to the program; None where it runs as written.
    kerf
        Whether the kerf and the pieces that it leaves are worked out.
    drawing
        What the cut is held against, if anything.
    density_g_cm3
        Density of the work.
    quiz
        What the replay asks a trainee.
    to_make
        How its program is made of its drawing; None where there is no more to it than the file. A file that stands
        there is what runs all the same.
    sheet
        What a shop writes on the sheet of the job.
    expect
        What the scenario promises of its report; checked after the run.
    technology, material
        What the wire does in a material, and which that is; the only one that it knows where None. The gap and the lag
        of `wire` are then those of the first pass.
    spark
        Sparks under which it is cut too (docs/sparks.md); None where nobody asked for that.
    events
        What happens in that cut.
    taper, guides
        What is told of a wire that leans beside the program, and its guides; those of the machine where None.
    machine_by_default
        Whether nobody named a machine. A file that is written names it, and makes the same run all the same.
    """

    title: str
    program: Path
    machine: Machine
    wire: Wire = DEFAULT_WIRE
    thickness_mm: float = DEFAULT_THICKNESS_MM
    start_mm: tuple[float, float] | None = None
    provenance: str = "not given"
    dialect: ChosenDialect = ""
    unit: str = ""
    registers: Registers = ()
    may_stay_open: bool = False
    past_stop: bool = False
    trace_spacing_um: float = DEFAULT_TRACE_SPACING_UM
    clamps: tuple[Clamp, ...] = ()
    work_um: Outline | None = None
    offset: Offset | None = None
    kerf: bool = False
    drawing: DrawingTarget | None = None
    density_g_cm3: float = DEFAULT_DENSITY_G_CM3
    quiz: tuple[Question, ...] = ()
    to_make: ToMake | None = None
    title_zh: str | None = None
    sheet: JobFields = JobFields()  # noqa: RUF009 - frozen
    expect: tuple[Expectation, ...] = ()
    technology: Technology | None = None
    material: str | None = None
    spark: Spark | None = None
    events: tuple[Event, ...] = ()
    taper: TaperSettings | None = None
    guides: Guides | None = None
    machine_by_default: bool = field(default=False, compare=False)

    def __post_init__(self) -> None:
        """Check the numbers, and that the wire has a lag in this work; the wire cuts as the technology says."""
        for name, bound in _BOUNDS.items():
            number(getattr(self, name), bound, name)
        if self.technology is not None:
            first = self.pass_technologies[0]
            lag_um = self.wire.lag if first.lag_um is None else first.lag_um.value
            wire = replace(self.wire, spark_gap_um=first.gap_um.value, lag=lag_um)
            object.__setattr__(self, "wire", wire)
        elif self.material is not None:
            raise SettingsError("material-without-technology", material=self.material)
        self.wire.lag_um(self.thickness_mm)

    @property
    def cut_material(self) -> str | None:
        """What is cut, None without a technology. SettingsError where it knows several, and none is named."""
        return self.material if self.technology is None else material_of(self.technology, self.material)

    @property
    def pass_technologies(self) -> tuple[PassTechnology, ...]:
        """What each pass does, as the technology says; without one a single pass, assumed.

        SettingsError where the technology knows nothing of the material or of the wire.
        """
        if self.technology is None or self.cut_material is None:
            feed_um_s = self.machine.cut_um_s(self.thickness_mm, self.machine.area_rate_mm2_min)
            return (assumed_pass(self.wire.spark_gap_um, mm(feed_um_s) * 60.0, self.wire_lag_um, self.machine.name),)
        return passes_at(self.technology, Choice(self.cut_material, self.wire.diameter_um, self.thickness_mm))

    def technology_of(self, number: int) -> PassTechnology:
        """What the pass of a number does, from 1; one that is not known does what the nearest before it does."""
        return pass_of(self.pass_technologies, number)

    @property
    def titles(self) -> Bilingual:
        """Its title in both languages."""
        return Bilingual(self.title, self.title_zh or self.title)

    def title_in(self, language: Language) -> str:
        """Its title in a language."""
        return self.titles.zh if language == "zh" else self.title

    @property
    def choices(self) -> Choices:
        """What the program is read with."""
        registers = merged([self.machine.controller.registers, self.registers])
        return Choices(dialect=self.dialect, unit=self.unit, registers=registers)

    @property
    def layer_wishes(self) -> tuple[LayerWish, ...]:
        """What is asked of the contours of some layers where its program is made."""
        return () if self.to_make is None else self.to_make.making.layers

    @property
    def known_guides(self) -> Guides:
        """Guides of its own, else those of its machine, else usual ones."""
        return self.guides or self.machine.guides or Guides()

    @property
    def wire_lag_um(self) -> float:
        """How far the wire bows back behind its guides."""
        return self.wire.lag_um(self.thickness_mm)

    def reach_um(self, number: int) -> float:
        """Half the width of the kerf of a pass, from 1."""
        return self.wire.radius_um + self.technology_of(number).gap_um.value

    def lag_um(self, number: int) -> float:
        """How far the wire bows back in a pass, from 1."""
        of_pass = self.technology_of(number)
        return self.wire_lag_um if of_pass.lag_um is None else of_pass.lag_um.value

    @property
    def pass_feeds_um_s(self) -> tuple[float, ...]:
        """Feed of each pass of its offset as the controller runs it, µm/s; none without an offset."""
        passes = () if self.offset is None else self.offset.passes
        return tuple(self._pass_feed_um_s(pass_, number) for number, pass_ in enumerate(passes, start=1))

    @property
    def pass_tables(self) -> tuple[OffsetPass, ...]:
        """Passes that its file tells one by one: none where ``[offset]`` says all of it."""
        return () if self.offset is None or self.offset.is_plain else self.offset.passes

    def _pass_feed_um_s(self, offset_pass: OffsetPass, number: int) -> float:
        if offset_pass.feed_um_s is not None:
            return self.machine.held_um_s(offset_pass.feed_um_s)
        if offset_pass.area_rate_mm2_min is not None:
            return self.machine.cut_um_s(self.thickness_mm, offset_pass.area_rate_mm2_min)
        return self.technology_feed_um_s(number)

    def technology_feed_um_s(self, number: int) -> float:
        """Feed of a pass as the controller runs it, µm/s: the technology's, else by the machine's own area rate."""
        feed_mm_min = self.technology_of(number).feed_mm_min
        if self.technology is None or feed_mm_min is None:
            return self.machine.cut_um_s(self.thickness_mm, self.machine.area_rate_mm2_min)
        return self.machine.held_um_s(from_mm(feed_mm_min.value) / 60.0)

    @property
    def start_um(self) -> tuple[float, float]:
        """Place of the program's start on the table, µm."""
        travel = self.machine.table.travel_x_mm / 2.0, self.machine.table.travel_y_mm / 2.0
        x, y = self.start_mm or travel
        return from_mm(x), from_mm(y)


def without_sparks(scenario: Scenario) -> Scenario:
    """The scenario for a run of its table alone: no sparks, no kerf, no drawing."""
    return replace(scenario, spark=None, events=(), kerf=False, drawing=None, expect=())


def _usual_names() -> tuple[str, ...]:
    """Names that programs in scenario folders go by, the most usual first."""
    return tuple(f"program{suffix}" for suffix in suffixes())


def _plain_program(scenario: Scenario) -> Path | None:
    """Its program where no section tells of it: a file has one or the other by that name."""
    return scenario.program if scenario.to_make is None else None


TOP = Section(
    "scenario",
    (
        Key("title", Name(), default=None),
        Key("title_zh", Name(), default=None),
        Key("provenance", Text(), default="not given"),
        Key("program", FileName(), default=_usual_names()[0], get=_plain_program),
        Key("machine", Text(), default=DEFAULT_MACHINE, get=lambda _: MACHINE_FILE),
        *READ_WITH,
        INTERPOLATOR,
        Key("technology", FileName(), default=None, get=lambda scenario: scenario.technology and Path(TECHNOLOGY_FILE)),
        Key("start_mm", TablePlace(), default=None),
        MAY_STAY_OPEN,
        PAST_STOP,
        Key("trace_spacing_um", Number(TRACE_SPACING_UM, "µm"), default=DEFAULT_TRACE_SPACING_UM),
        KERF,
    ),
    form="top",
)
SECTIONS = (
    *(TOP, WIRE, WORK, SHEET, OFFSET, PASS, DRAWING, PROGRAM, LAYER),
    *(CLAMPS, SPARK, EVENT, TAPER, GUIDES, QUIZ, EXPECT),
)
"""Sections of a scenario file."""


def load_scenario(path: Path | str) -> Scenario:
    """Scenario of a folder with a ``scenario.toml``, or of a program file with the defaults.

    Raises FileUnreadableError or SettingsError with file and key.
    """
    path = Path(path)
    try:
        is_folder = path.is_dir()
    except OSError as error:
        raise FileUnreadableError("cannot-be-read", file=path, why=system_message(error)) from None
    if not is_folder:
        return Scenario(printable(path.name), path, load_machine(DEFAULT_MACHINE), machine_by_default=True)
    file = path / "scenario.toml"
    if not file.exists():
        raise SettingsError("folder-without-scenario", path=path)
    content, where = load_toml(file), str(file)
    drawing = read_drawing_target(content, where, path)
    to_make = read_to_make(content, where, drawing)
    top = content if to_make is None else {**content, "program": str(to_make.file)}
    value = TOP.read(top, where, others=(section.name for section in SECTIONS[1:]))
    machine = load_machine(value.pop("machine"), folder=path)
    technology = value.pop("technology")
    if technology is not None:
        refuse_gap(section(content, "wire", where), f"{where}: [wire]")
    spark, events = read_spark(content, where), read_events(content, where)
    interpolator, program = value.pop("interpolator"), value.pop("program")
    value["dialect"] = chosen_dialect(value["dialect"], path, {}, where)
    scenario = Scenario(
        title=value.pop("title") or printable(path.resolve().name),
        program=path / (program if "program" in content else _usual_name(path)),
        machine=machine if interpolator is None else machine.stepping_by(interpolator),
        wire=read_wire(section(content, "wire", where), f"{where}: [wire]"),
        clamps=read_clamps(content, where),
        offset=read_offset(content, where),
        drawing=drawing,
        to_make=to_make,
        quiz=read_quiz(content, where),
        technology=technology and load_technology(path / technology),
        sheet=JobFields(**SHEET.read_in(content, where)),
        expect=read_expectation(section(content, "expect", where), f"{where}: [expect]"),
        spark=spark,
        events=events,
        taper=read_taper(content, where, path),
        guides=read_guides(content, where),
        machine_by_default="machine" not in content,
        **value,
        **WORK.read_in(content, where),
    )
    return under_sparks(scenario) if events else scenario


def under_sparks(scenario: Scenario, seed: int | None = None) -> Scenario:
    """The scenario cut under its own sparks, else under those of its machine, else under usual ones; by a seed."""
    spark = scenario.spark or scenario.machine.spark or Spark()
    return replace(scenario, spark=spark if seed is None else spark._replace(seed=seed))


def with_values(scenario: Scenario, values: Mapping[str, Any], technology: Technology | None = None) -> Scenario:
    """The scenario with values of options, as they are inside, in place of its own, and with a technology if given.

    SettingsError for a gap or a lag beside a technology, which tells both.
    """
    option = next((key.option for key in (SPARK_GAP, LAG) if key.name in values), None)
    if technology is None:
        technology = scenario.technology
    if option is not None and technology is not None:
        raise SettingsError("technology-tells-gap", where=technology.name, key=option)
    return with_settings(scenario, values, technology=technology)


def _without_gap(written: WrittenSection) -> WrittenSection:
    """A ``[wire]`` without what the technology tells."""
    of_technology = {key.name for key in (SPARK_GAP, *LAG_KEYS)}
    return written._replace(values={name: value for name, value in written.values.items() if name not in of_technology})


def refuse_gap(wire: Mapping[str, Any], where: str) -> None:
    """SettingsError where a gap or a lag of the wire is given, though the technology tells both."""
    key = next((key.name for key in (SPARK_GAP, *LAG_KEYS) if key.name in wire), None)
    if key is not None:
        raise SettingsError("technology-tells-gap", where=where, key=key)


def scenario_sections(scenario: Scenario) -> list[WrittenSection]:
    """Sections of the scenario file that asks for the same run, on the machine of ``machine.toml``."""
    tables = [written for section in SECTIONS[:-1] for written in section.written(scenario)]
    if scenario.technology is not None:
        tables = [_without_gap(written) if written.section is WIRE else written for written in tables]
    return [*tables, expect_section(scenario.expect)]


def _usual_name(folder: Path) -> str:
    """Name of the program in a scenario folder that names none: of the usual ones the first that is there."""
    names = _usual_names()
    return next((name for name in names if (folder / name).exists()), names[0])
