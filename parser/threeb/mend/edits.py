"""Mends of single fields as 3B writes them: what a field says, what changes in the text, what people are told."""

from parser.dialect.mender import Mend
from parser.findings.findings import Edit
from parser.text.encoding import narrow
from parser.text.source import Field
from parser.toolpath import Axis, Toolpath

_LETTERS = {Field.X: "X ", Field.Y: "Y ", Field.COUNT: "J "}
"""What people call the numbers, which say nothing of their field themselves."""
_LETTERED = (Field.AXIS, Field.SENSE)
"""Fields of letters and one sign behind them, the axis or the quadrant."""


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


def told(mends: tuple[Mend, ...]) -> str:
    """Mends of one block for people, such as ``GX J 4000``."""
    return " ".join(_LETTERS.get(mend.field, "") + mend.text for mend in mends)
