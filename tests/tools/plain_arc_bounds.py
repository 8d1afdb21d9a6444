"""How far arcs lie off rational curves at most, by other means than the fit: Boehm's knots, powers, steps of N itself.

Each curve is pieces (n, p + 1, 3) of x·w, y·w, w in powers 0 … p of a parameter in [0, 1].
"""

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from parser.drawing.dxf.entities import (
    BEGIN,
    CENTER,
    MAJOR,
    MINOR,
    SWEEP,
    Spline,
)
from parser.geometry.curves import Curves, Floats

_STEPS = 96
_SAMPLES = 96
_ON_CURVE_UM = 1e-5
_CANDIDATES = 4


class Place(NamedTuple):
    """A place on a curve: the piece, and its parameter."""

    piece: int
    at: float


def spline_pieces(spline: Spline) -> Floats:
    """The pieces of a spline: each knot inserted until it is there `degree` times (Boehm 1980)."""
    degree, knots = spline.degree, list(spline.knot)
    points = [np.array([x * w, y * w, w]) for (x, y, _), w in zip(spline.control, spline.weight, strict=True)]
    first, last = spline.knot[degree], spline.knot[len(spline.control)]
    for value in sorted(set(knots)):
        while first <= value <= last and knots.count(value) < degree:
            points, knots = _inserted(points, knots, degree, value)
    at = knots.index(first) + knots.count(first) - 1 - degree
    number = len([value for value in set(knots) if first <= value < last])
    bezier = np.array([points[at + degree * one : at + degree * one + degree + 1] for one in range(number)])
    return np.stack([np.array(_bernstein_to_power(degree)) @ piece for piece in bezier])


def _inserted(points: list[Floats], knots: list[float], degree: int, value: float) -> tuple[list[Floats], list[float]]:
    span = min(max(at for at, knot in enumerate(knots) if knot <= value), len(points) - 1)
    new = []
    for at in range(len(points) + 1):
        if at <= span - degree:
            new.append(points[at])
        elif at > span:
            new.append(points[at - 1])
        else:
            share = (value - knots[at]) / (knots[at + degree] - knots[at])
            new.append((1.0 - share) * points[at - 1] + share * points[at])
    return new, sorted([*knots, value])


def _bernstein_to_power(degree: int) -> list[list[float]]:
    return [
        [
            float((-1) ** (row - column) * math.comb(degree, row) * math.comb(row, column)) if column <= row else 0.0
            for column in range(degree + 1)
        ]
        for row in range(degree + 1)
    ]


def ellipse_pieces(form: Floats) -> Floats:
    """The pieces of an arc (17,) of an ellipse, by the tangent of half the angle from the middle of each of 6."""
    step = form[SWEEP] / 6
    tangent = math.tan(0.25 * step)
    pieces = []
    for one in range(6):
        middle = form[BEGIN] + (one + 0.5) * step
        turn = np.array([[math.cos(middle), -math.sin(middle)], [math.sin(middle), math.cos(middle)]])
        # s = tangent·(2u − 1); cos = (1 − s²)/(1 + s²), sin = 2s/(1 + s²)
        s = np.array([-tangent, 2.0 * tangent, 0.0])
        square = np.array([tangent**2, -4.0 * tangent**2, 4.0 * tangent**2])
        unit = np.array([1.0, 0.0, 0.0])
        cos, sin = turn @ np.stack([unit - square, 2.0 * s])
        weight = unit + square
        axes = np.stack([form[CENTER][:2], form[MAJOR][:2], form[MINOR][:2]])
        place = np.stack([weight, cos, sin], axis=1) @ axes
        pieces.append(np.column_stack([place, weight]))
    return np.array(pieces)


def at_most_off(pieces: Floats, curves: Curves) -> float:
    """How far curves in running order lie off a rational curve at most, either way, µm.

    AssertionError where an end of one is not on the curve, or the curve does not run along an arc without turning back.
    """
    ends = np.concatenate([curves.start_um[:1], curves.end_um])
    places = _places(pieces, ends)
    worst = 0.0
    for row in range(len(curves)):
        for part in _between(pieces, places[row], places[row + 1]):
            worst = max(worst, _off(part, curves.picked(slice(row, row + 1))))
    return worst


def _places(pieces: Floats, ends: Floats) -> list[Place]:
    """Where places (k, 2) are on the curve, each behind the last; past the end it goes on at the start."""
    at = np.linspace(0.0, 1.0, _SAMPLES + 1)
    sampled = np.array([_value(np.broadcast_to(piece, (len(at), *piece.shape)), at) for piece in pieces])
    off = np.hypot(*np.moveaxis(sampled.reshape(-1, 2) - ends[:, None], 2, 0))
    piece, sample = np.divmod(np.argsort(off, axis=1)[:, :_CANDIDATES].ravel(), len(at))
    low, high = at[np.maximum(sample - 1, 0)], at[np.minimum(sample + 1, _SAMPLES)]
    refined, off = _refined(pieces[piece], np.repeat(ends, _CANDIDATES, axis=0), low, high)
    found: list[Place] = []
    behind = -1.0
    for row in range(len(ends)):
        own = range(row * _CANDIDATES, (row + 1) * _CANDIDATES)
        close = sorted(Place(int(piece[one]), float(refined[one])) for one in own if off[one] <= _ON_CURVE_UM)
        assert close, f"{ends[row]} is not on the curve"
        ahead = [one for one in close if one.piece + one.at > behind + 1e-9]
        found.append(ahead[0] if ahead else close[0])
        behind = found[-1].piece + found[-1].at
    return found


def _refined(pieces: Floats, place: Floats, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """The parameters (m,) at which pieces (m, p + 1, 3) come nearest to places (m, 2), and how near."""
    for _ in range(60):
        one, two = low + (high - low) / 3.0, high - (high - low) / 3.0
        nearer = _off_place(pieces, place, one) < _off_place(pieces, place, two)
        low, high = np.where(nearer, low, one), np.where(nearer, two, high)
    middle = 0.5 * (low + high)
    return middle, _off_place(pieces, place, middle)


def _off_place(pieces: Floats, place: Floats, at: Floats) -> Floats:
    return np.asarray(np.hypot(*(_value(pieces, at) - place).T))


def _value(pieces: Floats, at: Floats) -> Floats:
    whole = sum(pieces[:, power] * at[:, None] ** power for power in range(pieces.shape[1]))
    return np.asarray(whole[:, :2] / whole[:, 2:])


def _between(pieces: Floats, start: Place, end: Place) -> list[Floats]:
    """The curve from one place to another, each part on a parameter in [0, 1] of its own."""
    stops = [start]
    piece = start.piece
    turns = 0
    while piece != end.piece or (turns == 0 and end.at < start.at - 1e-9):
        stops.append(Place(piece, 1.0))
        piece = (piece + 1) % len(pieces)
        stops.append(Place(piece, 0.0))
        turns += 1
        assert turns <= len(pieces), "an arc stands for more than the whole curve"
    stops.append(end)
    return [
        _part(pieces[low.piece], low.at, high.at)
        for low, high in zip(stops[::2], stops[1::2], strict=True)
        if high.at > low.at + 1e-12
    ]


def _part(piece: Floats, low: float, high: float) -> Floats:
    """A piece on [low, high] as powers of a parameter in [0, 1]."""
    made = np.zeros_like(piece)
    for power in range(len(piece)):
        for own in range(power + 1):
            made[own] += piece[power] * math.comb(power, own) * low ** (power - own) * (high - low) ** own
    return made


def _off(part: Floats, curve: Curves) -> float:
    return _off_arc(part, curve) if curve.is_arc[0] else _off_line(part, curve)


def _off_arc(part: Floats, curve: Curves) -> float:
    """The bound |N| / (w² (2R − off)) over steps of the parameter, with the coefficients of N and w² in each."""
    center, radius = curve.center_um[0], float(curve.radius_um[0])
    x, y, w = part[:, 0] - center[0] * part[:, 2], part[:, 1] - center[1] * part[:, 2], part[:, 2]
    times, slope = np.polynomial.polynomial.polymul, np.polynomial.polynomial.polyder
    power = _padded(times(x, x), 2 * len(x) - 1) + _padded(times(y, y), 2 * len(x) - 1)
    power = power - radius**2 * _padded(times(w, w), 2 * len(x) - 1)
    most = np.abs(_in_steps(power)).max(axis=1)
    least = _in_steps(_padded(times(w, w), 2 * len(x) - 1)).min(axis=1)
    assert (least > 0.0).all(), "the weight is not bounded away from 0"
    off = most / (least * radius)  # |P − C| + R is no less than R
    off = most / (least * (2.0 * radius - np.minimum(off, radius)))
    along = _in_steps(_padded(times(x, slope(y)), 2 * len(x)) - _padded(times(y, slope(x)), 2 * len(x)))
    along = along * math.copysign(1.0, curve.sweep_rad[0])
    assert (along.min(axis=1) >= -1e-9 * np.abs(along).max()).all(), "the curve turns back along an arc"
    return float(off.max())


def _off_line(part: Floats, curve: Curves) -> float:
    """From a line no control point is farther than the curve; all of the line is met on the way from end to end."""
    start, by = curve.start_um[0], curve.end_um[0] - curve.start_um[0]
    control = np.stack([_in_steps(part[:, column]) for column in range(3)], axis=2)
    place = control[:, :, :2] / control[:, :, 2:]
    share = np.clip((place - start) @ by / max(float(by @ by), 1e-300), 0.0, 1.0)
    return float(np.hypot(*np.moveaxis(place - start - share[:, :, None] * by, 2, 0)).max())


def _padded(power: Floats, length: int) -> Floats:
    return np.concatenate([power, np.zeros(length - len(power))])


def _in_steps(power: Floats) -> Floats:
    """Bernstein coefficients (steps, n) of a polynomial, by its powers (n,), on equal steps of [0, 1]."""
    return np.asarray(_to_steps(len(power) - 1) @ power)


@cache
def _to_steps(degree: int) -> Floats:
    low, by = np.arange(_STEPS) / _STEPS, 1.0 / _STEPS
    moved = np.zeros((_STEPS, degree + 1, degree + 1))
    for power in range(degree + 1):
        for own in range(power + 1):
            moved[:, own, power] = math.comb(power, own) * low ** (power - own) * by**own
    to_bernstein = np.zeros((degree + 1, degree + 1))
    for row in range(degree + 1):
        for column in range(row + 1):
            to_bernstein[row, column] = math.comb(row, column) / math.comb(degree, column)
    return np.asarray(to_bernstein @ moved)
