"""What lies between figures: waste that is too narrow for the wire, walls that are thin."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.model import BESIDE_UM
from parser.findings.remarks import Remark
from parser.geometry.curves import Floats, Ints, joined
from parser.geometry.inside import is_inside
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.model import CannotCutError, Figure, Refusal
from sim.make.cam.parts.contacts import between_contours, spread

_LIMIT_SHARE = 1.0 - 1e-6  # a gap as wide as the kerf is cut


def walls(figures: Sequence[Figure], offset_um: Sequence[float], reach_um: float) -> tuple[Remark, ...]:
    """What is to be said of walls between figures that are thinner than the kerf is wide.

    CannotCutError, ``too-near``, where the wire of one figure would cut another one: it removes what lies within the
    largest offset of the figure's passes and its reach, on its side of the contour. Of figures with an offset of 0
    nothing is known.
    """
    if len(figures) < 2 or max(offset_um) <= 0.0:
        return ()
    removed = [offset + reach_um if offset > 0.0 else 0.0 for offset in offset_um]
    close = _closest(figures, max(*removed, 2.0 * reach_um))
    lies = [_lies(figures, removed, close, at) for at in range(len(close.apart_um))]
    across = np.array([one.removed_um for one in lies], dtype=np.float64)
    is_wall = np.array([one.is_wall for one in lies], dtype=np.bool_)
    bad = np.flatnonzero(close.apart_um < across * _LIMIT_SHARE)
    thin = np.flatnonzero(is_wall & (close.apart_um < 2.0 * reach_um * _LIMIT_SHARE))
    if len(bad):
        worst = int(bad[np.argmin(close.apart_um[bad])])
        values = (
            ("one", str(figures[int(close.one[worst])].number)),
            ("other", str(figures[int(close.other[worst])].number)),
            ("apart_mm", f"{mm(float(close.apart_um[worst])):.4g}"),
            ("kerf_mm", f"{mm(float(across[worst])):.4g}"),
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


class _Lies(NamedTuple):
    """How much is removed between two figures by the wire of either, and whether a wall of material lies there."""

    removed_um: float
    is_wall: bool


def _lies(figures: Sequence[Figure], removed_um: Sequence[float], close: _Close, at: int) -> _Lies:
    one, other = int(close.one[at]), int(close.other[at])
    removed, is_wall = 0.0, True
    for mine, theirs in ((one, other), (other, one)):
        lies_inside = np.mean(is_inside(figures[mine].contour, spread(figures[theirs].contour))) > 0.5
        if lies_inside == figures[mine].runs_inside:
            removed, is_wall = max(removed, removed_um[mine]), False
    return _Lies(removed, is_wall)


def _told(name: str, close: _Close, thin: Ints) -> Remark:
    thinnest = int(thin[np.argmin(close.apart_um[thin])])
    x, y = (round(mm(at), 3) + 0.0 for at in close.place_um[thinnest].tolist())
    return Remark(name, {"number": len(thin), "width": float(close.apart_um[thinnest]), "place": f"({x:g}, {y:g})"})
