"""Curves of a drawing, each drawn once: the border type is `DrawnOnce`."""

from typing import NamedTuple

import numpy as np

from parser.drawing.loops.duplicates import drawn_again
from parser.drawing.loops.overlaps import Covered, covered
from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.along import places_at
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined


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


class _Kept(NamedTuple):
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
    told = [(entity[gone], np.ones(len(gone), dtype=np.bool_), places_at(curves, gone, middle))]
    if over is None or not len(over.row):
        return DrawnOnce(once, entity[rest], _told(told))
    kept = _kept(once, over)
    rows, first = np.unique(over.row, return_index=True)
    place = places_at(once, rows, 0.5 * (over.first_um + over.last_um)[first])
    told.append((entity[rest][rows], ~np.isin(rows, kept.row), place))
    return DrawnOnce(_cut(once, kept), entity[rest][kept.row], _told(told))


def _kept(curves: Curves, over: Covered) -> _Kept:
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
    return _Kept(rows[order], low[order], high[order])


def _running_max(values: Floats, group: Ints) -> Floats:
    """The largest of the values (k,) of a group so far; groups (k,) are numbers from 0 that do not decrease."""
    lift = (values.max(initial=0.0) + 1.0) * group
    highest: Floats = np.maximum.accumulate(values + lift) - lift
    return highest


def _cut(curves: Curves, kept: _Kept) -> Curves:
    """The stretches as curves; whole rows as they are."""
    ran = curves.picked(kept.row)
    from_start, to_end = kept.first_um == 0.0, kept.last_um == ran.length_um
    part = np.flatnonzero(~(from_start & to_end))
    row, of = kept.row[part], ran.picked(part)
    start = np.where(from_start[part, None], of.start_um, places_at(curves, row, kept.first_um[part]))
    end = np.where(to_end[part, None], of.end_um, places_at(curves, row, kept.last_um[part]))
    share = (kept.last_um - kept.first_um)[part] / of.length_um
    cut = curves_between(start, end, of.center_um, of.sweep_rad * share)
    whole = np.flatnonzero(from_start & to_end)
    return joined([ran.picked(whole), cut]).picked(np.argsort(np.concatenate([whole, part])))


def _told(told: list[tuple[Ints, Bools, Floats]]) -> tuple[Again, ...]:
    """What was drawn again, once for each entity and for whole curves and parts of them."""
    entity, whole, place = (np.concatenate(column) for column in zip(*told, strict=True))
    key, first, number = np.unique(2 * entity + ~whole, return_index=True, return_counts=True)
    columns = zip(key.tolist(), number.tolist(), place[first].tolist(), strict=True)
    return tuple(Again(at // 2, at % 2 == 0, count, (xy[0], xy[1])) for at, count, xy in columns)
