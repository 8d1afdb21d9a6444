"""Flow: the order in which the blocks of a program run, subprograms once a call (docs/iso.md §7)."""

from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.path.given import Given

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


_NOTHING = _Stretch(np.zeros(0, dtype=np.int64), "return", 0)


class _Walk:
    """Follows calls; `_known` are the subprograms that were walked, `_open` those that are being walked."""

    def __init__(self, given: Given) -> None:
        self._given = given
        self._past = len(given.listing.blocks.line)
        self._ends, self._returns, self._calls = (given.m(effect) for effect in ("end", "return", "call"))
        self._turns = np.flatnonzero(self._ends | self._returns | self._calls)
        self._names, self._times = given.word("P"), given.word("L")
        self._known: dict[int, _Stretch] = {}
        self._open: list[int] = []
        self._faults: dict[int, str] = {}

    def flow(self) -> Flow:
        ends = np.flatnonzero(self._ends)
        self._main_end = int(ends[0]) if len(ends) else self._past
        whole = self._stretch(0)
        faults = tuple(Fault(*one) for one in sorted(self._faults.items()))
        most = LONGEST if "call-too-long" in self._faults.values() else None  # a long text runs to its end
        return Flow(whole.block[:most], whole.left, self._main_end, faults)

    def _stretch(self, first: int) -> _Stretch:
        """From a block on until a return, an end code or the end of the text."""
        parts: list[Ints] = []
        depth = total = 0
        for at in range(int(self._turns.searchsorted(first)), len(self._turns)):
            turn = int(self._turns[at])
            parts.append(np.arange(first, turn + 1))
            total += turn + 1 - first
            first = turn + 1
            is_end = bool(self._ends[turn])
            if self._calls[turn]:
                called = self._called(turn)
                parts.append(called.block)
                total += len(called.block)
                depth, is_end = max(depth, called.depth), is_end or called.left == "end"
            if self._calls[turn] and total > LONGEST:
                self._faults[turn], is_end = "call-too-long", True
            if is_end or self._returns[turn]:
                return _Stretch(np.concatenate(parts), "end" if is_end else "return", depth)
        return _Stretch(np.concatenate([*parts, np.arange(first, self._past)]), "text", depth)

    def _called(self, block: int) -> _Stretch:
        """What a call runs, as often as it says; nothing where it cannot be followed."""
        target = self._target(block)
        fault = self._why_not(block, target)
        if fault:
            self._faults[block] = fault
            return _NOTHING
        called = self._known[target]
        if called.left == "text":
            self._faults[block] = "call-without-return"
        if called.left == "end":
            return called
        most = 1 + LONGEST // max(len(called.block), 1)
        return called._replace(block=np.tile(called.block, min(max(self._number(block, self._times) or 1, 1), most)))

    def _why_not(self, block: int, target: int) -> str:
        """The term for what keeps a call from being followed; empty where its target is known now."""
        if target < 0:
            return "call-without-number" if self._number(block, self._names) is None else "call-without-label"
        if target in self._open:
            return "call-recursive"
        if target not in self._known and len(self._open) < DEEPEST:
            self._open.append(target)
            within = self._stretch(target)
            self._open.pop()
            self._known[target] = within._replace(depth=within.depth + 1)
        if target not in self._known or len(self._open) + self._known[target].depth > DEEPEST:
            return "call-too-deep"
        return ""

    def _target(self, block: int) -> int:
        """The block that a call names: N behind the end of the program, O, or N before it; −1 where there is none."""
        label = self._number(block, self._names)
        if label is None:
            return -1
        for (values, blocks), first in zip(self._labels, (self._main_end, 0, 0), strict=True):
            at, past = values.searchsorted(label), values.searchsorted(label, side="right")
            at += blocks[at:past].searchsorted(first)
            if at < past:
                return int(blocks[at])
        return -1

    @cached_property
    def _labels(self) -> tuple[tuple[Floats, Ints], ...]:
        """Numbers, rising, and their blocks, of what a call may name, in the order in which it is looked for."""
        n, o = (_by_number(self._given, letter) for letter in "NO")
        return n, o, n

    def _number(self, block: int, word_of: Ints) -> int | None:
        word = int(word_of[block])
        return None if word < 0 else int(self._given.listing.words.value[word])


def _by_number(given: Given, letter: str) -> tuple[Floats, Ints]:
    """The words with a letter by their numbers, those of one number in file order, and their blocks."""
    word = given.listing.of(letter)
    value = given.listing.words.value[word]
    order = np.argsort(value, kind="stable")
    return value[order], given.listing.words.block[word[order]]


def idle(given: Given, run: Flow) -> Bools:
    """(b,) blocks that never run."""
    never = np.ones(len(given.listing.blocks.line), dtype=np.bool_)
    never[run.block] = False
    return never
