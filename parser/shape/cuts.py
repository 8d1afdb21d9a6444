"""Which stretches of contours cut along an edge: loops, open sections, or the whole contour where it is cut once."""

from typing import NamedTuple

import numpy as np

from parser.geometry.boxes import distinct
from parser.geometry.curves import Bools, Ints
from parser.shape.beside import Stretches
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.shape.contours import runs
from parser.shape.edges import edges_of
from parser.shape.loops import find_loops
from parser.shape.open_edges import MOST_ASIDE_UM, Section, is_slot, open_sections, sections_of_tours
from parser.shape.several_loops import several_loops
from parser.shape.tabs import cut_elsewhere
from parser.shape.turns import Turns, find_turns
from parser.toolpath import Toolpath


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


def find_cuts(toolpath: Toolpath, contour: Ints) -> Cuts:
    """Stretches of the contours; `contour` (n,) is each row's, −1 on jumps."""
    first, last, is_sure = several_loops(toolpath, contour)
    closed = np.ones(len(first), dtype=np.bool_)
    edge = edges_of(toolpath, Stretches(first, last))
    loops = Cuts(first, last, contour[first], closed, ~closed, first[edge])
    is_trimmed = np.bincount(edge, minlength=len(edge))[edge] > 1
    sections = _open(toolpath, contour, loops, edge)
    opened = np.array(sorted(sections), dtype=np.int64)
    together = np.isin(loops.contour, loops.contour[is_trimmed]) & ~np.isin(loops.contour, opened)
    kept = loops.take(together & (is_sure | is_trimmed))
    others = _without(np.arange(contour.max(initial=-1) + 1), np.concatenate([opened, kept.contour]))
    elsewhere = cut_elsewhere(toolpath, contour, sections, others)
    others = _without(others, np.array(sorted(elsewhere), dtype=np.int64))
    rows = [(one, at, several[0].first) for at, several in sections.items() for one in several]
    rows += [(one, at, sections[of][0].first) for at, (of, several) in elsewhere.items() for one in several]
    found = _joined(kept, _of_sections(rows), *_cut_once(toolpath, contour, others))
    return found.take(np.argsort(found.first))


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
        one, other = (np.arange(first, last + 1) for first, last in stretches)
        if np.hypot(*(toolpath.start_um[one[0]] - toolpath.start_um[other[0]])) <= CLOSED_WITHIN_UM:
            found[at] = sections_of_tours(toolpath, bounds[at], one, other)
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
    rows = [(one.first, one.last, at, of, one.is_tab) for one, at, of in sections]
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
