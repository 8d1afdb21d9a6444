"""The drawing and the path of a damaged program over it, as SVG path data in one box."""

from collections.abc import Collection
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Floats
from parser.toolpath import Toolpath
from sim.show.draw.flatten import bounds_um, cut_runs, flatten
from sim.show.draw.path_data import path_data
from sim.show.draw.simplify import simplify

WIDTH, HEIGHT = 720, 480
"""Of the box that the picture fills, whole units; y points down."""
_EDGE: Final = 12.0  # units left free on each side
_OFF: Final = 0.5  # units that a drawn line may leave the true one
_BEYOND: Final = 0.6  # of the drawing's extent: as far as a path is shown beside it


class Picture(NamedTuple):
    """SVG path data.

    Attributes
    ----------
    drawing, path, fault
        The sound path, the damaged one, and of that the blocks in which the fault stands; cuts alone.
    is_beyond
        Whether the damaged path leaves the box.
    """

    drawing: str
    path: str
    fault: str
    is_beyond: bool


class _Frame(NamedTuple):
    """µm to a unit of the box, and the place in its middle, µm."""

    unit_um: float
    middle_um: Floats


def picture_of(sound: Toolpath, damaged: Toolpath, lines: Collection[int]) -> Picture:
    """Both paths, in the box that holds the drawing and as much of the damaged path as stays near it."""
    low, high = bounds_um(sound)
    near = _BEYOND * float((high - low).max())
    reached = bounds_um(damaged)
    low = np.minimum(low, np.maximum(reached[0], low - near))
    high = np.maximum(high, np.minimum(reached[1], high + near))
    room = np.array([WIDTH, HEIGHT]) - 2.0 * _EDGE
    frame = _Frame(max(float(((high - low) / room).max()), 1e-6), (low + high) / 2.0)
    is_fault = np.isin(damaged.source.line, list(lines))
    return Picture(
        _data(sound, ~sound.is_jump, frame),
        _data(damaged, ~damaged.is_jump, frame),
        _data(damaged, ~damaged.is_jump & is_fault, frame),
        bool((reached[0] < low - 1.0).any() or (reached[1] > high + 1.0).any()),
    )


def _data(path: Curves, shown: np.ndarray[tuple[int], np.dtype[np.bool_]], frame: _Frame) -> str:
    points, row = flatten(path, _OFF / 2.0 * frame.unit_um)
    runs = cut_runs(points, row, ~shown)
    return "".join(path_data(_in_box(simplify((run - frame.middle_um) / frame.unit_um, _OFF / 2.0))) for run in runs)


def _in_box(points: Floats) -> Floats:
    return np.asarray(points * (1.0, -1.0) + (WIDTH / 2.0, HEIGHT / 2.0), dtype=np.float64)
