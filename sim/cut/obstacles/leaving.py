"""Where cuts leave the workpiece."""

from collections.abc import Iterator, Sequence

import numpy as np

from parser.geometry.curves import Floats
from parser.shape.contours import Contour
from sim.cut.obstacles.bodies import Pieces, grown, sides
from sim.cut.obstacles.touches import Touch, Way, touches
from sim.setup.obstacles import Outline
from sim.table.trace import Trace

ASTRAY_UM = 3.0
"""A wire this near to the edge of the work runs along it: steps and table stray from the path by as much."""


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
    return cut.kept((row >= contour.first - 1) & (row <= contour.last - 1))


def _first_out(way: Way, trace: Trace, contour: Contour, work: Pieces, edges: Pieces) -> Iterator[Touch]:
    """The first leaving that counts, if any: where the edge was crossed before the wire was clear of it outside."""
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
