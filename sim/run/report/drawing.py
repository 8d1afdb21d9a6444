"""A comparison as data, schema ``drycut.compare/1``, with its model (docs/compare.md); said in English."""

import json
from collections.abc import Sequence
from operator import attrgetter
from typing import Annotated, Final, Literal, TypedDict, cast

import numpy as np

from parser import __version__
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
from parser.findings.catalogue import Remark, remark_text
from parser.units import from_mm
from sim.base.units import DEG_DIGITS, known, place, rounded
from sim.measure.compare.findings import by_block, by_entity, corner_places, worst_places
from sim.measure.compare.result import Comparison, CornerPlace, WorstPlace


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
    """The comparison by itself, ``drycut compare --json``; the offset is null of an edge as cut.

    `top` is that at the top of the work, where a wire leans and a drawing of the top was given.
    """

    top: ComparisonEntry | None


COMPARE: Final = Document(CompareDocument, "docs/compare.md")


_DEVIATION_UM: Final = attrgetter("deviation_um")


def comparison_document(of: Comparison, top: Comparison | None = None) -> CompareDocument:
    """The comparison as plain lists, dicts, numbers and None, with that at the top; the order of keys is fixed."""
    placement, drawing = of.placement, of.drawing
    blocks, entities = by_block(of), by_entity(of)
    return {
        "schema": "drycut.compare/1",
        "drycut": __version__,
        "verdict": "pass" if of.passes else "fail",
        "tolerance_um": rounded(of.request.tolerance_um),
        "max_um": rounded(of.max_um),
        "rms_um": rounded(max(of.edge_to_drawing.rms_um, of.drawing_to_edge.rms_um)),
        "where_um": place(max([*blocks, *entities], key=_DEVIATION_UM).where_um),
        "offset_um": known(of.edge.offset_um),
        "edge_to_drawing": _direction(blocks, of.edge_to_drawing.rms_um),
        "drawing_to_edge": _direction(entities, of.drawing_to_edge.rms_um),
        "fit": {
            "fitted": of.request.fitted,
            "turn_deg": round(float(np.degrees(placement.turn_rad)), DEG_DIGITS) + 0.0,
            "shift_um": place(placement.shift_um),
            "mirror": placement.mirror,
            "scale": rounded(of.scale),
        },
        "names": [_named(named) for named in of.names],
        "worst": [_place(worst) for worst in worst_places(of)],
        "blocks": [_place(worst) for worst in blocks],
        "entities": [_entity(of, worst) for worst in entities],
        "sharp_corners": of.request.sharp_corners,
        "unreachable": [_corner(corner) for corner in corner_places(of)],
        "drawing": {"name": drawing.name, "version": drawing.version, "unit": drawing.unit},
        "notes": [remark_text(note) for note in of.notes],
        "top": comparison_entry(top),
    }


def comparison_entry(of: Comparison | None) -> ComparisonEntry | None:
    """``drawing`` of a report: the comparison as ``drycut compare --json`` has it, without what the report says."""
    if of is None:
        return None
    keys = ComparisonEntry.__annotations__
    return cast("ComparisonEntry", {key: value for key, value in comparison_document(of).items() if key in keys})


def document_text(of: Comparison, top: Comparison | None = None) -> str:
    """The document as JSON; the same comparison gives the same bytes."""
    return json.dumps(comparison_document(of, top), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _direction(places: Sequence[WorstPlace], rms_um: float) -> DirectionEntry:
    worst = max(places, key=_DEVIATION_UM)
    return {
        "max_um": rounded(worst.deviation_um),
        "rms_um": rounded(rms_um),
        "signed_um": _signed(worst),
        "where_um": place(worst.where_um),
        "block": worst.block,
        "entity": _number(worst),
    }


def _place(worst: WorstPlace) -> PlaceEntry:
    return {
        "from": worst.measured_from,
        "max_um": rounded(worst.deviation_um),
        "signed_um": _signed(worst),
        "where_um": place(worst.where_um),
        "block": worst.block,
        "entity": _number(worst),
    }


def _signed(worst: WorstPlace) -> float | None:
    """Positive where material is left, negative where the part is gouged; None where no side is known."""
    return rounded(worst.side * worst.deviation_um) if worst.side else None


def _number(worst: WorstPlace) -> int | None:
    return worst.entity if worst.entity >= 0 else None


def _named(named: Remark) -> NameEntry:
    """What is wrong, with the blocks and the shift of the one contour that it is wrong of."""
    of = named.values
    shift_mm = [float(of[key]) for key in ("shift_x_mm", "shift_y_mm") if key in of]
    return {
        "name": named.name,
        "text": remark_text(named),
        "blocks": [int(of["first"]), int(of["last"])] if "first" in of else None,
        "shift_um": place(map(from_mm, shift_mm)) or None,
    }


def _corner(corner: CornerPlace) -> CornerEntry:
    return {
        "where_um": place(corner.where_um),
        "depth_um": rounded(corner.depth_um),
        "angle_deg": round(float(np.degrees(corner.angle_rad)), DEG_DIGITS),
        "block": corner.block,
        "entity": corner.entity,
    }


def _entity(of: Comparison, worst: WorstPlace) -> EntityEntry:
    entity = of.drawing.entities[worst.entity]
    return {"kind": entity.kind, "handle": entity.handle, "layer": entity.layer, **_place(worst)}
