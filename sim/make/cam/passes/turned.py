"""Closed ways begun elsewhere, ways parted, and ways run back."""

import math
from dataclasses import replace

import numpy as np

from parser.drawing.model import running
from parser.geometry.along import along_um, places_at
from parser.geometry.curves import Curves, joined, total_before
from parser.geometry.distance import distance_to_curves
from parser.toolpath import Point
from sim.make.cam.passes.beside.short import SHORT_UM


def length_to(way: Curves, place_um: Point) -> float:
    """How far µm along a way its place nearest to another lies."""
    rows = np.arange(len(way))
    off = distance_to_curves(way, rows, np.full(len(way), place_um.x), np.full(len(way), place_um.y))[0]
    row = int(np.argmin(off))
    on = along_um(way, rows[row : row + 1], np.array([place_um]))
    return float(way.length_um[:row].sum() + on[0])


def begun_at(way: Curves, place_um: Point) -> Curves:
    """A closed way that begins and ends at its place nearest to another; at an end of a curve within 3 µm of that.

    A circle stays one curve.
    """
    if len(way) == 1:
        return _circle_at(way, place_um)
    first, last = parted(way, length_to(way, place_um))
    return joined([last, first])


def parted(way: Curves, length_um: float) -> tuple[Curves, Curves]:
    """A way in two, parted at a length along it; at an end of a curve within 3 µm of that, so that no sliver is left.

    Either may be empty.
    """
    before = total_before(way.length_um)
    nearest = int(np.argmin(np.abs(before - length_um)))
    if abs(float(before[nearest]) - length_um) < SHORT_UM:
        return way.picked(slice(nearest)), way.picked(slice(nearest, None))
    row = int(np.searchsorted(before, length_um)) - 1
    early, late = _halves(way.picked(slice(row, row + 1)), length_um - float(before[row]))
    return joined([way.picked(slice(row)), early]), joined([late, way.picked(slice(row + 1, None))])


def run_back(way: Curves) -> Curves:
    """A way run from its end to its start."""
    rows = np.arange(len(way))[::-1]
    return running(way, rows, np.ones(len(way), dtype=np.bool_))


def _circle_at(circle: Curves, place_um: Point) -> Curves:
    (x, y), radius = circle.center_um[0].tolist(), float(circle.radius_um[0])
    angle = math.atan2(place_um.y - y, place_um.x - x)
    start = np.array([[x + radius * math.cos(angle), y + radius * math.sin(angle)]])
    return replace(circle, start_um=start, end_um=start, start_angle_rad=np.array([angle]))


def _halves(one: Curves, on_um: float) -> tuple[Curves, Curves]:
    """One curve in two."""
    place = places_at(one, np.array([0]), np.array([on_um]))
    share = on_um / float(one.length_um[0])
    turned = share * one.sweep_rad
    early = replace(one, end_um=place, sweep_rad=turned, length_um=share * one.length_um)
    late = replace(
        one,
        start_um=place,
        start_angle_rad=one.start_angle_rad + turned,
        sweep_rad=one.sweep_rad - turned,
        length_um=(1.0 - share) * one.length_um,
    )
    return early, late
