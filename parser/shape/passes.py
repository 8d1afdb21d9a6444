"""Passes: which stretches of a path run over one edge, however they are written.

A contour may be cut at once, or roughed and then trimmed: in runs of their own, by its start hole, or there and back
without leaving it, with a tab left to the last. A contour that is cut once is one pass.

How far each block of an earlier pass lies from the last pass over its edge.
"""

from bisect import bisect_left
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.geometry.along import headings, places
from parser.geometry.curves import Bools, Floats, Ints
from parser.shape.contours import contour_rows, runs
from parser.shape.cuts import Cuts, edges_of, find_cuts
from parser.shape.loops import part_sides
from parser.shape.parallel_runs import neighbours, run_beside
from parser.toolpath import Toolpath

WIDEST_TAB = 0.25
"""Of the length of a pass: what is left open farther is open by its nature (assumed)."""


class Pass(NamedTuple):
    """Rows of the toolpath that cut once along an edge.

    Attributes
    ----------
    edge
        Which edge, from 0 in the order first cut: passes over one edge share it.
    number
        From 1 within the edge, in the order cut; passes over its tab go on counting behind all others.
    first, last
        Rows, both included; leads left out.
    is_back
        Whether it runs against the first pass over this edge.
    is_closed
        Whether it ends where it began.
    is_tab
        Whether it cuts what the earlier passes left standing.
    shift_um
        How far its path lies from that of the last pass over this edge, positive on the side of the waste; 0 of the
        last. A pass over the tab is held against the last one over the tab.
    part_side
        +1 with the part on the left of the path, −1 on the right, 0 unknown for want of a lead-in. The lead-in to the
        first pass comes from the waste.
    told_um
        Offset by which the program itself has the wire run beside its contour; None where it is the path that is
        written, or another one adds the offset.
    edge_um
        The least `shift_um` over the edge, or over its tab: the pass that runs there leaves the final edge.
    """

    edge: int
    number: int
    first: int
    last: int
    is_back: bool
    is_closed: bool
    is_tab: bool
    shift_um: float
    part_side: int
    told_um: float | None = None
    edge_um: float = 0.0

    def offset_um(self, reach_um: float) -> float:
        """Its offset: as the program tells it, else its distance from the edge that a wire of some reach leaves."""
        return reach_um + self.shift_um - self.edge_um if self.told_um is None else self.told_um


class Passes(NamedTuple):
    """Passes of a toolpath.

    Attributes
    ----------
    passes
        In the order they are cut.
    of_row
        (n,) index into `passes`; −1 on leads, steps between passes and jumps.
    """

    passes: tuple[Pass, ...]
    of_row: Ints

    def around(self, row: int) -> tuple[Pass, Pass] | None:
        """The last pass that begins before a row and the first that does not; None where one is missing."""
        later = bisect_left(self.passes, row, key=lambda each: each.first)
        return (self.passes[later - 1], self.passes[later]) if 0 < later < len(self.passes) else None


def find_passes(toolpath: Toolpath) -> Passes:
    """Passes of a toolpath, in the order they are cut."""
    cuts = find_cuts(toolpath, contour_rows(toolpath))
    edge = _edges(toolpath, cuts)
    sense = _senses(toolpath, cuts, edge)
    passes, of_row = [], np.full(len(toolpath), -1, dtype=np.int64)
    of_edge: dict[int, int] = {}
    part_side = _part_sides(toolpath, cuts, edge) * sense
    shift_um = _shifts(toolpath, cuts, edge, part_side)
    number = _numbers(edge, cuts.is_tab)
    columns = (number, cuts.first, cuts.last, sense < 0, cuts.is_closed, cuts.is_tab, shift_um, part_side)
    for at, (of, *rest) in enumerate(zip(*(column.tolist() for column in (edge, *columns)), strict=True)):
        passes.append(Pass(of_edge.setdefault(of, len(of_edge)), *rest))
        of_row[cuts.first[at] : cuts.last[at] + 1] = at
    return Passes(with_edges(passes), of_row)


def leads_of(passes: Passes, toolpath: Toolpath) -> Bools:
    """(n,) rows that are cut beside all passes: leads, and steps from one pass to the next."""
    return np.asarray((passes.of_row < 0) & ~toolpath.is_jump)


def own_numbers(passes: Passes) -> Ints:
    """(k,) which pass over its edge each one is, from 1, or which over its tab: both are counted by themselves.

    A trim behind the cut of a tab is the second pass still, as in a program that cuts its tab last.
    """
    edge = np.array([pass_.edge for pass_ in passes.passes], dtype=np.int64)
    is_tab = np.array([pass_.is_tab for pass_ in passes.passes], dtype=np.bool_)
    return _numbers(2 * edge + is_tab, is_tab)


def most_passes(passes: Passes) -> int:
    """How many passes the edge with the most has, those over its tab left out; 1 where there are none."""
    is_tab = np.array([pass_.is_tab for pass_ in passes.passes], dtype=np.bool_)
    return int(own_numbers(passes)[~is_tab].max(initial=1))


def pass_numbers(toolpath: Toolpath, passes: Passes) -> Ints:
    """(n,) which pass over its edge or its tab each row is of, from 1: a tab is cut in the solid, as by a first one.

    A lead is of the pass behind it in its contour, else of the one before it; where there is none it is of a first one.
    """
    of_pass = np.append(own_numbers(passes), 1)  # the last for rows of no pass, −1
    number, known = of_pass[passes.of_row], passes.of_row >= 0
    for first, past in runs(toolpath).tolist():
        at = np.flatnonzero(known[first:past]) + first
        if len(at):
            behind = np.minimum(np.searchsorted(at, np.arange(first, past)), len(at) - 1)
            number[first:past] = number[at[behind]]
    return number


def with_edges(passes: Sequence[Pass]) -> tuple[Pass, ...]:
    """The passes of a toolpath, each with the least shift over its edge, or over its tab."""
    least: dict[tuple[int, bool], float] = {}
    for pass_ in passes:
        over = pass_.edge, pass_.is_tab
        least[over] = min(least.get(over, pass_.shift_um), pass_.shift_um)
    return tuple(pass_._replace(edge_um=least[pass_.edge, pass_.is_tab]) for pass_ in passes)


def _edges(toolpath: Toolpath, cuts: Cuts) -> Ints:
    """Which edge each cut (k,) is over: the number of the first one over it.

    The last cut over each edge that is known by now is held against others: trims may follow behind a jump.
    """
    number = np.arange(len(cuts.first))
    known = np.minimum(np.searchsorted(cuts.first, cuts.edge_row), len(number) - 1)
    known = np.where(cuts.first[known] == cuts.edge_row, known, number)  # that one may be no cut after all
    last = np.full(len(known), -1, dtype=np.int64)
    main = np.flatnonzero(~cuts.is_tab)
    last[known[main]] = main
    group = np.flatnonzero(last >= 0)
    group = group[np.argsort(last[group])]
    together = edges_of(toolpath, cuts.take(last[group]).stretches)
    edge, first = number, np.full(len(group), len(known), dtype=np.int64)
    np.minimum.at(first, together, group)
    edge[group] = first[together]
    return edge[known]


def _numbers(edge: Ints, is_tab: Bools) -> Ints:
    """Number (k,) of each cut within its edge, from 1 in running order: those over its tab behind all others."""
    order = np.lexsort((is_tab, edge))  # stable: in running order within both
    first = np.flatnonzero(np.diff(edge[order], prepend=-1))
    number = np.empty(len(edge), dtype=np.int64)
    number[order] = np.arange(len(edge)) - np.repeat(first, np.diff(first, append=len(edge))) + 1
    return number


def _senses(toolpath: Toolpath, cuts: Cuts, edge: Ints) -> Ints:
    """+1 (k,) where a cut runs as the first one over its edge does, −1 where it runs against it.

    A tab is cut from the end of the first one on to its start, or the other way.
    """
    other = np.flatnonzero((edge != np.arange(len(edge))) & ~cuts.is_tab)
    parallel = run_beside(toolpath, cuts.stretches, edge[other], other)
    sense = np.ones(len(edge), dtype=np.int64)
    sense[other[parallel.sense < 0.0]] = -1
    tab = np.flatnonzero(cuts.is_tab)
    start = toolpath.start_um[cuts.first[tab]]
    from_start = np.hypot(*(start - toolpath.start_um[cuts.first[edge[tab]]]).T)
    from_end = np.hypot(*(start - toolpath.end_um[cuts.last[edge[tab]]]).T)
    sense[tab[from_start < from_end]] = -1
    return sense


def _part_sides(toolpath: Toolpath, cuts: Cuts, edge: Ints) -> Ints:
    """Side (k,) of the first cut over the same edge that the part lies on; 0 where that is all of its contour.

    It is 0 too where the first cut leaves so much open that it goes round nothing: on either side the part may lie.
    """
    first, of = np.unique(edge, return_inverse=True)
    begin = runs(toolpath)[cuts.contour[first], 0]
    side = part_sides(toolpath, begin, cuts.first[first], cuts.last[first])
    before = np.concatenate([[0.0], np.cumsum(toolpath.length_um)])
    length_um = before[cuts.last[first] + 1] - before[cuts.first[first]]
    gap_um = np.hypot(*(toolpath.end_um[cuts.last[first]] - toolpath.start_um[cuts.first[first]]).T)
    side[(gap_um > WIDEST_TAB * length_um) & ~np.isin(first, edge[cuts.is_tab])] = 0
    return side[of.reshape(-1)]


def _shifts(toolpath: Toolpath, cuts: Cuts, edge: Ints, part_side: Ints) -> Floats:
    """How far (k,) µm each cut lies from the last one over its edge, or over its tab, on the side of the waste."""
    number = np.arange(len(edge))
    last, first = np.zeros(2 * len(edge), dtype=np.int64), np.zeros(2 * len(edge), dtype=np.int64)
    group = 2 * edge + cuts.is_tab
    last[group], first[group[::-1]] = number, number[::-1]
    last, first = last[group], first[group]
    other = np.flatnonzero(number != last)
    aside = np.zeros(len(edge))
    aside[other] = run_beside(toolpath, cuts.stretches, other, last[other]).aside_um
    # Without a lead-in the waste lies where the first one is cut.
    waste = np.where(part_side != 0, -part_side, 0.0)[last[other]]
    aside[other] *= np.where(waste != 0.0, waste, np.sign(aside[first[other]]))
    return aside + 0.0  # no −0


_SHARES = np.array([1.0, 3.0, 5.0]) / 6.0  # of a block, at which it is held against the last pass


def row_shifts_um(toolpath: Toolpath, passes: Passes) -> Floats:
    """(n,) how far µm the blocks of earlier passes lie from the last pass, at the place where they come nearest to it.

    Positive on the side of the waste. NaN where there is no later pass, or none beside the block, or the side of the
    part is not known; passes over a tab are held against the last one over it.
    """
    shift = np.full(len(toolpath), np.nan)
    last = {(pass_.edge, pass_.is_tab): number for number, pass_ in enumerate(passes.passes)}
    later = np.array([last[pass_.edge, pass_.is_tab] for pass_ in passes.passes], dtype=np.int64)
    side = np.array([pass_.part_side for pass_ in passes.passes], dtype=np.int64)
    same = np.array([not pass_.is_back for pass_ in passes.passes], dtype=np.int64) * 2 - 1
    is_held = (later != np.arange(len(later))) & (side != 0)
    if not is_held.any():
        return shift
    row = np.flatnonzero((passes.of_row >= 0) & is_held[passes.of_row])
    is_last = np.isin(passes.of_row, later[is_held])
    at, share = np.repeat(row, len(_SHARES)), np.tile(_SHARES, len(row))
    beside_neighbours = neighbours(
        toolpath, np.flatnonzero(is_last), places(toolpath, at, share), headings(toolpath, at, share)
    )
    mine, other = passes.of_row[at[beside_neighbours.at]], passes.of_row[beside_neighbours.row]
    own = np.flatnonzero((other == later[mine]) & (beside_neighbours.sense == same[mine] * same[other]))
    # The last pass lies to the left of the place by so much; the part may lie there too.
    return _least(
        shift, at[beside_neighbours.at[own]], beside_neighbours.at[own], (beside_neighbours.aside_um * side[mine])[own]
    )


def _least(shift: Floats, row: Ints, place: Ints, aside: Floats) -> Floats:
    """The rows' shifts (n,) filled in: at each place the nearest neighbour counts, in each row the lowest shift."""
    order = np.lexsort((np.abs(aside), place))
    once = order[np.flatnonzero(np.diff(place[order], prepend=-1))]
    np.fmin.at(shift, row[once], aside[once])
    return shift
