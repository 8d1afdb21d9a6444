"""Small holes cut without a core: the wire takes the slug away from the inside out, so that nothing falls.

The way is a spiral of offsets of the contour, each a little nearer to it than the one before, so near that the kerf
takes all that lies between. It ends where the first pass begins: to all that follows it is a long lead-in. Whether
something is left is looked at here in polygons, and proved by the run of the written program.
"""

import math
from typing import Final

import numpy as np
import shapely

from controller.offset.chain import lines_between
from parser.findings.catalogue import Remark
from parser.geometry.along import outline
from parser.geometry.curves import Curves, Floats, curves_between, joined
from sim.make.cam.leads import line, run_back
from sim.make.cam.model import CannotCutError, CutPlan, FigureCut, PassCut, Refusal
from sim.make.cam.offset_path import SHORT_UM
from sim.make.cam.passes import around, figure_cut, parted
from sim.measure.compare.rings import polygon
from sim.setup.making import Making

WIDEST_UM: Final = 10_000.0
"""The width of the largest hole without a core: the way grows with the area, to some 500 mm here (assumed)."""
_STEPS: Final = (1.5, 1.35, 1.2, 1.05, 0.9, 0.75, 0.6)
"""Of the wire's reach, tried one after the other: 2 would do between straight lines, less does in sharp corners."""
_REACHED: Final = 0.99  # of the reach: what a path in whole µm and lines for arcs may lie off
_COARSE: Final = 0.07  # of a step: how far lines lie off the turn that they stand for
_NOTHING_UM2: Final = 1.0
_LEAST_ROOM: Final = 0.3  # of a step: a narrower turn would run there and back
_TOUCHING_UM: Final = 2.0  # check calls what runs through each other by 5 µm a crossing
_LEAST_TURN: Final = 4.0  # steps: from the end of a shorter turn the way would cross its start, and seem to close


def coreless(plan: CutPlan, with_core: frozenset[int]) -> CutPlan:
    """A plan whose small holes leave no core, with what is to be said of holes that keep theirs.

    `with_core` are numbers of those that do so in any case. So do holes with another contour in them: an island is a
    part. CannotCutError, ``no-core-offset``, where the path is the contour itself.
    """
    contours = [*(cut.figure.contour for cut in plan.cuts), *(each.contour for each in plan.uncut)]
    places = shapely.STRtree(shapely.points([contour.start_um[0] for contour in contours]).tolist())
    holes = [cut.figure.runs_inside and cut.figure.number not in with_core for cut in plan.cuts]
    made = [
        _without_core(cut, places, plan.making) if is_asked else cut
        for cut, is_asked in zip(plan.cuts, holes, strict=True)
    ]
    numbers = [str(cut.figure.number) for cut in made if cut.figure.runs_inside and not cut.is_coreless]
    notes = (Remark("core-stays", {"figures": ", ".join(numbers)}),) if numbers else ()
    return plan._replace(cuts=tuple(made), notes=(*plan.notes, *notes))


def _without_core(cut: FigureCut, places: shapely.STRtree, making: Making) -> FigureCut:
    """The cut of a hole with a lead-in that takes the slug away; as it is where that is too wide, or no way does.

    `places` has one of each contour: none but its own lies in a hole that can be cut so.
    """
    reach_um = min(each.by_um for each in cut.passes)
    if reach_um <= 0.0:
        raise CannotCutError(Refusal("no-core-offset"))
    hole = polygon(cut.figure.contour)
    if len(places.query(hole, predicate="contains_properly")):
        return cut
    room_um = float(shapely.length(shapely.maximum_inscribed_circle(hole, tolerance=1.0)))
    if 2.0 * room_um > WIDEST_UM + 1.0:
        return cut
    whole = _without_tab(cut, making)
    for share in _STEPS:
        step_um = share * reach_um
        way = (
            _round_spiral(whole, step_um) if len(cut.figure.contour) == 1 else _spiral(whole, step_um, room_um, making)
        )
        if _is_plain(whole, way) and _is_all_taken(hole, way, whole.passes[0], reach_um):
            first = whole.passes[0]._replace(into=way)
            return whole._replace(passes=(first, *whole.passes[1:]), is_coreless=True)
    return cut


def _without_tab(cut: FigureCut, making: Making) -> FigureCut:
    """The cut of a hole all round: there is no slug that could hang by a tab."""
    if not cut.cut_off:
        return cut
    passes_um = tuple(each.by_um for each in cut.passes)
    return figure_cut(cut.figure, cut.thread, passes_um, making._replace(slug_tab_um=0.0, layers=()))


def _round_spiral(cut: FigureCut, step_um: float) -> Curves:
    """The way from the thread point in a round hole to the start of the first pass, in half circles.

    Their centres lie a quarter of a step to either side of that of the hole, on the line through that start. So all
    begin and end on this line, run on into each other, and count to their ends without an error.
    """
    first, center = cut.passes[0], cut.figure.contour.center_um[0]
    by = first.along.start_um[0] - center
    radius_um = math.hypot(*by)
    halves = max(math.ceil(2.0 * radius_um / step_um) - 2, 0)
    number = np.arange(halves, -1, -1)
    far = (radius_um - 0.5 * step_um * number) / radius_um
    places = center + ((-1.0) ** number * far)[:, None] * by
    start, end = places[:-1], places[1:]
    sweep = np.full(halves, math.pi if cut.is_ccw else -math.pi)
    turns = curves_between(start, end, 0.5 * (start + end), sweep)
    return joined([line(np.array(cut.thread.place_um, dtype=np.float64), places[0]), turns])


def _spiral(cut: FigureCut, step_um: float, room_um: float, making: Making) -> Curves:
    """The way from the thread point to the start of the first pass, over offsets of the contour `step_um` apart.

    `room_um` is the radius of the largest circle in the hole. The way is of lines between whole µm: it need
    not lie just there, and they count to their ends without an error.
    """
    turns = [_turn(ring, step_um) for ring in reversed(_rings(cut, step_um, room_um, making))]
    corners = np.round(np.concatenate([[cut.thread.place_um], *turns])) + 0.0
    way = np.concatenate([corners, cut.passes[0].along.start_um[:1]])
    way = way[np.append(True, np.hypot(*np.diff(way, axis=0).T) >= SHORT_UM)]
    return lines_between(way[:-1], way[1:])


def _turn(ring: Curves, step_um: float) -> Floats:
    """Corners (m, 2) of a turn along a ring that ends a step before it closes."""
    turn, _ = parted(ring, float(ring.length_um.sum()) - step_um)
    corners = np.concatenate([outline(turn), turn.end_um[-1:]])
    return np.asarray(shapely.simplify(shapely.LineString(corners), _COARSE * step_um).coords)


def _rings(cut: FigureCut, step_um: float, room_um: float, making: Making) -> list[Curves]:
    """Offsets of the contour farther from it than the first pass, the nearest first, as far as there is one loop."""
    rings: list[Curves] = []
    for by_um in np.arange(cut.passes[0].by_um + step_um, room_um - _LEAST_ROOM * step_um, step_um).tolist():
        try:
            ring = around(cut.figure, cut.thread, by_um, making)
        except CannotCutError:
            break
        if float(ring.length_um.sum()) < _LEAST_TURN * step_um:
            break
        rings.append(ring if cut.is_ccw else run_back(ring))
    return rings


def _is_plain(cut: FigureCut, way: Curves) -> bool:
    """Whether a way does not cross itself, and the straight way back to the thread point only touches its turns.

    So it is where the turns lie about the thread point, and begin one behind the other on the lead.
    """
    corners = np.concatenate([outline(way), way.end_um[-1:]])
    back = shapely.LineString([corners[-1], cut.thread.place_um])
    met = shapely.get_coordinates(shapely.intersection(back, shapely.LineString(corners)))
    far = shapely.distance(shapely.points(met), shapely.MultiPoint(corners))
    return bool(shapely.is_simple(shapely.LineString(corners)) and far.max(initial=0.0) <= _TOUCHING_UM)


def _is_all_taken(hole: shapely.Polygon, way: Curves, first: PassCut, reach_um: float) -> bool:
    """Whether the kerf of a way, and of the pass behind it, leaves nothing within the pass."""
    ways = shapely.LineString(np.concatenate([outline(joined([way, first.along])), first.along.end_um[-1:]]))
    left = hole.buffer(-first.by_um).difference(ways.buffer(_REACHED * reach_um))
    return bool(left.area <= _NOTHING_UM2)
