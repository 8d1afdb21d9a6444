"""Where to begin a fit: the two laid centre on centre, turned as their far parts agree, mirrored or not.

Every shape is told by the moments Σ w r² exp(i k φ) of its places about its centre; the turn at which those of both
agree best is the peak of a sum over k. A part that looks the same after a turn has several peaks.

Where the drawing lies in the program's coordinates.

Places spread over curves, each with the length that it stands for.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.drawing.model import Drawing, running
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints

_WIDEST_RAD = np.radians(10.0)
_GAUSS = 0.5 / np.sqrt(3.0)  # of a stretch, from its middle: two places that integrate cubics exactly


class Spread(NamedTuple):
    """Places (m, 2), the rows (m,) that they lie on and their weights (m,), lengths in µm."""

    place_um: Floats
    row: Ints
    weight_um: Floats


def spread(curves: Curves, number: int, most: int | None = None) -> Spread:
    """At least `number` places, at least two on each curve; where these are more than `most`, every so many of them."""
    length = float(curves.length_um.sum())
    by_length = np.ceil(curves.length_um * (0.5 * number / length)) if length else 0.0
    stretches = np.maximum(np.maximum(by_length, np.ceil(np.abs(curves.sweep_rad) / _WIDEST_RAD)), 1.0)
    rows = np.repeat(np.arange(len(curves)), stretches.astype(np.int64))
    every = max(2 * len(rows) // number, 1) if most is not None and 2 * len(rows) > most else 1
    # First of the two places on all stretches, then the second ones.
    second, stretch = np.divmod(np.arange(0, 2 * len(rows), every), len(rows))
    row = rows[stretch]
    at = stretch - (np.cumsum(stretches) - stretches)[row]
    fraction = (at + 0.5 + (2.0 * second - 1.0) * _GAUSS) / stretches[row]
    return Spread(places(curves, row, fraction), row, 0.5 * (curves.length_um / stretches)[row])


def centroid(of: Spread) -> Floats:
    """Centre of gravity (2,) of the curves as wires."""
    weight = of.weight_um / of.weight_um.sum()
    middle: Floats = weight @ of.place_um
    return middle


class Placement(NamedTuple):
    """A place x of the drawing lies at turned(mirrored(x)) + shift in the program's coordinates.

    Attributes
    ----------
    turn_rad
        Counter-clockwise about (0, 0), after the mirror.
    shift_um
        (x, y) after the turn.
    mirror
        Whether x → −x comes first.
    """

    turn_rad: float
    shift_um: tuple[float, float]
    mirror: bool


IN_PLACE = Placement(0.0, (0.0, 0.0), mirror=False)


def placed(curves: Curves, placement: Placement) -> Curves:
    """The curves moved, in their order; arcs stay arcs of their radii."""
    matrix, shift = turning(placement.turn_rad, mirror=placement.mirror), np.array(placement.shift_um)
    side = -1.0 if placement.mirror else 1.0
    start = curves.start_angle_rad * side + (np.pi if placement.mirror else 0.0) + placement.turn_rad
    return Curves(
        kind=curves.kind,
        start_um=curves.start_um @ matrix.T + shift,
        end_um=curves.end_um @ matrix.T + shift,
        center_um=curves.center_um @ matrix.T + shift,
        radius_um=curves.radius_um,
        start_angle_rad=start,
        sweep_rad=curves.sweep_rad * side,
        length_um=curves.length_um,
    )


def laid_loops(drawing: Drawing, placement: Placement) -> list[Curves]:
    """The loops of a drawing as it is laid, each as it runs: a curve begins where the one before it ends."""
    return [placed(running(drawing.curves, loop.row, loop.backwards), placement) for loop in drawing.loops]


def turning(turn_rad: float, *, mirror: bool = False) -> Floats:
    """Matrix (2, 2) of a turn, behind x → −x where mirrored."""
    cos, sin = np.cos(turn_rad), np.sin(turn_rad)
    matrix = np.array([[cos, -sin], [sin, cos]])
    return matrix @ np.diag([-1.0, 1.0]) if mirror else matrix


def scaled(curves: Curves, factor: float) -> Curves:
    """The curves `factor` times as large about (0, 0)."""
    return replace(
        curves.picked(slice(None)),
        start_um=curves.start_um * factor,
        end_um=curves.end_um * factor,
        center_um=curves.center_um * factor,
        radius_um=curves.radius_um * factor,
        length_um=curves.length_um * factor,
    )


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
    for this, other in [(edge[0], drawing[0]), *_pairs(edge[1:], drawing[1:])]:
        a, b = spread(this.curves, _PLACES), spread(other.curves, _PLACES)
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
        (curve_group, other)
        for curve_group in edge[:1]
        for other in drawing
        if abs(curve_group.length_um - other.length_um) <= _ALIKE * curve_group.length_um
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
