"""What is wrong with one contour of several: cut on the wrong side of its path, without offset, or off its place."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from parser.findings.remarks import Remark
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.units import mm
from sim.measure.compare.consensus import shifted_onto
from sim.measure.compare.directed import directed
from sim.measure.compare.nearest import Index, indexed
from sim.measure.compare.placement import placed
from sim.measure.compare.program_edge import ProgramEdges, edge_at
from sim.measure.compare.result import Comparison
from sim.measure.compare.rings import PathEdge
from sim.measure.compare.spread import centroid, spread

_FAR_BETTER = 0.25  # of the deviations: what another edge of the same path must come to, to be named
_MOST = 50  # contours that are looked at; more that fail have a fault in common
_ALIKE = 0.02  # lengths of loops that may be one and the same
_PLACES = 400


class FailingContour(NamedTuple):
    """Number of a program's contour, and how far its edge lies off the drawing at most."""

    at: int
    off_um: float


def failing_contours(found: Comparison, of: ProgramEdges) -> list[FailingContour]:
    """The contours that lie past the tolerance, in their order."""
    each = (FailingContour(at, _off(found, ring)) for at, ring in enumerate(of.rings.rings))
    return [contour for contour in each if contour.off_um > found.asked.tolerance_um]


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
    most = most_left_um(off_um, found.asked.tolerance_um)
    if of.offset_um > found.asked.tolerance_um:
        for name, other_um, inside_um in offset_faults(of.offset_um):
            edge = edge_at(of, sides, other_um).curves
            if len(edge) and float(directed(edge, drawn).max_um.max()) <= most:
                return Remark(f"contour-{name}", {**span, "inside_mm": mm(inside_um)})
    shift = _shift(found, edge_at(of, sides, of.offset_um).curves, most)
    if shift is None or float(np.hypot(*shift)) <= found.asked.tolerance_um:
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
        alike = abs(float(found.laid.length_um[rows].sum()) - length) <= _ALIKE * length
        if alike and float(back[rows].max()) > found.asked.tolerance_um:
            yield centroid(spread(found.laid.picked(rows), _PLACES)) - middle
