"""Where the words of an ISO block stand that findings of the path point at."""

import pytest

from parser.iso.path.rows import fields_of
from parser.text.source import Field


@pytest.mark.parametrize(
    ("block", "field", "word"),
    [
        ("N10 G41 D11 G01 X200 Y-.5", Field.SIDE, "G41"),
        ("N10 G41 D11 G01 X200 Y-.5", Field.REGISTER, "D11"),
        ("N10 G41 D11 G01 X200 Y-.5", Field.Y, "Y-.5"),
        ("g042 h 001 x+3", Field.SIDE, "g042"),
        ("g042 h 001 x+3", Field.REGISTER, "h 001"),
        ("G02 X1 I2 (G03 D5)", Field.SENSE, "G02"),
        ("G20 G41.1 X1", Field.SIDE, None),
        ("G20 X1 ; G41 D1", Field.SIDE, None),
        ("G01 X1 (G41", Field.SIDE, None),
        ("", Field.X, None),
    ],
)
def test_words_stand_where_they_are_written(block: str, field: Field, word: str | None) -> None:
    found = fields_of(block).get(field)
    assert (found and block[slice(*found)]) == word
