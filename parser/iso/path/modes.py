"""Modes: what words of a group, once given, hold in force until another one of the group."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.path.given import Given

NO_MOTION = -1
_ABSOLUTE, _ABSOLUTE_CENTERS = 900, 901
_UM_PER_INCH = 25_400.0
_INCH, _MM = (200, 700), (210, 710)
_LEFT, _RIGHT = 410, 420


class Modes(NamedTuple):
    """What is in force in each block as it runs, words of the block itself included; each column has shape (e,).

    Attributes
    ----------
    motion
        int64: 0 G00 … 3 G03; −1 before the first one.
    is_absolute, has_absolute_centers
        bool: X Y are places, I J are places.
    integer_um, point_um
        float64: what a coordinate of 1 means without a point, and with one.
    side
        int64: +1 G41, −1 G42, 0 G40.
    """

    motion: Ints
    is_absolute: Bools
    has_absolute_centers: Bools
    integer_um: Floats
    point_um: Floats
    side: Ints


def modes(given: Given, runs: Ints) -> Modes:
    """The modes in force in the blocks `runs` (e,), in the order in which they run."""
    profile = given.profile
    motion = carried(given.group("motion")[runs], NO_MOTION)
    centers = carried(given.group("centres")[runs], _ABSOLUTE_CENTERS if profile.centers == "absolute" else 0)
    distance = carried(given.group("distance")[runs], _ABSOLUTE if profile.distance == "absolute" else 0)
    side = carried(given.group("compensation")[runs], 0)
    integer_um, point_um = _scales(given, carried(given.group("unit")[runs], 0))
    return Modes(
        motion=np.where(motion >= 0, motion // 10, NO_MOTION),
        is_absolute=distance == _ABSOLUTE,
        has_absolute_centers=centers == _ABSOLUTE_CENTERS,
        integer_um=integer_um,
        point_um=point_um,
        side=(side == _LEFT).astype(np.int64) - (side == _RIGHT),
    )


def carried(given: Ints, at_start: int) -> Ints:
    """Values (e,) that hold until the next one that is not negative; `at_start` before the first."""
    last = np.maximum.accumulate(np.where(given >= 0, np.arange(len(given)), -1))
    return np.where(last >= 0, given[last], at_start)


def _scales(given: Given, unit: Ints) -> tuple[Floats, Floats]:
    """Coordinates follow the profile until a unit word says the other system than the profile's."""
    profile = given.profile
    is_inch_profile = profile.point_um == _UM_PER_INCH
    integer = np.full(len(unit), profile.integer_um)
    point = np.full(len(unit), profile.point_um)
    if is_inch_profile:
        metric = np.isin(unit, _MM)
        return np.where(metric, 1.0, integer), np.where(metric, 1000.0, point)
    inch = np.isin(unit, _INCH)
    return np.where(inch, 1e-4 * _UM_PER_INCH, integer), np.where(inch, _UM_PER_INCH, point)
