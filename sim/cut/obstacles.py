"""Workpiece, clamps and arm: what touches them, where the wire leaves the work; the border type is `Finding`.

Bodies that stand still, as convex shapes of pymunk: clamps grown by what moves past them, and the work.

Where a moving point meets bodies that stand still: the engine's queries, asked only where the point comes near.

A way of hundreds of thousands of samples is looked at in stretches. Numpy tells by boxes which stretches come near;
those are halved for as long as the band round their chord meets the body, down to single moves between samples.

Findings of things in the way: clamps that the wire or its arm touches, cuts that leave the workpiece or miss it.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pymunk
from numpy.typing import NDArray

from parser.dialect.reader import at_block
from parser.findings.findings import Finding, Value
from parser.geometry.curves import Floats, Ints
from parser.program import Program
from parser.shape.contours import Contour
from parser.units import mm
from sim.setup.obstacles import Outline
from sim.setup.scenario import Scenario
from sim.table.trace import Trace

ALL = pymunk.ShapeFilter()
_ON_UM = 1e-3  # a point this near to a shape lies in it, and so does one on the seam between two shapes

Place = tuple[float, float]
_FLAT_UM = 1e-6


class BodyShapes(NamedTuple):
    """Shapes of one body in a space of their own, and the boxes (m, 2, 2) µm round them, lowest and highest (x, y)."""

    space: pymunk.Space
    boxes_um: Floats

    def near(self, low: Place, high: Place) -> list[pymunk.Shape]:
        """Shapes whose boxes meet a box."""
        return self.space.bb_query(pymunk.BB(*low, *high), ALL)

    def hold(self, place: Place) -> bool:
        """Whether a place lies in the body or on its edge."""
        return bool(self.space.point_query(place, _ON_UM, ALL))

    def entered_at(self, start: Place, end: Place) -> float:
        """Share of the way from outside to inside at which the body begins."""
        hit = self.space.segment_query_first(start, end, 0.0, ALL)
        return hit.alpha if hit is not None else 1.0


def grown(outline_um: Outline, radius_um: float) -> BodyShapes:
    """Where the centre of a circle stands when it touches an outline: the outline, grown by the radius."""
    return _pieces(triangles(outline_um), radius_um)


def swept(outline_um: Outline, moving_um: Outline) -> BodyShapes:
    """Where the origin of a moving outline stands when it touches an outline that stands still.

    That is the Minkowski sum of the standing outline and the moving one mirrored at the origin (M. de Berg et al.,
    "Computational Geometry", 3rd ed. 2008, 13.2). For two convex pieces it is the hull of the differences of their
    corners.
    """
    still, moving = triangles(outline_um), triangles(moving_um)
    return _pieces((each[:, None] - other for each in still for other in moving), 0.0)


def sides(outline_um: Outline, radius_um: float) -> BodyShapes:
    """All places within a radius of the sides of an outline.

    The sides are polygons of two corners: a query along a line misses the round ends of pymunk's own segments.
    """
    corners = np.array(outline_um)
    return _pieces(np.stack([corners, np.roll(corners, -1, axis=0)], axis=1), radius_um)


def _pieces(hulls: Iterable[Floats], radius_um: float) -> BodyShapes:
    """Pieces of the hulls of points (…, 2)."""
    space = pymunk.Space()
    corners = ([(x, y) for x, y in hull.reshape(-1, 2).tolist()] for hull in hulls)
    shapes = [pymunk.Poly(space.static_body, hull, radius=radius_um) for hull in corners]
    space.add(*shapes)
    boxes = np.array([(shape.bb.left, shape.bb.bottom, shape.bb.right, shape.bb.top) for shape in shapes])
    return BodyShapes(space, boxes.reshape(-1, 2, 2))


def triangles(outline_um: Outline) -> Floats:
    """Triangles (m, 3, 2) µm, counter-clockwise, that fill an outline and do not overlap."""
    left, found = np.array(outline_um), []
    while len(left) > 3:
        ear = int(np.argmax(_clearances_um(left)))
        found.append(left[[ear - 1, ear, (ear + 1) % len(left)]])
        left = np.delete(left, ear, axis=0)
    cut = np.array([*found, left])
    side = np.roll(cut, -1, axis=1) - cut
    height = _cross(side[:, 0], side[:, 1]) / np.hypot(side[..., 0], side[..., 1]).max(axis=1)
    solid: Floats = cut[height > _FLAT_UM]
    return solid


def _clearances_um(corners: Floats) -> Floats:
    """How far outside the ear at each corner of (n, 2) the nearest other corner lies; −inf at reflex corners.

    A polygon has two ears or more (G. H. Meisters, "Polygons have ears", 1975): the clearest corner is one.
    """
    ear = np.stack([np.roll(corners, 1, axis=0), corners, np.roll(corners, -1, axis=0)], axis=1)
    side = np.roll(ear, -1, axis=1) - ear
    unit = side / np.hypot(side[..., 0], side[..., 1])[..., None]
    to = corners[None, None, :] - ear[:, :, None]
    outside = -_cross(unit[:, :, None], to).min(axis=1)  # beyond any one of three sides is outside
    own = np.eye(len(corners), dtype=np.bool_)
    outside[own | np.roll(own, 1, axis=1) | np.roll(own, -1, axis=1)] = np.inf
    clearance: Floats = outside.min(axis=1)
    clearance[_cross(side[:, 0], side[:, 1]) <= 0.0] = -np.inf
    return clearance


def _cross(this: Floats, other: Floats) -> Floats:
    product: Floats = this[..., 0] * other[..., 1] - this[..., 1] * other[..., 0]
    return product


STRETCH = 256
"""Samples in a stretch, at most."""

_GRACE_UM = 1e-3  # added to the band, so that it holds all its samples whichever way they were rounded


class Way(NamedTuple):
    """Places of a point, in stretches that each belong to one block.

    Attributes
    ----------
    place_um
        (n, 2) float64.
    ends
        (k, 2) int64, first and last sample of each stretch, in order. Where the next stretch follows at once, it begins
        with the sample that this one ends with.
    boxes_um
        (k, 2, 2) float64, lowest and highest (x, y) of each stretch.
    """

    place_um: Floats
    ends: Ints
    boxes_um: Floats

    def picked(self, which: NDArray[np.bool_]) -> "Way":
        """The way with some of its stretches, (k,) bool."""
        return self._replace(ends=self.ends[which], boxes_um=self.boxes_um[which])


class Touch(NamedTuple):
    """A touch on the move that ends in a sample, at a share of the move from the sample before."""

    sample: int
    share: float


def way_of(place_um: Floats, row: Ints) -> Way:
    """Way through places (n, 2), n ≥ 2; `row` (n,) is that of the move that ends in each place."""
    last = len(row) - 1
    borders = np.flatnonzero(np.diff(row[1:])) + 1
    cuts = np.unique(np.concatenate([np.arange(0, last, STRETCH), borders, [last]]))
    ends = np.stack([cuts[:-1], cuts[1:]], axis=1)
    low = np.minimum(np.minimum.reduceat(place_um, ends[:, 0]), place_um[ends[:, 1]])
    high = np.maximum(np.maximum.reduceat(place_um, ends[:, 0]), place_um[ends[:, 1]])
    return Way(place_um, ends, np.stack([low, high], axis=1))


def touches(way: Way, pieces: BodyShapes) -> Iterator[Touch]:
    """Every move of a way that touches a body, in order; a move that begins in touch touches at once, at share 0."""
    near = way.picked(_near(way.boxes_um, pieces.boxes_um))
    for (low, high), (lowest, highest) in zip(near.ends.tolist(), near.boxes_um.tolist(), strict=True):
        yield from _halved(pieces.near(lowest, highest), way.place_um, low, high)


def _near(boxes_um: Floats, bodies_um: Floats) -> NDArray[np.bool_]:
    """Which boxes (k, 2, 2) meet one of the bodies (m, 2, 2)."""
    near = _meet(boxes_um, np.stack([bodies_um[:, 0].min(axis=0), bodies_um[:, 1].max(axis=0)]))
    some = boxes_um[near]
    any_ = np.zeros(len(some), dtype=np.bool_)
    for body in bodies_um:
        any_ |= _meet(some, body)
    near[near] = any_
    return near


def _meet(boxes_um: Floats, box_um: Floats) -> NDArray[np.bool_]:
    (left, bottom), (right, top) = box_um
    low, high = boxes_um[:, 0], boxes_um[:, 1]
    meets: NDArray[np.bool_] = (low[:, 0] <= right) & (high[:, 0] >= left) & (low[:, 1] <= top) & (high[:, 1] >= bottom)
    return meets


def _halved(shapes: Sequence[pymunk.Shape], place_um: Floats, low: int, high: int) -> Iterator[Touch]:
    """Touches between two samples, in order: the halves are looked at where the band round the chord meets a body."""
    first, last = place_um[low].tolist(), place_um[high].tolist()
    band = _bulge_um(place_um[low : high + 1]) + _GRACE_UM if high - low > 1 else 0.0
    hits = [hit for shape in shapes if (hit := shape.segment_query(first, last, band)) is not None]
    if not hits:
        return
    if high - low == 1:
        yield Touch(high, min(hit.alpha for hit in hits))
        return
    met = [hit.shape for hit in hits if hit.shape is not None]
    middle = (low + high) // 2
    yield from _halved(met, place_um, low, middle)
    yield from _halved(met, place_um, middle, high)


def _bulge_um(place_um: Floats) -> float:
    """How far places (n, 2) lie from the chord of the first and the last, at most."""
    chord, to = place_um[-1] - place_um[0], place_um - place_um[0]
    square = max(float(chord @ chord), float(np.finfo(np.float64).tiny))
    off = to - np.clip(to @ chord / square, 0.0, 1.0)[:, None] * chord
    return float(np.hypot(off[:, 0], off[:, 1]).max())


ASTRAY_UM = 3.0
"""A wire this near to the edge of the work runs along it: steps and table stray from the path by as much."""


def obstacle_findings(program: Program, trace: Trace, contours: Sequence[Contour], scenario: Scenario) -> list[Finding]:
    """Findings 3B404 and 3B405 of a run.

    3B404, an error, is the first touch of the wire, and of the arm, on each clamp. The wire is threaded on cuts alone;
    the arm moves on jumps too. 3B405, a warning, is the first place of each contour where the wire's centre leaves the
    work, save at its lead-in from outside and its lead-out.
    """
    if not scenario.clamps and scenario.work_um is None:
        return []
    wire = way_of(trace.wire_um, trace.row)
    cut = wire.picked(~program.toolpath.is_jump[trace.row[wire.ends[:, 1]]])
    return [*_touched(program, trace, cut, scenario), *_findings_of(program, trace, cut, contours, scenario)]


def missed_work_findings(program: Program, trace: Trace, scenario: Scenario) -> list[Finding]:
    """Finding 3B408, an error, of a run whose kerf nowhere comes to the work."""
    if scenario.work_um is None:
        return []
    wire = way_of(trace.wire_um, trace.row)
    cut = wire.picked(~program.toolpath.is_jump[trace.row[wire.ends[:, 1]]])
    if not len(cut.ends) or any(touches(cut, grown(scenario.work_um, scenario.wire.reach_um))):
        return []
    begin = Touch(int(cut.ends[0, 0]) + 1, 0.0)
    return [at_block(program.toolpath, program.lines, "3B408", _row(trace, begin), **_where(trace, cut, begin))]


def _touched(program: Program, trace: Trace, cut: Way, scenario: Scenario) -> Iterator[Finding]:
    """First touch of each body on each clamp."""
    arm_um = scenario.machine.arm_um
    table = way_of(trace.table_um, trace.row) if arm_um is not None else cut
    for clamp in scenario.clamps:
        bodies: dict[str, tuple[Way, BodyShapes]] = {"wire": (cut, grown(clamp.outline_um, scenario.wire.radius_um))}
        if arm_um is not None:
            bodies["arm"] = table, swept(clamp.outline_um, arm_um)
        for body, (way, pieces) in bodies.items():
            for touch in touches(way, pieces):
                values: dict[str, Value] = {"body": body, "name": clamp.name, **_where(trace, way, touch)}
                yield at_block(program.toolpath, program.lines, "3B404", _row(trace, touch), **values)
                break


def _findings_of(
    program: Program, trace: Trace, cut: Way, contours: Sequence[Contour], scenario: Scenario
) -> Iterator[Finding]:
    if scenario.work_um is not None:
        for touch in leavings(scenario.work_um, trace, cut, contours):
            yield at_block(program.toolpath, program.lines, "3B405", _row(trace, touch), **_where(trace, cut, touch))


def _row(trace: Trace, touch: Touch) -> int:
    return int(trace.row[touch.sample])


def _where(trace: Trace, way: Way, touch: Touch) -> dict[str, float]:
    """Place of the wire at a touch, mm, and the time, s."""
    sample, share = touch
    place, time = way.place_um[sample - 1 : sample + 1], trace.t_s[sample - 1 : sample + 1]
    x, y = mm(place[0] + share * (place[1] - place[0])).tolist()
    return {"x_mm": x, "y_mm": y, "t_s": float(time[0] + share * (time[1] - time[0]))}


def leavings(outline_um: Outline, trace: Trace, cut: Way, contours: Sequence[Contour]) -> Iterator[Touch]:
    """First place of each contour at which the wire's centre leaves the work; `cut` is its way where it cuts.

    A lead-out, the last block, leaves no finding; neither does the first block of a contour that begins outside.
    """
    work, edges = grown(outline_um, 0.0), sides(outline_um, ASTRAY_UM)
    for contour in contours:
        way = _of_contour(cut, trace, contour)
        if len(way.ends):
            yield from _first_out(way, trace, contour, work, edges)


def _of_contour(cut: Way, trace: Trace, contour: Contour) -> Way:
    row = trace.row[cut.ends[:, 1]]
    return cut.picked((row >= contour.first - 1) & (row <= contour.last - 1))


def _first_out(way: Way, trace: Trace, contour: Contour, work: BodyShapes, edges: BodyShapes) -> Iterator[Touch]:
    """The first leaving that counts, if any: the last crossing of the edge before the wire is clear of it outside."""
    begins_inside = inside = work.hold(_at(way.place_um, int(way.ends[0, 0])))
    quiet = {contour.last - 1} if begins_inside else {contour.first - 1, contour.last - 1}
    crossing: Touch | None = None
    for sample, _ in touches(way, edges):
        start, end = _at(way.place_um, sample - 1), _at(way.place_um, sample)
        holds = work.hold(end)
        if not holds and work.hold(start):
            crossing = Touch(sample, 1.0 - work.entered_at(end, start))
        if edges.hold(end):
            continue
        if (
            (inside and not holds and crossing is not None)
            # A block may end on the edge; then the next one leaves.
            and quiet.isdisjoint(trace.row[[crossing.sample, sample]].tolist())
        ):
            yield crossing
            return
        inside = holds


def _at(place_um: Floats, sample: int) -> tuple[float, float]:
    x, y = np.asarray(place_um[sample]).tolist()
    return x, y
