"""Pieces joined to strings: runs of curve without a corner, and a length along all of them that tells places."""

import math
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.curves.pieces import Pieces, legs_of
from parser.geometry.curves import Bools, Floats, Ints, total_before

_CORNER_RAD = math.radians(1.0)
"""Directions that jump more are corners: arcs with nodes on a curve join at up to 2°, so less is no one's intent."""
_SAME_UM = 1e-6  # what rounding leaves between the ends of pieces that follow each other
_STEPS = 8  # of each piece in the table of lengths
_SEEN = 1e-6  # a leg of a control polygon that is shorter beside the whole has no direction to speak of


class Strings(NamedTuple):
    """Runs of curve, and where along all of them each place is.

    Attributes
    ----------
    power
        (degree + 1, n, 3) coefficients of the powers 0 … of each piece's parameter in [0, 1], as x·w, y·w, w.
    control
        (n, degree + 1, 3) the same as control points.
    along, at
        (m,) lengths along all pieces, close to those of arc, and the piece and the share of it there, as one number.
    first, last
        (k,) the pieces of a string: from `first` to before `last`.
    of
        (k,) the curve that it is of.
    is_closed
        (k,) whether it runs into itself smoothly; its pieces then stand there twice, for runs that start anywhere.
    """

    power: Floats
    control: Floats
    along: Floats
    at: Floats
    first: Ints
    last: Ints
    of: Ints
    is_closed: Bools


def strings_of(pieces: Pieces) -> Strings:
    """The strings of pieces. ValueError where pieces of one curve do not meet."""
    follows = np.diff(pieces.of) == 0
    place = pieces.control[:, [0, -1], :2] / pieces.control[:, [0, -1], 2:]
    gap = np.hypot(*(place[1:, 0] - place[:-1, 1]).T)
    scale = np.abs(place).max(initial=1.0)
    same = max(_SAME_UM, 1e-13 * scale)
    if (gap[follows] > same).any():
        raise ValueError("a curve that is torn")
    into, out = _directions(pieces.control)
    smooth = follows & (_between(out[:-1], into[1:]) <= _CORNER_RAD)
    first = np.flatnonzero(np.concatenate([[True], ~smooth]))
    last = np.append(first[1:], len(pieces.of))
    whole = np.bincount(pieces.of, minlength=pieces.of[-1] + 1)[pieces.of[first]] == last - first
    shut = np.hypot(*(place[first, 0] - place[last - 1, 1]).T) <= same
    closed = whole & shut & (_between(out[last - 1], into[first]) <= _CORNER_RAD)
    return _with_table(pieces, first, last, closed)


def _with_table(pieces: Pieces, first: Ints, last: Ints, closed: Bools) -> Strings:
    number = (last - first) * np.where(closed, 2, 1)
    end = np.cumsum(number)
    string = np.repeat(np.arange(len(first)), number)
    row = first[string] + (np.arange(len(string)) - (end - number)[string]) % (last - first)[string]
    control = pieces.control[row]
    power = _powers(control)
    at = np.arange(len(row) * _STEPS + 1) / _STEPS
    share = np.broadcast_to(np.linspace(0.0, 1.0, _STEPS + 1), (len(row), _STEPS + 1))
    place = _placed(power, np.arange(len(row))[:, None], share)
    step = np.diff(place, axis=1)
    along = total_before(np.hypot(step[:, :, 0], step[:, :, 1]).ravel())
    return Strings(power, control, along, at, end - number, end, pieces.of[first], closed)


def places_on(strings: Strings, along: Floats, first: Ints, last: Ints) -> Floats:
    """Places (r, m, 2) in µm at lengths (r, m), each row on pieces from `first` to before `last` (r,)."""
    piece, share = where_at(strings, along, first[:, None], last[:, None])
    return _placed(strings.power, piece, share)


def where_at(strings: Strings, along: Floats, first: Ints, last: Ints) -> tuple[Ints, Floats]:
    """The piece at lengths, of those from `first` to before `last`, and the share of its parameter."""
    at = np.interp(along, strings.along, strings.at)
    piece = np.clip(at.astype(np.int64), first, last - 1)
    return piece, np.clip(at - piece, 0.0, 1.0)


def _placed(power: Floats, piece: Ints, share: Floats) -> Floats:
    value = power[-1][piece]
    for factors in power[-2::-1]:
        value = value * share[..., None] + factors[piece]
    place: Floats = value[..., :2] / value[..., 2:]
    return place


def _powers(control: Floats) -> Floats:
    """Coefficients (p + 1, n, 3) of powers from control points: binomials of p times differences of each order."""
    degree = control.shape[1] - 1
    rows, part = [], control
    for order in range(degree + 1):
        rows.append(math.comb(degree, order) * part[:, 0])
        part = np.diff(part, axis=1)
    return np.stack(rows)


def _directions(control: Floats) -> tuple[Floats, Floats]:
    """The legs (n, 2) of control polygons along which pieces start and end."""
    leg, length = legs_of(control)
    seen = length > _SEEN * length.max(axis=1, keepdims=True)
    rows = np.arange(len(leg))
    return leg[rows, seen.argmax(axis=1)], leg[rows, leg.shape[1] - 1 - seen[:, ::-1].argmax(axis=1)]


def _between(this: Floats, other: Floats) -> Floats:
    angle: Floats = np.abs(np.arctan2(this[:, 0] * other[:, 1] - this[:, 1] * other[:, 0], (this * other).sum(axis=1)))
    return angle
