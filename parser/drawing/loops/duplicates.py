"""Curves that a drawing holds twice, one upon the other."""

import numpy as np

from parser.drawing.loops.labels import labels
from parser.drawing.loops.strings import strings_of
from parser.geometry.along import places
from parser.geometry.curves import Bools, Curves, Ints

_MIX = np.random.default_rng(20260101).integers(-(1 << 62), 1 << 62, 7)  # odds and ends that mix the parts of a key


def drawn_again(curves: Curves, entity: Ints) -> Bools:
    """(n,) whether another entity has drawn a curve already, in either direction.

    Entities are numbers (n,) that do not decrease. A contour that runs there and back within one entity keeps both. An
    entity that closes upon itself goes as a whole, where another one is the same, or stays as a whole: so do two
    squares with an edge in common. A loose curve upon one of its curves goes wherever it stands in the file.
    """
    strings = strings_of(curves, entity)
    closed = strings.closed[strings.of_row]
    key = _keys(curves)
    twin = _twins(key @ _MIX, strings.of_row)[strings.of_row] & closed
    rows = np.flatnonzero(~twin)
    rows = rows[np.argsort(~closed[rows], kind="stable")]
    # One number for each key sorts many times as fast as keys do; keys that share one by chance are told apart.
    _, earliest, of = np.unique(key[rows] @ _MIX, return_index=True, return_inverse=True)
    first = rows[earliest[of]]
    again = twin
    again[rows] = ~closed[rows] & (entity[first] != entity[rows]) & (key[first] == key[rows]).all(axis=1)
    return again


def _keys(curves: Curves) -> Ints:
    """Numbers (n, 7) that curves of one shape and place share, whichever way they run."""
    rows = np.arange(len(curves))
    ends = np.stack([curves.start_um, curves.end_um, places(curves, rows, np.full(len(rows), 0.5))])
    full = np.abs(curves.sweep_rad) == 2.0 * np.pi
    beside = curves.center_um + curves.radius_um[:, None]
    ends[:, full] = np.stack([curves.center_um, beside, beside])[:, full]
    label = np.stack([labels(ends[:, :, axis]) for axis in (0, 1)], axis=2)
    first, second = label[0], label[1]
    swap = ((first[:, 0] > second[:, 0]) | ((first[:, 0] == second[:, 0]) & (first[:, 1] > second[:, 1])))[:, None]
    return np.column_stack([np.where(swap, second, first), np.where(swap, first, second), label[2], curves.kind])


def _twins(hashed: Ints, string: Ints) -> Bools:
    """Whether strings (s,) hold what an earlier string holds, by the sum of the hashes (n,) of their curves.

    Sums of 62 mixed bits are the same by chance for none of the strings that any drawing may have.
    """
    first = np.flatnonzero(np.diff(string, prepend=-1))
    total = np.add.reduceat(hashed, first) * len(hashed) + np.diff(np.append(first, len(string)))
    _, earliest = np.unique(total, return_index=True)
    twin = np.ones(len(first), dtype=np.bool_)
    twin[earliest] = False
    return twin
