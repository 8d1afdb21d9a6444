"""Round trips: toolpaths written in any spelling are read back as they were; any text and any bytes lose nothing."""

from typing import NamedTuple

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from plain import PlainBlock
from sound_cam import plain_end
from strategies import arcs, lines

from parser.findings.errors import ProgramError
from parser.program import Program, load_program
from parser.text.encoding import decode_text, encode_text
from parser.threeb.tokens import tokens

WIDE = {code: code + 0xFEE0 for code in range(0x21, 0x7F)} | {0x20: 0x3000}
REMARKS = ("", "", "//切割轮廓", "; 引入线，注意装夹", " (第一次)", "//B1B1B1GXL1", "; D DD", "//")
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16-le", "utf-16-be", "gb18030")


class Plan(NamedTuple):
    """Blocks with the marks that stand before some of them; 4B where each has a radius."""

    blocks: list[PlainBlock]
    pauses: set[int]
    has_end: bool
    is_4b: bool
    labels: str
    prints_ends: bool


class Spelling(NamedTuple):
    """How one program is written."""

    case: int
    gap: str
    zeros: int
    omits_zeros: bool
    is_wide: bool
    newline: str
    encoding: str
    header: bool
    mark_first: bool


plans = st.builds(
    Plan,
    st.lists(st.one_of(lines(), arcs(1)), min_size=1, max_size=8),
    st.sets(st.integers(1, 7), max_size=2),
    st.booleans(),
    st.booleans(),
    st.sampled_from(["", "N{}:", "N{} ", "n {} : ", "{}: ", "{} "]),
    st.booleans(),
)
spellings = st.builds(
    Spelling,
    st.integers(0, 2),
    st.sampled_from(["", " ", "\t", " \t ", "\u3000"]),
    st.integers(0, 3),
    st.booleans(),
    st.booleans(),
    st.sampled_from(["\n", "\r\n", "\r", "\n\n"]),
    st.sampled_from(ENCODINGS),
    st.booleans(),
    st.booleans(),
)


def written(plan: Plan, how: Spelling, remarks: list[str]) -> str:
    rows = ["CAXAWEDM -Version 2.0 , Name : 零件 D.3B", "Conner R= 0.0 , Offset F= 0.1 , ****"] if how.header else []
    at = np.zeros(2)
    for number, block in enumerate(plan.blocks):
        if number in plan.pauses:
            rows.append("D")
        at += plain_end(block)
        code = spelt(block, how, plan.is_4b)
        printed = f";{at[0] / 1000:.3f},{at[1] / 1000:.3f}" if plan.prints_ends else ""
        rows.append(plan.labels.format(number + 1) + code + printed + remarks[number % len(remarks)])
    return how.newline.join([*rows, *(["dd" if how.case == 1 else "DD"] if plan.has_end else [])])


def spelt(block: PlainBlock, how: Spelling, is_4b: bool) -> str:
    numbers = ["" if how.omits_zeros and n == 0 else "0" * how.zeros + str(n) for n in (block.x, block.y, block.count)]
    axis = ["G", block.axis]
    if is_4b:
        numbers.append(str(radius(block)) if block.sense != "L" else "" if how.omits_zeros else "0")
        axis = [] if block.sense == "L" else ["D"] if curve(block) == 1 else ["DD"]
        axis = [*axis, "G", block.axis] if how.mark_first else ["G", block.axis, *axis]
    text = how.gap.join([*(word for n in numbers for word in ("B", n)), *axis, *block.sense, str(block.quadrant)])
    text = (text, text.lower(), "".join(c.lower() if k % 2 else c for k, c in enumerate(text)))[how.case]
    return text.translate(WIDE) if how.is_wide else text


def radius(block: PlainBlock) -> int:
    return round((block.x**2 + block.y**2) ** 0.5)


def curve(block: PlainBlock) -> int:
    return 0 if block.sense == "L" else 1 if block.quadrant < 3 else 2


def read_words(program: Program) -> list[PlainBlock]:
    of = program.toolpath.words
    columns = zip(of.x_um, of.y_um, of.count_um, of.count_axis, of.turn, of.quadrant, strict=True)
    senses = {0: "L", 1: "NR", -1: "SR"}
    return [PlainBlock(int(x), int(y), int(j), "XY"[g], senses[int(t)], int(q)) for x, y, j, g, t, q in columns]


@given(plans, spellings, st.lists(st.sampled_from(REMARKS), min_size=1, max_size=4))
def test_a_toolpath_in_any_spelling_is_read_back(plan: Plan, how: Spelling, remarks: list[str]) -> None:
    program = load_program(encode_text(written(plan, how, remarks), how.encoding), "part.3b")
    toolpath, of = program.toolpath, program.toolpath.words
    assert program.reading.damages == ()
    assert not {finding.code for finding in program.findings} & {"3B100", "3B101", "3B104", "3B105", "3B106", "3B207"}
    assert read_words(program) == plan.blocks
    assert program.reading.dialect == ("4B" if plan.is_4b else "3B")
    if plan.is_4b:
        is_line = [block.sense == "L" for block in plan.blocks]
        assert of.radius_um.tolist() == [0 if line else radius(b) for line, b in zip(is_line, plan.blocks, strict=True)]
        assert of.curve.tolist() == [curve(block) for block in plan.blocks]
    pauses = sorted(at for at in plan.pauses if at < len(plan.blocks))
    ends = [("end", len(plan.blocks))] if plan.has_end else []
    assert [(stop.kind, stop.after) for stop in toolpath.stops] == [*(("pause", at) for at in pauses), *ends]
    expected = np.cumsum([plain_end(block) for block in plan.blocks], axis=0)
    assert np.abs(toolpath.end_um - expected).max() < 1e-4  # the plain walk loses digits near an extreme
    if plan.labels:
        assert [label.upper() for label in toolpath.source.label] == [f"N{k + 1}" for k in range(len(plan.blocks))]


@given(plans, spellings, spellings)
def test_two_spellings_are_one_toolpath(plan: Plan, one: Spelling, other: Spelling) -> None:
    first, second = (
        load_program(encode_text(written(plan, how, [""]), how.encoding), "a").toolpath for how in (one, other)
    )
    for column in ("kind", "start_um", "end_um", "center_um", "radius_um", "sweep_rad", "length_um"):
        assert np.array_equal(getattr(first, column), getattr(second, column), equal_nan=True), column


PIECES = st.one_of(
    st.sampled_from(
        ["B", "B1", "B20", "GX", "GY", "L1", "NR2", "SR", " ", "\t", "\n", "\r", "\r\n", "D", "DD", "N1:", ";"]
    ),
    st.sampled_from(["//", "(", ")", "1.5,2", "Start Point = 1 , 2", "CAXA", "Ｂ", "　", "切", "\u2028", "B1B0B1GXL1"]),
    st.text(max_size=3),
)


@given(st.lists(PIECES, max_size=40).map("".join))
def test_tokens_are_the_text(text: str) -> None:
    found = tokens(text)
    assert "".join(token.text for token in found) == text
    assert [token.first for token in found] == [0, *(token.past for token in found[:-1])][: len(found)]
    for token in found:
        assert token.text == text[token.first : token.past]
        assert (token.line, token.column) == place(text, token.first)


def place(text: str, at: int) -> tuple[int, int]:
    """Line and column of a character; lines end with LF, CRLF or CR."""
    line, column = 1, 1
    for k in range(at):
        ends = text[k] == "\n" or (text[k] == "\r" and text[k + 1 : k + 2] != "\n")
        line, column = (line + 1, 1) if ends else (line, column + 1)
    return line, column


CHINESE = "切割加工輪廓零件，。B1B0B1GXL1\r\n"
ANY_BYTES = st.one_of(
    st.binary(max_size=80),
    st.lists(
        st.sampled_from([b"B1B0B1GXL1", b"\xff", b"\xfe", b"\xef\xbb\xbf", b"\xa1", b"\x40", b"\xd6\xd0", b"\n"])
    ).map(b"".join),
    st.builds(
        lambda text, encoding, more: text.encode(encoding, "ignore") + more,
        st.text(st.sampled_from(CHINESE), max_size=20),
        st.sampled_from(["gbk", "big5", "utf-8", "utf-16", "utf-8-sig", "utf-16-be"]),
        st.binary(max_size=2),
    ),
)


@given(ANY_BYTES)
def test_bytes_that_load_come_back(data: bytes) -> None:
    try:
        text, encoding = decode_text(data)
    except ProgramError:
        return
    assert encode_text(text, encoding) == data
