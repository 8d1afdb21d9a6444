"""Columns: of many samples, the lowest and the highest in each column of pixels of a chart, or cell of a dial."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.show.draw.chart import Chart


class Columns(NamedTuple):
    """Columns with samples: middle of each in the unit of the X axis (k,), lowest and highest value there (k, 2)."""

    x: Floats
    ends: Floats


def columns_of(chart: Chart, x: Floats, value: Floats) -> Columns:
    """Columns of values (n,) over `x` (n,), n ≥ 1, which never falls; ends of the stretch are kept.

    They are 1 px wide, and wider on a page that is larger than the usual one, where they would be too fine to see.
    """
    return in_cells(np.floor(chart.x_px(x) / max(chart.unit, 1.0)).astype(np.int64), x, value)


def in_cells(cell: Ints, x: Floats, value: Floats) -> Columns:
    """Columns of the cells (n,), never falling, of values (n,) over `x` (n,), n ≥ 1."""
    first = np.flatnonzero(np.diff(cell, prepend=cell[0] - 1))
    ends = np.stack([np.minimum.reduceat(value, first), np.maximum.reduceat(value, first)], axis=1)
    middle = (x[first] + x[np.append(first[1:], len(x)) - 1]) / 2.0
    middle[0], middle[-1] = x[0], x[-1]
    return Columns(middle, ends)


def stretches(chosen: Ints) -> list[slice]:
    """Slices of the stretches of consecutive numbers in `chosen`, rising."""
    if not len(chosen):
        return []
    cuts = np.flatnonzero(np.diff(chosen) > 1) + 1
    first, last = np.concatenate([[0], cuts]), np.append(cuts, len(chosen)) - 1
    return [slice(a, b + 1) for a, b in zip(chosen[first].tolist(), chosen[last].tolist(), strict=True)]
