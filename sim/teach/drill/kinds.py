"""Every kind of fault that a hand, a cable or a memory makes.

Faults of whole lines: blocks and marks that are missing, stand twice, or stand elsewhere.
"""

from collections.abc import Mapping
from random import Random
from typing import Final, Literal, NamedTuple, get_args

from parser.program import Program
from parser.text.source import Field, Span
from sim.teach.drill import words
from sim.teach.drill.sound import Slip, Sound
from sim.teach.drill.words import Maker


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
        f"{name}-digit-{how}": Kind("number", words.digit(field, how))
        for name, field in _NUMBERS.items()
        for how in ("changed", "lost", "doubled")
    },
    "centre-digit-changed": Kind("number", words.digit_of_centre()),
    **{f"{name}-sign": Kind("number", words.sign(_NUMBERS[name])) for name in "xy"},
    **{f"{name}-point": Kind("number", words.point(_NUMBERS[name])) for name in "xy"},
    "axis": Kind("axis", words.axis()),
    "quadrant": Kind("quadrant", words.quadrant()),
    "turn": Kind("sense", words.turned()),
    "bent": Kind("sense", words.bent()),
    "side": Kind("side", words.other_side()),
    "b-lost": Kind("unreadable", words.letter_lost("B")),
    "g-lost": Kind("unreadable", words.letter_lost("G")),
    "axis-lost": Kind("unreadable", words.letter_lost("XY")),
    "sense-lost": Kind("unreadable", words.letter_lost("LNSR")),
    "letter-o": Kind("unreadable", words.letter_for_digit()),
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
