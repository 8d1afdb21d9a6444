"""Offset blocks joined one to the next; a block without a place between its neighbours is left out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controller.offset.joints import Joining, joints
from controller.offset.sections import OffsetSection
from controller.offset.shifted import NOTHING_UM, Blocks, turned_rad
from parser.controller_words import Outer
from parser.geometry.curves import Floats, Ints
from parser.geometry.near import distinct

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
