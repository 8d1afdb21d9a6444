"""Lines of one block alone are read as arrays: what comes out must be what the pattern reads."""

import random

import numpy as np
import pytest
from cam_programs import sound_program

from parser.dialect.reader import Marks
from parser.findings.errors import ProgramError
from parser.program import parse_program
from parser.text.source import LineIndex
from parser.threeb import reader
from parser.threeb.columns import RawBlocks, plain_lines
from parser.threeb.reader import Records, read_records

NO_LINES = plain_lines(LineIndex("(").codes)
PIECES = [
    *"BGXYLNSR0123 \t\n\r;:/(),.-DEFMJbgxlnrs",
    *("\r\n", "DD\n", "D\n", "N12:", "7 ", "(x)", "// a\n", "; 1.0, 2.0", "Start Point = 1.0, 2.0\n", "4294967296"),
    *("0", "\0", "\x0b", "\x85", "*\n", "B1B2B3 ", "B3B0B6GYNR1\n", "b3 b0\tb6 g y s r 2 \n", "B1B2B3B4GXL1\n"),
]


def text_of(rng: random.Random) -> str:
    """A sound program, or pieces of programs in any order, with pieces put in place of others."""
    if rng.random() < 0.5:
        text = sound_program(rng, printed=rng.random() < 0.2).text
    else:
        text = "".join(rng.choice(PIECES) for _ in range(rng.randrange(5, 80)))
    for _ in range(rng.choice((0, 1, 2, 5, 20))):
        at = rng.randrange(len(text) + 1)
        text = text[:at] + rng.choice(PIECES) + text[at + rng.choice((0, 0, 1, 3)) :]
    return text


def differing(one: Records, other: Records) -> list[str]:
    """What two readings of a text do not say alike."""
    columns = [
        name
        for name in RawBlocks._fields
        if not np.array_equal(getattr(one.blocks, name), getattr(other.blocks, name), equal_nan=name == "printed_um")
    ]
    said = [name for name in ("marks", "header", "damages", "findings") if getattr(one, name) != getattr(other, name)]
    said += ["remarks"] * (one.remarks.tolist() != other.remarks.tolist())
    return columns + said


def test_plain_lines_are_read_as_the_pattern_reads_them(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = random.Random(18)
    plain = 0
    for _ in range(250):
        text = text_of(rng)
        marks = rng.choice((Marks(end=("DD",), pause=("D",)), Marks(end=("STOP",), pause=("M00",))))
        by_lines = read_records(text, marks)
        with monkeypatch.context() as patched:
            patched.setattr(reader, "plain_lines", lambda codes: NO_LINES)
            by_pattern = read_records(text, marks)
        assert differing(by_lines, by_pattern) == [], text
        plain += len(plain_lines(by_lines.lines.codes).span)
    assert plain > 1000


def test_lines_with_more_than_a_block_are_left_to_the_pattern() -> None:
    plain, others = "B1 B2\tB 3 GX L1", ("N1:B1B2B3GXL1", "B1B2B3GXL5", "B1B2B3GXL12", "B1 2B2B3GXL1", "BB2B3GXL1")
    other_ends = ("B1B2B3GXL1;", "B1B2B3GXL1 D", "B1B2B3B4GXL1", "B1B2B3GXNL1", "B1B2B3GXSR1 B", "B1234567890B2B3GXL1")
    text = "\n".join([plain, *others, "  b4b5b6gySR4", *other_ends])
    read = plain_lines(LineIndex(text).codes)
    assert read.x_um.tolist() == [1, 4]
    assert read.count_um.tolist() == [3, 6]
    assert read.count_axis.tolist() == [0, 1]
    assert read.turn.tolist() == [0, -1]
    assert read.quadrant.tolist() == [1, 4]
    assert [text[first:past] for first, past in read.span.tolist()] == [plain, "b4b5b6gySR4"]


def test_a_text_is_cut_at_line_ends_alone() -> None:
    block = "B123456789B0B123456789GXL1"
    text = "\r\n".join([block] * 12_000 + ["(" + "x" * 300_000 + block] + [block] * 12_000)
    read = plain_lines(LineIndex(text).codes)
    assert len(read.span) == 24_000
    assert set(read.x_um.tolist()) == {123_456_789}
    assert {text[first:past] for first, past in read.span.tolist()} == {block}


def test_an_empty_text_has_no_program() -> None:
    with pytest.raises(ProgramError, match="no block"):
        parse_program("", "part.3b")
