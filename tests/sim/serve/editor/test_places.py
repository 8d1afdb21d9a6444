"""Places as editors count them, held against what Python's own encodings say."""

import random

import pytest
from lsprotocol.types import Position

from parser.text.source import LineIndex
from sim.serve.editor.shown import Places

UNITS = {"utf-8": ("utf-8", 1), "utf-16": ("utf-16-le", 2), "utf-32": ("utf-32-le", 4)}
LETTERS = "B1G X电é😀\t\x0b\u2028"


def random_text(seed: int) -> str:
    rng = random.Random(seed)
    lines = ["".join(rng.choices(LETTERS, k=rng.randrange(9))) for _ in range(rng.randrange(1, 9))]
    return "".join(line + rng.choice(["\n", "\r\n", "\r"]) for line in lines) + rng.choice(["", "B1"])


def told_plainly(text: str, encoding: str, character: int) -> tuple[int, int]:
    """Line and unit of a character, by cutting the text before it at its line ends."""
    before = text[:character].replace("\r\n", "\n").replace("\r", "\n")
    if text[character - 1 : character + 1] == "\r\n":
        before = before[:-1]  # between the two the line has not ended yet
    line = before.rpartition("\n")[2]
    name, size = UNITS[encoding]
    return before.count("\n"), len(line.encode(name)) // size


@pytest.mark.parametrize("encoding", UNITS)
@pytest.mark.parametrize("seed", range(30))
def test_a_character_has_its_place_and_a_place_its_character(seed: int, encoding: str) -> None:
    text = random_text(seed)
    places = Places(LineIndex(text), encoding)
    for character in range(len(text) + 1):
        at = places.position(character)
        assert (at.line, at.character) == told_plainly(text, encoding, character)
        if text[character - 1 : character + 1] != "\r\n":
            assert places.character(at) == character


def test_places_beyond_the_text_are_its_ends() -> None:
    places = Places(LineIndex("B1\nB22\n"), "utf-16")
    assert [places.character(Position(line, 99)) for line in range(5)] == [2, 6, 7, 7, 7]
    assert places.whole.end == Position(2, 0)
    assert places.line_range(2).end == Position(1, 3)
    assert places.count == 3
