"""Slips of units: a program is too large or too small, by the ratio of two units, such as inch and millimetre."""

from typing import NamedTuple

from parser.findings.remarks import Remark
from parser.geometry.curves import Curves, Ints
from sim.measure.compare.fit import Fit, fit
from sim.measure.compare.nearest import Index, indexed
from sim.measure.compare.placement import scaled
from sim.measure.compare.starts import CurveGroup, groups

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
