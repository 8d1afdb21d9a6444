"""Flow: the order in which the blocks of a program run, subprograms once a call (docs/iso.md §7)."""

from typing import Literal, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Ints
from parser.iso.given import Given

DEEPEST = 10
LONGEST = 2_000_000
"""Calls within calls, and blocks in all, that are followed."""

Left = Literal["end", "return", "text"]


class Fault(NamedTuple):
    """A call that cannot be followed as it stands: its block, and the term of the catalogue that says why."""

    block: int
    why: str


class Flow(NamedTuple):
    """How a program runs.

    Attributes
    ----------
    block
        (e,) blocks as they run, from 0.
    left
        How the program is left: by its end code, by a return that nothing called, or where its text ends.
    main_end
        The first block with an end code, which subprograms stand behind; the number of blocks where none has one.
    faults
        Calls that cannot be followed.
    """

    block: Ints
    left: Left
    main_end: int
    faults: tuple[Fault, ...]


def flow(given: Given) -> Flow:
    """How the program of a listing runs."""
    return _Walk(given).flow()


class _Stretch(NamedTuple):
    """Blocks from a label to where they are left, calls followed, and how deep those are nested."""

    block: Ints
    left: Left
    depth: int


class _Walk:
    def __init__(self, given: Given) -> None:
        self._given = given
        self._past = len(given.listing.blocks.line)
        self._ends, self._returns, self._calls = (given.m(effect) for effect in ("end", "return", "call"))
        self._turns = np.flatnonzero(self._ends | self._returns | self._calls)
        self._known: dict[int, _Stretch] = {}
        self._open: list[int] = []
        self._faults: dict[int, str] = {}

    def flow(self) -> Flow:
        ends = np.flatnonzero(self._ends)
        self._main_end = int(ends[0]) if len(ends) else self._past
        whole = self._stretch(0)
        faults = tuple(Fault(*one) for one in sorted(self._faults.items()))
        return Flow(whole.block[:LONGEST], whole.left, self._main_end, faults)

    def _stretch(self, first: int) -> _Stretch:
        """From a block on until a return, an end code or the end of the text."""
        parts: list[Ints] = []
        depth = total = 0
        for turn in self._turns[np.searchsorted(self._turns, first) :].tolist():
            parts.append(np.arange(first, turn + 1))
            total += turn + 1 - first
            first = turn + 1
            if self._calls[turn]:
                called, times = self._called(turn)
                depth = max(depth, called.depth)
                times = min(times, 1 + LONGEST // max(len(called.block), 1))
                parts += [called.block] * (1 if called.left == "end" else times)
                total += len(called.block) * times
                if called.left == "end":
                    return _Stretch(np.concatenate(parts), "end", depth)
                if total > LONGEST:
                    self._faults[turn] = "call-too-long"
                    break
            if self._ends[turn] or self._returns[turn]:
                return _Stretch(np.concatenate(parts), "end" if self._ends[turn] else "return", depth)
        return _Stretch(np.concatenate([*parts, np.arange(first, self._past)]), "text", depth)

    def _called(self, block: int) -> tuple[_Stretch, int]:
        """What a call runs, and how often."""
        nothing = _Stretch(np.zeros(0, dtype=np.int64), "return", 0)
        label = self._number(block, "P")
        target = -1 if label is None else self._target(label)
        if target < 0:
            self._faults[block] = "call-without-number" if label is None else "call-without-label"
            return nothing, 0
        if target in self._open:
            self._faults[block] = "call-recursive"
            return nothing, 0
        if target not in self._known and len(self._open) < DEEPEST:
            self._open.append(target)
            within = self._stretch(target)
            self._open.pop()
            self._known[target] = within._replace(depth=within.depth + 1)
        called = self._known.get(target, nothing._replace(depth=1))
        if len(self._open) + called.depth > DEEPEST:
            self._faults[block] = "call-too-deep"
            return nothing, 0
        if called.left == "text":
            self._faults[block] = "call-without-return"
        return called, max(self._number(block, "L") or 1, 1)

    def _target(self, label: int) -> int:
        """The block that a call names: N behind the end of the program, O, or N before it; −1 where there is none."""
        words = self._given.listing.words
        for letter, first in (("N", self._main_end), ("O", 0), ("N", 0)):
            named = self._given.listing.of(letter)
            blocks = words.block[named[words.value[named] == label]]
            blocks = blocks[blocks >= first]
            if len(blocks):
                return int(blocks[0])
        return -1

    def _number(self, block: int, letter: str) -> int | None:
        word = int(self._given.word(letter)[block])
        return None if word < 0 else int(self._given.listing.words.value[word])


def idle(given: Given, run: Flow) -> Bools:
    """(b,) blocks that never run."""
    never = np.ones(len(given.listing.blocks.line), dtype=np.bool_)
    never[run.block] = False
    return never
