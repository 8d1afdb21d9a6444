"""Model of ``remains`` of the report: what a cut leaves (docs/report.md)."""

from typing import Annotated, TypedDict

from parser.documents import (
    BlockRange,
    Count,
    Ordinal,
    Point,
    Ring,
    Size,
    of_length,
    one_of,
)


class RangeEntry(TypedDict):
    """Mean, least and largest of a width; null where nothing was cut."""

    mean: float | None
    min: float | None
    max: float | None


class KerfBlockEntry(TypedDict):
    """How far the kerf of a block reaches to both sides of the path."""

    block: Ordinal
    left_um: RangeEntry
    right_um: RangeEntry
    width_um: RangeEntry


class KerfEntry(TypedDict):
    """The material that was cut away."""

    area_mm2: Size
    blocks: list[KerfBlockEntry]


class FrameEntry(TypedDict):
    """What stays in the clamp; null where the work has no edge."""

    area_mm2: Size | None
    mass_g: Size | None
    openings_um: list[Ring]


class FreedEntry(TypedDict):
    """Where a piece comes free."""

    contour: Ordinal
    block: Ordinal
    t_s: Size
    wire_um: Point


class BridgeEntry(TypedDict):
    """What holds a piece last."""

    place_um: Point
    closes_on_block: Ordinal | None
    left_um: Size
    last_mm_block: Ordinal
    last_mm_t_s: Size


class ShiftEntry(TypedDict):
    """How far a freed piece can move in a direction; null where nothing stops it."""

    toward_deg: float
    by_um: Size | None
    touches_um: Point | None


class TurnEntry(TypedDict):
    """How far a freed piece can turn; null where nothing stops it."""

    by_deg: float | None
    touches_um: Point | None


class PinchEntry(TypedDict):
    """Whether a freed piece can pinch the wire."""

    wall_um: Point
    width_um: Size
    narrowest_um: Size
    pinches: bool
    after_um: float


class PlayEntry(TypedDict):
    """How a freed piece can move in its opening."""

    shifts: list[ShiftEntry]
    turns: Annotated[list[TurnEntry], of_length(2, 2)]
    pinch: PinchEntry
    exact_to_um: Size


class PieceEntry(TypedDict):
    """A piece that comes free."""

    kind: Annotated[str, one_of("part", "slug")]
    area_mm2: Size
    mass_g: Size
    center_um: Point
    freed: FreedEntry
    bridge: BridgeEntry
    held_after_block: Ordinal | None
    cut_after_um: Size
    early: bool
    play: PlayEntry
    outline_um: Ring
    holes_um: list[Ring]


class BoxEntry(TypedDict):
    """Width and height of a part, a hole or an opening, and between which they lie as the gap does."""

    what: Annotated[str, one_of("part", "hole", "opening")]
    piece: Ordinal | None
    center_um: Point
    cut_um: Point
    nominal_um: Point
    least_um: Point
    most_um: Point


class RadiusEntry(TypedDict):
    """Radius of a hole or a boss, how far it is from round, and between which radii it lies by gap and form."""

    what: Annotated[str, one_of("hole", "boss")]
    block: Ordinal
    center_um: Point
    cut_um: float
    nominal_um: float
    form_um: Size
    least_um: float
    most_um: float


class DistanceEntry(TypedDict):
    """Distance of two parallel lines, across material or a slot, and between which it lies as the gap does."""

    what: Annotated[str, one_of("material", "slot")]
    blocks: BlockRange
    cut_um: float
    nominal_um: float
    least_um: float
    most_um: float


class SizesEntry(TypedDict):
    """Sizes as a micrometer would find them, and their nominal ones."""

    boxes: list[BoxEntry]
    radii: list[RadiusEntry]
    distances: list[DistanceEntry]


class RemainsEntry(TypedDict):
    """What a cut leaves: kerf, frame, pieces and sizes."""

    kerf: KerfEntry
    frame: FrameEntry
    pieces: list[PieceEntry]
    crumbs: Count
    sizes: SizesEntry
