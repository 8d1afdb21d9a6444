"""The way of a block through the decoder: each word and the field that it sets (docs/iso.md §8).

A word that is not repeated leaves its field alone: what is in force from earlier blocks is not in the buffer.
"""

import math
import re
from collections.abc import Iterable
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from parser.dialect.decoding import UNREAD, DecodedBlock, DecodeStep, InForce
from parser.dialect.reader import Choices
from parser.iso.listing.listing import Assignment, Listing
from parser.iso.path.flow import GivenColumns, flow
from parser.iso.path.places import NO_MOTION, carried, modes
from parser.iso.path.registers import offsets
from parser.iso.profiles.profile import Profile

_COOR: Final = {letter: at for at, letter in enumerate("XYZUVWIJKR", start=1)}
"""Places of dimension words in COOR: the course has X and Y; the others are put behind them here."""
_FLAGS: Final = {0.0: 0, 1.0: 1, 2.0: 2, 3.0: 3, 6.0: 4}
_DISTANCES: Final = {90.0: 0, 91.0: 1}
_SIDES: Final = {40.0: 0, 41.0: 1, 42.0: 2}
_DISTANCE_BIT, _SIDE_BIT = 5, 6
_OWN: Final = "FSTDH"
_DIGITS: Final = 6  # of a µm, that a length in inches has no tail of noughts and ones
_MOTIONS: Final = {NO_MOTION: "", **{motion: f"G0{motion}" for motion in range(4)}}
_DISTANCE_WORDS: Final = {True: "G90", False: "G91"}
_SIDE_WORDS: Final = {0: "G40", 1: "G41", -1: "G42"}
_END_SIGN: Final = re.compile(r"[ \t]*(?:\([^()\r\n]*\)[ \t]*)*;")
_SPACES: Final = re.compile(r"\s+")


class _Word(NamedTuple):
    """One word: as written without blanks, its column, letter, value, and that in µm."""

    text: str
    column: int
    letter: str
    value: float
    um: float


class _Mode(NamedTuple):
    """What is in force in a block, and µm of a coordinate of 1 there, without a point and with one."""

    in_force: InForce
    integer_um: float
    point_um: float


class Trace:
    """Decodes the blocks of a listing, read by a profile and by choices."""

    def __init__(self, listing: Listing, profile: Profile, choices: Choices) -> None:
        self._listing, self._profile, self._choices = listing, profile, choices

    def blocks(self) -> tuple[DecodedBlock, ...]:
        """All blocks of the listing, in file order."""
        return tuple(self._block(at, self._modes.get(at)) for at in range(len(self._listing.blocks.line)))

    @cached_property
    def _modes(self) -> dict[int, _Mode]:
        """What is in force in each block, as it runs for the first time; none for blocks that never run."""
        given = GivenColumns(self._listing, self._profile)
        runs = flow(given).block
        mode = modes(given, runs)
        offset = offsets(given, runs, mode, self._choices)
        feed = carried(given.word("F")[runs], -1)
        block, first = np.unique(runs, return_index=True)
        return {
            number: _Mode(
                InForce(
                    motion=_MOTIONS[int(mode.motion[at])],
                    distance=_DISTANCE_WORDS[bool(mode.is_absolute[at])],
                    side=_SIDE_WORDS[int(mode.side[at])],
                    register=offset.names[offset.name[at]],
                    offset_um=None if np.isnan(offset.by_um[at]) else float(offset.by_um[at]),
                    f=None if feed[at] < 0 else float(self._listing.words.value[feed[at]]),
                ),
                float(mode.integer_um[at]),
                float(mode.point_um[at]),
            )
            for number, at in zip(block.tolist(), first.tolist(), strict=True)
        }

    @cached_property
    def _assignments(self) -> dict[int, list[Assignment]]:
        """Registers that are set, by their blocks."""
        by_block: dict[int, list[Assignment]] = {}
        for assignment in self._listing.assignments:
            by_block.setdefault(assignment.block, []).append(assignment)
        return by_block

    @cached_property
    def _left_out(self) -> dict[int, list[DecodeStep]]:
        """Steps that set no field, by their blocks: lines in other forms than words, and pieces that are no words."""
        by_block: dict[int, list[DecodeStep]] = {}
        statements = ((statement.block, statement.span, statement.form.value) for statement in self._listing.statements)
        unread = ((each.block, each.span, UNREAD) for each in self._listing.unread)
        for block, span, field in (*statements, *unread):
            text = " ".join(self._listing.text[slice(*span)].split())
            by_block.setdefault(block, []).append(DecodeStep(0, text, self._column(span[0]), field, None))
        return by_block

    def _block(self, at: int, mode: _Mode | None) -> DecodedBlock:
        blocks = self._listing.blocks
        scale = (self._profile.integer_um, self._profile.point_um) if mode is None else mode[1:]
        words = [self._word(word, *scale) for word in range(int(blocks.word[at]), int(blocks.word[at + 1]))]
        last = {word.letter: word.value for word in words}
        g_words = tuple(word.value for word in words if word.letter == "G")
        count = _whole(last.get("N"))
        others = [self._assigned(each, *scale) for each in self._assignments.get(at, ())]
        steps = [*map(_set_by, words), *others, *self._left_out.get(at, ())]
        steps = [*sorted(steps, key=lambda step: step.column), self._closing(int(blocks.past[at]))]
        return DecodedBlock(
            line=int(blocks.line[at]),
            span=(int(blocks.first[at]), int(blocks.past[at])),
            number=count,
            number_bcd=None if count is None else binary_coded(count),
            coor_um={word.letter: word.um for word in words if word.letter in _COOR},
            f=last.get("F"),
            s=last.get("S"),
            t=last.get("T"),
            d=last.get("D"),
            h=last.get("H"),
            g0=flags(g_words),
            g=g_words,
            m=tuple(word.value for word in words if word.letter == "M"),
            others={letter: value for letter, value in last.items() if letter not in {*_COOR, *_OWN, *"NGM"}},
            steps=tuple(step._replace(order=order) for order, step in enumerate(steps, start=1)),
            in_force=mode and mode.in_force,
        )

    def _word(self, at: int, integer_um: float, point_um: float) -> _Word:
        words = self._listing.words
        first, value = int(words.first[at]), float(words.value[at])
        scale = integer_um if words.decimals[at] < 0 else point_um
        letter = chr(int(words.letter[at]))
        return _Word(
            self._text(first, int(words.past[at])), self._column(first), letter, value, _rounded(value * scale)
        )

    def _assigned(self, assignment: Assignment, integer_um: float, point_um: float) -> DecodeStep:
        """The step of a register that is set: its value where numbers tell it, else none: it depends on other ones."""
        profile = self._profile
        integer_um *= profile.register_integer_um / profile.integer_um
        point_um *= profile.register_point_um / profile.point_um
        parts = [None if isinstance(term, str) else _scaled(*term, integer_um, point_um) for term in assignment.terms]
        known = [part for part in parts if part is not None]
        um = _rounded(sum(known)) if len(known) == len(parts) else None
        return DecodeStep(0, self._text(*assignment.span), self._column(assignment.span[0]), assignment.register, um)

    def _closing(self, past: int) -> DecodeStep:
        """The step that tells the next stage that the block is whole: a closing ``;``, or the end of the line."""
        sign = _END_SIGN.match(self._listing.text, past)
        column = self._column(sign.end() - 1) if sign else self._column(past - 1) + 1
        return DecodeStep(0, ";" if sign else "", column, "buf_state", 1)

    def _text(self, first: int, past: int) -> str:
        return _SPACES.sub("", self._listing.text[first:past])

    def _column(self, at: int) -> int:
        return self._listing.lines.column(at)


def flags(g_words: Iterable[float]) -> int:
    """The byte G0 of the G words of a block; those that have no bit change nothing."""
    byte = 0
    for word in g_words:
        if word in _FLAGS:
            byte |= 1 << _FLAGS[word]
        elif word in _DISTANCES:
            byte = byte & ~(1 << _DISTANCE_BIT) | _DISTANCES[word] << _DISTANCE_BIT
        elif word in _SIDES:
            byte = byte & ~(3 << _SIDE_BIT) | _SIDES[word] << _SIDE_BIT
    return byte


def binary_coded(number: int) -> int:
    """A whole number with one decimal digit in every four bits: 12 is 0x12."""
    return int(str(abs(number)), 16)


def _set_by(word: _Word) -> DecodeStep:
    """The step of a word."""
    field, value = _field(word)
    return DecodeStep(0, word.text, word.column, field, value)


def _field(word: _Word) -> tuple[str, float]:
    """The field that a word sets, and what it becomes."""
    if word.letter in _COOR:
        return f"COOR[{_COOR[word.letter]}]", word.um
    if word.letter == "G":
        return _g_field(word.value)
    return {"N": "block_num", "M": "M0"}.get(word.letter, word.letter), word.value


def _g_field(value: float) -> tuple[str, float]:
    if value in _FLAGS:
        return f"G0.D{_FLAGS[value]}", 1
    if value in _DISTANCES:
        return f"G0.D{_DISTANCE_BIT}", _DISTANCES[value]
    return ("G0.D7D6", _SIDES[value]) if value in _SIDES else ("G1", value)


def _scaled(value: float, decimals: int, integer_um: float, point_um: float) -> float:
    return value * (integer_um if decimals < 0 else point_um)


def _whole(number: float | None) -> int | None:
    return int(number) if number is not None and math.isfinite(number) else None


def _rounded(um: float) -> float:
    return round(um, _DIGITS)
