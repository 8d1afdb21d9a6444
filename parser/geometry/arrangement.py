"""Curves as edges between corners: cut where others end on them and where lines cross, each once.

An arrangement is the graph that curves in the plane make. Cells of it are walked round, and ways through it are found.

Numbers for places: those that are one place share one.
"""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.along import along_um, places_at
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import curves_meet, distance_to_curves
from parser.geometry.near import near_pairs, near_places

_MOST_PAIRS: Final = 20_000_000


class Edges(NamedTuple):
    """Curves (e,) between corners, the numbers of the corners at both ends of each (e, 2), and the row each is of."""

    curves: Curves
    corner: Ints
    row: Ints

    def take(self, at: Ints | Bools) -> "Edges":
        """Those at the indices `at`."""
        return Edges(self.curves.picked(at), self.corner[at], self.row[at])


def edges_of(curves: Curves, within_um: float) -> Edges:
    """All curves (n,), cut where others end on them within a distance, and where lines cross; ends so near are one."""
    ends = np.concatenate([curves.start_um, curves.end_um])
    near = near_places(curves, ends, within_um)
    off, _ = distance_to_curves(curves, near.row, ends[near.other, 0], ends[near.other, 1])
    on = np.flatnonzero(off <= within_um)
    early, late, _ = near_pairs(curves, np.zeros(len(curves), dtype=np.int64), within_um, _MOST_PAIRS)
    lines = ~curves.is_arc[early] & ~curves.is_arc[late]
    meets = curves_meet(curves, early[lines], late[lines], 0.0)
    row = np.concatenate([near.row[on], meets.early, meets.late])
    place = np.concatenate([ends[near.other[on]], meets.place_um, meets.place_um])
    return _once(_cut(curves, row, along_um(curves, row, place), within_um), within_um)


def _cut(curves: Curves, row: Ints, along: Floats, within_um: float) -> Edges:
    """Curves cut at lengths (k,) along rows (k,)."""
    within = (along > within_um) & (along < curves.length_um[row] - within_um)
    whole = np.arange(len(curves))
    of = np.concatenate([whole, row[within], whole])
    at = np.concatenate([np.zeros(len(whole)), along[within], curves.length_um])
    order = np.lexsort([at, of])
    of, at = of[order], at[order]
    is_next = np.append(True, (np.diff(at) > within_um) | (np.diff(of) != 0))
    of, at = of[is_next], at[is_next]
    piece = np.flatnonzero(np.diff(of) == 0)
    row, first, last = of[piece], at[piece], at[piece + 1]
    share = (last - first) / curves.length_um[row]
    is_whole = share >= 1.0
    start = np.where((first > 0.0)[:, None], places_at(curves, row, first), curves.start_um[row])
    end = np.where((last < curves.length_um[row])[:, None], places_at(curves, row, last), curves.end_um[row])
    cut = curves_between(start, end, curves.center_um[row], curves.sweep_rad[row] * share)
    order = np.argsort(np.concatenate([np.flatnonzero(is_whole), np.flatnonzero(~is_whole)]), kind="stable")
    pieces = joined([curves.picked(row[is_whole]), cut.picked(~is_whole)]).picked(order)
    corner = place_labels(np.concatenate([pieces.start_um, pieces.end_um]), within_um).reshape(2, -1).T
    return Edges(pieces, corner, row)


def _once(edges: Edges, within_um: float) -> Edges:
    """Those that lie upon each other once: between the same corners, by the same middle."""
    middle = places_at(edges.curves, np.arange(len(edges.row)), 0.5 * edges.curves.length_um)
    key = np.column_stack([np.sort(edges.corner, axis=1), place_labels(middle, within_um)])
    _, first = np.unique(key, axis=0, return_index=True)
    return edges.take(np.sort(first))


def labels(values: Floats, within_um: float) -> Ints:
    """A number for each value, in the same shape; values that follow each other within a distance share one."""
    order = np.argsort(values, axis=None)
    step = np.diff(values.ravel()[order], prepend=-np.inf) > within_um
    label = np.empty(values.size, dtype=np.int64)
    label[order] = np.cumsum(step)
    return label.reshape(values.shape)


def place_labels(place_um: Floats, within_um: float) -> Ints:
    """A number (k,) from 0 for each of the places (k, 2); those that are one place share one."""
    key = labels(place_um[:, 0], within_um) * (len(place_um) + 1) + labels(place_um[:, 1], within_um)
    label: Ints = np.unique(key, return_inverse=True)[1]
    return label


def merged(label: Ints, pair: Ints) -> Ints:
    """The labels (k,), from 0, where those of the pairs (p, 2) of labels are made one, and what these pair with too."""
    to = np.arange(int(label.max(initial=-1)) + 1)
    while True:
        low = np.minimum(to[pair[:, 0]], to[pair[:, 1]])
        if (to[pair] == low[:, None]).all():
            joined_labels: Ints = to[label]
            return joined_labels
        for side in (0, 1):
            np.minimum.at(to, to[pair[:, side]], low)
            np.minimum.at(to, pair[:, side], low)
        to = to[to]
