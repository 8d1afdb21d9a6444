"""Models of what the server answers, from which the types of the page's script are written (`make pages`).

Places in a text count units of UTF-16, as a page does.
"""

from typing import Annotated, Literal, NotRequired, Required, TypedDict

from parser.documents import Code, Point, SaidEntry, SeverityName, of_length, one_of
from sim.show.index_page.model import FindingCountEntry, VerdictName
from sim.show.replay.model import CurvesEntry

Outcome = Annotated[str, one_of("pass", "to-check", "incomplete", "fail", "none")]
EditEntry = Annotated[tuple[int, int, str], "first, past, the text in their place"]
Box = Annotated[list[float], of_length(4, 4)]
"""Left, bottom, right, top."""


class RecentEntry(TypedDict):
    """A file that was opened before, and the number that it has as a program."""

    name: str
    folder: str
    number: str


class MachineFileEntry(TypedDict):
    """A machine file that came to the page: the name by which a form names it, and what people call the machine."""

    name: str
    title: SaidEntry


class FileTextEntry(TypedDict):
    """A file as a text with lines that end with LF, and what brings back its bytes; of a drawing its number."""

    name: str
    text: Annotated[str | None, "null where it is none"]
    encoding: str
    newline: Annotated[str, "how all lines end; where they end in several ways, a letter for each"]
    number: Annotated[str, "of the program whose file it is; empty where it came to the page"]
    drawing: NotRequired[str]
    machine: NotRequired[MachineFileEntry]
    technologies: NotRequired[Annotated[list[MachineFileEntry], "one for each material that the file knows"]]
    why: NotRequired[Annotated[SaidEntry, "what was to be open at the start could not be, or is no machine"]]
    recent: NotRequired[Annotated[list[RecentEntry], "where nothing is open at the start"]]


class PlacementEntry(TypedDict):
    """Where a drawing lies beneath a program: mirrored, x to −x, then turned about (0, 0), then shifted."""

    turn_rad: float
    shift_um: Point
    mirror: bool


class LookedEntry(TypedDict):
    """A drawing: its curves as they lie beneath the program, and what there is to say; else why not."""

    unit: NotRequired[str]
    curves: NotRequired[CurvesEntry]
    placement: NotRequired[PlacementEntry]
    told: list[SaidEntry]
    why: NotRequired[SaidEntry | None]


class PlannedFigureEntry(TypedDict):
    """A figure of a plan: its number, of each of its contours the first row and one past its last, and how it is cut.

    It is cut from `entry_um` on the drawing, with the wire towards `out`, a unit vector; `is_ccw` is its direction in
    the drawing, `is_inside` whether the wire runs inside of it. `tab_um` is where its tab begins, none where it has
    none.
    """

    number: int
    spans: list[list[int]]
    thread_um: Point
    entry_um: Point
    out: Point
    is_ccw: bool
    is_inside: bool
    tab_um: Point | None


class PlannedEntry(TypedDict):
    """What would be cut of a drawing, as it lies beneath the program, not proved; else why nothing."""

    path: NotRequired[CurvesEntry]
    is_lead: NotRequired[list[bool]]
    row_pass: NotRequired[Annotated[list[int], "pass of its figure that each block is of, from 1; 0 of others"]]
    is_left: NotRequired[Annotated[list[bool], "whether the waste is on the left of each block"]]
    figures: NotRequired[Annotated[list[PlannedFigureEntry], "in the order in which they are cut"]]
    told: NotRequired[list[SaidEntry]]
    why: NotRequired[SaidEntry | None]


class DraftedEntry(TypedDict):
    """The program that was made of a drawing, none where it was refused; what there is to say, and of its proof."""

    program: FileTextEntry | None
    told: list[SaidEntry]
    verdict: Annotated[str, one_of("pass", "to-check", "incomplete", "fail")]


class FindingEntry(TypedDict):
    """A finding of a text."""

    code: Code
    severity: SeverityName
    title: SaidEntry
    message: SaidEntry
    hint: SaidEntry
    line: Annotated[int, "from 1; 0 of the whole program"]
    block: int
    block_name: Annotated[str, "as the listing has it"]
    first: int
    past: int
    edits: Annotated[list[EditEntry], "that certainly mend it"]


class ExplainedEntry(TypedDict):
    """The page of a code, Markdown."""

    why: SaidEntry
    mend: SaidEntry


class SourcesEntry(TypedDict):
    """Where each block stands in the text."""

    line: list[int]
    first: list[int]
    past: list[int]
    name: Annotated[list[str], "of each block as the listing has it"]


class PathEntry(CurvesEntry, SourcesEntry):
    """A path: its columns, where each block stands in the text, and when it begins; `border_s` has n + 1."""

    border_s: Annotated[list[float], "at the machine's feeds"]
    is_lead: list[bool]


class FigureEntry(TypedDict):
    """A contour by its first and last blocks."""

    first: int
    last: int
    length_um: float
    closes: Annotated[bool | None, "null of a parting cut"]
    thread_um: Point


class SizeEntry(TypedDict):
    """How large a program is."""

    lines: int
    arcs: int
    rapids: int
    cut_um: float
    box_um: Box | None
    steps: int
    time: Annotated[SaidEntry, "about how long the cut takes"]


class AnswerEntry(TypedDict):
    """What is found in a text, and its path."""

    name: str
    dialect: str
    verdict: Outcome
    settings: Annotated[str, "why the settings near its file do not count; else empty"]
    findings: list[FindingEntry]
    pages: Annotated[dict[str, ExplainedEntry], "of their codes"]
    path: PathEntry | None
    figures: list[FigureEntry]
    size: SizeEntry | None
    machine: Annotated[SaidEntry, "whose feeds and travel count"]


class ChangeEntry(TypedDict):
    """Lines that are others than in an earlier text."""

    line: Annotated[int, "from 1, in the text after"]
    before: str
    after: str
    lines: Annotated[list[int], of_length(2, 2), "how many before and after; of long ones the first are told"]


class ChangesEntry(TypedDict):
    """The places where the lines of two texts differ."""

    places: list[ChangeEntry]
    more: Annotated[int, "places that are not told"]


class RowEntry(TypedDict):
    """A program in a list."""

    file: str
    title: str
    verdict: VerdictName
    message: Annotated[SaidEntry | None, "why there is no program"]
    findings: Annotated[list[FindingCountEntry], "the worst first"]
    titles: Annotated[dict[str, SaidEntry], "of their codes"]
    picture: Annotated[str, "data of an SVG path"]
    cut_um: float | None
    box_um: Box | None
    number: NotRequired[Annotated[str, "of a program of the folder"]]


class RowsEntry(TypedDict):
    """How far the check of a folder is."""

    rows: list[RowEntry]
    folder: Annotated[str, "empty where none is open"]
    list: Annotated[int, "another one once the folder was looked through again"]
    total: int
    left_out: int
    is_over: bool


class MadeFileEntry(TypedDict):
    """A file of a run."""

    name: str
    bytes: int


class RanEntry(TypedDict, total=False):
    """What a run that ended well tells last."""

    verdict: Literal["pass", "to-check", "fail"]
    machine: SaidEntry
    findings: Annotated[list[FindingEntry], "that the run itself made, beyond those of the check"]
    pages: Annotated[dict[str, ExplainedEntry], "of their codes"]


class RunStateEntry(RanEntry, total=False):
    """How far a run is, or what more is made of it."""

    state: Required[Literal["idle", "running", "done", "wrong", "cancelled"]]
    job: Literal["run", "film", "pictures", "drills", "program"]
    run: int
    stage: str
    at: int
    of: int
    share: float
    why: SaidEntry | None
    files: Annotated[list[MadeFileEntry], "once it has ended well"]


ANSWERS = (AnswerEntry, ChangesEntry, DraftedEntry, LookedEntry, PlannedEntry, RowsEntry, RunStateEntry)
"""What the server answers; the models of their parts are found from them."""
