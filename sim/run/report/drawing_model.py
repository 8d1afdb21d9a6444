"""Model of ``drycut.compare/1``, and of ``drawing`` of the report (docs/compare.md)."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    BlockRange,
    Count,
    Document,
    Judgement,
    Ordinal,
    Point,
    Positive,
    Size,
    Text,
    Version,
    between,
    of_length,
    one_of,
)


class DirectionEntry(TypedDict):
    """The largest distance in one direction, from edge to drawing or back."""

    max_um: Size
    rms_um: Size
    signed_um: float | None
    where_um: Point
    block: Ordinal
    entity: Count | None


class PlacementEntry(TypedDict):
    """Where the drawing lies in the program's coordinates."""

    fitted: bool
    turn_deg: Annotated[float, between(-180, 180)]
    shift_um: Point
    mirror: bool
    scale: Positive


class NameEntry(TypedDict):
    """What is wrong as a whole, or of one contour, whose blocks and shift are said."""

    name: Annotated[
        str,
        one_of(
            "unit-slip",
            "mirrored",
            "turned",
            "wrong-side",
            "offset-missing",
            "lead-in-part",
            "contour-wrong-side",
            "contour-offset-missing",
            "contour-shifted",
        ),
    ]
    text: Text
    blocks: BlockRange | None
    shift_um: Point | None


PlaceEntry = TypedDict(
    "PlaceEntry",
    {
        "from": Annotated[str, one_of("edge", "drawing", "lead")],
        "max_um": Size,
        "signed_um": float | None,
        "where_um": Point,
        "block": Ordinal,
        "entity": Count | None,
    },
)


EntityEntry = TypedDict(
    "EntityEntry",
    {
        "kind": Text,
        "handle": str,
        "layer": str,
        "from": Annotated[str, one_of("edge", "drawing", "lead")],
        "max_um": Size,
        "signed_um": float | None,
        "where_um": Point,
        "block": Ordinal,
        "entity": Count | None,
    },
)


class CornerEntry(TypedDict):
    """A sharp inside corner that no wire cuts."""

    where_um: Point
    depth_um: Positive
    angle_deg: Annotated[float, between(0, 180)]
    block: Ordinal
    entity: Count


class DrawingFileEntry(TypedDict):
    """The drawing: its file, DXF version and unit."""

    name: Text
    version: Text
    unit: Text


class ComparisonEntry(TypedDict):
    """The cut edge beside its drawing."""

    verdict: Judgement
    tolerance_um: Positive
    max_um: Size
    rms_um: Size
    where_um: Point
    edge_to_drawing: DirectionEntry
    drawing_to_edge: DirectionEntry
    fit: PlacementEntry
    names: list[NameEntry]
    worst: Annotated[list[PlaceEntry], of_length(1, 10)]
    blocks: Annotated[list[PlaceEntry], of_length(1)]
    entities: Annotated[list[EntityEntry], of_length(1)]
    sharp_corners: Annotated[str, one_of("tell", "fail")]
    unreachable: list[CornerEntry]
    drawing: DrawingFileEntry
    notes: list[Text]


class _Head(TypedDict):
    schema: Literal["drycut.compare/1"]
    drycut: Version
    offset_um: Size | None


class CompareDocument(_Head, ComparisonEntry):
    """The comparison by itself, ``drycut compare --json``; the offset is null of an edge as cut."""


COMPARE: Final = Document(CompareDocument, "docs/compare.md")
