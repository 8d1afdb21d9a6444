"""Every kind of fault that a hand, a cable or a memory makes, in a sound program as who damages it sees it.

A program without faults, as those who damage it look at it: its blocks, its lines, the words of its blocks.

Faults in the words of one block: its place in the program, its label and its printed end stay as they are.

Faults of whole lines: blocks and marks that are missing, stand twice, or stand elsewhere.
"""

import re
from collections.abc import Callable, Mapping
from functools import cached_property
from itertools import pairwise
from random import Random
from typing import Final, Literal, NamedTuple, get_args

import numpy as np

from parser.dialect.reader import Spelling
from parser.geometry.curves import Ints
from parser.program import Program
from parser.step_words.words import SENSES
from parser.text.source import Field, Span


class Slip(NamedTuple):
    """A damaged text; the fault stands, or shows, in one of its `lines`, from 1."""

    text: str
    lines: frozenset[int]


class Sound:
    """A program that is to be damaged.

    Parameters
    ----------
    program
        With at least one block.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self.path = program.toolpath
        self.text = program.text

    @cached_property
    def rows(self) -> list[int]:
        """Rows of the path, one for each block that stands in the text; routines that run twice stand there once."""
        spans = self.path.source.span
        _, first = np.unique(spans[:, 0], return_index=True)
        return [row for row in sorted(first.tolist()) if spans[row, 0] < spans[row, 1]]

    @cached_property
    def alone(self) -> list[int]:
        """Those of the rows whose block has its line for itself."""
        lines = self._lines[self.rows]
        known, counts = np.unique(lines, return_counts=True)
        return [row for row in self.rows if counts[np.searchsorted(known, self._lines[row])] == 1]

    @cached_property
    def neighbours(self) -> list[tuple[int, int]]:
        """Rows of two cuts in lines that follow one another."""
        cuts = [row for row in self.alone if not self.path.is_jump[row]]
        pairs = pairwise(cuts)
        return [(this, other) for this, other in pairs if self.line(other) == self.line(this) + 1]

    @property
    def _lines(self) -> Ints:
        return self.path.source.line

    def line(self, row: int) -> int:
        """The line in which the block of a row stands, from 1."""
        return int(self._lines[row])

    def stops(self, kind: str) -> list[int]:
        """Lines of pauses, or of the end, that hold no block."""
        of_blocks = set(self._lines.tolist())
        return [stop.line for stop in self.path.stops if stop.kind == kind and stop.line not in of_blocks]

    def field(self, row: int, field: Field) -> tuple[Span, str] | None:
        """Where a field of a block stands in the text, and what stands there; None where the block has none."""
        span = self.path.source.field(row, field)
        return span and (span, self.text[slice(*span)])

    def line_span(self, line: int) -> Span:
        """A line with its end, which the last line may lack."""
        first, past = self.program.lines.bounds(line)
        ends = self.text[past : past + 2]
        return first, past + (2 if ends == "\r\n" else len(ends[:1]))

    def line_text(self, line: int) -> str:
        """A line as written, without its end."""
        return self.program.excerpt(line)

    @cached_property
    def line_end(self) -> str:
        """How the first line ends."""
        past = self.program.lines.bounds(1)[1]
        return self.text[past : self.line_span(1)[1]] or "\n"

    def with_text(self, span: Span, text: str) -> str:
        """The whole text with another one in place of a span."""
        return f"{self.text[: span[0]]}{text}{self.text[span[1] :]}"


Maker = Callable[[Random, Sound], Slip | None]
"""Makes a fault by chance; None where the place that chance chose has nothing to damage in this way."""

_QUADRANTS = "1234"
_OF_CENTRE = re.compile(r"(?<=[IJij])[-+]?[\d.]+", re.ASCII)


def digit(field: Field, how: str) -> Maker:
    """A digit of a number ``changed``, ``lost`` or ``doubled``."""
    return _in_field(field, lambda chance, word, _: _with_digit(chance, word, how))


def digit_of_centre() -> Maker:
    """A digit of I or J changed."""

    def make(chance: Random, sound: Sound) -> Slip | None:
        row = chance.choice(sound.rows)
        if sound.path.words is not None:
            return None
        first = int(sound.path.source.span[row, 0])
        numbers = list(_OF_CENTRE.finditer(sound.path.source.block_text(row)))
        if not numbers:
            return None
        number = chance.choice(numbers)
        span = first + number.start(), first + number.end()
        put = _with_digit(chance, number[0], "changed")
        return Slip(sound.with_text(span, put), frozenset({sound.line(row)})) if put else None

    return make


def sign(field: Field) -> Maker:
    """A minus lost, or one that was not there."""

    def change(_: Random, word: str, sound: Sound) -> str | None:
        if sound.path.words is not None:  # block lengths have no signs
            return None
        return word.replace("-", "", 1) if "-" in word else re.sub(r"(?=[\d.])", "-", word, count=1)

    return _in_field(field, change)


def point(field: Field) -> Maker:
    """A decimal point lost: controllers take the number for steps."""
    return _in_field(field, lambda _, word, __: re.sub(r"\.(?=\d)", "", word, count=1))


def axis() -> Maker:
    """GX for GY."""
    return _in_field(Field.AXIS, lambda _, word, __: word.translate(str.maketrans("XYxy", "YXyx")))


def quadrant() -> Maker:
    """Another quadrant behind the letters of the sense."""

    def change(chance: Random, word: str, sound: Sound) -> str | None:
        if sound.path.words is None:
            return None
        return word[:-1] + chance.choice([each_quadrant for each_quadrant in _QUADRANTS if each_quadrant != word[-1]])

    return _in_field(Field.SENSE, change)


def turned() -> Maker:
    """An arc that turns the other way."""

    def change(_: Random, word: str, sound: Sound) -> str | None:
        spelling = sound.program.reading.spelling
        for this, other in _arcs(spelling), _arcs(spelling)[::-1]:
            if _bare(word).startswith(_bare(this)):
                return other + _bare(word)[len(_bare(this)) :]
        return None

    return _in_field(Field.SENSE, change)


def bent() -> Maker:
    """A line made an arc, or an arc a line."""

    def change(chance: Random, word: str, sound: Sound) -> str | None:
        if sound.path.words is None:
            return None
        line, *arcs = SENSES.values()
        return (chance.choice(arcs) if word.upper().startswith(line) else line) + word[-1]

    return _in_field(Field.SENSE, change)


def other_side() -> Maker:
    """The offset on the other side of the path."""
    return _in_field(Field.SIDE, lambda _, word, __: word[:-1] + {"1": "2", "2": "1"}.get(word[-1], word[-1]))


def letter_lost(letters: str) -> Maker:
    """One of some letters lost from a block."""
    return _in_text(letters, "")


def letter_for_digit() -> Maker:
    """The letter O for a zero."""
    return _in_text("0", "O")


def _in_field(field: Field, change: Callable[[Random, str, Sound], str | None]) -> Maker:
    """A fault in one field of a block that has it."""

    def make(chance: Random, sound: Sound) -> Slip | None:
        row = chance.choice(sound.rows)
        found = sound.field(row, field)
        put = found and change(chance, found[1], sound)
        if not found or not put:
            return None
        return Slip(sound.with_text(found[0], put), frozenset({sound.line(row)}))

    return make


def _in_text(signs: str, put: str) -> Maker:
    """One of some characters of a block's text replaced."""

    def make(chance: Random, sound: Sound) -> Slip | None:
        row = chance.choice(sound.rows)
        first = int(sound.path.source.span[row, 0])
        text = sound.path.source.block_text(row)
        places = [first + at for at, each in enumerate(text) if each.upper() in signs]
        if not places:
            return None
        at = chance.choice(places)
        return Slip(sound.with_text((at, at + 1), put), frozenset({sound.line(row)}))

    return make


def _with_digit(chance: Random, word: str, how: str) -> str | None:
    """A word with one digit ``changed``, ``lost`` or ``doubled``; None where none would be left."""
    places = [at for at, each in enumerate(word) if each.isdigit()]
    if len(places) < (2 if how == "lost" else 1):
        return None
    at = chance.choice(places)
    other = chance.choice([each for each in "0123456789" if each != word[at]])
    put = {"changed": other, "lost": "", "doubled": word[at] * 2}[how]
    return f"{word[:at]}{put}{word[at + 1 :]}"


def _arcs(spelling: Spelling) -> tuple[str, str]:
    return spelling.clockwise, spelling.counter_clockwise


def _bare(word: str) -> str:
    """In capitals, without blanks, and without the zeros that ``G02`` may go without."""
    return re.sub(r"[\s0]", "", word).upper()


def block_lost(chance: Random, sound: Sound) -> Slip | None:
    """A cut left out; it shows at the block that takes its place, or at the one before."""
    return _without(sound, [sound.line(row) for row in sound.alone if not sound.path.is_jump[row]], chance)


def jump_lost(chance: Random, sound: Sound) -> Slip | None:
    """A jump left out, its pauses not."""
    return _without(sound, [sound.line(row) for row in sound.alone if sound.path.is_jump[row]], chance)


def block_doubled(chance: Random, sound: Sound) -> Slip | None:
    """A block that stands twice."""
    if not sound.alone:
        return None
    line = sound.line(chance.choice(sound.alone))
    return _with_line(sound, line, sound.line_text(line))


def swapped(chance: Random, sound: Sound) -> Slip | None:
    """Two neighbours of one figure in each other's place."""
    if not sound.neighbours:
        return None
    first, second = (sound.line(row) for row in chance.choice(sound.neighbours))
    span = sound.program.lines.bounds(first)[0], sound.program.lines.bounds(second)[1]
    between = sound.text[sound.program.lines.bounds(first)[1] : sound.program.lines.bounds(second)[0]]
    text = f"{sound.line_text(second)}{between}{sound.line_text(first)}"
    return Slip(sound.with_text(span, text), frozenset({first, second}))


def mark_lost(kind: str) -> Maker:
    """A pause, or the end, left out."""
    return lambda chance, sound: _without(sound, sound.stops(kind), chance)


def mark_early(kind: str) -> Maker:
    """A pause, or the end, before some block that is not the first."""

    def make(chance: Random, sound: Sound) -> Slip | None:
        if len(sound.alone) < 2:
            return None
        spelling = sound.program.reading.spelling
        line = sound.line(chance.choice(sound.alone[1:]))
        return _with_line(sound, line, {"pause": spelling.pause, "end": spelling.end}[kind])

    return make


def _without(sound: Sound, lines: list[int], chance: Random) -> Slip | None:
    """One of some lines left out."""
    if not lines:
        return None
    line = chance.choice(lines)
    return Slip(sound.with_text(sound.line_span(line), ""), frozenset({max(line - 1, 1), line}))


def _with_line(sound: Sound, line: int, text: str) -> Slip:
    """One more line before another one."""
    before: Span = (sound.line_span(line)[0],) * 2
    return Slip(sound.with_text(before, f"{text}{sound.line_end}"), frozenset({line, line + 1}))


Group = Literal["number", "axis", "quadrant", "sense", "side", "unreadable", "missing", "twice", "order", "mark"]
"""What is wrong, as people are asked for it."""
GROUPS: Final[tuple[Group, ...]] = get_args(Group)


class Kind(NamedTuple):
    """How a fault is made, and what people call it."""

    group: Group
    make: Maker


def groups_of(program: Program) -> tuple[Group, ...]:
    """What can be wrong in a program of its dialect."""
    lacks: set[Group] = set() if program.toolpath.compensation is not None else {"side"}
    if program.toolpath.words is None:
        lacks |= {"axis", "quadrant"}
    return tuple(group for group in GROUPS if group not in lacks)


_NUMBERS: Final = {"x": Field.X, "y": Field.Y, "count": Field.COUNT, "radius": Field.RADIUS}

KINDS: Final[Mapping[str, Kind]] = {
    **{
        f"{name}-digit-{how}": Kind("number", digit(field, how))
        for name, field in _NUMBERS.items()
        for how in ("changed", "lost", "doubled")
    },
    "centre-digit-changed": Kind("number", digit_of_centre()),
    **{f"{name}-sign": Kind("number", sign(_NUMBERS[name])) for name in "xy"},
    **{f"{name}-point": Kind("number", point(_NUMBERS[name])) for name in "xy"},
    "axis": Kind("axis", axis()),
    "quadrant": Kind("quadrant", quadrant()),
    "turn": Kind("sense", turned()),
    "bent": Kind("sense", bent()),
    "side": Kind("side", other_side()),
    "b-lost": Kind("unreadable", letter_lost("B")),
    "g-lost": Kind("unreadable", letter_lost("G")),
    "axis-lost": Kind("unreadable", letter_lost("XY")),
    "sense-lost": Kind("unreadable", letter_lost("LNSR")),
    "letter-o": Kind("unreadable", letter_for_digit()),
    "block-lost": Kind("missing", block_lost),
    "jump-lost": Kind("missing", jump_lost),
    "block-doubled": Kind("twice", block_doubled),
    "swapped": Kind("order", swapped),
    "pause-lost": Kind("mark", mark_lost("pause")),
    "end-lost": Kind("mark", mark_lost("end")),
    "pause-early": Kind("mark", mark_early("pause")),
    "end-early": Kind("mark", mark_early("end")),
}
"""Name of a kind -> it."""
