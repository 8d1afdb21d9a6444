"""Model of ``report.json`` (docs/report.md)."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    DIALECT,
    AssumptionEntry,
    AxisName,
    BlockCountsEntry,
    CheckProgress,
    Code,
    Count,
    CurveName,
    Document,
    Encoding,
    Judgement,
    Law,
    Ordinal,
    Point,
    Positive,
    SeverityName,
    Size,
    StepPoint,
    Text,
    Version,
    between,
    matching,
    of_length,
    one_of,
)
from sim.run.report.cut_model import RemainsEntry
from sim.run.report.drawing import ComparisonEntry
from sim.run.report.run_model import (
    CardEntry,
    ContourEntry,
    DeviationsEntry,
    EndedEntry,
    InterpolatorEntry,
    LimitEntry,
    LossEntry,
    OffsetBlockEntry,
    OffsetEntry,
    PassEntry,
    SparkEntry,
    ThreadPointEntry,
)
from sim.run.report.taper import TaperEntry

_WITH_ERROR: Final = {"contains": {"properties": {"severity": {"const": "error"}}}}


class HeaderEntry(TypedDict):
    """What the header lines of a 3B program say; an ISO program has none."""

    version: Text | None
    name: Text | None
    corner_radius_um: float | None
    offset_um: float | None
    lengths_um: list[float]


class NoHeaderEntry(TypedDict):
    """What an ISO program says in a header, which it has not."""


class ProgramEntry(TypedDict):
    """The program, and how it was read."""

    name: Text
    title: Text
    provenance: str
    encoding: Encoding
    dialect: Annotated[str, matching(f"^(?:GE card|{DIALECT})$")]
    header: HeaderEntry | NoHeaderEntry


class MachineEntry(TypedDict):
    """The machine, and where the program starts on its table, from the corner of the travel."""

    name: Text
    engine: Annotated[str, one_of("compiled", "pymunk")]
    start_um: Point


class MeasuredEntry(TypedDict):
    """A value of the machine file that was measured, in the unit of its key: 95 of 100 lie no farther off."""

    key: Text
    value: float
    within: Size


class AssumptionsEntry(TypedDict):
    """What the program leaves open, which figures nobody has measured, and what was left out."""

    program: list[AssumptionEntry]
    machine_by_default: bool
    machine_values: list[Text]
    machine_measured: list[MeasuredEntry]
    drawing_compared: bool
    wire_bows: bool


class WireEntry(TypedDict):
    """The wire, and the slot that it cuts."""

    diameter_um: Positive
    spark_gap_um: float
    kerf_um: Size
    lag_um: Size


class GradedEntry(TypedDict):
    """A figure with the interval that 90 % of cuts fall into, how it was come by, and where it stands."""

    value: float
    least: float
    most: float
    grade: Annotated[str, one_of("measured", "maker", "assumed")]
    source: str


class PassTechnologyEntry(TypedDict):
    """What one pass does; null where nobody says."""

    number: Ordinal
    gap_um: GradedEntry
    feed_mm_min: GradedEntry | None
    lag_um: GradedEntry | None
    offset_um: GradedEntry | None
    roughness_um: GradedEntry | None


class TechnologyEntry(TypedDict):
    """What the wire does in the work, pass by pass; name and material null where no technology was named."""

    name: str | None
    material: str | None
    passes: Annotated[list[PassTechnologyEntry], of_length(1)]


class WorkEntry(TypedDict):
    """The work: thickness mm, density g/cm³."""

    thickness_mm: Positive
    density_g_cm3: Size


class SummaryEntry(TypedDict):
    """Blocks of the path, the length of it that ran, and its steps of 1 µm."""

    blocks: Ordinal
    length_um: Size
    steps: Count


class IntervalEntry(TypedDict):
    """Between which times it lies, how sure that is, and how many cuts of the machine say so."""

    least: Size
    most: Size
    level: Annotated[float, between(0, 1)]
    from_cuts: Count


class TimeEntry(TypedDict):
    """Time of the run to its last step, and the share of each block; no interval of what a program in C timed."""

    total: Size
    interval: IntervalEntry | None
    by_block: Annotated[list[Size], of_length(1)]


class CheckEntry(TypedDict):
    """How far a check came, and why it is not complete."""

    check: Annotated[
        str,
        one_of(
            "grammar",
            "order",
            "blocks",
            "printed-ends",
            "header",
            "steps",
            "contours",
            "senses",
            "crossings",
            "passes",
            "corners",
            "travel",
            "compensation",
            "remains",
            "sparks",
            "taper",
        ),
    ]
    state: CheckProgress
    reason: Text | None


class CoverageEntry(TypedDict):
    """How far the checks came."""

    blocks: BlockCountsEntry
    checks: Annotated[list[CheckEntry], of_length(1)]


class FindingEntry(TypedDict):
    """What is wrong, in English; line, column and block are null where a finding has none."""

    code: Code
    severity: SeverityName
    title: Text
    found: Text
    expected: Text
    machine: Text
    hint: Text
    line: Ordinal | None
    column: Ordinal | None
    block: Ordinal | None
    block_name: Text | None


class StopEntry(TypedDict):
    """A stop of the program, after which block it comes."""

    kind: Annotated[str, one_of("pause", "end")]
    after_block: Count
    line: Ordinal


class SteppedEntry(TypedDict):
    """A block as it is stepped; deviations are null where it never ran."""

    end_um: StepPoint
    steps: Count
    max_deviation_um: Size | None
    interpolation_um: Size | None


class TableEntry(TypedDict):
    """A block as the table moves it."""

    max_deviation_um: Size | None


class ExactStraightEntry(TypedDict):
    """Exact geometry of a line or a jump."""

    start_um: Point
    end_um: Point
    center_um: None
    radius_um: None
    sweep_deg: None
    start_angle_deg: None
    end_angle_deg: None
    is_major: Literal[False]
    length_um: Size


class ExactArcEntry(TypedDict):
    """Exact geometry of an arc."""

    start_um: Point
    end_um: Point
    center_um: Point
    radius_um: Positive
    sweep_deg: float
    start_angle_deg: Annotated[float, between(-180, 180)]
    end_angle_deg: float
    is_major: bool
    length_um: Size


class BlockEntry(TypedDict):
    """A block of the path; words to count by are null where the dialect has none."""

    block: Ordinal
    line: Ordinal
    label: Annotated[str, matching(r"^N[0-9]+$")] | None
    text: Text
    kind: CurveName
    count_um: Count | None
    radius_um: Count | None
    curve: Annotated[str, one_of("convex", "concave")] | None
    count_axis: AxisName | None
    exact: ExactStraightEntry | ExactArcEntry
    stepped: SteppedEntry
    table: TableEntry
    printed_end_um: Point | None


class ReportDocument(TypedDict):
    """The report of a run, ``report.json``."""

    schema: Literal["drycut.report/1"]
    drycut: Version
    verdict: Judgement
    to_check: bool
    program: ProgramEntry
    machine: MachineEntry
    assumptions: AssumptionsEntry
    wire: WireEntry
    technology: TechnologyEntry
    work: WorkEntry
    offset: OffsetEntry | None
    summary: SummaryEntry
    time_s: TimeEntry
    ended: EndedEntry | None
    contours: list[ContourEntry]
    thread_points: list[ThreadPointEntry]
    passes: list[PassEntry]
    interpolator: InterpolatorEntry
    deviation: DeviationsEntry
    limits: list[LimitEntry]
    losses: list[LossEntry]
    spark: SparkEntry | None
    taper: TaperEntry | None
    remains: RemainsEntry | None
    drawing: ComparisonEntry | None
    coverage: CoverageEntry
    findings: list[FindingEntry]
    stops: list[StopEntry]
    card: CardEntry | None
    blocks: Annotated[list[BlockEntry], of_length(1)]


class CardProgramEntry(TypedDict):
    """A program for the card."""

    name: Text
    title: Text
    dialect: Literal["GE card"]


class CardDocument(TypedDict):
    """The report of a program for the card that moved neither X nor Y."""

    schema: Literal["drycut.card/1"]
    drycut: Version
    verdict: Judgement
    program: CardProgramEntry
    findings: list[FindingEntry]
    card: CardEntry


REPORT: Final = Document(
    ReportDocument,
    "docs/report.md",
    (
        Law(ReportDocument, "verdict", Literal["fail"], {"findings": _WITH_ERROR}, {"findings": {"not": _WITH_ERROR}}),
        Law(BlockEntry, "kind", Literal["arc"], {"exact": ExactArcEntry}, {"exact": ExactStraightEntry}),
        Law(CheckEntry, "state", Literal["complete"], {"reason": None}, {"reason": Text}),
        Law(LimitEntry, "limit", None, {"share": None}, {"share": float}),
        Law(
            OffsetBlockEntry,
            "kind",
            Literal["arc"],
            {"center_um": Point, "radius_um": Size, "sweep_deg": float},
            {"center_um": None, "radius_um": None, "sweep_deg": None},
        ),
    ),
)
