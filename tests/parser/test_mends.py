"""A mend changes as little of the text as it can, and people see which field it means."""

import pytest

from parser.controller_words import Axis
from parser.dialect.mender import Mend
from parser.program import parse_program
from parser.text.source import Field
from parser.threeb.mend import MENDER


@pytest.mark.parametrize(
    ("block", "mend", "mended"),
    [
        ("B900B0B800 g x l 1", MENDER.counted_on(Axis.Y), "B900B0B800 g Y l 1"),
        ("B900B0B800GXL1", MENDER.counting(900), "B900B0B900GXL1"),
        ("B900B0BGXL1", MENDER.counting(900), "B900B0B900GXL1"),
        ("B0B900B900GX n r1", Mend(Field.SENSE, "NR4"), "B0B900B900GX n r4"),
        ("B0B900B900GX\uff2e\uff32\uff11", Mend(Field.SENSE, "NR4"), "B0B900B900GX\uff2e\uff324"),
        ("B900B0B900GXNR1", Mend(Field.SENSE, "L2"), "B900B0B900GXL2"),
        ("B900B0B900GXL1", Mend(Field.Y, "7"), "B900B7B900GXL1"),
    ],
)
def test_an_edit_keeps_what_stays(block: str, mend: Mend, mended: str) -> None:
    text = f"B5B0B5GXL1\n{block}\nDD"
    edit = MENDER.edit(parse_program(text).toolpath, 1, mend)
    assert text[: edit.first] + edit.text + text[edit.past :] == f"B5B0B5GXL1\n{mended}\nDD"


def test_a_field_that_a_block_has_not_cannot_be_edited() -> None:
    with pytest.raises(ValueError, match="block 1 has no radius"):
        MENDER.edit(parse_program("B5B0B5GXL1 DD").toolpath, 0, Mend(Field.RADIUS, "5"))


def test_people_see_which_field_is_meant() -> None:
    assert MENDER.mends_text((MENDER.counted_on(Axis.X), MENDER.counting(4000))) == "GX J 4000"
    assert MENDER.mends_text((Mend(Field.X, "1"),)) == "X 1"
    assert MENDER.mends_text((Mend(Field.SENSE, "L1"),)) == "L1"
