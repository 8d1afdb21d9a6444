"""Which stretches of contours cut along an edge: loops, open sections, or the whole contour where it is cut once.

Tabs that another contour cuts: the edge was left open, and the wire comes back to it after a jump.

Which stretches of a path run over one edge: those that lie in like boxes and run beside one another.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Bools, Floats, Ints, extents
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import distinct, near_places
from parser.shape.contours import CLOSED_WITHIN_UM, closers, runs
from parser.shape.loops import find_loops, several_loops
from parser.shape.open_edges import (
    AT_END_UM,
    MOST_ASIDE_UM,
    Section,
    Turns,
    find_turns,
    is_slot,
    open_sections,
    sections_elsewhere,
    sections_of_tours,
)
from parser.shape.parallel_runs import BESIDE_UM, Stretches, run_beside
from parser.toolpath import Toolpath

_BOX_UM = 2.0 * BESIDE_UM
"""Sides of boxes about passes over one edge lie this near each other: at a sharp corner farther than the passes do."""
_BOX_SHARE = 0.4  # of the box: no pass takes more of a small one
_LEAST_SHARE = 0.6  # of a pass that runs beside another one; corners are rounded in one and not in the other
_LEAST_SENSE = 0.8  # all of a pass runs one way
_MOST_LIKE = 8  # stretches whose boxes one is held against: the latest before it that begin near
_MOST_HELD = 2  # of these, stretches that one is held against itself
_ON_EDGE_UM = 60.0  # of an edge that is left in one pass, its tab is cut on the same way, but for the lag of a wire
_CELLS = 1 << 31  # more cells than any path has across


def edges_of(toolpath: Toolpath, stretches: Stretches) -> Ints:
    """Which edge each stretch (k,) runs over: the number of the first stretch over it."""
    this, other = _alike(toolpath, stretches)
    parallel = run_beside(toolpath, stretches, this, other)
    back = run_beside(toolpath, stretches, other, this)
    share = np.minimum(parallel.share, back.share)
    mates = (share >= _LEAST_SHARE) & (np.abs(parallel.sense) >= _LEAST_SENSE)
    edge = list(range(len(stretches.first)))
    for early, late in zip(this[mates].tolist(), other[mates].tolist(), strict=True):
        here, there = _root(edge, early), _root(edge, late)
        edge[max(here, there)] = min(here, there)
    return np.array([_root(edge, number) for number in range(len(edge))], dtype=np.int64)


def _root(edge: list[int], number: int) -> int:
    while edge[number] != number:
        edge[number] = edge[edge[number]]
        number = edge[number]
    return number


def _alike(toolpath: Toolpath, stretches: Stretches) -> tuple[Ints, Ints]:
    """Pairs (m,) of stretches in boxes that are alike, the earlier one first."""
    low, high = _boxes(toolpath, stretches)
    most_off = np.minimum(_BOX_UM, _BOX_SHARE * (high - low).max(axis=1, initial=0.0))
    k = len(stretches.first)
    found = [np.empty(0, dtype=np.int64)]
    # Corners within half a cell of each other share a cell of one of four grids that lie half a cell apart.
    for shift in np.ndindex(2, 2):
        cell = np.floor(low / (2.0 * _BOX_UM) + np.array(shift) / 2.0).astype(np.int64)
        key = cell[:, 0] * _CELLS + cell[:, 1]
        order = np.argsort(key, kind="stable")
        for step in range(1, min(_MOST_LIKE, k - 1) + 1):
            this, other = order[:-step], order[step:]
            off = np.maximum(np.abs(low[this] - low[other]), np.abs(high[this] - high[other])).max(axis=1)
            alike = (key[this] == key[other]) & (off <= np.maximum(most_off[this], most_off[other]))
            found.append(this[alike] * k + other[alike])
    pairs, _ = np.unique(np.concatenate(found), return_index=True)
    this, other = pairs // k, pairs % k
    # The latest before each are enough: passes follow each other.
    order = np.lexsort((-this, other))
    first = np.searchsorted(other[order], other[order])
    kept_order = order[np.arange(len(order)) - first < _MOST_HELD]
    return this[kept_order], other[kept_order]


def _boxes(toolpath: Toolpath, stretches: Stretches) -> tuple[Floats, Floats]:
    """Lowest and highest places (k, 2) of stretches."""
    low, high = extents(toolpath)
    # Every other one of these ranges lies between two stretches.
    edges = np.stack([stretches.first, np.minimum(stretches.last + 1, len(toolpath))], axis=1).reshape(-1)
    low, high = np.append(low, low[-1:], axis=0), np.append(high, high[-1:], axis=0)
    return np.minimum.reduceat(low, edges)[::2], np.maximum.reduceat(high, edges)[::2]


def cut_elsewhere(
    toolpath: Toolpath, contour: Ints, sections: dict[int, list[Section]], wanted: Ints, within_um: float = AT_END_UM
) -> dict[int, tuple[int, list[Section]]]:
    """Of the contours `wanted` those that cut a tab, each with the contour that left it and with its own sections.

    `contour` (n,) is each row's; `sections` are those of the contours that leave an edge open. The wire comes within
    `within_um` of both ends of the edge.
    """
    bounds = [(first, past) for first, past in runs(toolpath).tolist()]
    left = [at for at, several in sections.items() if not any(section.is_tab for section in several)]
    rows = np.flatnonzero(np.isin(contour, wanted))
    if not left or not len(rows):
        return {}
    found: dict[int, tuple[int, list[Section]]] = {}
    for number, at in zip(*_at_both_ends(toolpath, rows, contour, [sections[at][-1] for at in left]), strict=True):
        section = sections[left[number]][-1]
        edge = np.arange(section.first, section.last + 1)
        several = sections_elsewhere(toolpath, bounds[at], edge, within_um)
        if bounds[at][0] > section.last and any(each.is_tab for each in several):
            found[at] = left[number], several
    return found


def _at_both_ends(toolpath: Toolpath, rows: Ints, contour: Ints, edges: list[Section]) -> tuple[list[int], list[int]]:
    """Which edge, and which contour: pairs of which a row of `rows` (r,) comes near both ends of the edge."""
    first, last = (np.array([getattr(edge, end) for edge in edges], dtype=np.int64) for end in ("first", "last"))
    place = np.concatenate([toolpath.start_um[first], toolpath.end_um[last]])
    curves = toolpath.picked(rows)
    near = near_places(curves, place, AT_END_UM)
    off, _ = distance_to_curves(curves, near.row, place[near.other, 0], place[near.other, 1])
    near = near.take(np.flatnonzero(off <= AT_END_UM))
    base = int(contour.max()) + 1
    edge, is_last = near.other % len(edges), near.other // len(edges)
    pair = distinct((edge * base + contour[rows[near.row]]) * 2 + is_last) // 2
    both = pair[:-1][pair[1:] == pair[:-1]]
    return (both // base).tolist(), (both % base).tolist()


class Cuts(NamedTuple):
    """Stretches (k,) in the order they are cut.

    Attributes
    ----------
    first, last, contour
        (k,) rows, both included, and contours.
    is_closed, is_tab
        (k,) whether they close, and whether they cut a tab.
    edge_row
        (k,) first row of the first stretch that is known to be over the same edge, or to have left the tab.
    """

    first: Ints
    last: Ints
    contour: Ints
    is_closed: Bools
    is_tab: Bools
    edge_row: Ints

    def take(self, at: Ints | Bools) -> "Cuts":
        """Those at the indices `at`."""
        return Cuts(
            self.first[at], self.last[at], self.contour[at], self.is_closed[at], self.is_tab[at], self.edge_row[at]
        )

    @property
    def stretches(self) -> Stretches:
        """Their rows alone."""
        return Stretches(self.first, self.last)


class _Found(NamedTuple):
    """Passes that close, sections by the contours that leave an edge open, and the numbers of the other contours."""

    passes: Cuts
    sections: dict[int, list[Section]]
    others: Ints


def find_cuts(toolpath: Toolpath, contour: Ints) -> Cuts:
    """Stretches of the contours; `contour` (n,) is each row's, −1 on jumps."""
    found = _passes_and_sections(toolpath, contour)
    left, closing = _left_open(toolpath, found.others)
    tabs: dict[int, tuple[int, list[Section]]] = {}
    if left:
        tabs = cut_elsewhere(toolpath, contour, left, closing, _ON_EDGE_UM)
        contour = _behind_tabs(toolpath, contour, left, tabs)
        found = _passes_and_sections(toolpath, contour)
    elsewhere = cut_elsewhere(toolpath, contour, found.sections, found.others)
    others = _without(found.others, np.array(sorted(elsewhere), dtype=np.int64))
    open_edges = found.sections | left
    rows = [(each, at, several[0].first) for at, several in open_edges.items() for each in several]
    rows += [(each, at, open_edges[of][0].first) for at, (of, several) in tabs.items() for each in several]
    rows += [(each, at, open_edges[of][0].first) for at, (of, several) in elsewhere.items() for each in several]
    cuts = _joined(found.passes, _of_sections(rows), *_cut_once(toolpath, contour, others))
    return cuts.take(np.argsort(cuts.first))


def _passes_and_sections(toolpath: Toolpath, contour: Ints) -> _Found:
    first, last, is_sure = several_loops(toolpath, contour)
    closed = np.ones(len(first), dtype=np.bool_)
    edge = edges_of(toolpath, Stretches(first, last))
    loops = Cuts(first, last, contour[first], closed, ~closed, first[edge])
    is_trimmed = np.bincount(edge, minlength=len(edge))[edge] > 1
    sections = _open(toolpath, contour, loops, edge)
    opened = np.array(sorted(sections), dtype=np.int64)
    together = np.isin(loops.contour, loops.contour[is_trimmed]) & ~np.isin(loops.contour, opened)
    passes = loops.take(together & (is_sure | is_trimmed))
    others = _without(distinct(contour[contour >= 0]), np.concatenate([opened, passes.contour]))
    return _Found(passes, sections, others)


def _behind_tabs(
    toolpath: Toolpath, contour: Ints, left: dict[int, list[Section]], tabs: dict[int, tuple[int, list[Section]]]
) -> Ints:
    """The contours (n,) without those that leave a tab, and of those that cut one what follows it from the start hole.

    There passes may follow over the same edge, once the slug is out.
    """
    behind, bounds = contour.copy(), runs(toolpath)
    for at in left:
        behind[slice(*bounds[at])] = -1
    for at, (_, several) in tabs.items():
        first, past = bounds[at].tolist()
        rows = np.arange(several[-1].last + 1, past)
        back = np.hypot(*(toolpath.end_um[rows] - toolpath.start_um[first]).T) <= CLOSED_WITHIN_UM
        behind[first : int(rows[np.argmax(back)]) + 1 if back.any() else past] = -1
    return behind


def _left_open(toolpath: Toolpath, wanted: Ints) -> tuple[dict[int, list[Section]], Ints]:
    """Of the contours `wanted` those that leave a tab for a later one, each with its one pass; and those that cut it.

    Both come to the edge by the same lead.
    """
    bounds = runs(toolpath)
    first, past = bounds[wanted].T
    is_open = np.hypot(*(toolpath.end_um[past - 1] - toolpath.start_um[first]).T) > CLOSED_WITHIN_UM
    left = wanted[is_open]
    found: dict[int, list[Section]] = {}
    closing: list[int] = []
    for at, closer in zip(left.tolist(), closers(toolpath, left).tolist(), strict=True):
        (low, high), (other, _) = bounds[at].tolist(), bounds[closer].tolist()
        lead = 0
        while closer >= 0 and low + lead < high and _is_one_way(toolpath, low + lead, other + lead):
            lead += 1
        if 0 < lead < high - low:
            found[at] = [Section(low + lead, high - 1, is_tab=False)]
            closing.append(closer)
    return found, distinct(np.array(closing, dtype=np.int64))


def _is_one_way(toolpath: Toolpath, row: int, other: int) -> bool:
    """Whether two rows that begin at one place run one way: their middles and ends are one place each."""
    place = places(toolpath, np.array([row, row, other, other]), np.array([0.5, 1.0, 0.5, 1.0]))
    return bool((np.hypot(*(place[:2] - place[2:]).T) <= CLOSED_WITHIN_UM).all())


def _without(numbers: Ints, gone: Ints) -> Ints:
    return numbers[~np.isin(numbers, gone)]


def _joined(*parts: Cuts) -> Cuts:
    first, last, contour, edge_row = (np.concatenate([part[k] for part in parts]) for k in (0, 1, 2, 5))
    closed, tab = (np.concatenate([getattr(part, name) for part in parts]) for name in ("is_closed", "is_tab"))
    return Cuts(first, last, contour, closed, tab, edge_row)


def _open(toolpath: Toolpath, contour: Ints, loops: Cuts, edge: Ints) -> dict[int, list[Section]]:
    """Sections of the contours that run over one edge several times and leave it open, by contour."""
    bounds = [(first, past) for first, past in runs(toolpath).tolist()]
    found: dict[int, list[Section]] = {}
    again = _trimmed(loops, edge)
    for at, stretches in again.items():
        this, other = (np.arange(first, last + 1) for first, last in stretches)
        if np.hypot(*(toolpath.start_um[this[0]] - toolpath.start_um[other[0]])) <= CLOSED_WITHIN_UM:
            found[at] = sections_of_tours(toolpath, bounds[at], this, other)
    turned = {at: of for at, of in _turned(contour, find_turns(toolpath, contour)).items() if at not in again}
    for at, of in turned.items():
        found[at] = open_sections(toolpath, bounds[at], of)
    return _without_slots(toolpath, contour, {at: sections for at, sections in found.items() if sections})


def _without_slots(toolpath: Toolpath, contour: Ints, found: dict[int, list[Section]]) -> dict[int, list[Section]]:
    """The sections by contour, without those that are only the two sides of a slot."""
    loop = find_loops(toolpath, contour, np.array(sorted(found), dtype=np.int64))
    ends = zip(loop.first.tolist(), loop.last.tolist(), strict=True)
    loop_of = dict(zip(loop.contour.tolist(), ends, strict=True))
    begin = runs(toolpath)[:, 0].tolist()
    return {at: several for at, several in found.items() if not is_slot(several, begin[at], loop_of.get(at))}


def _trimmed(loops: Cuts, edge: Ints) -> dict[int, list[tuple[int, int]]]:
    """The first two loops over one edge, by their rows, of each contour that closes two over one."""
    seen: dict[tuple[int, int], tuple[int, int]] = {}
    found: dict[int, list[tuple[int, int]]] = {}
    columns = (loops.contour, edge, loops.first, loops.last)
    for contour, of, first, last in zip(*(column.tolist() for column in columns), strict=True):
        earlier = seen.setdefault((contour, of), (first, last))
        if earlier != (first, last):
            found.setdefault(contour, [earlier, (first, last)])
    return found


def _turned(contour: Ints, turns: Turns) -> dict[int, Turns]:
    """Turns of the contours that turn back at one of them as from one pass to the next one, by contour."""
    aside = np.abs(turns.aside_um)
    of = contour[turns.leave]
    wanted = distinct(of[aside <= MOST_ASIDE_UM])
    first, past = np.searchsorted(of, wanted), np.searchsorted(of, wanted, side="right")
    return {
        at: turns.take(slice(low, high))
        for at, low, high in zip(wanted.tolist(), first.tolist(), past.tolist(), strict=True)
    }


def _of_sections(sections: list[tuple[Section, int, int]]) -> Cuts:
    """Sections with their contours, and with the first row of their edge."""
    rows = [(each.first, each.last, at, of, each.is_tab) for each, at, of in sections]
    first, last, contour, edge_row, tab = np.array(rows, dtype=np.int64).reshape(-1, 5).T
    return Cuts(first, last, contour, np.zeros(len(first), dtype=np.bool_), tab.astype(np.bool_), edge_row)


def _cut_once(toolpath: Toolpath, contour: Ints, wanted: Ints) -> tuple[Cuts, Cuts]:
    """Contours that are cut once: their loops, and all of those that close none."""
    loops = find_loops(toolpath, contour, wanted)
    rest = _without(wanted, loops.contour)
    first, past = runs(toolpath)[rest].T
    closed, plain = np.ones(len(loops.first), dtype=np.bool_), np.zeros(len(rest), dtype=np.bool_)
    looped = Cuts(loops.first, loops.last, loops.contour, closed, ~closed, loops.first)
    return looped, Cuts(first, past - 1, rest, plain, plain, first)
