"""An inside corner as it was measured, to how far the wire lags and how far it reaches.

A wire that lags behind its guides by L leaves an inside corner rounder than its reach R does. The guides run to the
corner and on; the wire follows them on a tractrix: with the guides s past the corner it hangs behind them at the angle
φ to the new way, tan(φ/2) = tan(φ₀/2) e^(−s/L) from the turn φ₀ on (`sim.cut.wire_lag`). The edge is R beside it:

    x = s − L cos φ − R sin φ,    y = −L sin φ + R cos φ,    φ from φ₀ to 0,

with the new way along X. Before the corner it is a fillet's, behind it settles: so the edge is not the same from both
sides, which tells L from R. Both are fitted with the place and the directions of the two faces, by least squares; the
intervals are quantiles of Student's t times the standard errors of the residuals.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from sim.measure.fit.circle import has_few_runs
from sim.measure.fit.parameters import LEVEL, FittedRows, Parameter
from sim.measure.statistics import student

LEAST_PLACES: Final = 20
_OF_FACES: Final = 0.25
"""Of the rows, from either end: they lie on the faces."""
_ON_CURVE: Final = 160
_SETTLED: Final = 14.0  # lags behind the corner: e^−14 of the turn is left
_FAR_UM: Final = 1e6
_ROUNDS: Final = 60
_SAME: Final = 1e-6  # of the sum of squares: a step that gains less is the last one
_LEAST_TURN_RAD, _MOST_TURN_RAD = math.radians(20.0), math.radians(95.0)
"""Past a turn of 90° the wire waits before it turns (`sim.cut.wire_lag`), and leaves a corner of another form."""
_ALIKE: Final = 0.98
"""Correlation of lag and reach: more, and the corner does not tell one from the other."""
_ROUGH_UM: Final = 1e-3  # what places cannot be right to


class CornerFit(NamedTuple):
    """What a corner tells.

    Attributes
    ----------
    parameters
        Lag and reach, and the turn, each with its interval or why there is none.
    residual_um
        Root mean square of what the model leaves.
    places
        How many rows were fitted.
    lack
        What speaks against the model: name of a text ``fit.lack-…``; empty where nothing does.
    rows
        What it is of: how far places lie from the faces, or where these would meet, along the way from there.
    """

    parameters: tuple[Parameter, ...]
    residual_um: float
    places: int
    lack: str
    rows: FittedRows


class _Solved(NamedTuple):
    """Values (6,) of `_residuals`, what they leave (n,), the slopes of that (n, 6), and the sense of the rows."""

    values: Floats
    left_um: Floats
    slope: Floats
    is_ahead: bool


def fit_corner(place_um: Floats) -> CornerFit:
    """What places (n, 2) along an inside corner tell: on one face, round the corner, and on the other, in order.

    SettingsError where they are too few, or no corner.
    """
    if len(place_um) < LEAST_PLACES:
        raise SettingsError("corner-too-few", found=len(place_um), least=LEAST_PLACES)
    solved = min(
        (_solved(place_um, is_ahead) for is_ahead in (True, False)), key=lambda each: float((each.left_um**2).sum())
    )
    reach_um, lag_um = (abs(float(value)) for value in solved.values[4:])
    free = len(place_um) - len(solved.values)
    variance = max(float((solved.left_um**2).sum()) / free, _ROUGH_UM**2)
    covariance = variance * np.linalg.pinv(solved.slope.T @ solved.slope)
    errors, by = np.sqrt(np.diag(covariance)), student(0.5 * (1.0 + LEVEL), free)
    shared = abs(float(covariance[4, 5])) / max(float(errors[4] * errors[5]), 1e-30)
    why = "corner-alike" if shared > _ALIKE else ""
    found = [
        Parameter(name, "µm", why=why) if why else Parameter(name, "µm", value, max(value - half, 0.0), value + half)
        for name, value, half in (("lag", lag_um, by * float(errors[5])), ("reach", reach_um, by * float(errors[4])))
    ]
    residual_um = float(np.sqrt(np.mean(solved.left_um**2)))
    ordered = solved.left_um if solved.is_ahead else solved.left_um[::-1]
    lack = "runs" if has_few_runs(ordered) else ""
    return CornerFit(tuple(found), residual_um, len(place_um), lack, _rows(place_um, solved))


def _rows(place_um: Floats, solved: _Solved) -> FittedRows:
    """Rows in the order in which the wire ran, beside the two faces without their corner."""
    places = place_um if solved.is_ahead else place_um[::-1]
    seen, turn = _from_corner(solved.values, places)
    off_um = _off(seen, corner_edge(turn, 0.0, 0.0))
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places, axis=0).T))])
    at = way - way[int(np.argmin(np.hypot(*seen.T)))]
    none = np.zeros(len(places), dtype=np.bool_)
    return FittedRows(at, off_um, off_um - solved.left_um, none, ~none)


def _solved(place_um: Floats, is_ahead: bool) -> _Solved:
    """The least squares of one sense: whether the wire ran along the rows, or against them (Levenberg, Marquardt)."""
    places = place_um if is_ahead else place_um[::-1]
    values = _first_guess(places)
    left, damping = _residuals(values, places), 1e-3
    slope = _slope(values, places)
    for _ in range(_ROUNDS):
        normal = slope.T @ slope
        step = np.linalg.solve(normal + damping * np.diag(np.maximum(np.diag(normal), 1e-12)), -slope.T @ left)
        tried = values + step
        new = _residuals(tried, places)
        before, after = float((left**2).sum()), float((new**2).sum())
        if after < before:
            values, left, damping = tried, new, damping / 4.0
            if before - after < _SAME * before:
                break
            slope = _slope(values, places)
        else:
            damping *= 4.0
            if damping > 1e9:
                break
    return _Solved(values, left, _slope(values, places), is_ahead)


def _first_guess(places: Floats) -> Floats:
    """Corner of both faces (2,), their directions away from it (2,), reach and lag. SettingsError for no corner."""
    number = max(int(_OF_FACES * len(places)), 3)
    (first, along_first), (second, along_second) = (_line(part) for part in (places[:number], places[-number:]))
    cross = along_first[0] * along_second[1] - along_first[1] * along_second[0]
    turn = abs(math.atan2(cross, float(along_first @ along_second)))
    if not _LEAST_TURN_RAD < turn < _MOST_TURN_RAD:
        raise SettingsError("no-corner", degrees=math.degrees(turn))
    by = second - first
    corner = first + along_first * float((by[0] * along_second[1] - by[1] * along_second[0]) / cross)
    away = [math.atan2(*(sign * along)[::-1].tolist()) for sign, along in ((-1.0, along_first), (1.0, along_second))]
    nearest = float(np.hypot(*(places - corner).T).min())
    # A fillet of radius R leaves R (1/cos(turn/2) − 1) in the corner.
    reach = nearest / max(1.0 / math.cos(0.5 * turn) - 1.0, 0.02)
    return np.array([*corner, *away, 0.8 * reach, 0.2 * reach])


def _line(places: Floats) -> tuple[Floats, Floats]:
    """Middle (2,) of places, and the unit direction (2,) in which they run."""
    middle = places.mean(axis=0)
    _, _, ways = np.linalg.svd(places - middle)
    way: Floats = ways[0] * math.copysign(1.0, float(ways[0] @ (places[-1] - places[0])))
    return middle, way


def _slope(values: Floats, places: Floats) -> Floats:
    """(n, 6) how residuals change with each value, by differences to both sides."""
    steps = np.array([0.01, 0.01, 1e-7, 1e-7, 0.01, 0.01])
    columns = []
    for at, step in enumerate(steps.tolist()):
        by = np.zeros(len(values))
        by[at] = step
        columns.append((_residuals(values + by, places) - _residuals(values - by, places)) / (2.0 * step))
    return np.column_stack(columns)


def _residuals(values: Floats, places: Floats) -> Floats:
    """(n,) how far places lie from the edge: the corner's place, directions of both faces away from it, reach, lag."""
    reach, lag = (abs(value) for value in values[4:].tolist())
    seen, turn = _from_corner(values, places)
    return _off(seen, corner_edge(turn, reach, lag))


def _from_corner(values: Floats, places: Floats) -> tuple[Floats, float]:
    """Places (n, 2) from where both faces would meet, the new way along X; and the turn of the corner."""
    x, y, away_one, away_two = values[:4].tolist()
    inner = math.remainder(away_one - away_two, 2.0 * math.pi)
    turn = math.pi - abs(inner)
    along = np.array([math.cos(away_two), math.sin(away_two)])
    # The new way along X; the way before comes from below.
    across = np.array([along[1], -along[0]]) * math.copysign(1.0, -inner)
    out = places - np.array([x, y])
    return np.column_stack([out @ along, -(out @ across)]), turn


def corner_edge(turn_rad: float, reach_um: float, lag_um: float) -> Floats:
    """(m, 2) the edge beside an inside corner, from where its two faces would meet: the new way along X."""
    lag = max(lag_um, 1e-3)
    s = lag * np.linspace(0.0, 1.0, _ON_CURVE) ** 2 * _SETTLED
    angle = 2.0 * np.arctan(math.tan(0.5 * turn_rad) * np.exp(-s / lag))
    x = s - lag * np.cos(angle) - reach_um * np.sin(angle) + reach_um * math.tan(0.5 * turn_rad)
    y = -lag * np.sin(angle) + reach_um * np.cos(angle) - reach_um
    before = np.array([x[0] - _FAR_UM * math.cos(turn_rad), y[0] - _FAR_UM * math.sin(turn_rad)])
    behind = np.array([x[-1] + _FAR_UM, 0.0])
    edge: Floats = np.concatenate([before[None], np.column_stack([x, y]), behind[None]])
    return edge


def _off(places: Floats, edge: Floats) -> Floats:
    """(n,) distances of places from a polyline (m, 2), on its left positive."""
    start, by = edge[:-1], np.diff(edge, axis=0)
    square = np.maximum((by**2).sum(axis=1), 1e-12)
    out = places[:, None] - start
    share = np.clip((out * by).sum(axis=2) / square, 0.0, 1.0)
    apart = out - share[:, :, None] * by
    away = np.hypot(apart[:, :, 0], apart[:, :, 1])
    nearest = np.argmin(away, axis=1)
    rows = np.arange(len(places))
    cross = by[nearest, 0] * apart[rows, nearest, 1] - by[nearest, 1] * apart[rows, nearest, 0]
    off: Floats = away[rows, nearest] * np.sign(cross)
    return off
