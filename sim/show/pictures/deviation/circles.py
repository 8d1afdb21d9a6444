"""Circles of a program: arcs of one block, or of several about one centre, that go most of the way round."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats
from parser.toolpath import Toolpath

LEAST_RADIUS_UM: Final = 20.0
LEAST_SWEEP_RAD: Final = 1.5 * np.pi
SAME_UM: Final = 2.5
"""Arcs of one circle whose words are rounded to whole µm differ by less in centre and radius."""


class Circle(NamedTuple):
    """Rows of one circle, `first` to `last`, its centre (2,) and radius µm, and 1 counter-clockwise, −1 clockwise."""

    first: int
    last: int
    center_um: Floats
    radius_um: float
    turn: int


def circles_of(toolpath: Toolpath) -> list[Circle]:
    """All circles of a program, more than three quarters of them cut, in its order; empty where there is none."""
    group = np.cumsum(~_goes_on(toolpath))
    first = np.flatnonzero(np.diff(group, prepend=-1))
    last = np.append(first[1:], len(group)) - 1
    swept = np.add.reduceat(np.abs(toolpath.sweep_rad), first)
    round_ = toolpath.is_arc[first] & (swept > LEAST_SWEEP_RAD)
    round_[round_] &= toolpath.radius_um[first[round_]] >= LEAST_RADIUS_UM
    return [_circle(toolpath, *rows) for rows in zip(first[round_].tolist(), last[round_].tolist(), strict=True)]


def _goes_on(toolpath: Toolpath) -> Bools:
    """Whether each block (n,) goes on around the circle of the block before it."""
    with np.errstate(invalid="ignore"):  # lines have no centre
        by = np.diff(toolpath.center_um, axis=0)
        same = (np.hypot(by[:, 0], by[:, 1]) < SAME_UM) & (np.abs(np.diff(toolpath.radius_um)) < SAME_UM)
    onward = toolpath.sweep_rad[1:] * toolpath.sweep_rad[:-1] > 0.0
    return np.concatenate([[False], same & onward])


def _circle(toolpath: Toolpath, first: int, last: int) -> Circle:
    turn = 1 if toolpath.sweep_rad[first] > 0.0 else -1
    return Circle(first, last, toolpath.center_um[first], float(toolpath.radius_um[first]), turn)
