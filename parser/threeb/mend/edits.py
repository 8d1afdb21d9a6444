"""Mends of single fields as 3B writes them: what a field says, what changes in the text, what people are told."""

from dataclasses import replace

import numpy as np

from parser.controller_words import Axis, StepWords
from parser.dialect.mender import Mend
from parser.findings.findings import Edit
from parser.step_words.words import label
from parser.text.encoding import narrow
from parser.text.source import Field
from parser.threeb.block_checks import ruled_label
from parser.threeb.decode import decoded_words
from parser.toolpath import Toolpath

_LETTERS = {Field.X: "X ", Field.Y: "Y ", Field.COUNT: "J "}
"""What people call the numbers, which say nothing of their field themselves."""
_LETTERED = (Field.AXIS, Field.SENSE)
"""Fields of letters and one sign behind them, the axis or the quadrant."""


def turned(toolpath: Toolpath, row: int) -> Mend:
    """The other sense, with the label that the trade writes for the same start (docs/3b.md §1)."""
    word = _word(toolpath, row)
    return Mend(Field.SENSE, _ruled(replace(word, turn=-word.turn)))


def label_slips(toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
    """Labels of another way, with one letter or the digit other than written, that the trade writes for that way."""
    word = _word(toolpath, row)
    turned = [replace(word, turn=-word.turn)] if word.turn[0] else []
    others = [*turned, *(replace(word, quadrant=np.array([digit])) for digit in (1, 2, 3, 4))]
    ruled = [_ruled(other) for other in others if _written(other) == _ruled(other)]
    return tuple(Mend(Field.SENSE, text) for text in ruled if text != _ruled(word))


def other_labels(toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
    """The seven other labels of the arc in a row."""
    word = _word(toolpath, row)
    texts = (label(turn, digit) for turn in (1, -1) for digit in (1, 2, 3, 4))
    return tuple(Mend(Field.SENSE, text) for text in texts if text != _written(word))


def _word(toolpath: Toolpath, row: int) -> StepWords:
    words = decoded_words(toolpath)
    return StepWords(**{name: getattr(words, name)[[row]] for name in StepWords.__slots__})


def _written(word: StepWords) -> str:
    return label(int(word.turn[0]), int(word.quadrant[0]))


def _ruled(word: StepWords) -> str:
    """The label that the trade writes for one block that goes so."""
    return label(int(word.turn[0]), int(ruled_label(word)[0]))


def counted_on(axis: Axis) -> Mend:
    """The count axis."""
    return Mend(Field.AXIS, f"G{axis.name}")


def counting(count_um: int) -> Mend:
    """The count length."""
    return Mend(Field.COUNT, str(count_um))


def edit(toolpath: Toolpath, row: int, mend: Mend) -> Edit:
    """The least change of the text: where the letters of a field stay, its last sign alone.

    Blanks between the two stay then, and small letters. ValueError where the block has no such field.
    """
    span = toolpath.source.field(row, mend.field)
    if span is None:
        raise ValueError(f"block {toolpath.source.block[row]} has no {mend.field}")
    low, high = span
    letters = "".join(narrow(toolpath.source.text[low : high - 1]).split()).upper()
    if mend.field in _LETTERED and letters == mend.text[:-1]:
        return Edit(high - 1, high, mend.text[-1])
    return Edit(low, high, mend.text)


def mends_text(mends: tuple[Mend, ...]) -> str:
    """Mends of one block for people, such as ``GX J 4000``."""
    return " ".join(_LETTERS.get(mend.field, "") + mend.text for mend in mends)
