"""The tone of each pass over an edge, and what a legend says of it: the first has that of the kerf, trims their own."""

from collections.abc import Iterable
from typing import Final, NamedTuple

from parser.findings.catalogue import Said
from parser.shape.passes import Pass
from sim.show.draw.paints import Paint
from sim.show.words import said

TONES: Final = (Paint.KERF, Paint.TRIM_1, Paint.TRIM_2, Paint.TRIM_3, Paint.TRIM_4)
"""A rough cut and four trims; the passes after them have the last tone too."""


class Tone(NamedTuple):
    """A tone, and the passes that have it."""

    paint: Paint
    name: Said


def tone_number(number: int) -> int:
    """The first of the passes, by their numbers from 1, that have the tone of a pass."""
    return min(number, len(TONES))


def paint_of_pass(number: int) -> Paint:
    """Tone of a pass, by its number from 1."""
    return TONES[tone_number(number) - 1]


def tones_of(passes: Iterable[Pass]) -> list[Tone]:
    """Tones of some passes, each once."""
    numbers = {one.number for one in passes}
    later = max(numbers, default=0) > len(TONES)
    return [
        Tone(
            paint_of_pass(number),
            said("phrases.passes-from" if later and number == len(TONES) else "phrases.one-pass", number=number),
        )
        for number in sorted(set(map(tone_number, numbers)))
    ]
