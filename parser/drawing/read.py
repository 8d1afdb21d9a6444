"""The file of a drawing to what it holds: `read_drawing`, the one way in.

Points and circles of a drawing, which may be thread points.

What is said of a drawing as it was read: what is missing of it, what was assumed and what was mended.

What of a drawing is left out, entity by entity, and why.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from ezdxf.document import Drawing as Document
from ezdxf.math import Vec3

from parser.drawing.dxf.blocks import Placed, placed_entities
from parser.drawing.dxf.document import Linetypes, read_document
from parser.drawing.dxf.dwg import dxf_of_dwg
from parser.drawing.dxf.entities import (
    behind,
    of_extrusion,
    place_of,
    reader_of,
    scaled,
)
from parser.drawing.fit.curves import loops_with_arcs
from parser.drawing.gather import Gathered, Missed, gather
from parser.drawing.loops.chain import Chained, chain, without_flat
from parser.drawing.loops.joints import welded
from parser.drawing.loops.once import Again, drawn_once
from parser.drawing.model import (
    DEFAULT_FLATTEN_UM,
    DEFAULT_GAP_UM,
    UNITS,
    Drawing,
    Entity,
    FitFigures,
    LeftOut,
    Mark,
    Unit,
)
from parser.drawing.plane import FARTHEST_UM
from parser.drawing.plots.source import Source
from parser.drawing.plots.sources import source_of
from parser.files import kind_of, read_bytes
from parser.findings.catalogue import LANGUAGES, Bilingual, Remark, remark_text
from parser.findings.errors import DrawingError, Message
from parser.geometry.curves import Curves, Floats, extents
from parser.text.encoding import printable
from parser.units import mm

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

    placed: list[Placed]
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
            wanted.placed.append(each_placed)
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
        placed = wanted.placed[each_missed.entity]
        why = each_missed.why or _WHY.get(placed.entity.dxftype(), "no-curve")
        yield LeftOut(entity_of(placed), why, place_of(placed.entity, placed.place), detail=each_missed.detail)


def entity_of(placed: Placed) -> Entity:
    """An entity by the names that people know it by."""
    handle, kind = str(placed.entity.dxf.get("handle", "")), placed.entity.dxftype()
    return Entity(printable(kind), printable(handle), printable(placed.layer), printable(placed.block), placed.color)


_MOST_NAMED = 5  # places and entities named one by one
_UNSEEN = ("off", "frozen", "hidden", "other-layer")
_BY_HABIT = ("broken-line", "never-plotted")  # seen, but drawn as no contour is; read where their layer is asked for


def notes_of(left: Sequence[LeftOut], gathered: Gathered, again: Sequence[Again], chained: Chained) -> Iterator[Remark]:
    """What was left out or mended."""
    counts, why = gathered.counts, Counter(each_left_out.why for each_left_out in left)
    yield from _not_wanted(left)
    if counts.no_curves:
        yield Remark("no-curves", {"kinds": _listed(counts.no_curves)})
    if counts.unreadable:
        yield Remark("unreadable", {"kinds": _listed(counts.unreadable)})
    yield from [each_left_out.detail for each_left_out in left if each_left_out.detail][:_MOST_NAMED]
    for number, name in (
        (counts.beyond, "beyond"),
        (counts.upright, "upright"),
        (counts.slanted, "slanted"),
        (why["no-width"], "no-width"),
        (why["dot"], "dot"),
        (sum(each.curves for each in again if each.whole), "drawn-twice"),
        (sum(each.curves for each in again if not each.whole), "overlaps"),
    ):
        if number:
            yield Remark(name, {"number": number})
    yield from _of_chain(chained)


def _not_wanted(left: Sequence[LeftOut]) -> Iterator[Remark]:
    """What would be curves, and was not read."""
    why = Counter(each_left_out.why for each_left_out in left)
    unseen = sum(why[each] for each in _UNSEEN)
    if unseen:
        yield Remark("other-layers", {"number": unseen})
    for name in _BY_HABIT:
        if why[name]:
            yield Remark(name, {"number": why[name]})


def no_contour(left: Sequence[LeftOut], layer: str | None) -> DrawingError:
    """What is wrong with a drawing that gives no curve: what is there instead, as far as that can be told."""
    where = "" if layer is None else Message("on-layer", layer=printable(layer))
    wrong = [each_left_out.detail for each_left_out in left if each_left_out.detail][:1]
    instead = [*([] if layer else _not_wanted(left)), *wrong]
    aside = Bilingual(*("; ".join(remark_text(remark, language) for remark in instead) for language in LANGUAGES))
    return DrawingError("no-curve", where=where, instead=aside)


def _of_chain(chained: Chained) -> Iterator[Remark]:
    bridged = [loop.gap_um for loop in chained.loops if loop.gap_um > 0.0]
    if bridged:
        yield Remark("bridged", {"gap": max(bridged), "loops": len(bridged)})
    places = [f"({mm(x):g}, {mm(y):g})" for x, y in chained.branches_um[:_MOST_NAMED].tolist()]
    more = len(chained.branches_um) - len(places)
    if more:
        yield Remark("many-branches", {"places": ", ".join(places), "more": more})
    elif places:
        yield Remark("branches", {"places": ", ".join(places)})


def _listed(counts: Counter[str]) -> str:
    return ", ".join(f"{number} {kind}" for kind, number in sorted(counts.items()))


_AT = {"POINT": "location", "CIRCLE": "center"}


def marks_of(placed: Sequence[Placed]) -> tuple[Mark, ...]:
    """Marks in file order, of all layers; circles that are stretched by their block count by their width in X."""
    found = [each_placed for each_placed in placed if each_placed.entity.dxftype() in _AT]
    centers, radii = np.full((len(found), 3), np.nan), np.zeros((len(found), 3))
    maps: list[Floats] = []
    which, known = np.zeros(len(found), dtype=np.int64), dict[tuple[int, bytes], int]()
    for row, each in enumerate(found):
        try:
            centers[row], radii[row, 0], own = _numbers(each)
        except Exception:  # damaged numbers; the entity is told of where it is read  # noqa: S112
            continue
        key = (id(each.place), b"" if own is None else own.tobytes())
        if key not in known:
            known[key] = len(maps)
            maps.append(each.place if own is None else behind(own, each.place))
        which[row] = known[key]
    return _marks(found, centers, radii, np.array(maps).reshape(-1, 4, 3)[which] if maps else np.zeros((0, 4, 3)))


def _numbers(placed: Placed) -> tuple[tuple[float, float, float], float, Floats | None]:
    """Centre and radius of a mark, and the map from its own coordinates, if any."""
    kind, dxf = placed.entity.dxftype(), placed.entity.dxf
    x, y, z = dxf.get(_AT[kind])
    if kind == "POINT":
        return (x, y, z), 0.0, None
    return (x, y, z), abs(dxf.radius), of_extrusion(Vec3(dxf.extrusion))


def _marks(found: Sequence[Placed], centers: Floats, radii: Floats, maps: Floats) -> tuple[Mark, ...]:
    places = np.einsum("ki,kij->kj", centers, maps[:, :3]) + maps[:, 3] if len(maps) else centers
    radius = np.hypot(*np.einsum("ki,kij->kj", radii, maps[:, :3])[:, :2].T) if len(maps) else radii[:, 0]
    near = np.flatnonzero((np.abs(places[:, :2]) <= FARTHEST_UM).all(axis=1))
    columns = zip(places[near].tolist(), radius[near].tolist(), near.tolist(), strict=True)
    return tuple(Mark((x, y), printable(found[row].layer), r_um) for (x, y, _), r_um, row in columns)


class _ReadWith(NamedTuple):
    """What a drawing is read with; see `read_drawing`."""

    layer: str | None
    gap_um: float
    flatten_um: float
    fit_um: float | None
    unit: Unit | None


def read_drawing(  # noqa: PLR0913, PLR0917 - all that can be asked of a drawing
    path: Path | str,
    layer: str | None = None,
    gap_um: float = DEFAULT_GAP_UM,
    flatten_um: float = DEFAULT_FLATTEN_UM,
    fit_um: float | None = None,
    unit: str | None = None,
) -> Drawing:
    """The drawing of a DXF file, ASCII or binary, of any release; of a plot in HPGL, SVG, IGES, or curves in CSV.

    Parameters
    ----------
    path
        The file.
    layer
        The one layer to read, in letters of either case, seen or not; None for all that are neither off nor frozen.
    gap_um
        Ends that are no farther apart are joined.
    flatten_um
        How far the lines that ellipses and splines become may lie off them.
    fit_um
        How far arcs may lie off the ellipses, splines and dense polylines that they are fitted to; None where no arcs
        are fitted.
    unit
        The unit that it is drawn in, by its word in `UNITS`; None for the one that the file names.

    Raises FileUnreadableError where there is no readable file; DrawingError where it is no drawing, is damaged beyond
    mending, has no such layer, or holds no curve.
    """
    path = Path(path)
    own = next((each for each in UNITS.values() if each.word == unit), None)
    data = read_bytes(path)
    try:
        source = source_of(data)
    except DrawingError as error:
        raise DrawingError("in-file", file=path, message=error.message) from None
    if source is None:
        source = _of_dxf(path, dxf_of_dwg(path, data) if kind_of(data) == "kind-dwg" else data)
    try:
        with np.errstate(all="ignore"):  # damaged numbers overflow; what comes of them is left out by its value
            return _drawing(path.name, source, _ReadWith(layer, gap_um, flatten_um, fit_um, own))
    except DrawingError as error:
        raise DrawingError("in-file", file=path, message=error.message) from None
    except Exception as error:  # what no part of the reader foresaw in a damaged file
        raise DrawingError("drawing-damaged", path=path, name=type(error).__name__) from None


def _of_dxf(path: Path, data: bytes) -> Source:
    document, notes = read_document(path, data)
    return Source(document, str(document.acad_release), None, tuple(notes))


def _drawing(name: str, source: Source, read_with: _ReadWith) -> Drawing:
    document, notes = source.document, source.notes
    named, assumed = (source.unit, None) if source.unit else unit_of(document.header.get("$INSUNITS", None))
    unit = read_with.unit or named
    placed = list(placed_entities(document, scaled(unit.um)))
    _refuse_unknown(document, placed, read_with.layer)
    wanted = wanted_of(document, placed, read_with.layer)
    gathered = gather(wanted.placed, read_with.flatten_um, read_with.fit_um)
    left = tuple(left_out(wanted, gathered.counts.missed))
    if not len(gathered.curves):
        raise no_contour(left, read_with.layer)
    metric = None if source.unit else document.header.get("$MEASUREMENT", None)
    doubt = unit_doubt(unit, gathered.curves, metric)
    of_unit = [] if read_with.unit else [each for each in (assumed, doubt) if each]
    once = drawn_once(gathered.curves, gathered.entity)
    chained = chain(once.curves, np.unique(once.entity, return_inverse=True)[1], read_with.gap_um)
    contours = without_flat(once.curves, once.entity, chained.loops)
    flat = [LeftOut(entity_of(wanted.placed[once.entity[each.row]]), each.why, each.place_um) for each in contours.flat]
    number, entity = np.unique(contours.entity, return_inverse=True)
    drawing = Drawing(
        name=name,
        version=source.version,
        unit=unit.name,
        curves=welded(contours.curves, contours.loops),
        entity=entity.astype(np.int64),
        entities=tuple(entity_of(wanted.placed[at]) for at in number.tolist()),
        loops=contours.loops,
        flattened=gathered.counts.flattened,
        flatten_um=read_with.flatten_um,
        notes=(*notes, *of_unit, *notes_of([*left, *flat], gathered, once.again, chained)),
        left_out=(*left, *(_again(wanted.placed, again) for again in once.again), *flat),
        marks=marks_of(placed),
    )
    return drawing if read_with.fit_um is None else _with_arcs(drawing, read_with.fit_um, gathered.counts.fit_max_um)


def _with_arcs(drawing: Drawing, fit_um: float, so_far_um: float) -> Drawing:
    """A drawing with arcs in place of dense lines, where ellipses and splines are arcs already."""
    fitted = loops_with_arcs(drawing, fit_um)
    arcs = int(fitted.curves.is_arc.sum())
    figures = FitFigures(fit_um, max(so_far_um, fitted.max_um), arcs, len(fitted.curves) - arcs)
    return replace(drawing, curves=fitted.curves, entity=fitted.entity, loops=fitted.loops, fit=figures)


def _refuse_unknown(document: Document, placed: Sequence[Placed], layer: str | None) -> None:
    drawn = {each_placed.layer for each_placed in placed}
    names = drawn | {str(entry.dxf.name) for entry in document.layers}
    if layer is not None and layer.lower() not in map(str.lower, names):
        shown_text = ", ".join(sorted(map(printable, drawn or names)))
        raise DrawingError("no-such-layer", layer=printable(layer), layers=shown_text)


def _again(wanted: Sequence[Placed], again: Again) -> LeftOut:
    return LeftOut(entity_of(wanted[again.entity]), "drawn-twice" if again.whole else "overlaps", again.place_um)


def unit_of(code: object) -> tuple[Unit, Remark | None]:
    """The unit that $INSUNITS names, mm where it names none; with a note on what was assumed."""
    if isinstance(code, int) and code in UNITS:
        return UNITS[code], None
    assumed = Remark("no-unit") if code in (None, 0) else Remark("strange-unit", {"code": printable(str(code))})
    return UNITS[4], assumed


_LEAST_PART_UM, _MOST_PART_UM = 500.0, 2e6
"""No part is smaller than half a start hole of 1 mm, none larger than the tables of wire EDM, 2 m (assumed)."""
_ENGLISH = ("inch", "foot", "yard", "mil", "microinch")
_LIKELY = tuple(UNITS[code] for code in (4, 1, 13, 6))  # in which a drawing may be meant, the likeliest first


def unit_doubt(unit: Unit, curves: Curves, measurement: object) -> Remark | None:
    """What speaks against the unit that a file names, or that was taken for it, and what it may be instead.

    Its drawing would be of a size that no part has, and in another unit it would not; or the file is drawn in inches
    and says that it is metric ($MEASUREMENT 1).
    """
    low, high = extents(curves)
    size_um = float((high.max(axis=0) - low.min(axis=0)).max())
    likely = [each for each in _LIKELY if _LEAST_PART_UM <= size_um / unit.um * each.um <= _MOST_PART_UM]
    is_odd = not _LEAST_PART_UM <= size_um <= _MOST_PART_UM
    if not likely or not (is_odd or (unit.name in _ENGLISH and measurement == 1)):
        return None
    sizes = {"size": mm(size_um), "other_size": mm(size_um / unit.um * likely[0].um)}
    return Remark("doubtful-unit", {"unit": unit.name, "other": likely[0].name, **sizes})
