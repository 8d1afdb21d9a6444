"""Curves as rows of numbers, for compiled loops: how far places lie from them, and places on them.

`parser.geometry.distance` tells the same of lines and arcs by whole arrays, for rooms that load no compiled loops.
"""

import math
from typing import Final

import numpy as np

from controller.compiled.loops import loop_part
from parser.geometry.curves import Curves, Floats

_START_X, _START_Y, _END_X, _END_Y = 0, 1, 2, 3
IS_ARC: Final = 4
LENGTH: Final = 5
_WAY_X, _WAY_Y = 6, 7  # of a line, its unit vector
_CENTER_X, _CENTER_Y = 6, 7  # of an arc
RADIUS: Final = 8
_ANGLE, _TURN, _SWEEP = 9, 10, 11  # of an arc: at its start; +1 or −1; how much it covers
_COLUMNS: Final = 12
_FULL_TURN_RAD: Final = 2.0 * math.pi


def curve_rows(curves: Curves) -> Floats:
    """The curves as rows (n, 12), in the order of the columns above; what a line does not have is 0."""
    row, is_arc = np.zeros((len(curves), _COLUMNS)), curves.is_arc
    row[:, : _END_X + 2] = np.concatenate([curves.start_um, curves.end_um], axis=1)
    by = curves.end_um - curves.start_um
    length = np.hypot(by[:, 0], by[:, 1])
    inverse = 1.0 / np.where(length > 0.0, length, 1.0)
    row[:, IS_ARC], row[:, LENGTH] = is_arc, np.where(is_arc, curves.length_um, length)
    # A line without length has no direction: any will do.
    row[:, _WAY_X], row[:, _WAY_Y] = np.where(length > 0.0, by[:, 0] * inverse, 1.0), by[:, 1] * inverse
    turned = (curves.radius_um, curves.start_angle_rad, np.sign(curves.sweep_rad), np.abs(curves.sweep_rad))
    row[is_arc, _CENTER_X:] = np.column_stack([curves.center_um, *turned])[is_arc]
    return row


@loop_part("Tuple((f8, i8))(f8[::1], f8, f8)")
def _away_from_line(line: Floats, x: float, y: float) -> tuple[float, int]:
    """As `away_from`."""
    out_x, out_y = x - line[_START_X], y - line[_START_Y]
    along = out_x * line[_WAY_X] + out_y * line[_WAY_Y]
    across = out_x * line[_WAY_Y] - out_y * line[_WAY_X]
    if along < 0.0:
        return math.hypot(across, along), -1
    past = along - line[LENGTH]
    if past > 0.0:
        return math.hypot(across, past), 1
    return abs(across), 0


@loop_part("Tuple((f8, i8))(f8[::1], f8, f8)")
def _away_from_arc(arc: Floats, x: float, y: float) -> tuple[float, int]:
    """As `away_from`. Outside of the sweep, the half of the open sector nearer the end is past it."""
    out_x, out_y, sweep = x - arc[_CENTER_X], y - arc[_CENTER_Y], arc[_SWEEP]
    turned = ((math.atan2(out_y, out_x) - arc[_ANGLE]) * arc[_TURN]) % _FULL_TURN_RAD
    if turned <= sweep:
        return abs(math.hypot(out_x, out_y) - arc[RADIUS]), 0
    if turned - sweep < _FULL_TURN_RAD - turned:
        out_x, out_y, beyond = x - arc[_END_X], y - arc[_END_Y], 1
    else:
        out_x, out_y, beyond = x - arc[_START_X], y - arc[_START_Y], -1
    return math.hypot(out_x, out_y), beyond


@loop_part("Tuple((f8, i8))(f8[::1], f8, f8)")
def away_from(curve: Floats, x: float, y: float) -> tuple[float, int]:
    """Distance µm of a place from a curve, its ends included, and −1, 0, +1: before, beside, past the curve."""
    return _away_from_arc(curve, x, y) if curve[IS_ARC] else _away_from_line(curve, x, y)


@loop_part("f8(f8[::1], f8, f8, f8)")
def distance_from(curve: Floats, x: float, y: float, within_um: float) -> float:
    """Distance µm of a place from a curve; where it is beyond a bound, anything between the two."""
    if curve[IS_ARC]:
        out_x, out_y = x - curve[_CENTER_X], y - curve[_CENTER_Y]
        from_circle: float = abs(math.hypot(out_x, out_y) - curve[RADIUS])
        if from_circle > within_um:
            return from_circle
    return away_from(curve, x, y)[0]


@loop_part("f8(f8[::1], f8, f8)")
def side_of(curve: Floats, x: float, y: float) -> float:
    """+1 left of a curve in its direction and on it, −1 right of it."""
    if curve[IS_ARC]:
        out_x, out_y = x - curve[_CENTER_X], y - curve[_CENTER_Y]
        outside = math.hypot(out_x, out_y) > curve[RADIUS]
        return -1.0 if outside == (curve[_TURN] > 0.0) else 1.0
    out_x, out_y = x - curve[_START_X], y - curve[_START_Y]
    by_x, by_y = curve[_END_X] - curve[_START_X], curve[_END_Y] - curve[_START_Y]
    return -1.0 if out_x * by_y > out_y * by_x else 1.0


@loop_part("f8(f8[::1], f8)")
def angle_at(arc: Floats, share: float) -> float:
    """Angle of the radius at a share of an arc's length."""
    return float(arc[_ANGLE] + share * arc[_TURN] * arc[_SWEEP])


@loop_part("f8(f8[::1], f8, f8)")
def foot_angle(arc: Floats, x: float, y: float) -> float:
    """Angle of the radius at the place of an arc nearest to another place; it runs on as the sweep does."""
    turned = ((math.atan2(y - arc[_CENTER_Y], x - arc[_CENTER_X]) - arc[_ANGLE]) * arc[_TURN]) % _FULL_TURN_RAD
    if turned > arc[_SWEEP]:
        turned = arc[_SWEEP] if turned - arc[_SWEEP] < _FULL_TURN_RAD - turned else 0.0
    return float(arc[_ANGLE] + arc[_TURN] * turned)


@loop_part("UniTuple(f8, 2)(f8[::1], f8)")
def place_at(curve: Floats, share: float) -> tuple[float, float]:
    """Place at a share of the length of a line or an arc."""
    if curve[IS_ARC]:
        angle = angle_at(curve, share)
        return curve[_CENTER_X] + curve[RADIUS] * math.cos(angle), curve[_CENTER_Y] + curve[RADIUS] * math.sin(angle)
    x, y = curve[_START_X], curve[_START_Y]
    return x + share * (curve[_END_X] - x), y + share * (curve[_END_Y] - y)
