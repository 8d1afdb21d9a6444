"""Where to begin a fit: the two laid centre on centre, turned as their far parts agree, mirrored or not.

Every shape is told by the moments Σ w r² exp(i k φ) of its places about its centre; the turn at which those of both
agree best is the peak of a sum over k. A part that looks the same after a turn has several peaks.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Curves, Floats, Ints
from sim.measure.compare.placement import turning
from sim.measure.compare.spread import centroid, spread

_HARMONICS = np.arange(1, 49)
_TURNS = np.arange(720) * (2.0 * np.pi / 720)
_PLACES = 1000
_BACK = np.exp(-1j * np.outer(_TURNS, _HARMONICS))
_MOST_PAIRS = 4  # of loops laid on each other, besides the whole
_ALIKE = 0.05  # lengths of loops that may be one and the same
_NEAR_PEAK = 0.8  # peaks of the sum that are looked at, as a share of the highest
_HIGHEST, _LEAST_TURNED = 2, 4  # of the peaks, how many are tried


class RigidMotion(NamedTuple):
    """Moves a place x to matrix x + shift µm; the matrix (2, 2) turns, or mirrors too."""

    matrix: Floats
    shift_um: Floats

    @property
    def mirror(self) -> bool:
        """Whether it mirrors."""
        return bool(np.linalg.det(self.matrix) < 0.0)

    @property
    def turn_rad(self) -> float:
        """How far it turns, behind the mirror."""
        side = -1.0 if self.mirror else 1.0
        return float(np.arctan2(side * self.matrix[1, 0], side * self.matrix[0, 0]))

    def of(self, place_um: Floats) -> Floats:
        """Places (m, 2) moved."""
        return place_um @ self.matrix.T + self.shift_um


class CurveGroup(NamedTuple):
    """Curves of a whole, or of one loop of it."""

    curves: Curves
    length_um: float


def groups(curves: Curves, loop: Ints) -> list[CurveGroup]:
    """The whole, then its loops, the longest first; `loop` (n,) tells them apart, −1 belongs to none."""
    number = loop.max(initial=-1) + 1
    lengths = np.bincount(loop + 1, curves.length_um, number + 1)[1:]
    longest = np.argsort(-lengths, kind="stable")[: 2 * _MOST_PAIRS]
    loops = [CurveGroup(curves.picked(loop == of), float(lengths[of])) for of in longest.tolist()]
    return [CurveGroup(curves, float(curves.length_um.sum())), *loops]


def starts(edge: list[CurveGroup], drawing: list[CurveGroup]) -> Iterator[RigidMotion]:
    """Rigid motions of the edge onto the drawing to begin from, of their groups."""
    for one, other in [(edge[0], drawing[0]), *_pairs(edge[1:], drawing[1:])]:
        a, b = spread(one.curves, _PLACES), spread(other.curves, _PLACES)
        from_, to = centroid(a), centroid(b)
        moments = _moments(a.place_um - from_, a.weight_um), _moments(b.place_um - to, b.weight_um)
        for mirror in (False, True):
            # x → −x turns an angle φ into π − φ.
            of_edge = moments[0].conj() * (-1.0) ** _HARMONICS if mirror else moments[0]
            for turn in [0.0, *_peaks(of_edge, moments[1])]:
                matrix = turning(turn, mirror=mirror)
                yield RigidMotion(matrix, to - matrix @ from_)


def _pairs(edge: list[CurveGroup], drawing: list[CurveGroup]) -> list[tuple[CurveGroup, CurveGroup]]:
    """The longest loop of the edge with those of the drawing that are about as long."""
    pairs = [
        (one, other)
        for one in edge[:1]
        for other in drawing
        if abs(one.length_um - other.length_um) <= _ALIKE * one.length_um
    ]
    return pairs[:_MOST_PAIRS]


def _moments(out: Floats, weight: Floats) -> NDArray[np.complex128]:
    place = out[:, 0] + 1j * out[:, 1]
    away = np.abs(place)
    turn = np.divide(place, away, out=np.ones_like(place), where=away > 0.0)
    moments, share = np.empty(len(_HARMONICS), np.complex128), weight * away**2 + 0j
    for at in range(len(_HARMONICS)):  # each k has the phase of the one before it, turned once more
        share *= turn
        moments[at] = share.sum()
    return moments


def _peaks(edge: NDArray[np.complex128], drawing: NDArray[np.complex128]) -> list[float]:
    """Turns of the edge, rad within ±π, at which the moments agree best: the highest, and of high ones the smallest."""
    agree = (_BACK * (drawing * edge.conj())).sum(axis=1).real
    peak = np.flatnonzero((agree >= np.roll(agree, 1)) & (agree > np.roll(agree, -1)))
    peak = peak[agree[peak] >= _NEAR_PEAK * agree.max()]
    turn = np.mod(_TURNS[peak] + np.pi, 2.0 * np.pi) - np.pi
    highest, least = np.argsort(-agree[peak], kind="stable"), np.argsort(np.abs(turn), kind="stable")
    tried = {*highest[:_HIGHEST].tolist(), *least[:_LEAST_TURNED].tolist()}
    return [float(turn[at]) for at in sorted(tried)]
