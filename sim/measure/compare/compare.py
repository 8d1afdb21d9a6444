"""Lay a drawing on a cut edge, or on a program's, measure both ways, and name what is wrong as a whole.

Slips of units: a program is too large or too small, by the ratio of two units, such as inch and millimetre.

On which side of a curve the part lies, of the edge and of the drawing beside it.

A program against a drawing: its edge, and whether the offset is to the wrong side or missing.

What is wrong with one contour of several: cut on the wrong side of its path, without offset, or off its place.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.drawing.model import Drawing, running
from parser.findings.catalogue import Remark
from parser.findings.errors import DrawingError, SettingsError
from parser.geometry.along import headings, headings_at
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.distance import feet
from parser.text.encoding import printable
from parser.toolpath import Point, Toolpath
from parser.units import mm
from sim.cut.regions import RegionError
from sim.measure.compare.descent import Fit, fit, settled, shifted_onto
from sim.measure.compare.directed import Directed, directed, feet_on
from sim.measure.compare.nearest import Index, indexed, nearest
from sim.measure.compare.program_edge import ProgramEdges, edge_at, program_edges, with_gouges
from sim.measure.compare.result import Comparison, Edge, FitRequest
from sim.measure.compare.rings import PathEdge
from sim.measure.compare.starts import (
    IN_PLACE,
    CurveGroup,
    Placement,
    centroid,
    groups,
    placed,
    scaled,
    spread,
    turning,
)
from sim.measure.compare.unreachable import Reachable, Unreachable, as_drawn, reachable

_PLACES = 400  # of a drawn loop
_BESIDE = 4.0  # times the wire's reach: how far an edge may lie from the loop that it is of, on its wrong side too


def part_sides(edge: Edge, index: Index, drawing: Drawing, placement: Placement) -> Ints:
    """Side (k,) of the part along each closed loop of the drawing: +1 left, −1 right, 0 where no edge lies beside it.

    The index is that of the edge. Loops are run as the drawing has them, counter-clockwise before they are mirrored.
    """
    sides = []
    for loop in (each for each in drawing.loops if each.closed):
        ring = placed(running(drawing.curves, loop.row, loop.backwards), placement)
        at = spread(ring, _PLACES)
        near = nearest(index, at.place_um)
        foot = feet(edge.curves, near.row, at.place_um).place_um
        along = (headings_at(ring, at.row, at.place_um) * headings_at(edge.curves, near.row, foot)).sum(axis=1)
        side = np.where(
            near.distance_um <= _BESIDE * edge.reach_um, at.weight_um * along * edge.part_side[near.row], 0.0
        )
        sides.append(int(np.sign(side.sum())) * (-1 if placement.mirror else 1))
    return np.array(sides, dtype=np.int64)


def edge_sides(edge: Edge, laid: Curves, there: Directed) -> Floats:
    """Sides (n,) of the largest distance of each curve of the edge."""
    row = np.arange(len(edge.curves))
    foot = feet(laid, there.other, there.where_um).place_um
    return _sides(headings(edge.curves, row, there.fraction), edge.part_side, there.where_um - foot)


def drawing_sides(edge: Edge, back: Directed) -> Floats:
    """Sides (n,) of the largest distance of each curve of the drawing."""
    foot = feet(edge.curves, back.other, back.where_um).place_um
    heading = headings_at(edge.curves, back.other, foot)
    return _sides(heading, edge.part_side[back.other], foot - back.where_um)


def _sides(heading: Floats, part_side: Ints, from_drawing: Floats) -> Floats:
    """+1 where the edge lies outside of the drawing's part, −1 inside: moved on to the side where the part lies."""
    to_left = heading[:, 0] * from_drawing[:, 1] - heading[:, 1] * from_drawing[:, 0]
    return -np.sign(to_left) * part_side


_UNITS = {
    1000.0: ("unit-mm", "unit-um"),
    25.4: ("unit-inch", "unit-mm"),
    10.0: ("unit-cm", "unit-mm"),
    2.54: ("unit-inch", "unit-cm"),
    100.0: ("unit-m", "unit-cm"),
    39.37: ("unit-m", "unit-inch"),
}
"""Ratios of units in use; 39.37 inches make a metre (1 inch = 25.4 mm, ISO 80000-3)."""
_ALIKE = 0.01  # of a ratio
_SAME_SHAPE = 0.01  # of the size: root mean square of the distances once scaled


class UnitSlip(NamedTuple):
    """The program is `scale` times as large as the drawing; two units in that ratio, terms of the catalogue."""

    scale: float
    larger: str
    smaller: str

    @property
    def remark(self) -> Remark:
        """What is wrong, to be said."""
        times = f"{self.scale:g}" if self.scale > 1.0 else f"1/{round(1.0 / self.scale, 2):g}"
        return Remark("unit-slip", {"times": times, "larger": self.larger, "smaller": self.smaller})


def unit_slip(
    edge: Curves, edge_loop: Ints, drawing: Index, drawing_loop: Ints, as_it_is: Fit | None
) -> UnitSlip | None:
    """The slip between an edge and a drawing; None where there is none. Their fit as they are is made if not given.

    Sizes are lengths of the longest loops, of all curves where there are no loops. The drawing scaled by the slip must
    fit the edge, and as it is it must not.
    """
    ours, theirs = _size(groups(edge, edge_loop)), _size(groups(drawing.curves, drawing_loop))
    slip = _known(ours / theirs) if theirs else None
    if slip is None:
        return None
    in_scale = indexed(scaled(drawing.curves, slip.scale))
    if fit(edge, edge_loop, in_scale, drawing_loop).rms_um > _SAME_SHAPE * ours:
        return None
    as_it_is = as_it_is or fit(edge, edge_loop, drawing, drawing_loop)
    return slip if as_it_is.rms_um > _SAME_SHAPE * ours else None


def _size(of: list[CurveGroup]) -> float:
    return of[min(1, len(of) - 1)].length_um


def _known(ratio: float) -> UnitSlip | None:
    for scale, (larger, smaller) in _UNITS.items():
        for exact in (scale, 1.0 / scale):
            if abs(ratio / exact - 1.0) <= _ALIKE:
                return UnitSlip(exact, larger, smaller)
    return None


_MOST_LAYERS = 8  # named one by one


def compare(edge: Edge, drawing: Drawing, request: FitRequest) -> Comparison:
    """The edge against the drawing, one curve or more each.

    The wire leaves fillets in sharp inside corners. Where these are told apart, the edge is held against the drawing
    with the fillets; where they fail, against the drawing as it is. Raises DrawingError where that is too much work.
    """
    try:
        return _compare(edge, drawing, request)
    except DrawingError as error:
        raise DrawingError("in-file", file=printable(drawing.name), message=error.message) from None


def _compare(edge: Edge, drawing: Drawing, request: FitRequest) -> Comparison:
    whole = as_drawn(drawing)
    index, of_edge = indexed(whole.curves), indexed(edge.curves)
    as_it_is = fit(edge.curves, edge.loop, index, whole.loop) if request.fitted else None
    placement = as_it_is.placement if as_it_is else IN_PLACE
    rolled = reachable(drawing, part_sides(edge, of_edge, drawing, placement), edge.reach_um)
    target = rolled if request.sharp_corners == "tell" else whole
    if as_it_is:
        placement = settled(edge, target, placement, request.tolerance_um)
    laid = placed(target.curves, placement)
    drawn = indexed(laid)
    there, back = directed(edge.curves, drawn), directed(laid, of_edge, feet_on(drawn, edge.curves.start_um))
    slip = unit_slip(edge.curves, edge.loop, index, whole.loop, as_it_is)
    gouges = tuple(gouge for gouge in edge.gouges if gouge.depth_um > request.tolerance_um)
    names = [slip.remark] if slip else _posed(placement, edge.curves, request.tolerance_um)
    names += [Remark("lead-in-part", {"block": gouge.block, "depth": gouge.depth_um}) for gouge in gouges]
    return Comparison(
        edge=edge,
        drawing=drawing,
        target=target,
        laid=laid,
        request=request,
        placement=placement,
        scale=slip.scale if slip else 1.0,
        edge_to_drawing=there,
        drawing_to_edge=back,
        edge_side=edge_sides(edge, laid, there),
        drawing_side=drawing_sides(edge, back),
        gouges=gouges,
        unreachable=_where_laid(rolled, placement),
        names=tuple(names),
        notes=(*edge.notes, *_of_drawing(drawing), *_of_corners(target)),
    )


def _where_laid(rolled: Reachable, placement: Placement) -> tuple[Unreachable, ...]:
    """The places that the wire cannot reach, in the program's coordinates."""
    matrix, shift = turning(placement.turn_rad, mirror=placement.mirror), np.array(placement.shift_um)
    return tuple(
        place._replace(where_um=Point(*(matrix @ np.array(place.where_um) + shift).tolist()))
        for place in rolled.unreachable
    )


def _of_drawing(drawing: Drawing) -> Iterator[Remark]:
    """What its reader notes, and signs that it holds more than the contours of a part: construction lines, a frame."""
    yield from drawing.notes
    loose = sum(not loop.closed for loop in drawing.loops)
    if loose:
        yield Remark("open-chains", {"open": loose, "all": len(drawing.loops)})
    layers = sorted({entity.layer for entity in drawing.entities})
    if len(layers) > 1:
        more = ["…"] if len(layers) > _MOST_LAYERS else []
        yield Remark("all-layers", {"layers": ", ".join([*layers[:_MOST_LAYERS], *more])})


def _of_corners(target: Reachable) -> Iterator[Remark]:
    """That some of the drawing is not held against the edge."""
    if target.unreachable:
        deepest = max(corner.depth_um for corner in target.unreachable)
        yield Remark("sharp-corners", {"number": len(target.unreachable), "depth": deepest})


def _posed(placement: Placement, edge: Curves, tolerance_um: float) -> list[Remark]:
    """What is to be said of how the drawing had to be laid; a turn that moves no place past the tolerance is none."""
    names = []
    if placement.mirror:
        names.append(Remark("mirrored"))
    size = float(np.ptp(edge.start_um, axis=0).max())
    if abs(placement.turn_rad) * size > tolerance_um:
        names.append(Remark("turned", {"turn_deg": float(np.degrees(placement.turn_rad))}))
    return names


_FAR_BETTER = 0.25  # of the deviations: what another edge of the same path must come to, to be named
_MOST = 50  # contours that are looked at; more that fail have a fault in common
_ALIKE_LOOPS = 0.02  # lengths of loops that may be one and the same


class FailingContour(NamedTuple):
    """Number of a program's contour, and how far its edge lies off the drawing at most."""

    at: int
    off_um: float


def failing_contours(found: Comparison, of: ProgramEdges) -> list[FailingContour]:
    """The contours that lie past the tolerance, in their order."""
    failing = (FailingContour(at, _off(found, ring)) for at, ring in enumerate(of.rings.rings))
    return [contour for contour in failing if contour.off_um > found.request.tolerance_um]


def contour_names(
    found: Comparison, of: ProgramEdges, sides: Ints, failing: Sequence[FailingContour]
) -> list[Remark | None]:
    """A remark on each of the first contours that fail, None where no one fault explains it."""
    drawn = indexed(placed(found.drawing.curves, found.placement))
    return [_named(found, of.alone(at), sides[[at]], off_um, drawn) for at, off_um in failing[:_MOST]]


def offset_faults(offset_um: float) -> Iterator[tuple[str, float, float]]:
    """Names of faults of an offset, at which offset the edge would fit then, and how far it lies inside the part."""
    yield "wrong-side", -offset_um, 2.0 * offset_um
    yield "offset-missing", 0.0, offset_um


def most_left_um(off_um: float, tolerance_um: float) -> float:
    """What may be left of deviations of `off_um` by a fault that explains them."""
    return max(tolerance_um, _FAR_BETTER * off_um)


def _off(found: Comparison, ring: PathEdge) -> float:
    """How far the edge of a contour lies off the drawing at most."""
    return float(found.edge_to_drawing.max_um[np.isin(found.edge.block, ring.block)].max(initial=0.0))


def _named(found: Comparison, of: ProgramEdges, sides: Ints, off_um: float, drawn: Index) -> Remark | None:
    """The fault of a program's one contour `of`, whose edge is off by `off_um`."""
    span = dict(zip(("first", "last"), of.rings.rings[0].last_blocks, strict=True))
    most = most_left_um(off_um, found.request.tolerance_um)
    if of.offset_um > found.request.tolerance_um:
        for name, other_um, inside_um in offset_faults(of.offset_um):
            edge = edge_at(of, sides, other_um).curves
            if len(edge) and float(directed(edge, drawn).max_um.max()) <= most:
                return Remark(f"contour-{name}", {**span, "inside_mm": mm(inside_um)})
    shift = _shift(found, edge_at(of, sides, of.offset_um).curves, most)
    if shift is None or float(np.hypot(*shift)) <= found.request.tolerance_um:
        return None
    return Remark("contour-shifted", {**span, "shift_x_mm": mm(float(shift[0])), "shift_y_mm": mm(float(shift[1]))})


def _shift(found: Comparison, edge: Curves, most_um: float) -> Floats | None:
    """How far (2,) an edge lies off a loop of the drawing that it is of; None where no shift explains it."""
    if not len(edge):
        return None
    index = indexed(found.laid)
    tried = [shifted_onto(edge, index, start) for start in (np.zeros(2), *_starts(found, edge))]
    # Of loops that are alike the nearest one is meant.
    shifts = [-fitted.motion.shift_um for fitted in tried if fitted.max_um <= most_um]
    return min(shifts, key=lambda shift: float(np.hypot(*shift)), default=None)


def _starts(found: Comparison, edge: Curves) -> Iterator[Floats]:
    """Shifts (2,) of an edge on to loops of the drawing that are as long, and that nothing was cut along."""
    length, middle = float(edge.length_um.sum()), centroid(spread(edge, _PLACES))
    back, loop = found.drawing_to_edge.max_um, found.target.loop
    for number in range(int(loop.max(initial=-1)) + 1):
        rows: Bools = loop == number
        alike = abs(float(found.laid.length_um[rows].sum()) - length) <= _ALIKE_LOOPS * length
        if alike and float(back[rows].max()) > found.request.tolerance_um:
            yield centroid(spread(found.laid.picked(rows), _PLACES)) - middle


def compare_program(toolpath: Toolpath, offset_um: float, drawing: Drawing, request: FitRequest) -> Comparison:
    """The edge of a program whose wire cuts `offset_um` past its path, against a drawing.

    SettingsError where no contour closes, where there are more than are compared (`rings_of`), where the offset leaves
    no edge, or where it could not be worked out.
    """
    of = program_edges(toolpath, offset_um)
    if not of.rings.rings:
        raise SettingsError("no-closed-contour")
    try:
        tried = [(edge_at(of, sides, offset_um), sides) for sides in of.sides]
    except RegionError as error:
        raise SettingsError("no-edge-worked-out", first=error.first, last=error.last) from None
    tried = [(with_gouges(of, edge), sides) for edge, sides in tried if len(edge.curves)]
    if not tried:
        raise SettingsError("offset-leaves-no-edge", offset_mm=mm(offset_um))
    results = [(compare(edge, drawing, request), sides) for edge, sides in tried]
    best, sides = min(results, key=lambda result: result[0].edge_to_drawing.rms_um)
    if len(of.sides) > 1:
        best = replace(best, notes=(*best.notes, Remark("side-tried")))
    if best.passes or best.scale != 1.0:
        return best
    return replace(best, names=(*best.names, *_faults(best, of, sides)))


def _faults(found: Comparison, of: ProgramEdges, sides: Ints) -> Sequence[Remark]:
    """What is wrong with the contours that fail, or with the offset of the whole, which is wrong where all have it."""
    failing = failing_contours(found, of)
    if len(of.rings.rings) == 1:
        return _offset_names(found, of, sides)
    named = contour_names(found, of, sides, failing)
    faults = [remark for remark in named if remark is not None]
    alike = {remark.name for remark in faults} in ({"contour-wrong-side"}, {"contour-offset-missing"})
    if len(failing) == len(of.rings.rings) and (alike or len(faults) < len(failing)):
        return _offset_names(found, of, sides) or faults
    return faults


def _offset_names(found: Comparison, of: ProgramEdges, sides: Ints) -> list[Remark]:
    """Whether another edge of the same path fits the drawing far better: on its other side, or the path itself.

    Either way the part loses what the names tell, all along its edge.
    """
    if of.offset_um <= found.request.tolerance_um:
        return []
    for name, other_um, inside_um in offset_faults(of.offset_um):
        edge = edge_at(of, sides, other_um)
        if len(edge.curves) and _far_better(compare(edge, found.drawing, found.request), found):
            return [Remark(name, {"inside_mm": mm(inside_um)})]
    return []


def _far_better(other: Comparison, found: Comparison) -> bool:
    """Whether the other edge lies on the drawing; what of that nobody cut tells nothing."""
    most = most_left_um(float(found.edge_to_drawing.max_um.max()), found.request.tolerance_um)
    return float(other.edge_to_drawing.max_um.max()) <= most
