"""Model of ``drycut.decode/1`` (docs/iso.md, section 8)."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    AssumptionEntry,
    Count,
    CurveName,
    Document,
    Ordinal,
    Point,
    Size,
    Text,
    Version,
    between,
    matching,
    of_length,
    one_of,
)


class StepEntry(TypedDict):
    """A word of the block, and the field that it fills."""

    order: Ordinal
    word: str
    column: Ordinal
    field: Text
    value: float | None


class InForceEntry(TypedDict):
    """What holds while the block runs."""

    motion: Annotated[str, one_of("", "G00", "G01", "G02", "G03")]
    distance: Annotated[str, one_of("G90", "G91")]
    side: Annotated[str, one_of("G40", "G41", "G42")]
    register: Annotated[str, matching(r"^([DH][0-9]+)?$")]
    offset_um: float | None
    f: float | None


class WayEntry(TypedDict):
    """The way of a block, and of the wire on either side."""

    row: Count
    runs: Ordinal
    kind: CurveName
    start_um: Point
    end_um: Point
    left_um: Point | None
    right_um: Point | None
    wire_center_um: Point | None
    arc_center_um: Point | None
    length_um: Size
    joint: Annotated[
        str, one_of("none", "set-up", "normal", "tangent", "shortened", "lengthened", "inserted", "cancel")
    ]
    before_line: Ordinal | None


class BlockEntry(TypedDict):
    """A block as the controller's buffer has it; letters that it does not state are null."""

    line: Ordinal
    buf_state: Literal[1]
    number: int | None
    number_bcd: int | None
    coor_um: dict[Annotated[str, matching(r"^[A-Z]$")], float | None]
    f: float | None
    s: float | None
    g0: Annotated[int, between(0, 255)]
    g: list[float | None]
    m: list[float | None]
    t: float | None
    d: float | None
    h: float | None
    others: dict[Annotated[str, matching(r"^[A-Z]$")], float | None]
    steps: Annotated[list[StepEntry], of_length(1)]
    in_force: InForceEntry | None
    way: WayEntry | None


class DecodeDocument(TypedDict):
    """Blocks of a program as a controller decodes them, ``drycut decode --json``."""

    schema: Literal["drycut.decode/1"]
    drycut: Version
    file: str
    dialect: Text
    assumptions: list[AssumptionEntry]
    blocks: list[BlockEntry]


DECODE: Final = Document(
    DecodeDocument,
    "docs/iso.md",
)
