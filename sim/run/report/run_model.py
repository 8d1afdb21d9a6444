"""Models of the parts of the report on how the program ran, and what a program in C asked (docs/report.md).

Model of ``card`` of the report: what a program in C asked of the card (docs/libges.md).
"""

from typing import Annotated, TypedDict

from parser.documents import (
    AxisName,
    BlockRange,
    Count,
    CurveName,
    Ordinal,
    Point,
    Positive,
    Size,
    Slug,
    between,
    matching,
    of_length,
    one_of,
)


class ProgramEndEntry(TypedDict):
    """How a program for the card ended."""

    code: int | None
    signal: str | None
    is_stopped: bool


class RefusalEntry(TypedDict):
    """A refused call that the program did not look at, and what it went on with."""

    line: Ordinal
    call: str
    code: int
    then: str


class LimitStopEntry(TypedDict):
    """A motion that a limit switch ended, of which the program did not ask."""

    line: Ordinal
    t_s: Size
    axis: Annotated[int, between(1, 4)]
    limit: Annotated[str, one_of("positive", "negative")]
    then: str | None


class ShortSleepEntry(TypedDict):
    """A sleep that was over before the axes stood, and the calls that were refused for that."""

    line: Ordinal
    slept_s: Size
    needed_s: Size
    refused: Annotated[list[str], of_length(1)]


class CardEntry(TypedDict):
    """What a program asked of the card, and how it ended; times s on the card's clock."""

    ended: ProgramEndEntry
    calls: Count
    asked: Count
    time_s: Size
    went_on_s: Size | None
    places: list[Annotated[list[int], of_length(4, 4)]]
    status: Annotated[str, matching(r"^[0-9a-f]{4,8}$")]
    refused: Count
    refused_unread: list[RefusalEntry]
    ended_on_limit: list[LimitStopEntry]
    sleeps_too_short: list[ShortSleepEntry]


class OffsetPassEntry(TypedDict):
    """A pass over each contour: its offset, where it runs to, and its feed as the controller runs it."""

    by_um: Size
    direction: Annotated[str, one_of("forward", "back")]
    feed_um_s: Positive


OffsetBlockEntry = TypedDict(
    "OffsetBlockEntry",
    {
        "block": Ordinal,
        "source_block": Ordinal,
        "pass": Ordinal | None,
        "kind": CurveName,
        "made": Annotated[str, one_of("as-it-is", "lead", "shifted", "bridge")],
        "start_um": Point,
        "end_um": Point,
        "center_um": Point | None,
        "radius_um": Size | None,
        "sweep_deg": float | None,
    },
)


VanishedEntry = TypedDict(
    "VanishedEntry",
    {
        "source_block": Ordinal,
        "pass": Ordinal | None,
        "left_um": Size,
    },
)


class GougeEntry(TypedDict):
    """A place where the wire cuts into the contour: the block of the run, and the block that it cuts into."""

    block: Ordinal
    source_block: Ordinal
    into_source_block: Ordinal
    where_um: Point
    depth_um: Size


class OffsetEntry(TypedDict):
    """The path that the controller makes of a program on the drawing's contour."""

    by_um: Size
    side: Annotated[str, one_of("left", "right")]
    passes: Annotated[list[OffsetPassEntry], of_length(1)]
    blocks: Annotated[list[OffsetBlockEntry], of_length(1)]
    vanished: list[VanishedEntry]
    gouges: list[GougeEntry]
    closed_paths: list[Count]


class EndedEntry(TypedDict):
    """Where the machine stopped before its program was through."""

    cause: Annotated[str, one_of("trip", "travel")]
    axis: AxisName
    block: Ordinal
    t_s: Size
    x_um: float
    y_um: float


class ContourEntry(TypedDict):
    """A stretch of cut blocks with no jump between them; the closure is the distance of its ends."""

    first_block: Ordinal
    last_block: Ordinal
    closure_exact_um: Size
    closure_stepped_um: Size
    time_s: Size


class ThreadPointEntry(TypedDict):
    """Where the wire is threaded and taken out, and how far the path reaches from there."""

    blocks: BlockRange
    at_um: Point
    at_s: Size | None
    out_um: Point
    out_s: Size | None
    left_um: Size
    right_um: Size
    down_um: Size
    up_um: Size


class StockEntry(TypedDict):
    """Material that a pass takes off, on the side of the part."""

    least: Size
    most: Size
    mean: Size


class PassDeviationEntry(TypedDict):
    """The largest deviation of a pass."""

    max_um: Size
    where_um: Point | None


class PassEntry(TypedDict):
    """A pass over an edge."""

    contour: Ordinal
    number: Ordinal
    blocks: BlockRange
    offset_um: float
    direction: Annotated[str, one_of("forward", "back")]
    cuts_tab: bool
    length_um: Size
    time_s: Size
    stock_um: StockEntry | None
    deviation: PassDeviationEntry


class InterpolatorEntry(TypedDict):
    """How the path became steps; periods, axes and chords are of a sampling card alone."""

    name: Annotated[str, one_of("point-by-point", "card")]
    servo_period_s: Positive | None
    axis_um: Annotated[list[Size], of_length(2, 2)] | None
    chord_um: Size | None


class WhereEntry(TypedDict):
    """Block, place and time of the largest deviation."""

    block: Ordinal
    x_um: float
    y_um: float
    t_s: Size


class DeviationEntry(TypedDict):
    """Deviation from the exact path: largest, root mean square, and what 95 % of the length keep to."""

    max_um: Size
    rms_um: Size
    p95_um: Size
    where: WhereEntry | None


class CauseEntry(TypedDict):
    """What a cause adds to the deviation."""

    max_um: Size
    where: WhereEntry | None


class CausesEntry(TypedDict):
    """What each cause adds to the deviation."""

    interpolation: CauseEntry
    carried: CauseEntry
    planning: CauseEntry
    table: CauseEntry
    wire: CauseEntry


class DeviationsEntry(TypedDict):
    """Deviation of the interpolation, of the steps, of the table and of the wire."""

    interpolation: DeviationEntry
    steps: DeviationEntry
    table: DeviationEntry
    wire: DeviationEntry
    by_cause: CausesEntry


class LimitEntry(TypedDict):
    """How near force (N), speed (µm/s) or lag (µm) of an axis came to its limit."""

    quantity: Annotated[str, one_of("force", "speed", "lag")]
    axis: AxisName
    value: Size
    limit: Size | None
    share: Size | None
    block: Ordinal
    t_s: Size
    x_um: float
    y_um: float


class SparkMomentEntry(TypedDict):
    """Something that happened in a cut under sparks, or why the control stopped."""

    kind: Slug
    block: Ordinal
    step: Count
    t_s: Size
    x_um: float
    y_um: float
    deviation: int
    count_left_um: Count


class SparkMarkEntry(TypedDict):
    """A place where a stop or a way back shows on the wall."""

    block: Ordinal
    x_um: float
    y_um: float
    depth_um: float
    within_um: Size


class SparkTimeEntry(TypedDict):
    """Times between which a share `level` of runs of other seeds lie."""

    least: Size
    most: Size
    level: float


class SparkEntry(TypedDict):
    """The cut under sparks: means of the time in which there was something to cut, and what happened."""

    mean_voltage_share: Size
    gap_um: Size
    area_rate_mm2_min: Size
    feed_um_s: Size
    shorts: Count
    breaks: Count
    retreated_um: Size
    lost_s: Size
    time_s: Size
    time_within_s: SparkTimeEntry | None
    sparks: Count
    seed: Count
    stopped: SparkMomentEntry | None
    events: list[SparkMomentEntry]
    events_unlisted: Count
    marks: list[SparkMarkEntry]
    displaced_um: Point | None
    collided_um: Size | None


class LossEntry(TypedDict):
    """Steps that a drive lost, or the error at which a servo tripped."""

    kind: Annotated[str, one_of("lost-steps", "trip")]
    axis: AxisName
    amount_um: float
    least_um: float
    most_um: float
    block: Ordinal
    t_s: Size
    x_um: float
    y_um: float
