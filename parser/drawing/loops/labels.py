"""Numbers for places: those that are one place share one."""

import numpy as np

from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.curves import Floats, Ints


def labels(values: Floats) -> Ints:
    """A number for each value, in the same shape; values that follow each other within `SAME_WITHIN_UM` share one."""
    order = np.argsort(values, axis=None)
    step = np.diff(values.ravel()[order], prepend=-np.inf) > SAME_WITHIN_UM
    label = np.empty(values.size, dtype=np.int64)
    label[order] = np.cumsum(step)
    return label.reshape(values.shape)


def place_labels(place_um: Floats) -> Ints:
    """A number (k,) from 0 for each of the places (k, 2)."""
    key = labels(place_um[:, 0]) * (len(place_um) + 1) + labels(place_um[:, 1])
    label: Ints = np.unique(key, return_inverse=True)[1]
    return label


def merged(label: Ints, pair: Ints) -> Ints:
    """The labels (k,), from 0, where those of the pairs (p, 2) of labels are made one, and what these pair with too."""
    to = np.arange(int(label.max(initial=-1)) + 1)
    while True:
        low = np.minimum(to[pair[:, 0]], to[pair[:, 1]])
        if (to[pair] == low[:, None]).all():
            one: Ints = to[label]
            return one
        for side in (0, 1):
            np.minimum.at(to, to[pair[:, side]], low)
            np.minimum.at(to, pair[:, side], low)
        to = to[to]
