"""Model of ``drycut.program/1`` (docs/program.md)."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    BlockRange,
    CheckVerdict,
    Code,
    Count,
    Document,
    Law,
    Ordinal,
    Point,
    Positive,
    Sense,
    SeverityName,
    Size,
    Slug,
    Text,
    Version,
    of_length,
    one_of,
)

_NOTHING: Final = {"maxItems": 0}


class DrawingFileEntry(TypedDict):
    """The drawing: its file, DXF version and unit."""

    name: Text
    version: str
    unit: Text


class FitEntry(TypedDict):
    """How curves of the drawing became lines and arcs."""

    tolerance_um: Positive
    max_um: Size
    arcs: Count
    lines: Count


class PassEntry(TypedDict):
    """A pass over a figure."""

    offset_um: Size
    direction: Sense
    cut_off: bool
    length_um: Size
    time_s: Size | None


class FigureEntry(TypedDict):
    """A hole or an outline, and how it is cut."""

    number: Ordinal
    kind: Annotated[str, one_of("hole", "outline")]
    part: Ordinal
    layer: str
    blocks: BlockRange | None
    spans: list[BlockRange]
    length_um: Size
    time_s: Size | None
    thread_um: Point
    thread_by: Annotated[str, one_of("asked", "marked", "chosen", "contour", "kerf")]
    side: Annotated[str, one_of("left", "right")]
    direction: Sense
    no_core: bool
    passes: Annotated[list[PassEntry], of_length(1)]


class EntityEntry(TypedDict):
    """An entity of the drawing."""

    kind: Text
    handle: str
    layer: str


class LeftOutEntry(TypedDict):
    """What was left out of the drawing, and why."""

    entity: EntityEntry
    why: Slug
    text: Text
    detail: Text | None
    gap_um: Size | None
    place_um: Point | None


class TakenEntry(TypedDict):
    """A contour that is cut: the number of its figure, and the entities that draw it."""

    figure: Ordinal
    entities: Annotated[list[EntityEntry], of_length(1)]


class LeftEntry(TypedDict):
    """A contour, or a curve that closes none, that is not cut, and why."""

    entity: EntityEntry
    at_mm: Point | None
    why: Slug


class BridgedEntry(TypedDict):
    """A gap of the drawing that was bridged."""

    figure: Ordinal
    at_mm: Point
    gap_mm: Positive


class PiecesEntry(TypedDict):
    """Pieces that the program cuts free."""

    parts: Count
    slugs: Count


class WireEntry(TypedDict):
    """The wire of the proof."""

    diameter_um: Positive
    spark_gap_um: float


class FindingEntry(TypedDict):
    """A finding of the check, which has a code, or a fault of the proof, which has a name."""

    code: Code | None
    name: Slug | None
    severity: SeverityName
    text: Text
    figure: Ordinal | None
    block: Ordinal | None
    line: Ordinal | None
    place_um: Point | None


class LagEntry(TypedDict):
    """The lag of the wire that the program corrects, and the edge at the faces of the work, where it is known."""

    lag_um: Positive
    face_lag_um: Size | None
    face_edge_to_drawing_um: Size | None


class WallEntry(TypedDict):
    """How far the wall of a figure lies off at a height over the bottom of the work; null: no wall was found."""

    figure: Ordinal
    z_mm: Size
    off_um: Size | None


class ProofEntry(TypedDict):
    """How the program was held against its drawing, as written and as cut."""

    verdict: CheckVerdict
    written_um: Size | None
    path_um: Size | None
    edge_to_drawing_um: Size | None
    drawing_to_edge_um: Size | None
    tolerance_um: Positive | None
    pieces: PiecesEntry | None
    wire: WireEntry
    lag: LagEntry | None
    walls: list[WallEntry]
    start_mm: Point | None
    findings: list[FindingEntry]
    unproved: list[Text]
    notes: list[Text]


class RefusalEntry(TypedDict):
    """Why there is no program, and at which places of the drawing."""

    why: Slug
    text: Text
    places_um: list[Point]


class ProgramDocument(TypedDict):
    """A program made of a drawing, ``drycut program --json``."""

    schema: Literal["drycut.program/1"]
    drycut: Version
    made: bool
    drawing: DrawingFileEntry | None
    fit: FitEntry | None
    figures: list[FigureEntry]
    taken: list[TakenEntry]
    left: list[LeftEntry]
    bridged: list[BridgedEntry]
    left_out: list[LeftOutEntry]
    length_um: Size | None
    time_s: Size | None
    proof: ProofEntry | None
    notes: list[Text]
    refusal: RefusalEntry | None


PROGRAM: Final = Document(
    ProgramDocument,
    "docs/program.md",
    (
        Law(
            ProgramDocument,
            "made",
            Literal[True],
            {"refusal": None, "drawing": DrawingFileEntry, "figures": Annotated[list[FigureEntry], of_length(1)]},
            {"refusal": RefusalEntry, "proof": None, "length_um": None, "figures": _NOTHING},
        ),
        Law(
            ProofEntry,
            "verdict",
            Literal["pass"],
            {"unproved": _NOTHING, "findings": {"items": {"properties": {"severity": {"const": "note"}}}}},
        ),
        Law(FindingEntry, "code", None, {"name": Slug}, {"name": None}),
    ),
)
