"""What of a drawing is left out, entity by entity, and why."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ezdxf.document import Drawing as Document

from parser.drawing.dxf.blocks import Placed
from parser.drawing.dxf.entities import reader_of
from parser.drawing.dxf.forms import place_of
from parser.drawing.dxf.linetypes import Linetypes
from parser.drawing.gather import Missed
from parser.drawing.model import Entity, LeftOut
from parser.text.encoding import printable

NEVER_PLOTTED = "defpoints"
"""The layer, in small letters, on which CADs put the points that dimensions hang on, and people what helps to draw."""
_KINDS = {
    "text": ("TEXT", "MTEXT", "ATTDEF", "ATTRIB", "RTEXT", "ARCALIGNEDTEXT", "ACAD_TABLE", "SHAPE"),
    "dimension": ("DIMENSION", "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION", "TOLERANCE"),
    "leader": ("LEADER", "MULTILEADER", "MLEADER"),
    "hatch": ("HATCH", "MPOLYGON"),
    "point": ("POINT",),
    "solid": (
        "SOLID",
        "TRACE",
        "3DFACE",
        "3DSOLID",
        "BODY",
        "REGION",
        "MESH",
        "POLYLINE",
        "SURFACE",
        "EXTRUDEDSURFACE",
        "LOFTEDSURFACE",
        "PLANESURFACE",
        "REVOLVEDSURFACE",
        "SWEPTSURFACE",
    ),
    "block": ("INSERT",),
    "endless": ("XLINE", "RAY"),
    "picture": ("IMAGE", "WIPEOUT", "OLE2FRAME", "PDFUNDERLAY", "DWFUNDERLAY", "DGNUNDERLAY"),
    "window": ("VIEWPORT",),
}
_WHY = {kind: why for why, kinds in _KINDS.items() for kind in kinds}


class Wanted(NamedTuple):
    """Entities that are read, and those that are not, each with the reason."""

    kept: list[Placed]
    left: list[tuple[Placed, str]]


def wanted_of(document: Document, placed: Sequence[Placed], layer: str | None) -> Wanted:
    """Entities of one layer, seen or not; or of all layers, but those that are not seen or that no contour is drawn by.

    These are of broken linetypes, such as centre lines, and on the layer that is never plotted.
    """
    linetypes, wanted = Linetypes(document), Wanted([], [])
    for each_placed in placed:
        why = _why_not(each_placed, linetypes) if layer is None else _why_other(each_placed, layer.lower())
        if why:
            wanted.left.append((each_placed, why))
        else:
            wanted.kept.append(each_placed)
    return wanted


def _why_not(placed: Placed, linetypes: Linetypes) -> str:
    if placed.unseen:
        return placed.unseen
    if placed.layer.lower() == NEVER_PLOTTED:
        return "never-plotted"
    if placed.linetype != "continuous" and linetypes.is_broken(placed.linetype) and reader_of(placed.entity):
        return "broken-line"
    return ""


def _why_other(placed: Placed, layer: str) -> str:
    return "" if placed.layer.lower() == layer else "other-layer"


def left_out(wanted: Wanted, missed: Sequence[Missed]) -> Iterator[LeftOut]:
    """What is not read, and what of that which is read gives no curve, with the places of both."""
    for placed, why in wanted.left:
        yield LeftOut(entity_of(placed), why, place_of(placed.entity, placed.place))
    for each_missed in missed:
        placed = wanted.kept[each_missed.entity]
        why = each_missed.why or _WHY.get(placed.entity.dxftype(), "no-curve")
        yield LeftOut(entity_of(placed), why, place_of(placed.entity, placed.place), detail=each_missed.detail)


def entity_of(placed: Placed) -> Entity:
    """An entity by the names that people know it by."""
    handle, kind = str(placed.entity.dxf.get("handle", "")), placed.entity.dxftype()
    return Entity(printable(kind), printable(handle), printable(placed.layer), printable(placed.block), placed.color)
