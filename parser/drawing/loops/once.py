"""Curves of a drawing, each drawn once: the border type is `DrawnOnce`.

Curves that a drawing holds twice, one upon the other.

Numbers for places: those that are one place share one.
"""

from typing import NamedTuple

import numpy as np

from parser.drawing.loops.overlaps import Covered, covered, strings_of
from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.along import places, places_at
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined


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
            joined: Ints = to[label]
            return joined
        for side in (0, 1):
            np.minimum.at(to, to[pair[:, side]], low)
            np.minimum.at(to, pair[:, side], low)
        to = to[to]


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
    extreme_um = curves.center_um + curves.radius_um[:, None]
    ends[:, full] = np.stack([curves.center_um, extreme_um, extreme_um])[:, full]
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


class Again(NamedTuple):
    """What an entity draws that another one draws too.

    Attributes
    ----------
    entity
        Its number.
    whole
        Whether whole curves of it are left out; else they are shortened.
    curves
        How many.
    place_um
        In the middle of the first of them.
    """

    entity: int
    whole: bool
    curves: int
    place_um: tuple[float, float]


class DrawnOnce(NamedTuple):
    """Curves (k,), the number of the entity of each, never decreasing, and what was drawn again."""

    curves: Curves
    entity: Ints
    again: tuple[Again, ...]


class _Stretches(NamedTuple):
    """Stretches (k,) of rows that are kept, from a length along the row to another, µm."""

    row: Ints
    first_um: Floats
    last_um: Floats


def drawn_once(curves: Curves, entity: Ints) -> DrawnOnce:
    """Curves (n,) of entities, numbers (n,) that do not decrease, without what another entity draws too.

    See `drawn_again` and `covered` for which one is kept.
    """
    again = drawn_again(curves, entity)
    rest = np.flatnonzero(~again)
    once = curves.picked(rest)
    over = covered(once, entity[rest]) if len(np.unique(entity[rest])) > 1 else None
    gone = np.flatnonzero(again)
    middle = 0.5 * curves.length_um[gone]
    doubled = [(entity[gone], np.ones(len(gone), dtype=np.bool_), places_at(curves, gone, middle))]
    if over is None or not len(over.row):
        return DrawnOnce(once, entity[rest], _drawn_again(doubled))
    uncovered = _uncovered(once, over)
    rows, first = np.unique(over.row, return_index=True)
    place = places_at(once, rows, 0.5 * (over.first_um + over.last_um)[first])
    doubled.append((entity[rest][rows], ~np.isin(rows, uncovered.row), place))
    return DrawnOnce(_cut(once, uncovered), entity[rest][uncovered.row], _drawn_again(doubled))


def _uncovered(curves: Curves, over: Covered) -> _Stretches:
    """All rows that are not covered, and what is left of those that are, in the order of the rows."""
    order = np.lexsort([over.first_um, over.row])
    row, first, last = over.row[order], over.first_um[order], over.last_um[order]
    begin = np.diff(row, prepend=-1) != 0
    # How far each row is covered before a stretch begins: the farthest end so far, row by row.
    far = _running_max(last, np.cumsum(begin) - 1)
    before = np.where(begin, 0.0, np.append(0.0, far[:-1]))
    whole = np.setdiff1d(np.arange(len(curves)), row)
    ends = np.append(np.flatnonzero(begin)[1:], len(row)) - 1
    rows = np.concatenate([row, row[ends]])
    low, high = np.concatenate([before, far[ends]]), np.concatenate([first, curves.length_um[row[ends]]])
    long = high - low > SAME_WITHIN_UM
    rows = np.concatenate([whole, rows[long]])
    low = np.concatenate([np.zeros(len(whole)), low[long]])
    high = np.concatenate([curves.length_um[whole], high[long]])
    order = np.lexsort([low, rows])
    return _Stretches(rows[order], low[order], high[order])


def _running_max(values: Floats, group: Ints) -> Floats:
    """The largest of the values (k,) of a group so far; groups (k,) are numbers from 0 that do not decrease."""
    lift = (values.max(initial=0.0) + 1.0) * group
    highest: Floats = np.maximum.accumulate(values + lift) - lift
    return highest


def _cut(curves: Curves, stretches: _Stretches) -> Curves:
    """The stretches as curves; whole rows as they are."""
    ran = curves.picked(stretches.row)
    from_start, to_end = stretches.first_um == 0.0, stretches.last_um == ran.length_um
    part = np.flatnonzero(~(from_start & to_end))
    row, of = stretches.row[part], ran.picked(part)
    start = np.where(from_start[part, None], of.start_um, places_at(curves, row, stretches.first_um[part]))
    end = np.where(to_end[part, None], of.end_um, places_at(curves, row, stretches.last_um[part]))
    share = (stretches.last_um - stretches.first_um)[part] / of.length_um
    cut = curves_between(start, end, of.center_um, of.sweep_rad * share)
    whole = np.flatnonzero(from_start & to_end)
    return joined([ran.picked(whole), cut]).picked(np.argsort(np.concatenate([whole, part])))


def _drawn_again(doubled: list[tuple[Ints, Bools, Floats]]) -> tuple[Again, ...]:
    """What was drawn again, once for each entity and for whole curves and parts of them."""
    entity, whole, place = (np.concatenate(column) for column in zip(*doubled, strict=True))
    key, first, number = np.unique(2 * entity + ~whole, return_index=True, return_counts=True)
    columns = zip(key.tolist(), number.tolist(), place[first].tolist(), strict=True)
    return tuple(Again(at // 2, at % 2 == 0, count, (xy[0], xy[1])) for at, count, xy in columns)
