"""Curves of a drawing, each drawn once: what runs over others, or so near beside them that it is the same, goes.

Curves of a drawing, each drawn once: the border type is `DrawnOnce`.

Curves that a drawing holds twice, one upon the other.

Curves that run over others for a part of their way, or beside them so near that they are the same.

Strings: curves that an entity runs through in one go, each from the end of the one before it.
"""

from typing import Final, NamedTuple

import numpy as np

from parser.drawing.model import BESIDE_UM, SAME_WITHIN_UM
from parser.geometry.along import places, places_at
from parser.geometry.arrangement import labels
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.near import near_pairs


class Strings(NamedTuple):
    """First and last rows (s,) of the strings, and whether each closes upon itself."""

    first: Ints
    last: Ints
    closed: Bools

    @property
    def of_row(self) -> Ints:
        """(n,) string of each row."""
        return np.repeat(np.arange(len(self.first)), self.last - self.first + 1)


def strings_of(curves: Curves, entity: Ints) -> Strings:
    """Strings of curves (n,) by their entities (n,), numbers that do not decrease."""
    apart = np.hypot(*(curves.start_um[1:] - curves.end_um[:-1]).T) > SAME_WITHIN_UM
    cut = np.flatnonzero(apart | (np.diff(entity) != 0)) + 1
    first, last = np.append(0, cut), np.append(cut, len(curves)) - 1
    gap = np.hypot(*(curves.start_um[first] - curves.end_um[last]).T)
    return Strings(first, last, gap <= SAME_WITHIN_UM)


_MOST_PAIRS: Final = 20_000_000  # of pieces of curves near each other that are looked at: some seconds
_OPEN: Final = 0.01  # of a string that another one covers all round, what lies beside it at its corners at most
_SLENDER: Final = 20.0  # curves that run over each other do so for so many times as far as they lie apart, at least


class Covered(NamedTuple):
    """Stretches (k,) of rows over which other rows run, from a length along the row to another, µm."""

    row: Ints
    by: Ints
    first_um: Floats
    last_um: Floats

    def take(self, at: Ints | Bools) -> "Covered":
        """Those at the indices `at`."""
        return Covered(self.row[at], self.by[at], self.first_um[at], self.last_um[at])


def covered(curves: Curves, entity: Ints) -> Covered:
    """What of curves (n,) a curve of another entity draws too that comes before it.

    Two curves run over each other where they lie within `BESIDE_UM`. Curves of entities that close upon themselves come
    first, and are covered as a whole or not at all. Then come those of whose ends more are the ends of others, then the
    longer ones: where they lie decides, never the order of the file, unless they are the same.
    """
    strings = strings_of(curves, entity)
    rank = _ranks(curves, strings)
    early, late, _ = near_pairs(curves, np.zeros_like(entity), SAME_WITHIN_UM, _MOST_PAIRS, BESIDE_UM)
    other = np.flatnonzero((entity[early] != entity[late]) & (curves.kind[early] == curves.kind[late]))
    early, late = early[other], late[other]
    turn = rank[early] > rank[late]
    row, by = np.where(turn, early, late), np.where(turn, late, early)
    closed = strings.closed[strings.of_row]
    looked = np.flatnonzero(~closed[row] | (closed[by] & _alike(curves, strings, row, by)))
    found = over(curves, row[looked], by[looked])
    return found.take(~closed[found.row] | _all_round(curves, found, strings))


def _alike(curves: Curves, strings: Strings, row: Ints, by: Ints) -> Bools:
    """Whether the strings of pairs of rows (k,) are as long as each other, as those are that run beside each other."""
    length = np.add.reduceat(curves.length_um, strings.first)
    rows = strings.last - strings.first + 1
    this, other = strings.of_row[row], strings.of_row[by]
    alike: Bools = np.abs(length[this] - length[other]) <= 2.0 * np.pi * BESIDE_UM * (rows[this] + rows[other])
    return alike


def _ranks(curves: Curves, strings: Strings) -> Ints:
    """Place (n,) of each row in the order in which they come; all rows of a closed string have one place."""
    of, rows = strings.of_row, np.arange(len(curves))
    closed = strings.closed[of]
    low = np.minimum(curves.start_um, curves.end_um)
    lowest = np.minimum.reduceat(low, strings.first, axis=0)[of]
    low = np.where(closed[:, None], lowest, low)
    length = np.where(closed, np.add.reduceat(curves.length_um, strings.first)[of], curves.length_um)
    met = np.where(closed, 0, _met(curves))
    order = np.lexsort([np.where(closed, strings.first[of], rows), low[:, 1], low[:, 0], -length, -met, ~closed])
    rank = np.empty(len(order), dtype=np.int64)
    rank[order] = np.arange(len(order))
    return np.where(closed, np.minimum.reduceat(rank, strings.first)[of], rank)


def _met(curves: Curves) -> Ints:
    """How many ends (n,) of each curve are ends of other curves."""
    ends = np.round(np.concatenate([curves.start_um, curves.end_um]) / SAME_WITHIN_UM).astype(np.int64)
    _, of, number = np.unique(ends @ (1, 1 << 31), return_inverse=True, return_counts=True)
    met: Ints = (number[of] > 1).reshape(2, -1).sum(axis=0)
    return met


def over(curves: Curves, row: Ints, by: Ints) -> Covered:
    """Where the curves of pairs of rows (k,), both lines or both arcs, run over each other."""
    line, arc = np.flatnonzero(~curves.is_arc[row]), np.flatnonzero(curves.is_arc[row])
    found = [_of_lines(curves, row[line], by[line]), *_of_arcs(curves, row[arc], by[arc])]
    return Covered(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _of_lines(curves: Curves, row: Ints, by: Ints) -> Covered:
    along = curves.end_um[row] - curves.start_um[row]
    along /= np.hypot(along[:, 0], along[:, 1])[:, None]
    out = [place[by] - curves.start_um[row] for place in (curves.start_um, curves.end_um)]
    at = np.stack([(way * along).sum(axis=1) for way in out])
    off = np.stack([along[:, 0] * way[:, 1] - along[:, 1] * way[:, 0] for way in out])
    first, last = np.clip(at.min(axis=0), 0.0, None), np.minimum(at.max(axis=0), curves.length_um[row])
    slope = (off[1] - off[0]) / np.where(at[1] == at[0], np.inf, at[1] - at[0])
    apart = np.maximum(*(np.abs(off[0] + slope * (end - at[0])) for end in (first, last)))
    return _slender(curves, Covered(row, by, first, last), apart)


def _of_arcs(curves: Curves, row: Ints, by: Ints) -> tuple[Covered, Covered]:
    """As `_of_lines`; two arcs of one circle may run over each other at both of their ends."""
    begin, reach = _turned(curves, row, curves.center_um[row])
    other, other_reach = _turned(curves, by, curves.center_um[row])
    lead = np.mod(other - begin, 2.0 * np.pi)
    found = []
    for before in (0.0, 2.0 * np.pi):
        first, last = np.clip(lead - before, 0.0, None), np.minimum(lead - before + other_reach, reach)
        apart = np.zeros(len(row))
        for share in (0.0, 0.5, 1.0):
            angle = begin + first + share * (last - first)
            place = curves.center_um[row] + curves.radius_um[row][:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
            away = np.hypot(*(place - curves.center_um[by]).T)
            apart = np.maximum(apart, np.abs(away - curves.radius_um[by]))
        back = curves.sweep_rad[row] < 0.0
        first, last = np.where(back, reach - last, first), np.where(back, reach - first, last)
        radius = curves.radius_um[row]
        found.append(_slender(curves, Covered(row, by, radius * first, radius * last), apart))
    return found[0], found[1]


def _turned(curves: Curves, row: Ints, center: Floats) -> tuple[Floats, Floats]:
    """The angle (k,) at which arcs begin, run counter-clockwise, and how far they reach, seen from centres (k, 2)."""
    back = (curves.sweep_rad[row] < 0.0)[:, None]
    start, end = curves.start_um[row], curves.end_um[row]
    begin, past = np.where(back, end, start) - center, np.where(back, start, end) - center
    angle = np.arctan2(begin[:, 1], begin[:, 0])
    reach = np.mod(np.arctan2(past[:, 1], past[:, 0]) - angle, 2.0 * np.pi)
    whole = np.abs(curves.sweep_rad[row]) > 2.0 * np.pi - SAME_WITHIN_UM / curves.radius_um[row]
    return angle, np.where(whole, 2.0 * np.pi, reach)


def _slender(curves: Curves, found: Covered, apart_um: Floats) -> Covered:
    """Those that lie beside each other for long enough. What lies beside another curve ends where that does."""
    over_um = found.last_um - found.first_um
    is_slender = (apart_um <= BESIDE_UM) & (over_um > np.maximum(_SLENDER * apart_um, SAME_WITHIN_UM))
    found, within = found.take(is_slender), np.where(apart_um[is_slender] > SAME_WITHIN_UM, BESIDE_UM, 0.0)
    length = curves.length_um[found.row]
    return found._replace(
        first_um=np.where(found.first_um <= within, 0.0, found.first_um),
        last_um=np.where(length - found.last_um <= within, length, found.last_um),
    )


def _all_round(curves: Curves, found: Covered, strings: Strings) -> Bools:
    """Whether stretches (k,) are of strings that one other string covers, all but what it lies beside at corners."""
    of = strings.of_row
    pair = of[found.row] * len(strings.first) + of[found.by]
    which, at = np.unique(pair, return_inverse=True)
    total = np.bincount(at, found.last_um - found.first_um, len(which))
    string = which // len(strings.first)
    rows = strings.last[string] - strings.first[string] + 1
    length = np.add.reduceat(curves.length_um, strings.first)[string]
    left = length - total
    all_round: Bools = (left <= np.minimum(2.0 * BESIDE_UM * rows, _OPEN * length))[at]
    return all_round


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
    label = np.stack([labels(ends[:, :, axis], SAME_WITHIN_UM) for axis in (0, 1)], axis=2)
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
