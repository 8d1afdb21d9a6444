"""The walls of a made program at all heights, held against its drawing by distances alone.

At a height z a wall that leans by T stands d = |z − p| tan T beside the contour as it is drawn in the program plane p.
So no place of the edge there is nearer to that contour than d, and d straight beside a place of the contour there is an
edge, wherever nothing else of the contour is nearer. Neither asks how a corner is made, nor knows how the path was.

Between two drawings a wall is ruled: at a height it is the section of the surface between partners, and at the top the
drawing of the top itself.
"""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.curves import Floats
from parser.toolpath import Point
from parser.units import mm
from sim.cut.pieces.kept_edges import kept_shapes
from sim.cut.pieces.pieces import Pieces
from sim.cut.solids import Section, TiltedCut
from sim.make.cam.lean.angle import grows_upwards
from sim.make.cam.model import CutPlan
from sim.make.cam.proof_model import Fault, WallOff
from sim.make.cam.target import Target
from sim.measure.compare.rings import polygon
from sim.setup.taper import TaperSettings

_PLACES_UM: Final = 100.0
"""Between places that are looked at along an edge."""
_MOST_PLACES: Final = 20_000
_SWALLOWED_UM: Final = 0.5
"""A place straight beside the contour that lies so much nearer to another part of it is within a corner."""
_ALIKE: Final = 0.5
"""An edge is that of a contour where both have at least this share of their areas in common."""
_FAR_MITRE: Final = 50.0
"""How far corners of a wall are prolonged at most, in offsets."""
_QUARTER: Final = 64
"""Lines of a quarter of a round."""
_MITRE: Final = 4.0
"""Corners that turn by up to 145° are extended to where their walls meet, 3.33 d away."""


def walls_off(cut: TiltedCut, plan: CutPlan, target: Target) -> Iterator[WallOff]:
    """How far the walls of each contour lie off at each height but that of the program; µm.

    A contour of which no edge is found at a height is infinitely far off. Sections whose pieces are not known are left
    out.
    """
    taper = plan.taper
    if taper is None or taper.angle_rad is None:
        return
    for section in cut.sections:
        by_um = (section.z_um - cut.path.heights.program_um) * float(np.tan(taper.angle_rad))
        if section.pieces is not None and by_um:
            yield from _at_height(section, by_um, plan, target, taper)


def ruled_walls_off(
    cut: TiltedCut, plan: CutPlan, target: Target, top: Sequence[shapely.Polygon], reach_um: float
) -> Iterator[WallOff]:
    """How far the walls between two drawings lie off at each height but that of the lower one, as `walls_off` has them.

    `top` are the contours of the drawing of the top, as drawn. What a round wire cannot reach in a corner is no fault.
    """
    heights = cut.path.heights
    for section in cut.sections:
        if section.pieces is None or section.z_um == heights.program_um:
            continue
        edges = _edges(section.pieces)
        for at in target.cut.tolist():
            figure = plan.cuts[at].figure
            wall = polygon(plan.facings[at].ruled(heights.program_um, heights.work_um).section(section.z_um)[0])
            if section.z_um == heights.work_um:
                wall = _most_alike(np.array(top), wall) or wall
            edge = _most_alike(edges, wall)
            if edge is None:
                yield WallOff(figure.number, section.z_um, np.inf, Point(0.0, 0.0))
                continue
            # The wire's way, prolonged round corners, and from there what a round wire leaves.
            by_um = -reach_um if figure.runs_inside else reach_um
            reached = wall.buffer(by_um, join_style="mitre", mitre_limit=_FAR_MITRE).buffer(-by_um, quad_segs=_QUARTER)
            off_um, where = _apart(edge.exterior, shapely.Polygon(reached.exterior).exterior)
            yield WallOff(figure.number, section.z_um, off_um, Point(*where.tolist()))


def _apart(edge: shapely.LinearRing, wall: shapely.LinearRing) -> tuple[float, Floats]:
    """How far two rings lie apart at most, from each to the other, and where."""
    places = [_places(edge), _places(wall)]
    off = np.concatenate([_distance(places[0], wall), _distance(places[1], edge)])
    worst = int(np.argmax(off))
    return float(off[worst]), np.concatenate(places)[worst]


def _edges(pieces: Pieces) -> NDArray[np.object_]:
    """The edges that a cut leaves, as polygons."""
    return np.array([shapely.Polygon(shape.outline_um.exterior) for shape in kept_shapes(pieces)])


def wall_faults(walls: Sequence[WallOff], bound_um: float) -> Iterator[Fault]:
    """The worst height of each figure whose walls lie farther off than a bound."""
    worst = {wall.figure: wall for wall in sorted(walls, key=lambda wall: wall.off_um)}  # the farthest is entered last
    for wall in worst.values():
        if wall.off_um == np.inf:
            yield Fault("no-wall", {"z_mm": mm(wall.z_um)}, None, wall.figure)
        elif wall.off_um > bound_um:
            where = {"x_mm": mm(wall.where_um.x), "y_mm": mm(wall.where_um.y)}
            values = {"z_mm": mm(wall.z_um), "off": wall.off_um, "bound": bound_um, **where}
            yield Fault("wall", values, wall.where_um, wall.figure)


def _at_height(
    section: Section, by_um: float, plan: CutPlan, target: Target, taper: TaperSettings
) -> Iterator[WallOff]:
    assert section.pieces is not None  # noqa: S101 - asked before
    edges = _edges(section.pieces)
    for drawn, at in zip(target.shapes, target.cut.tolist(), strict=True):
        figure_cut = plan.cuts[at]
        number, out_um = figure_cut.figure.number, by_um if grows_upwards(figure_cut, taper) else -by_um
        edge = _most_alike(edges, drawn.buffer(out_um, join_style="mitre", mitre_limit=_MITRE))
        if edge is None:
            yield WallOff(number, section.z_um, np.inf, Point(0.0, 0.0))
        else:
            off_um, where = _off(edge.exterior, shapely.Polygon(drawn.exterior), out_um)
            yield WallOff(number, section.z_um, off_um, Point(*where.tolist()))


def _most_alike(edges: NDArray[np.object_], wall: shapely.Geometry) -> shapely.Polygon | None:
    """The edge that has most in common with a wall; None where none has enough."""
    if not len(edges):
        return None
    common = shapely.area(shapely.intersection(edges, wall))
    share = common / np.maximum(shapely.area(edges), shapely.area(wall))
    best = int(np.argmax(share))
    found: shapely.Polygon = edges[best]
    return found if share[best] >= _ALIKE else None


def _off(edge: shapely.LinearRing, drawn: shapely.Polygon, out_um: float) -> tuple[float, Floats]:
    """How far an edge lies off the wall of a contour, and where: too near to it, or not beside it."""
    contour, on_edge, opposite = drawn.exterior, _places(edge), _opposite(drawn, out_um)
    too_near = abs(out_um) - _distance(on_edge, contour)
    opposite = opposite[_distance(opposite, contour) >= abs(out_um) - _SWALLOWED_UM]
    off, where = np.concatenate([too_near, _distance(opposite, edge)]), np.concatenate([on_edge, opposite])
    worst = int(np.argmax(off))
    return max(float(off[worst]), 0.0), where[worst]


def _distance(place_um: Floats, ring: shapely.LinearRing) -> Floats:
    """(n,) of places (n, 2) from a ring."""
    found: Floats = np.asarray(shapely.distance(shapely.points(place_um), ring))
    return found


def _opposite(drawn: shapely.Polygon, out_um: float) -> Floats:
    """Places (n, 2) straight beside a contour: so far outside of it, below 0 inside."""
    ring = shapely.segmentize(shapely.geometry.polygon.orient(drawn).exterior, _step_um(drawn.exterior))
    corner = np.asarray(ring.coords)[:, :2]
    way, middle = np.diff(corner, axis=0), 0.5 * (corner[1:] + corner[:-1])
    length = np.hypot(*way.T)
    outwards = np.stack([way[:, 1], -way[:, 0]], axis=1)[length > 0.0] / length[length > 0.0, None]
    opposite: Floats = middle[length > 0.0] + out_um * outwards
    return opposite


def _places(ring: shapely.LinearRing) -> Floats:
    found: Floats = np.asarray(shapely.segmentize(ring, _step_um(ring)).coords)[:, :2]
    return found


def _step_um(ring: shapely.LinearRing) -> float:
    return max(_PLACES_UM, ring.length / _MOST_PLACES)
