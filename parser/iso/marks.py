"""Marks: what in a listing tells the family that it was written for, and what no wire machine is told.

Marks: what in a listing tells the family that it was written for (docs/iso.md §6).

Mill code: what in a listing no wire machine is told (docs/iso.md §6).
"""

from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.listing.listing import Form, Listing

COORDINATES = "XYIJR"
"""Letters of lengths in the plane of the program."""
DIGITS_IN_MM = 3
"""Behind the point, in programs in mm: those in inches need more."""
_DWELL = 4.0  # G04, whose X is a time
_LONG = 1000.0  # an integer of four digits
_EXACT = 1e-6


class MarksSeen:
    """What stands in a listing, asked for by the marks of families."""

    def __init__(self, listing: Listing) -> None:
        self.listing = listing

    def has(self, letter: str, *numbers: float) -> bool:
        """Whether there is a word with a letter, and with one of the numbers where some are named."""
        values = self.listing.words.value[self.listing.of(letter)]
        return bool((values[:, None] == np.array(numbers)).any() if numbers else len(values))

    def has_long(self, letter: str) -> bool:
        """Whether there is a word with a letter and a number of four digits or more."""
        return bool((np.abs(self.listing.words.value[self.listing.of(letter)]) >= _LONG).any())

    @cached_property
    def coordinates(self) -> Ints:
        """(k,) words of lengths in the plane, in file order; not those of 0, which is the same at any scale."""
        words, word = self.listing.words, self.listing.of_any(COORDINATES)
        dwells = words.block[self.listing.of("G")[words.value[self.listing.of("G")] == _DWELL]]
        lengths: Ints = word[(words.value[word] != 0.0) & ~np.isin(words.block[word], dwells)]
        return lengths

    @cached_property
    def is_pointed(self) -> Bools:
        """(k,) whether each of these is written with a point."""
        pointed: Bools = self.listing.words.decimals[self.coordinates] >= 0
        return pointed

    @property
    def first_length(self) -> int:
        """The first block with such a word; −1 where there is none."""
        return int(self.listing.words.block[self.coordinates[0]]) if len(self.coordinates) else -1

    @property
    def are_integers(self) -> bool:
        """Whether there are lengths, and none has a point."""
        return bool(len(self.coordinates)) and not self.is_pointed.any()

    @property
    def are_long_integers(self) -> bool:
        """Whether all lengths are written without a point, and some with four digits or more."""
        return self.are_integers and bool((np.abs(self.listing.words.value[self.coordinates]) >= _LONG).any())

    @property
    def calls_labels(self) -> bool:
        """Whether M98 P calls a number that stands behind an N, and no program has one behind an O."""
        called = self.listing.words.value[self.listing.of("P")]
        labels = self.listing.words.value[self.listing.of("N")]
        return self.has("M", 98) and not self.has("O") and not set(called.tolist()).isdisjoint(labels.tolist())

    def sets(self, letter: str, *, pointed: bool) -> bool:
        """Whether a register with a letter is set to a number with a point, or to one without."""
        return any(
            (term[1] >= 0) is pointed
            for assignment in self.listing.assignments
            if assignment.register.startswith(letter)
            for term in assignment.terms
            if not isinstance(term, str)
        )

    @property
    def sums_registers(self) -> bool:
        """Whether a register is set to a sum with another one."""
        return any(
            len(assignment.terms) > 1 and any(isinstance(term, str) for term in assignment.terms)
            for assignment in self.listing.assignments
        )

    @property
    def greatest_setting(self) -> float:
        """The greatest number with a point that a register is set to; 0 where there is none."""
        terms = [
            term for assignment in self.listing.assignments for term in assignment.terms if not isinstance(term, str)
        ]
        return max((abs(number) for number, decimals in terms if decimals >= 0), default=0.0)

    @cached_property
    def decimals(self) -> int:
        """Digits behind the point that the lengths need, trailing zeros left out, up to 6."""
        value = self.listing.words.value[self.coordinates][self.is_pointed]
        return next((digits for digits in range(6) if _is_whole(value * 10.0**digits)), 6)

    def states(self, form: Form, start: str) -> bool:
        """Whether a line of a form begins with some letters."""
        return any(
            statement.form is form
            and self.listing.text[statement.span[0] : statement.span[1]].lstrip().upper().startswith(start)
            for statement in self.listing.statements
        )


class Mark(NamedTuple):
    """What tells a family: its profile, the term that says why, and whether it is seen."""

    dialect: str
    why: str
    is_seen: Callable[[MarksSeen], bool]


MARKS = (
    Mark("robofil", "because-g38", lambda seen: seen.has("G", 38)),
    Mark("mitsubishi", "because-register-sum", lambda seen: seen.sums_registers),
    Mark("sodick", "because-tables", lambda seen: seen.states(Form.SETTING, "C") or seen.states(Form.FUNCTION, "QAIC")),
    Mark("sodick", "because-t84-g149", lambda seen: seen.has("T", 84) and seen.has("G", 149)),
    Mark("skd2", "because-registers-um", lambda seen: seen.sets("H", pointed=False)),
    Mark("skd2", "because-e-table", lambda seen: seen.states(Form.SETTING, "E")),
    Mark("mitsubishi", "because-conditions", lambda seen: seen.has_long("E")),
    Mark("mitsubishi", "because-switches", lambda seen: seen.has("M", 78, 80, 82)),
    Mark("sodick", "because-registers-mm", lambda seen: seen.has("H") and seen.sets("H", pointed=True)),
    Mark("skd2", "because-called-labels", lambda seen: seen.calls_labels and seen.are_integers),
    Mark("fanuc", "because-o-number", lambda seen: seen.has("O") and seen.has("D") and seen.has("S")),
    Mark("fanuc", "because-o-inches", lambda seen: seen.has("O") and seen.decimals > DIGITS_IN_MM),
    Mark("robofil", "because-g60", lambda seen: seen.has("G", 60)),
    Mark("patent-mill", "because-cylinder", lambda seen: seen.has("M", 55, 56)),
    Mark("fast-wire", "because-long-integers", lambda seen: seen.are_long_integers and not seen.has("M", 30)),
)
"""Marks in the order in which they decide."""


def mark_of(seen: MarksSeen) -> Mark | None:
    """The first mark that is seen; None where there is none."""
    return next((mark for mark in MARKS if mark.is_seen(seen)), None)


def _is_whole(value: Floats) -> bool:
    return bool((np.abs(value - np.rint(value)) < _EXACT).all())


_LEVELS = 2  # of Z, at which something moves down and up


def mill_code(listing: Listing) -> Finding | None:
    """Finding ISO100 at the word that tells a mill; None where nothing does."""
    word, what = next(
        (
            (word, what)
            for word, what in (
                (_first(listing, "M", 6), "mill-tool"),
                (_first(listing, "G", 43), "mill-length"),
                (_spindle(listing), "mill-spindle"),
                (_depth(listing), "mill-depth"),
            )
            if word >= 0
        ),
        (-1, ""),
    )
    if word < 0:
        return None
    detail = listing.written(word)
    return listing.at_word("ISO100", word, what=what, detail=detail, hint="hint-wire-program")


def _first(listing: Listing, letter: str, number: float) -> int:
    """The first word with a letter and a number; −1 where there is none."""
    word = listing.of(letter)
    found = word[listing.words.value[word] == number]
    return int(found[0]) if len(found) else -1


def _spindle(listing: Listing) -> int:
    """The first M03 or M04 in a block with an S word: a spindle turns."""
    turns = listing.of("M")
    value = listing.words.value[turns]
    turns = turns[(value == 3.0) | (value == 4.0)]
    found = turns[listing.blocks_of(listing.of("S"))[listing.words.block[turns]]]
    return int(found[0]) if len(found) else -1


def _depth(listing: Listing) -> int:
    """The first Z below 0 where Z moves between levels: something goes down into the work."""
    words = listing.words
    sets = listing.blocks_of(listing.of("G")[words.value[listing.of("G")] == 92.0])
    depth = listing.of("Z")
    depth = depth[~sets[words.block[depth]]]
    below = depth[words.value[depth] < 0.0]
    return int(below[0]) if len(below) and len(set(words.value[depth].tolist())) >= _LEVELS else -1
