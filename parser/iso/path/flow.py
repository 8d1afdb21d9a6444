"""Flow: the order in which the blocks of a program run, subprograms once a call (docs/iso.md §7).

What each block gives: words by letter, G and M words by what the profile says that they do.
"""

from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.listing.listing import Listing
from parser.iso.profiles.profile import Profile

_TENFOLD = 10_000  # G words are numbers below 1000 with one decimal at most


STOPS = ("stop", "thread", "cut")
"""What M words do behind which the wire may be threaded elsewhere."""


class GivenColumns:
    """Columns (b,) of the blocks of a listing, in file order. Of words that contradict each other the last one counts.

    G words go by ten times their number: 901 is G90.1.
    """

    def __init__(self, listing: Listing, profile: Profile) -> None:
        self.listing = listing
        self.profile = profile
        self._size = len(listing.blocks.line)

    def word(self, letter: str) -> Ints:
        """(b,) the word with a letter; −1 where a block has none."""
        return self._last(self.listing.of(letter))

    def group(self, name: str) -> Ints:
        """(b,) the G word of a group; −1 where a block has none."""
        chosen = np.flatnonzero(self._group_of[self._tenfold] == self._groups.get(name, -1))
        at = np.full(self._size, -1, dtype=np.int64)
        at[self._block_of_g[chosen]] = self._tenfold[chosen]
        return at

    def contradicts(self, name: str) -> Bools:
        """(b,) whether a block has G words of a group that differ."""
        chosen = np.flatnonzero(self._group_of[self._tenfold] == self._groups.get(name, -1))
        block = self._block_of_g[chosen]
        return self._any(block[self._tenfold[chosen] != self.group(name)[block]])

    def g(self, tenfold: int) -> Bools:
        """(b,) whether a block has one G word."""
        return self._any(self._block_of_g[self._tenfold == tenfold])

    def m(self, *effects: str) -> Bools:
        """(b,) whether a block has an M word with one of the effects that profiles name."""
        return self._any(self.listing.words.block[self.m_words(*effects)])

    def m_words(self, *effects: str) -> Ints:
        """(k,) the M words with one of the effects that profiles name, in file order."""
        numbers = [float(number) for number, effect in self.profile.m.items() if effect in effects]
        word = self.listing.of("M")
        return word[np.isin(self.listing.words.value[word], numbers)]

    def _last(self, word: Ints) -> Ints:
        at = np.full(self._size, -1, dtype=np.int64)
        at[self.listing.words.block[word]] = word
        return at

    def _any(self, block: Ints) -> Bools:
        has = np.zeros(self._size, dtype=np.bool_)
        has[block] = True
        return has

    @cached_property
    def _block_of_g(self) -> Ints:
        return self.listing.words.block[self.listing.of("G")]

    @cached_property
    def _tenfold(self) -> Ints:
        """(k,) ten times the number of each G word; the last place of the table where it is beyond it."""
        number = np.rint(self.listing.words.value[self.listing.of("G")] * 10)
        return np.where((number >= 0) & (number < _TENFOLD - 1), number, _TENFOLD - 1).astype(np.int64)

    @cached_property
    def _groups(self) -> dict[str, int]:
        return {name: at for at, name in enumerate(sorted(set(self.profile.g.values())))}

    @cached_property
    def _group_of(self) -> Ints:
        table = np.full(_TENFOLD, -2, dtype=np.int64)
        for number, name in self.profile.g.items():
            table[round(float(number) * 10)] = self._groups[name]
        return table


DEEPEST = 10
LONGEST = 400_000
"""Calls within calls, and blocks in all, that are followed: their checks take some 140 MB, and 3 s."""
_LABELS = 10_000
"""Numbers of programs have four digits where P may say more than one."""

Left = Literal["end", "return", "text"]


class Fault(NamedTuple):
    """A call that cannot be followed as it stands: its block, and the term of the catalogue that says why."""

    block: int
    why: str


class Call(NamedTuple):
    """A call that is followed: its block, that of the subprogram, and the P and the label that name it, as words."""

    block: int
    target: int
    name: int
    label: int


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
    calls
        Those that are, in file order.
    """

    block: Ints
    left: Left
    main_end: int
    faults: tuple[Fault, ...]
    calls: tuple[Call, ...] = ()


def flow(given: GivenColumns) -> Flow:
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

    def __init__(self, given: GivenColumns) -> None:
        self._given = given
        self._past = len(given.listing.blocks.line)
        self._ends, self._returns, self._calls = (given.m(effect) for effect in ("end", "return", "call"))
        self._begins = self._beginnings()
        self._turns = np.flatnonzero(self._ends | self._returns | self._calls | np.append(self._begins[1:], False))
        self._names, self._times = given.word("P"), given.word("L")
        self._known: dict[int, _Stretch] = {}
        self._open: list[int] = []
        self._faults: dict[int, str] = {}
        self._followed: dict[int, Call] = {}

    def flow(self) -> Flow:
        ends = np.flatnonzero(self._ends)
        self._main_end = int(ends[0]) if len(ends) else self._past
        whole = self._stretch(0)
        faults = tuple(Fault(*item) for item in sorted(self._faults.items()))
        most = LONGEST if "call-too-long" in self._faults.values() else None  # a long text runs to its end
        calls = tuple(self._followed[block] for block in sorted(self._followed))
        return Flow(whole.block[:most], whole.left, self._main_end, faults, calls)

    def _beginnings(self) -> Bools:
        """(b,) the blocks at which the one before cannot run on: there another program begins."""
        begins = np.zeros(self._past, dtype=np.bool_)
        if self._given.profile.programs_end_at_o:
            begins[self._given.listing.words.block[self._given.listing.of("O")]] = True
        return begins

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
            if first < self._past and self._begins[first]:
                return _Stretch(np.concatenate(parts), "text", depth)
        return _Stretch(np.concatenate([*parts, np.arange(first, self._past)]), "text", depth)

    def _called(self, block: int) -> _Stretch:
        """What a call runs, as often as it says; nothing where it cannot be followed."""
        label = self._label(block)
        target = int(self._given.listing.words.block[label]) if label >= 0 else -1
        fault = self._why_not(block, target)
        if fault:
            self._faults[block] = fault
            return _NOTHING
        self._followed[block] = Call(block, target, int(self._names[block]), label)
        called = self._known[target]
        if called.left == "text":
            self._faults[block] = "call-without-return"
        if called.left == "end":
            return called
        most = 1 + LONGEST // max(len(called.block), 1)
        return called._replace(block=np.tile(called.block, min(max(self._repeats(block), 1), most)))

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

    def _label(self, block: int) -> int:
        """The word that a call names, by what the dialect calls; −1 where there is none."""
        number = self._number(block, self._names)
        if number is None:
            return -1
        if self._given.profile.repeats_in_call:
            number %= _LABELS
        for kind in self._given.profile.calls:
            for values, words in self._labels[kind]:
                at = int(values.searchsorted(number))
                if at < len(values) and values[at] == number:
                    return int(words[at])
        return -1

    def _repeats(self, block: int) -> int:
        """How often a call runs its subprogram: L, or the digits before the label where the dialect has them there."""
        times, name = self._number(block, self._times), self._number(block, self._names)
        if times is None and self._given.profile.repeats_in_call and name is not None:
            return name // _LABELS
        return times or 1

    @cached_property
    def _labels(self) -> dict[str, tuple[tuple[Floats, Ints], ...]]:
        """Kind of label -> numbers, rising, and the words that bear them, in the order in which they are looked for."""
        n, o = self._given.listing.of("N"), self._given.listing.of("O")
        block = self._given.listing.words.block
        is_behind = block[n] >= self._main_end
        begins = is_behind & self._begins_a_subprogram[block[n]]
        by_number = (self._by_number(words) for words in (n[begins], o, n[is_behind], n))
        beginning, program, behind, anywhere = by_number
        return {"beginning": (beginning,), "program": (program,), "number": (behind, anywhere)}

    @cached_property
    def _begins_a_subprogram(self) -> Bools:
        """(b,) the blocks behind an end or a return, and those behind a block that is one label alone there."""
        begins = np.append(True, (self._ends | self._returns)[:-1])
        alone = self._given.listing.stands_alone()
        for at in np.flatnonzero(alone[:-1]).tolist():
            begins[at + 1] |= begins[at]
        return begins

    def _by_number(self, word: Ints) -> tuple[Floats, Ints]:
        """The numbers of words, rising, those of one number in file order, and the words."""
        value = self._given.listing.words.value[word]
        order = np.argsort(value, kind="stable")
        return value[order], word[order]

    def _number(self, block: int, word_of: Ints) -> int | None:
        word = int(word_of[block])
        return None if word < 0 else int(self._given.listing.words.value[word])


def idle(given: GivenColumns, run: Flow) -> Bools:
    """(b,) blocks that never run."""
    never = np.ones(len(given.listing.blocks.line), dtype=np.bool_)
    never[run.block] = False
    return never
