"""Offset of a program that tells its controller itself where to compensate: by G41, G42 and G40 (docs/iso.md §9)."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from controller.offset.chain import (
    Chain,
    OffsetPath,
    Order,
    RowOrigin,
    Rows,
    bridge_rows,
    in_order,
    joined_blocks,
    lines_between,
    moved_rows,
)
from controller.offset.shifted import NOTHING_UM, Blocks, shifted_blocks
from controller.offset.stretches import Alarm, Runs, Stretch, alarms_of, idle_rows, known_sides, runs_of, stretches_of
from parser.controller_words import CompensationRules
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.toolpath import Toolpath


@dataclass(frozen=True, slots=True, eq=False)
class Compensated:
    """What a controller makes of a program's own compensation.

    Attributes
    ----------
    path
        The path of the wire's centre, over the rows of the toolpath. Set-ups and cancels are rows of `Made.LEAD`. The
        path goes on to its end where the controller would stop.
    alarms
        What stops the controller, or should be known, by row.
    stretches
        From set-up to cancel, in order.
    """

    path: OffsetPath
    alarms: tuple[Alarm, ...]
    stretches: tuple[Stretch, ...]


def leaning_offset_um(toolpath: Toolpath, offset_um: Floats) -> Floats:
    """Offsets (n,) as they are in the program plane, where the wire leans by T: D / cos T (EDM_NC, g24.cpp)."""
    return offset_um if toolpath.taper is None else offset_um / np.cos(toolpath.taper.angle_rad)


class _Ends(NamedTuple):
    """Where the path of each of k runs begins (k, 2), behind what leads into it, and ends, before what leads out."""

    start_um: Floats
    end_um: Floats


def compensated(toolpath: Toolpath) -> Compensated:
    """The path of the wire's centre of a toolpath whose `compensation` is told.

    A set-up is a straight line from where it begins to where the offset begins, a cancel one from where the offset ends
    to where the cancel does; jumps stay jumps. A program that ends compensated stays at the offset. Blocks are joined,
    and vanish, as those of `compensate` do, by the program's own rules. Stretches in which the value of a register is
    not known stay as they are. Blocks without length do nothing.
    """
    compensation = toolpath.compensation
    if compensation is None:
        raise ValueError("the toolpath tells of no compensation")
    side = known_sides(compensation)
    row = np.flatnonzero(~idle_rows(toolpath, side))
    blocks, side, left_um = toolpath.picked(row), side[row], leaning_offset_um(toolpath, compensation.left_um)[row]
    runs = runs_of(blocks, side, left_um, compensation.rules)
    parts, gone = _parts(blocks, side, runs, compensation.rules)
    vanished = np.delete(np.arange(len(toolpath)), np.delete(row, gone))
    path = in_order(parts, vanished)
    return Compensated(
        path=replace(path, source_row=row[path.source_row]),
        alarms=alarms_of(toolpath, compensation, runs, row, row[gone]),
        stretches=stretches_of(runs, row),
    )


def _parts(blocks: Curves, side: Ints, runs: Runs, rules: CompensationRules) -> tuple[list[Rows], Ints]:
    """All rows of the path of the blocks, and the blocks (v,) that have no place on it."""
    alone = side == 0
    alone[runs.cancel[runs.cancel >= 0]] = False
    free = np.flatnonzero(alone)
    parts = [Rows(blocks.picked(free), free, RowOrigin.AS_IT_IS, Order.ITSELF)]
    if not len(runs.first):
        return parts, free[:0]
    sections = runs.sections
    shifted = shifted_blocks(blocks, sections, runs.left_um)
    chain = joined_blocks(shifted, sections, rules.outer)
    length = np.array([section.last - section.first + 1 for section in sections])
    past = np.cumsum(length)
    first = past - length
    is_link = _links(runs, first, past)
    ends = _ends(runs, shifted, chain, first, past)
    left = np.flatnonzero(chain.is_left)
    parts += [
        moved_rows(shifted, chain, left[~is_link[left]]),
        *bridge_rows(shifted, chain, left),
        *_leads(blocks, runs, ends),
        *_changes(blocks, runs, ends),
    ]
    return parts, shifted.row[~chain.is_left & ~is_link]


def _links(runs: Runs, first: Ints, past: Ints) -> Bools:
    """(m,) True on the blocks of the runs' sections, from `first` (k,) to before `past` (k,), that lead in or out."""
    is_link = np.zeros(past[-1], dtype=np.bool_)
    is_link[first[_begins_itself(runs)]] = True
    is_link[past[runs.is_handed_on] - 1] = True
    return is_link


def _begins_itself(runs: Runs) -> Bools:
    """(k,) True on runs whose section begins with the block that leads in."""
    return runs.is_wedge | (runs.is_setup & ~runs.is_skipped)


def _ends(runs: Runs, shifted: Blocks, chain: Chain, first: Ints, past: Ints) -> _Ends:
    """Where a run has no place at all, it begins and ends where it does without offset."""
    start, end = shifted.drawn.start_um[first], shifted.drawn.start_um[first].copy()
    left = np.append(np.flatnonzero(chain.is_left), past[-1])
    low, high = np.searchsorted(left, first), np.searchsorted(left, past)
    there = np.flatnonzero(high > low)
    head, tail = left[low[there]], left[high[there] - 1]
    leads_in = _begins_itself(runs)[there] & (head == first[there])
    leads_out = runs.is_handed_on[there] & (tail == past[there] - 1)
    start[there] = np.where(leads_in[:, None], chain.end_um[head], chain.start_um[head])
    end[there] = np.where(leads_out[:, None], chain.start_um[tail], chain.end_um[tail])
    return _Ends(start, end)


def _leads(blocks: Curves, runs: Runs, ends: _Ends) -> list[Rows]:
    """Set-ups and cancels."""
    into, out = np.flatnonzero(runs.is_setup), np.flatnonzero(runs.cancel >= 0)
    setup, cancel = runs.first[into], runs.cancel[out]
    return [
        Rows(_line(blocks, setup, blocks.start_um[setup], ends.start_um[into]), setup, RowOrigin.LEAD, Order.ITSELF),
        Rows(_line(blocks, cancel, ends.end_um[out], blocks.end_um[cancel]), cancel, RowOrigin.LEAD, Order.ITSELF),
    ]


def _changes(blocks: Curves, runs: Runs, ends: _Ends) -> list[Rows]:
    """Wedges between the offsets of two runs, and lines across to a run that begins at its own."""
    wedge = np.flatnonzero(runs.is_wedge)
    step = np.flatnonzero(~runs.is_setup & ~runs.is_wedge)
    # What is nothing but rounding a line takes up by itself; an arc cannot.
    nothing_um = np.where(blocks.is_arc[runs.first[step]], 0.0, NOTHING_UM)
    step = step[np.hypot(*(ends.start_um[step] - ends.end_um[step - 1]).T) > nothing_um]
    row, before = runs.first[wedge], runs.first[step] - 1
    across = lines_between(ends.end_um[step - 1], ends.start_um[step])
    return [
        Rows(_line(blocks, row, ends.end_um[wedge - 1], ends.start_um[wedge]), row, RowOrigin.SHIFTED, Order.ITSELF),
        Rows(across, before, RowOrigin.BRIDGE, Order.LEAD_OUT),
    ]


def _line(blocks: Curves, row: Ints, start_um: Floats, end_um: Floats) -> Curves:
    """Lines in the place of the blocks `row` (k,); jumps stay jumps."""
    lines = lines_between(start_um, end_um)
    is_jump = blocks.kind[row] == CurveKind.JUMP
    return replace(lines, kind=np.where(is_jump, CurveKind.JUMP, CurveKind.LINE).astype(np.int64))
