"""Model of what a replay's page is handed, and of what its script reads (`assets/document.js`)."""

from typing import Annotated, Literal, TypedDict

from parser.documents import (
    AxisName,
    CurveName,
    Point,
    SaidEntry,
    SeverityName,
    Version,
    of_length,
    one_of,
)

PassPaint = Annotated[str, one_of("kerf", "trim-1", "trim-2", "trim-3", "trim-4")]
Span = Annotated[list[int], of_length(2, 2)]


class ProgramEntry(TypedDict):
    """The program's text, line by line."""

    name: str
    dialect: str
    is_worded: Annotated[bool, "whether the steps are counted by words of the program, not by the controller's own"]
    lines: list[str]


class ClampEntry(TypedDict):
    """A clamp, seen from above."""

    name: str
    outline_um: list[Point]


class CurvesEntry(TypedDict):
    """Columns of n curves, each from the end of the one before it; `place_*` have n + 1.

    What only an arc has is null elsewhere, where nothing asks for it.
    """

    kind: list[CurveName]
    place_x_um: list[float]
    place_y_um: list[float]
    center_x_um: Annotated[list[float], "of an arc"]
    center_y_um: Annotated[list[float], "of an arc"]
    radius_um: Annotated[list[float], "of an arc"]
    start_angle_rad: Annotated[list[float], "of an arc"]
    sweep_rad: Annotated[list[float], "of an arc"]
    length_um: list[float]


class BlocksEntry(CurvesEntry):
    """Columns of n blocks, as of curves; `first_step` and `border_s` have n + 1."""

    word_x_um: list[int]
    word_y_um: list[int]
    count_um: list[int]
    count_axis: list[AxisName]
    quadrant: list[int]
    turn: list[Literal[-1, 0, 1]]
    number: list[int]
    line: list[int]
    character: list[int]
    characters: list[int]
    name: Annotated[list[str], "what people call it"]
    label: Annotated[list[str], "where its number stands beside it; empty where it has none"]
    first_step: list[int]
    border_s: list[float]
    reach_um: Annotated[list[float] | None, "half the width of the kerf, where a technology has it by pass"]


class NamedTextEntry(TypedDict):
    """A text with the name of what it tells."""

    name: SaidEntry
    text: SaidEntry


class DecodeStepEntry(TypedDict):
    """A word decoded, and the field that it sets."""

    order: str
    word: SaidEntry
    field: str
    value: SaidEntry


class DecodedBlockEntry(TypedDict):
    """A block, word by word, the buffer that it leaves, and its way."""

    text: str
    steps: list[DecodeStepEntry]
    buffer: str
    ways: list[NamedTextEntry]


class DecodingEntry(TypedDict):
    """How the blocks are decoded; `of_row` has for each row of the blocks the index of its decoded block, or −1."""

    of_row: list[int]
    blocks: list[DecodedBlockEntry]


class PlanEntry(TypedDict):
    """Columns of p phases; `t_s` has p + 1."""

    t_s: list[float]
    speed_um_s: list[float]
    acceleration_um_s2: list[float]
    jerk_um_s3: list[float] | None


class StopEntry(TypedDict):
    """A pause or the end."""

    kind: str
    after: Annotated[int, "so many blocks"]
    line: int


class ContourEntry(TypedDict):
    """A contour by the rows of its first and last blocks."""

    first_row: int
    last_row: int
    closure_exact_um: float
    closure_stepped_um: float


class PassEntry(TypedDict):
    """A pass over an edge: its rows without leads, and the name of its colour in the style sheet."""

    first_row: int
    last_row: int
    number: int
    paint: PassPaint
    name: SaidEntry


class FindingTextsEntry(TypedDict):
    """What is said of a finding in one language."""

    title: str
    found: str
    expected: str
    machine: str
    hint: str
    message: str


class BothTextsEntry(TypedDict):
    """Texts of a finding in both languages."""

    en: FindingTextsEntry
    zh: FindingTextsEntry


class FindingEntry(TypedDict):
    """A finding; row, time and place are null where it has none."""

    code: str
    severity: SeverityName
    line: int | None
    block: int | None
    block_name: Annotated[str, "as the listing has it; empty where no block is meant"]
    row: int | None
    t_s: float | None
    place_um: Point | None
    texts: BothTextsEntry


class LossEntry(TypedDict):
    """Steps that a stepper lost, or where a servo tripped."""

    kind: str
    axis: AxisName
    row: int
    t_s: float
    amount_um: float
    place_um: Point


class EndingEntry(TypedDict):
    """Where the machine stopped before its program was through, and why."""

    cause: str
    axis: AxisName
    row: int
    t_s: float
    place_um: Point


class PieceEntry(TypedDict):
    """A piece that comes free."""

    kind: str
    row: int
    t_s: float
    area_mm2: float
    mass_g: float
    center_um: Point
    outline_um: list[Point]
    holes_um: list[list[Point]]


class QuestionEntry(TypedDict):
    """A question about a block."""

    row: int
    block: int
    name: Annotated[str, "of the block"]
    about: str | None
    ask: SaidEntry
    answers: list[SaidEntry]
    right: int
    why: SaidEntry
    hidden: Annotated[
        list[Span], "where in the text of the block its answer stands: first character, one past the last"
    ]


class QuizEntry(TypedDict):
    """Questions of the scenario, those of any program, and which of these make a set."""

    own: list[QuestionEntry]
    pool: list[QuestionEntry]
    sets: list[list[int]]


class TapeEntry(TypedDict):
    """Steps and samples; texts are packed columns (sim/show/replay/tape.py)."""

    tick_s: float
    grain_um: float
    origin_um: Point
    steps: int
    moves: str
    step_ticks: str
    samples: int
    sample_ticks: str
    table_x: str
    table_y: str
    wire_x: str | None
    wire_y: str | None
    foot_row: str


class ReplayDocument(TypedDict):
    """A recorded run; rows of blocks count from 0, steps from 1; places and lengths are µm of the program."""

    schema: Literal["drycut.replay/1"]
    drycut: Version
    title: str
    provenance: str
    verdict: Literal["pass", "to-check", "fail"]
    duration_s: float
    program: ProgramEntry
    machine: str
    interpolator: Annotated[str, '"point-by-point", "card" …']
    wire_diameter_um: float
    offset_um: float
    thickness_mm: float
    travel_um: Annotated[list[Point], of_length(2, 2)]
    work_um: list[Point] | None
    clamps: list[ClampEntry]
    has_jumps: bool
    drawing: Annotated[CurvesEntry | None, "that the cut was held against, as it lies on the part"]
    blocks: BlocksEntry
    decoding: Annotated[DecodingEntry | None, "null where the dialect decodes no words, and of long programs"]
    plan: PlanEntry
    stops: list[StopEntry]
    contours: list[ContourEntry]
    passes: Annotated[list[PassEntry], "none where every edge is cut once"]
    findings: list[FindingEntry]
    losses: list[LossEntry]
    ended: EndingEntry | None
    pieces: list[PieceEntry]
    quiz: QuizEntry
    tape: TapeEntry
