"""Closed ways begun elsewhere, and ways run back."""

from dataclasses import replace

import numpy as np

from parser.drawing.model import running
from parser.geometry.along import along_um, places_at
from parser.geometry.curves import Curves, joined
from parser.geometry.distance import distance_to_curves
from parser.toolpath import Point


def begun_at(way: Curves, place_um: Point) -> Curves:
    """A closed way that begins and ends at its place nearest to another."""
    rows = np.arange(len(way))
    off = distance_to_curves(way, rows, np.full(len(way), place_um.x), np.full(len(way), place_um.y))[0]
    row = int(np.argmin(off))
    along = float(along_um(way, np.array([row]), np.array([place_um]))[0])
    first, last = parted(way.picked(np.array([row])), along)
    order = np.concatenate([rows[row + 1 :], rows[:row]])
    whole = joined([last, way.picked(order), first])
    return whole.picked(np.flatnonzero(whole.length_um > 1e-6))


def parted(one: Curves, along: float) -> tuple[Curves, Curves]:
    """One curve in two, parted at a length along it."""
    place = places_at(one, np.array([0]), np.array([along]))
    share = along / float(one.length_um[0])
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


def run_back(way: Curves) -> Curves:
    """A way run from its end to its start."""
    row = np.arange(len(way))[::-1]
    return running(way, row, np.ones(len(way), dtype=np.bool_))
