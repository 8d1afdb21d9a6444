"""Faults of whole lines: blocks and marks that are missing, stand twice, or stand elsewhere."""

from random import Random

from parser.text.source import Span
from sim.drill.sound import Slip, Sound
from sim.drill.words import Maker


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
