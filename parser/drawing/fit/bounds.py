"""How far arcs and lines lie off a curve at most: proved by Bernstein coefficients, no sample."""

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.pieces import halves
from parser.drawing.fit.strings import Arcs, Chords, Runs, Strings, chords_between, places_on, where_at
from parser.geometry.curves import Bools, Floats, Ints

_MOST_ROUNDS = 12
_ENOUGH = 1.002  # of what is certain to be reached
_ENOUGH_OF_TOLERANCE = 1e-4
_ROUNDING = 1e-12  # of the largest coefficient


class _Parts(NamedTuple):
    """Parts (n, p + 1, 3) of pieces in the frame of their arc's chord, and the arc (n,) of each."""

    control: Floats
    arc: Ints


class _Frame(NamedTuple):
    """Of arcs (n,) in the frame of their chord: half its length, where the centre is above it, and the radius.

    Of lines the last two are infinite.
    """

    half_um: Floats
    height_um: Floats
    radius_um: Floats

    def picked(self, row: Ints) -> "_Frame":
        return _Frame(*(column[row] for column in self))


def off_at_most(strings: Strings, runs: Runs, arcs: Arcs, tolerance_um: float) -> Floats:
    """How far (n,) arcs and what they stand for lie apart at most, either way, in µm; inf where that is not proved.

    Of a rational piece of degree p from the centre, N = x² + y² − R²w² and w² have degree 2p. The least and the
    largest ratio of their Bernstein coefficients bound |P − C|² − R², and so the distance from the circle. Where the
    coefficients of x·y' − y·x' have one sign, the piece runs along the arc without turning back, so that each end of
    the arc is met once and the bound holds both ways. From a line no control point is farther than the curve is.
    """
    chord, frame = _frames(strings, runs, arcs)
    parts = _parts(strings, runs, arcs, chord)
    reached, bound = np.zeros(len(arcs.run)), np.zeros(len(arcs.run))
    for turn in range(_MOST_ROUNDS):
        at_ends, most = _off(parts, frame.picked(parts.arc))
        np.maximum.at(reached, parts.arc, at_ends)
        enough = np.maximum(_ENOUGH * reached[parts.arc], _ENOUGH_OF_TOLERANCE * tolerance_um)
        fine = most <= enough if turn + 1 < _MOST_ROUNDS else np.ones(len(most), dtype=np.bool_)
        np.maximum.at(bound, parts.arc[fine], most[fine])
        if fine.all():
            break
        before, behind = halves(parts.control[~fine])
        parts = _Parts(np.concatenate([before, behind]), np.tile(parts.arc[~fine], 2))
    return bound


def _frames(strings: Strings, runs: Runs, arcs: Arcs) -> tuple[Chords, _Frame]:
    ends = places_on(strings, np.stack([arcs.start, arcs.end], axis=1), runs.first[arcs.run], runs.last[arcs.run])
    chord = chords_between(ends[:, 0], ends[:, 1])
    height = np.divide(1.0, arcs.bend, out=np.full(len(arcs.bend), np.inf), where=arcs.bend != 0.0)
    return chord, _Frame(chord.half_um, height, np.hypot(chord.half_um, height))


def _parts(strings: Strings, runs: Runs, arcs: Arcs, chord: Chords) -> _Parts:
    """The parts of pieces that arcs stand for."""
    first, last = runs.first[arcs.run], runs.last[arcs.run]
    piece, share = where_at(strings, arcs.start, first, last)
    end_piece, end_share = where_at(strings, arcs.end, first, last)
    number = end_piece - piece + 1
    arc = np.repeat(np.arange(len(number)), number)
    at = piece[arc] + np.arange(len(arc)) - (np.cumsum(number) - number)[arc]
    low = np.where(at == piece[arc], share[arc], 0.0)
    high = np.where(at == end_piece[arc], end_share[arc], 1.0)
    some = high > low
    arc, at, low, high = arc[some], at[some], low[some], high[some]
    control = halves(halves(strings.control[at], high)[0], low / high)[1]
    out = control[:, :, :2] - chord.middle_um[arc][:, None] * control[:, :, 2:]
    along = chord.along[arc]
    x = out[:, :, 0] * along[:, None, 0] + out[:, :, 1] * along[:, None, 1]
    y = out[:, :, 1] * along[:, None, 0] - out[:, :, 0] * along[:, None, 1]
    return _Parts(np.stack([x, y, control[:, :, 2]], axis=2), arc)


def _off(parts: _Parts, frame: _Frame) -> tuple[Floats, Floats]:
    """How far parts (n,) are off their arc at one of their ends, and how far they are at most."""
    line = np.isinf(frame.height_um)
    at_ends, most = np.empty(len(line)), np.empty(len(line))
    at_ends[line], most[line] = _off_line(parts.control[line], frame.half_um[line])
    of_arc = _Frame(*(column[~line] for column in frame))
    at_ends[~line], most[~line] = _off_arc(parts.control[~line], of_arc)
    return at_ends, most


def _off_line(control: Floats, half_um: Floats) -> tuple[Floats, Floats]:
    place = control[:, :, :2] / control[:, :, 2:]
    beyond = np.maximum(np.abs(place[:, :, 0]) - half_um[:, None], 0.0)
    off = np.hypot(beyond, place[:, :, 1])
    return np.maximum(off[:, 0], off[:, -1]), off.max(axis=1)


def _off_arc(control: Floats, frame: _Frame) -> tuple[Floats, Floats]:
    x, y, w = control[:, :, 0], control[:, :, 1], control[:, :, 2]
    half, height, radius = (column[:, None] for column in frame)
    # |P − C|² − R² is x² + y² − a² − 2hy in the frame of the chord: no difference of large squares.
    square = _times(w, w)
    power = _times(x, x) + _times(y, y) - half**2 * square - 2.0 * height * _times(y, w)
    ratio = power / square
    off = np.abs(ratio) / (np.sqrt(np.maximum(radius**2 + ratio, 0.0)) + radius)
    out = y - height * w
    degree = control.shape[1] - 1
    along = _times(x, degree * np.diff(out, axis=1)) - _times(out, degree * np.diff(x, axis=1))
    along *= np.sign(height)  # counter-clockwise about a centre above the chord
    ahead = along.min(axis=1) >= -_ROUNDING * np.abs(along).max(axis=1)
    return np.maximum(off[:, 0], off[:, -1]), np.where(ahead, off.max(axis=1), np.inf)


def _times(this: Floats, other: Floats) -> Floats:
    """Bernstein coefficients (n, p + q + 1) of products of polynomials given by (n, p + 1) and (n, q + 1)."""
    outer = (this[:, :, None] * other[:, None, :]).reshape(len(this), this.shape[1] * other.shape[1])
    product: Floats = outer @ _product(this.shape[1] - 1, other.shape[1] - 1)
    return product


@cache
def _product(degree: int, other: int) -> Floats:
    """What each product of two coefficients adds to those of the product, ((p + 1)·(q + 1), p + q + 1)."""
    shares = np.zeros((degree + 1, other + 1, degree + other + 1))
    for i in range(degree + 1):
        for j in range(other + 1):
            shares[i, j, i + j] = math.comb(degree, i) * math.comb(other, j) / math.comb(degree + other, i + j)
    return shares.reshape(-1, degree + other + 1)


def are_within(bound_um: Floats, tolerance_um: float) -> Bools:
    """Whether bounds (n,) are within a tolerance, rounding aside."""
    return np.asarray(bound_um <= tolerance_um * (1.0 + 1e-9))
