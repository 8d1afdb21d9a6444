"""What lies between figures: waste that is too narrow for the wire, walls that are thin."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.model import BESIDE_UM
from parser.findings.remarks import Remark
from parser.geometry.curves import Floats, Ints, joined
from parser.toolpath import Point
from parser.units import mm
from sim.cam.model import CannotCutError, Figure, Refusal
from sim.cam.parts.contacts import between_contours, spread
from sim.cam.parts.inside import is_inside

_LIMIT_SHARE = 1.0 - 1e-6  # a gap as wide as the kerf is cut


def walls(figures: Sequence[Figure], passes_um: Sequence[float], reach_um: float) -> tuple[Remark, ...]:
    """What is to be said of walls between figures that are thinner than the kerf is wide.

    CannotCutError, ``too-near``, where the wire of one figure would cut another one: it removes what lies within its
    largest offset and its reach, on its side of the contour. Nothing is looked at where the offset is 0.
    """
    most = max(passes_um)
    if most <= 0.0 or len(figures) < 2:
        return ()
    close = _closest(figures, max(most + reach_um, 2.0 * reach_um))
    cut = [_is_cut(figures, close, at, most + reach_um) for at in range(len(close.apart_um))]
    bad, thin = (np.flatnonzero([one is which for one in cut]) for which in (True, False))
    if len(bad):
        worst = int(bad[np.argmin(close.apart_um[bad])])
        values = (
            ("one", str(figures[int(close.one[worst])].number)),
            ("other", str(figures[int(close.other[worst])].number)),
            ("apart_mm", f"{mm(float(close.apart_um[worst])):.4g}"),
            ("kerf_mm", f"{mm(most + reach_um):.4g}"),
        )
        raise CannotCutError(Refusal("too-near", tuple(Point(x, y) for x, y in close.place_um[bad].tolist()), values))
    touch = close.apart_um[thin] <= BESIDE_UM
    told = ("contours-touch", thin[touch]), ("thin-walls", thin[~touch])
    return tuple(_told(name, close, which) for name, which in told if len(which))


class _Close(NamedTuple):
    """Pairs (k,) of figures near each other, by their places in the sequence, how far apart, and where (k, 2)."""

    one: Ints
    other: Ints
    apart_um: Floats
    place_um: Floats


def _closest(figures: Sequence[Figure], within_um: float) -> _Close:
    curves = joined([figure.contour for figure in figures])
    of = np.repeat(np.arange(len(figures)), [len(figure.contour) for figure in figures])
    near = between_contours(curves, of, within_um * _LIMIT_SHARE)
    one, other = of[near.path_row], of[near.row]
    key = one * len(figures) + other
    order = np.lexsort([near.distance_um, key])
    first = order[np.diff(key[order], prepend=-1) > 0]
    return _Close(one[first], other[first], near.distance_um[first], near.place_um[first])


def _is_cut(figures: Sequence[Figure], close: _Close, at: int, kerf_um: float) -> bool | None:
    """Whether the wire of one of two figures cuts the other; None where it would, but lies far enough from it."""
    pair = figures[int(close.one[at])], figures[int(close.other[at])]
    for figure, other in (pair, pair[::-1]):
        lies_inside = bool(np.mean(is_inside(figure.contour, spread(other.contour))) > 0.5)
        if lies_inside == figure.runs_inside:
            return True if close.apart_um[at] < kerf_um * _LIMIT_SHARE else None
    return False


def _told(name: str, close: _Close, thin: Ints) -> Remark:
    thinnest = int(thin[np.argmin(close.apart_um[thin])])
    x, y = (round(mm(at), 3) + 0.0 for at in close.place_um[thinnest].tolist())
    return Remark(name, {"number": len(thin), "width": float(close.apart_um[thinnest]), "place": f"({x:g}, {y:g})"})
