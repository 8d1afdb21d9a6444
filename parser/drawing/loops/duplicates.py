"""Curves that a drawing holds twice, one upon the other."""

import numpy as np

from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints

_MIX = np.random.default_rng(20260101).integers(-(1 << 62), 1 << 62, 7)  # odds and ends that mix the parts of a key


def drawn_once(curves: Curves, entity: Ints) -> Ints:
    """Rows (k,) of curves without those that an earlier entity has drawn already, in either direction.

    A contour that runs there and back within one entity keeps both.
    """
    rows = np.arange(len(curves))
    ends = np.stack([curves.start_um, curves.end_um, places(curves, rows, np.full(len(rows), 0.5))])
    full = np.abs(curves.sweep_rad) == 2.0 * np.pi
    beside = curves.center_um + curves.radius_um[:, None]
    ends[:, full] = np.stack([curves.center_um, beside, beside])[:, full]
    label = np.stack([_labels(ends[:, :, axis]) for axis in (0, 1)], axis=2)
    first, second = label[0], label[1]
    swap = ((first[:, 0] > second[:, 0]) | ((first[:, 0] == second[:, 0]) & (first[:, 1] > second[:, 1])))[:, None]
    key = np.column_stack([np.where(swap, second, first), np.where(swap, first, second), label[2], curves.kind])
    # One number for each key sorts many times as fast as keys do; keys that share one by chance are told apart.
    _, earliest, of = np.unique(key @ _MIX, return_index=True, return_inverse=True)
    first = earliest[of]
    again = (entity[first] != entity) & (key[first] == key).all(axis=1)
    return np.flatnonzero(~again)


def _labels(values: Floats) -> Ints:
    """A number for each value, in the same shape; values that follow each other within `SAME_WITHIN_UM` share one."""
    order = np.argsort(values, axis=None)
    step = np.diff(values.ravel()[order], prepend=-np.inf) > SAME_WITHIN_UM
    label = np.empty(values.size, dtype=np.int64)
    label[order] = np.cumsum(step)
    return label.reshape(values.shape)
