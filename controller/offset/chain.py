"""Offset blocks joined one to the next, and the rows that an offset path has of them.

Offset blocks joined one to the next; a block without a place between its neighbours is left out.

Rows of an offset path: made of joined blocks, and put in their order.

The offset path, block by block, each with the block that it comes from, and the toolpath that it makes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.joints import Joining, joints
from controller.offset.passes import PassedPath
from controller.offset.shifted import NOTHING_UM, Blocks, OffsetSection, turned_rad
from controller.stepping.steps import stepped_words
from parser.controller_words import Outer
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.geometry.near import distinct
from parser.toolpath import Toolpath

_NONE = -1
_LESS_SHORT = 0.5
"""Where two neighbours both run backwards, one is spared for now if it lacks less than this share of the other's lack:
once the other has gone, it may fit beside a new neighbour. At shares near 1 a fine spiral's blocks would go singly."""
_AS_SHORT = 1.0 - 1e-6  # the same where blocks are apart: from a cusp to where its sides cross, they do go singly


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """m blocks and what follows each.

    Attributes
    ----------
    early, late
        (m,) the block before and behind each, −1 for none.
    is_left
        (m,) True on blocks with a place on the path.
    start_um, end_um
        (m, 2) where each begins and ends.
    bridge, corner_um, turn_rad
        (m,), (m, 2), (m,) what lies behind each block, as in `Joints`.
    """

    early: Ints
    late: Ints
    is_left: NDArray[np.bool_]
    start_um: Floats
    end_um: Floats
    bridge: Ints
    corner_um: Floats
    turn_rad: Floats


def joined_blocks(blocks: Blocks, sections: Sequence[OffsetSection], outer: Outer) -> Chain:
    """Blocks joined, at outer corners as `outer` says; those that would run backwards vanish, until none does."""
    m = len(blocks.row)
    early, late = _neighbours(sections)
    chain = Chain(
        early=early,
        late=late,
        is_left=np.ones(m, dtype=np.bool_),
        start_um=blocks.shifted.start_um.copy(),
        end_um=blocks.shifted.end_um.copy(),
        bridge=np.zeros(m, dtype=np.int64),
        corner_um=np.full((m, 2), np.nan),
        turn_rad=np.zeros(m),
    )
    _left_out(chain, np.flatnonzero(~blocks.is_left_over))
    touched = np.flatnonzero(chain.is_left)
    lack, is_apart = np.full(m, -np.inf), np.zeros(m, dtype=np.bool_)
    while len(touched):
        small = _join(chain, blocks, touched, is_apart, outer)
        behind = chain.late[touched]
        looked_at = distinct(np.concatenate([touched, behind[behind != _NONE], np.flatnonzero(lack > -np.inf)]))
        lack[looked_at] = _lack(chain, blocks, looked_at)
        gone = distinct(np.concatenate([small, _shortest(chain, looked_at, lack, is_apart)]))
        lack[gone] = -np.inf
        touched = _left_out(chain, gone)
        _loosen(chain, blocks, touched)
    return chain


def _neighbours(sections: Sequence[OffsetSection]) -> tuple[Ints, Ints]:
    number = np.array([section.last - section.first + 1 for section in sections])
    past = np.cumsum(number)
    first, last = past - number, past - 1
    # A circle in one block is no neighbour of itself.
    closed = np.array([section.closed for section in sections]) & (number > 1)
    at = np.arange(past[-1])
    early, late = at - 1, at + 1
    early[first], late[last] = np.where(closed, last, _NONE), np.where(closed, first, _NONE)
    return early, late


def _left_out(chain: Chain, gone: Ints) -> Ints:
    """Take blocks out of the chain; returns those that have got a new neighbour."""
    chain.is_left[gone] = False
    touched: set[int] = set()
    for block in gone.tolist():
        before, behind = int(chain.early[block]), int(chain.late[block])
        touched |= {before, behind}
        if before != _NONE:
            chain.late[before] = behind
        if behind != _NONE:
            chain.early[behind] = before
    near = np.array(sorted(touched - {_NONE}), dtype=np.int64)
    return near[chain.is_left[near]]


def _loosen(chain: Chain, blocks: Blocks, touched: Ints) -> None:
    """Let blocks that are now the first or the last of an open section run to their own shifted ends there."""
    head, tail = touched[chain.early[touched] == _NONE], touched[chain.late[touched] == _NONE]
    chain.start_um[head] = blocks.shifted.start_um[head]
    chain.end_um[tail], chain.bridge[tail] = blocks.shifted.end_um[tail], Joining.NONE


def _join(chain: Chain, blocks: Blocks, touched: Ints, is_apart: NDArray[np.bool_], outer: Outer) -> Ints:
    """Join blocks with those behind them; returns arcs too small to be joined."""
    early = touched[chain.late[touched] != _NONE]
    late = chain.late[early]
    made = joints(blocks, early, late, outer)
    chain.end_um[early], chain.start_um[late], chain.bridge[early] = made.end_um, made.start_um, made.bridge
    chain.corner_um[early], chain.turn_rad[early] = made.corner_um, made.turn_rad
    is_apart[early] = made.is_apart
    return np.concatenate([early[made.early_vanishes], late[made.late_vanishes]])


def _lack(chain: Chain, blocks: Blocks, block: Ints) -> Floats:
    """How far (k,) µm blocks run backwards between their ends; −∞ for those that do not."""
    way = chain.end_um[block] - chain.start_um[block]
    along = (way * blocks.leaving[block]).sum(axis=1)
    is_arc = blocks.shifted.is_arc[block]
    arc = block[is_arc]
    since, until = turned_ends(chain, blocks, arc)
    along[is_arc] = blocks.shifted.radius_um[arc] * (np.abs(blocks.shifted.sweep_rad[arc]) - since + until)
    return np.where(along <= NOTHING_UM, np.maximum(-along, NOTHING_UM), -np.inf)


def turned_ends(chain: Chain, blocks: Blocks, arc: Ints) -> tuple[Floats, Floats]:
    """Angles (k,) from each arc's own start to its joined start, and from its own end to its joined end, as it runs."""
    shifted = blocks.shifted
    low = shifted.start_angle_rad[arc]
    since = turned_rad(shifted, arc, low, chain.start_um[arc])
    return since, turned_rad(shifted, arc, low + shifted.sweep_rad[arc], chain.end_um[arc])


def _shortest(chain: Chain, block: Ints, lack: Floats, is_apart: NDArray[np.bool_]) -> Ints:
    """The reversed blocks among (k,) blocks, save those with a neighbour that lacks much more."""
    block = block[lack[block] > -np.inf]
    before, behind = chain.early[block], chain.late[block]
    share_before = np.where(is_apart[before], _AS_SHORT, _LESS_SHORT)
    share_behind = np.where(is_apart[block], _AS_SHORT, _LESS_SHORT)
    spared: NDArray[np.bool_] = (before != _NONE) & (lack[block] < share_before * lack[before])
    spared |= (behind != _NONE) & (lack[block] < share_behind * lack[behind])
    return block[~spared]


class RowOrigin(IntEnum):
    """How a row of the offset path came about.

    AS_IT_IS: a block without offset, such as a jump. LEAD: a lead-in or lead-out, between a place without offset and
    the offset path. SHIFTED: a block moved aside, shortened or lengthened at its ends. BRIDGE: an arc or a chamfer
    round an outer corner, or a line between ends that do not meet.
    """

    AS_IT_IS = 0
    LEAD = 1
    SHIFTED = 2
    BRIDGE = 3


@dataclass(frozen=True, slots=True, eq=False)
class OffsetPath:
    """Path of the wire's centre, m rows.

    Attributes
    ----------
    curves
        Its geometry, each row from the end of the one before it. Offset arcs have the centres of their blocks, and
        radii that differ from theirs by the offset, exactly.
    source_row
        (m,) row that each comes from, rising; a bridge has that of the block before it.
    made
        (m,) values of `RowOrigin`.
    place
        (m,) values of `Order`: its place among the rows that come from the same one.
    vanished
        (v,) rows that have no place on the offset path.
    """

    curves: Curves
    source_row: Ints
    made: Ints
    place: Ints
    vanished: Ints


def offset_toolpath(passed: PassedPath, path: OffsetPath) -> Toolpath:
    """Toolpath of the offset `path` of a toolpath in passes: its exact curves, to be stepped like any other.

    If the program has words, its offset has words too, in whole µm. Every row has the source of the block that it comes
    from, and stops keep their places among these blocks. Only blocks without offset keep their printed ends, and only
    where they run as they are drawn.
    """
    drawn, row = passed.drawn, passed.row[path.source_row]
    as_it_is = (path.made == RowOrigin.AS_IT_IS) & ~passed.is_back[path.source_row]
    return Toolpath(
        **{field.name: getattr(path.curves, field.name) for field in fields(Curves)},
        printed_end_um=np.where(as_it_is[:, None], drawn.printed_end_um[row], np.nan),
        words=None if drawn.words is None else stepped_words(path.curves),
        source=drawn.source.picked(row),
        stops=tuple(stop._replace(after=int(np.searchsorted(path.source_row, stop.after))) for stop in passed.stops),
    )


class Order(IntEnum):
    """Order of rows that come from one row of the toolpath; a chamfer has up to three lines."""

    LEAD_IN = 0
    ITSELF = 1
    BRIDGE = 2
    CHAMFER = 3
    BACK = 4
    LEAD_OUT = 5


class Rows(NamedTuple):
    """Rows of the path, in any order: their curves, the rows (k,) that they come from, and how they came about."""

    curves: Curves
    source_row: Ints
    made: RowOrigin
    place: Order


def moved_rows(blocks: Blocks, chain: Chain, left: Ints) -> Rows:
    """The blocks `left` (k,) of a chain as rows, each from where it begins to where it ends."""
    return Rows(_cut(blocks, chain, left), blocks.row[left], RowOrigin.SHIFTED, Order.ITSELF)


def bridge_rows(blocks: Blocks, chain: Chain, left: Ints) -> list[Rows]:
    """The bridges behind the blocks `left` (k,) of a chain: arcs of the offset's radius round corners, and lines."""
    arc, line, chamfer = (left[chain.bridge[left] == kind] for kind in (Joining.ARC, Joining.LINE, Joining.CHAMFER))
    lines = lines_between(chain.end_um[line], chain.start_um[chain.late[line]])
    arcs = curves_between(chain.end_um[arc], chain.start_um[chain.late[arc]], chain.corner_um[arc], chain.turn_rad[arc])
    radius = np.abs(blocks.left_um[arc])
    arcs = replace(arcs, radius_um=radius, length_um=radius * np.abs(arcs.sweep_rad))
    return [
        Rows(arcs, blocks.row[arc], RowOrigin.BRIDGE, Order.BRIDGE),
        Rows(lines, blocks.row[line], RowOrigin.BRIDGE, Order.BRIDGE),
        *_chamfers(blocks, chain, chamfer),
    ]


def _chamfers(blocks: Blocks, chain: Chain, early: Ints) -> list[Rows]:
    """Chamfers behind the blocks `early` (k,): where a block is an arc, a tangent of the offset's length leads on."""
    late = chain.late[early]
    by_um = np.abs(blocks.left_um[early])[:, None]
    on, back = blocks.shifted.is_arc[early], blocks.shifted.is_arc[late]
    end, start = chain.end_um[early], chain.start_um[late]
    far_end = end + np.where(on[:, None], by_um * blocks.arriving[early], 0.0)
    far_start = start - np.where(back[:, None], by_um * blocks.leaving[late], 0.0)
    row = blocks.row[early]
    return [
        Rows(lines_between(end[on], far_end[on]), row[on], RowOrigin.BRIDGE, Order.BRIDGE),
        Rows(lines_between(far_end, far_start), row, RowOrigin.BRIDGE, Order.CHAMFER),
        Rows(lines_between(far_start[back], start[back]), row[back], RowOrigin.BRIDGE, Order.BACK),
    ]


def in_order(parts: Sequence[Rows], vanished: Ints) -> OffsetPath:
    """The path of all parts; `vanished` (v,) are the rows without a place on it.

    Each line and jump begins where the row before it ends.
    """
    source_row = np.concatenate([part.source_row for part in parts])
    made, place = (
        np.concatenate([np.full(len(part.source_row), value) for part, value in zip(parts, values, strict=True)])
        for values in ([part.made for part in parts], [part.place for part in parts])
    )
    order = np.lexsort((place, source_row))
    curves = _continued(joined([part.curves for part in parts]).picked(order))
    origins, places = made[order].astype(np.int64), place[order].astype(np.int64)
    return OffsetPath(curves, source_row[order], origins, places, vanished)


def lines_between(start_um: Floats, end_um: Floats) -> Curves:
    """Lines between places; a line that is nothing but rounding gets the length 0."""
    lines = curves_between(start_um, end_um, np.full_like(start_um, np.nan), np.zeros(len(start_um)))
    return replace(lines, length_um=np.where(lines.length_um > NOTHING_UM, lines.length_um, 0.0))


def _cut(blocks: Blocks, chain: Chain, left: Ints) -> Curves:
    """The shifted blocks `left` (k,) from where each begins to where it ends."""
    shifted = blocks.shifted.picked(left)
    start, end = chain.start_um[left], chain.end_um[left]
    turn = np.sign(shifted.sweep_rad)
    since, until = np.zeros(len(left)), np.zeros(len(left))
    since[shifted.is_arc], until[shifted.is_arc] = turned_ends(chain, blocks, left[shifted.is_arc])
    sweep = shifted.sweep_rad + turn * (until - since)
    way = end - start
    angle = shifted.start_angle_rad + turn * since
    return replace(
        shifted,
        start_um=start,
        end_um=end,
        start_angle_rad=np.where(np.abs(angle) > np.pi, angle - 2.0 * np.pi * np.rint(angle / (2.0 * np.pi)), angle),
        sweep_rad=sweep,
        length_um=np.where(shifted.is_arc, shifted.radius_um * np.abs(sweep), np.hypot(way[:, 0], way[:, 1])),
    )


def _continued(curves: Curves) -> Curves:
    """Curves of which each line and jump begins where the one before it ends."""
    off = (curves.start_um[1:] != curves.end_um[:-1]).any(axis=1) & ~curves.is_arc[1:]
    late = np.flatnonzero(off) + 1
    start, length = curves.start_um.copy(), curves.length_um.copy()
    start[late] = curves.end_um[late - 1]
    length[late] = lines_between(start[late], curves.end_um[late]).length_um
    return replace(curves, start_um=start, length_um=length)
