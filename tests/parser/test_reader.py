"""The reader takes every spelling of the corpus, and nothing between the blocks is lost in silence."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import program_text, programs

from parser.findings.errors import ProgramError
from parser.program import Program, parse_program
from parser.threeb.reader import read_records

LINE_UP = (0, 24900, 24900, "Y", 2)


def words(text: str) -> list[tuple[int, int, int, str, str]]:
    blocks = read_records(text).blocks
    sense = {0: "L", 1: "NR", -1: "SR"}
    return [
        (x, y, j, "XY"[axis], f"{sense[turn]}{quadrant}")
        for x, y, j, axis, turn, quadrant in zip(
            *(column.tolist() for column in (blocks.x_um, blocks.y_um, blocks.count_um, blocks.count_axis)),
            blocks.turn.tolist(),
            blocks.quadrant.tolist(),
            strict=True,
        )
    ]


@pytest.mark.parametrize(
    "text",
    [
        "B0B24900B24900GYL2",
        "B 0 B 24900 B 24900 GY L2",
        "N1: B0 B24900 B24900 GYL2;0.000,24.900//remark",
        "N1 B0 B24900 B24900 GYL2",
        "N  1: B       0 B   24900 B   24900 GY  L2 ;        0.000 ,       24.900",
        "B B24900 B24900 GY L2",
        "b0b24900b24900gyl2",
        "B 0 B 024900 B 00024900 Gy L2",
        "B\t0\tB\t24900\tB\t24900\tG\tY\tL\t2",
        "Ｂ０　Ｂ２４９００　Ｂ２４９００　ＧＹ　Ｌ２",
        "// B1B1B1GXL1\r\nB0B24900B24900GYL2 (B2B2B2GXL1) ; remark with B 12 and D and DD",
    ],
)
def test_one_block_in_any_spelling(text: str) -> None:
    assert words(text) == [(*LINE_UP[:4], "L2")]
    assert read_records(text).findings == ()


def test_glued_blocks_without_separator() -> None:
    assert words("B9900B0B9900GXL1B9900B0B39600GYNR1B9900B0B9900GXL3") == [
        (9900, 0, 9900, "X", "L1"),
        (9900, 0, 39600, "Y", "NR1"),
        (9900, 0, 9900, "X", "L3"),
    ]


def test_several_blocks_a_line_glued_and_spaced() -> None:
    text = "B 9900B 0B 9900 GX L3 B 0B 70100B 70100 GY L2\nB 1 B 2 B 3 GY NR1B 54900B 0B 54900 GX L1"
    assert len(words(text)) == 4
    assert read_records(text).blocks.line.tolist() == [1, 1, 2, 2]


def test_labels_text_lines_and_printed_ends() -> None:
    text = "N1: B0 B24900 B24900 GYL2;0.000,24.900//向上\r\nN12:B1 B0 B7 GX L1 ; -1.5 , 2\rDD"
    blocks = read_records(text).blocks
    assert blocks.label == ("N1", "N12")
    assert blocks.line.tolist() == [1, 2]
    assert blocks.printed_um.tolist() == [[0.0, 24900.0], [-1500.0, 2000.0]]
    assert [text[low:high] for low, high in blocks.span.tolist()] == ["B0 B24900 B24900 GYL2", "B1 B0 B7 GX L1"]
    assert [(mark.kind, mark.line) for mark in read_records(text).marks] == [("end", 3)]


@pytest.mark.parametrize(
    ("text", "marks"),
    [
        ("B1B0B1GXL1 DD", ["end"]),
        ("B1B0B1GXL1DD", ["end"]),
        ("B1B0B1GXL1\nN2: DD//done", ["end"]),
        ("B1B0B1GXL1\nd\nB1B0B1GXL1\nD\ndd", ["pause", "pause", "end"]),
        ("Start Point = 1.5 , -2 ; Length = 3\nB1B0B1GXL1", ["node"]),
        ("CAXAWEDM -Version 2.0 , Name : ADD D DD.3B\n****D****\nB1B0B1GXL1", []),
    ],
)
def test_marks_are_tokens_not_letters(text: str, marks: list[str]) -> None:
    records = read_records(text)
    assert [mark.kind for mark in records.marks] == marks
    assert records.findings == ()


@pytest.mark.parametrize("mark", ["N7DD", "7DD", "7 DD", "N7 DD", "7:DD", "7DD//off", "N7D\n8 DD", "7 D\n8DD"])
def test_marks_with_any_label_are_marks(mark: str) -> None:
    records = read_records(f"B1B0B1GXL1\n{mark}\n")
    assert [m.kind for m in records.marks][-1] == "end"
    assert records.findings == ()


@pytest.mark.parametrize("node", ["start point : 1 , 2", "Start Point =( 1.0 , 2.0 )", "Start Point = 1., 2."])
def test_start_points_in_any_spelling(node: str) -> None:
    assert parse_program(f"{node}\nB1B0B1GXL1\nDD").toolpath.start_um.tolist() == [[1000.0, 2000.0]]


@pytest.mark.parametrize("words", [" mm", "mm", " end", " mm // 1", " end of B"])
def test_words_behind_a_printed_end_are_a_remark(words: str) -> None:
    records = read_records(f"B1B0B1GXL1;0.001,0.000{words}\nB1B0B1GXL3;0,0 DD")
    assert records.findings == ()
    assert (len(records.blocks.line), [mark.kind for mark in records.marks]) == (2, ["end"])


def test_printed_ends_may_leave_out_the_zero() -> None:
    assert read_records("B1B0B1GXL1;.001,-.000").blocks.printed_um.tolist() == [[1.0, 0.0]]


@pytest.mark.parametrize(
    "text", ["Bottom plate", "BOB's part B12", "Name : B12", "LED holder G2", "PART 17 by Li\r\nTHICKNESS 40", "BOB"]
)
def test_plain_text_before_the_first_block_is_header(text: str) -> None:
    assert read_records(f"{text}\nB1B0B1GXL1").findings == ()


@pytest.mark.parametrize("text", ["DD\n", "part D\n", "PART-D DD\n", "3D model\n", "Name : DD.3B\n", "Name : B12\n"])
def test_marks_in_a_header_are_words(text: str) -> None:
    program = parse_program(f"{text}B1B0B1GXL1\nDD")
    assert program.findings == ()
    assert [(stop.kind, stop.after) for stop in program.toolpath.stops] == [("end", 1)]


def test_marks_glued_to_blocks_on_both_sides() -> None:
    toolpath = parse_program("B1B0B1GXL1DB1B0B1GXL1DD").toolpath
    assert [(stop.kind, stop.after) for stop in toolpath.stops] == [("pause", 1), ("end", 2)]


@pytest.mark.parametrize(
    "text",
    ["B1B0B1GXL1;B1B0B1GXL1", "Length= 4 B1B0B1GXL1\nB1B0B1GXL1", "Start Point = 1.0,2.0 B1B0B1GXL1\nB1B0B1GXL1"],
)
def test_a_block_is_not_lost_in_a_remark(text: str) -> None:
    records = read_records(text)
    assert [finding.code for finding in records.findings] == ["3B104"]
    assert len(records.blocks.line) == 1


def test_what_follows_the_end_is_not_judged() -> None:
    program = parse_program("B1B0B1GXL1\nDD\nsome note\nD\nB1B0B1000000000000GXL1\nDD")
    assert [(finding.code, finding.line) for finding in program.findings] == [("3B103", 5)]
    assert [stop.kind for stop in program.toolpath.stops] == ["end"]


def test_caxa_header_is_no_finding() -> None:
    text = (
        "****************************************\nCAXAWEDM -Version 2.0 , Name : part.3B\n"
        "Conner R= 0.00000 , Offset F= 0.10000 ,Length= 10.0 mm\n****************************************\n"
        "Start Point = 0.00000 , 0.00000 ; X , Y\nN 1: B 10000 B 0 B 10000 GX L1 ; 10.000 , 0.000\nDD\n"
    )
    program = parse_program(text)
    assert program.findings == ()
    assert program.toolpath.end_um.tolist() == [[10000.0, 0.0]]


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("B1B0B1GXL1\n  what is this\nDD", 2, 3),
        ("B1B0B1GXL1\nBottom plate\nDD", 2, 1),
    ],
)
def test_unreadable_text_is_named_with_its_place(text: str, line: int, column: int) -> None:
    findings = read_records(text).findings
    assert [(f.code, f.line, f.column) for f in findings] == [("3B101", line, column)]


@pytest.mark.parametrize(
    ("text", "line", "column", "field", "found"),
    [
        ("B1B0B1GXL1\nN2: B 10 B 0 B 10 GX L5\nDD", 2, 22, "field-sense", "L5"),
        ("B1B0B1GXL12\nB1B0B1GXL1", 1, 9, "field-sense", "L12"),
        ("B1B0B1GX\nB1B0B1GXL1", 1, 9, "field-sense", "nothing"),
        ("B1B0B1GZL1\nB1B0B1GXL1", 1, 7, "field-axis", "GZ"),
        ("B1B0B1L1\nB1B0B1GXL1", 1, 7, "field-axis", "nothing"),
        ("B-1B0B1GXL1\nB1B0B1GXL1", 1, 2, "field-x", "-1"),
        ("B1B24 900B1GXL1\nB1B0B1GXL1", 1, 4, "field-y", "24 900"),
        ("B1B0B1.5GXL1\nB1B0B1GXL1", 1, 6, "field-count", "1.5"),
        ("B1B0GXL1\nB1B0B1GXL1", 1, 5, "field-b", "GXL1"),
        ("B5 B1B0B1GXL1", 1, 4, "field-b", "nothing"),
        ("B1B0B1GXL1\nGYL2", 2, 1, "field-b", "GYL2"),
        ("BOBOB9900GXL1\nB1B0B1GXL1", 1, 2, "field-x", "O"),
        ("N1: 0 24900 24900 GYL2\nB1B0B1GXL1", 1, 1, "field-b", "N1: 0 24900 24900 GYL2"),
        ("GYL2\nB1B0B1GXL1", 1, 1, "field-b", "GYL2"),
        ("9900GXL1\nB1B0B1GXL1", 1, 1, "field-b", "9900GXL1"),
        ("PART 17 by Li\nTHICKNESS 40\nB0B1x0B10GYL2\nB1B0B1GXL1", 3, 4, "field-y", "1x0"),
    ],
)
def test_a_damaged_block_is_named_by_its_first_wrong_field(
    text: str, line: int, column: int, field: str, found: str
) -> None:
    records = read_records(text)
    (finding,) = records.findings
    assert (finding.code, finding.line, finding.column) == ("3B106", line, column)
    assert (finding.values["field"], finding.values["found"]) == (field, found)
    assert len(records.blocks.line) == 1


def test_reading_goes_on_behind_a_damaged_block_in_the_same_line() -> None:
    records = read_records("B1B0B1GXL1 B1B2B3 B4B5B6GXL1 B7B8GXL1 B9B0B9GXL1 DD")
    assert records.blocks.x_um.tolist() == [1, 4, 9]
    assert [damage.after for damage in records.damages] == [1, 2]


@pytest.mark.parametrize("digits", ["1000000000", "1000000000000000", "9" * 5000, "0" * 5000 + "1" * 11])
def test_numbers_beyond_any_table_are_a_finding(digits: str) -> None:
    findings = read_records(f"B0B0B{digits}GXL1").findings
    assert [f.code for f in findings] == ["3B206"]


@pytest.mark.parametrize("mark", ["", "D\n"])
def test_start_points_beyond_any_table_are_a_finding(mark: str) -> None:
    program = parse_program(f"{mark}Start Point = 99999999999 , 0\nB1B0B1GXL1\nStart Point = 0 , -{'9' * 400}\nDD")
    assert [finding.code for finding in program.findings if finding.code == "3B206"] == ["3B206", "3B206"]


@pytest.mark.parametrize("km", [1, 2, 9])
def test_a_part_kilometres_from_0_is_the_part_at_0(km: int) -> None:
    def square(at: float) -> Program:
        ends = [(at + 10, 0), (at + 10, 10), (at, 10), (at, 0)]
        blocks = ("B10000B0B10000GXL1", "B0B10000B10000GYL2", "B10000B0B10000GXL3", "B0B10000B10000GYL4")
        printed = "".join(f"{block} ; {x:.3f}, {y:.3f}\n" for block, (x, y) in zip(blocks, ends, strict=True))
        return parse_program(f"Start Point = {at:.5f}, 0.00000 ; X,Y\n{printed}DD\n")

    far, near = square(km * 1e6), square(0)
    assert far.findings == near.findings == ()
    assert np.array_equal(far.toolpath.end_um - near.toolpath.end_um, np.tile([km * 1e9, 0.0], (4, 1)))
    assert np.array_equal(far.toolpath.printed_end_um, far.toolpath.end_um)


def test_leading_zeros_do_not_make_a_number_large() -> None:
    assert words("B" + "0" * 5000 + "B0B" + "0" * 5000 + "7GXL1") == [(0, 0, 7, "X", "L1")]


@pytest.mark.parametrize(
    "text", ["B" + " " * 200_000 + "x", "B" * 200_000, "B1" * 100_000, "(" * 200_000, "N" * 200_000]
)
def test_hostile_runs_are_read_in_bounded_time(text: str) -> None:
    with pytest.raises(ProgramError, match="no block"):
        parse_program(text)


@given(programs, st.sampled_from(["\n", "\r\n", "\r", " ", "", "\t", "\n\n"]))
def test_what_is_written_is_read(program: list, separator: str) -> None:
    text = separator.join(block.text() for block in program)
    assert words(text) == [(b.x, b.y, b.count, b.axis, f"{b.sense}{b.quadrant}") for b in program]
    assert read_records(text).findings == ()


@given(programs)
def test_every_block_knows_its_text(program: list) -> None:
    toolpath = parse_program(program_text(program)).toolpath
    assert [block.text for block in toolpath] == [block.text() for block in program]
    assert np.array_equal(toolpath.source.line, np.arange(1, len(program) + 1))


@pytest.mark.parametrize("mark", ["N7DD", "N7: DD", "7:DD", "7DD", "7 DD", "N 7 DD"])
def test_a_mark_may_carry_any_label(mark: str) -> None:
    program = parse_program(f"B1B0B1GXL1\n{mark}\n")
    assert program.findings == ()
    assert [stop.kind for stop in program.toolpath.stops] == ["end"]


@pytest.mark.parametrize("printed", [";0.000,1.000 mm", ";.000,1.000", ";0,1 end //x", "; 0.0 , 1.0"])
def test_a_printed_end_in_any_spelling(printed: str) -> None:
    program = parse_program(f"B0B1000B1000GYL2{printed}\nDD")
    assert program.findings == ()
    assert program.toolpath.printed_end_um.tolist() == [[0.0, 1000.0]]


def test_an_arc_without_radius_does_not_move() -> None:
    toolpath = parse_program("B1B0B100000GXNR1\nB0B100B100GYL2 DD").toolpath
    assert toolpath.end_um.tolist() == [[0.0, 0.0], [0.0, 100.0]]


def test_more_blocks_than_are_read_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("parser.threeb.reader.MOST_BLOCKS", 4)
    assert read_records("B9B0B9GXL1\n" * 4).blocks.x_um.tolist() == [9] * 4
    with pytest.raises(ProgramError) as caught:
        read_records("B9B0B9GXL1\n" * 5)
    assert caught.value.finding.values == {"what": "too-many-blocks", "detail": "4", "hint": "hint-split"}


@pytest.mark.parametrize("at_once", [1, 2, 3])
def test_blocks_are_the_same_however_many_are_read_at_once(monkeypatch: pytest.MonkeyPatch, at_once: int) -> None:
    text = "N1:B9B0B9GXL1\nD\n2:B0B9B9GYL2;1.000,2.000\nB9B5B9B10GDDXNR1\nDD\n"
    whole = read_records(text)
    monkeypatch.setattr("parser.threeb.reader._BLOCKS_AT_ONCE", at_once)
    parted = read_records(text)
    assert parted.marks == whole.marks
    for column, same in zip(parted.blocks, whole.blocks, strict=True):
        np.testing.assert_array_equal(column, same)
