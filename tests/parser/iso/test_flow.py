"""The order in which blocks run: calls, returns, ends, and what cannot be followed or never runs."""

import tracemalloc

import pytest

from parser.findings.findings import edited
from parser.iso.path import flow
from parser.program import parse_program
from parser.toolpath import Stop
from tests.tools.iso_reading import findings, path, read


def lines(text: str) -> list[int]:
    """Lines of the blocks that move, as they run."""
    return path("G91 G92 X0 Y0\n" + text).source.line.tolist()


def nested(depth: int) -> str:
    """Subprograms of which each calls the next one, the deepest one moves."""
    subprograms = [f"N{one} M98 P{one + 1}\nM99" for one in range(1, depth)]
    return "\n".join(["G91 G01", "M98 P1", "M02", *subprograms, f"N{depth} G01 X1", "M99"])


def test_a_program_runs_to_its_end_code_and_no_further() -> None:
    assert lines("G01 X1\nX2\nM30\nX3") == [2, 3]


def test_the_tape_ends_at_its_mark() -> None:
    assert path("%\nG91 G01 X1\n%\nX2").source.line.tolist() == [2]


def test_a_call_runs_its_subprogram_and_comes_back() -> None:
    assert lines("G01 X1\nM98 P0007\nX2\nM02\nN0007\nX3\nX4\nM99") == [2, 7, 8, 4]


def test_a_repeated_call_runs_as_often_as_it_says() -> None:
    assert lines("G01\nM98 P7 L3\nX2\nM02\nN7 X3\nM99") == [6, 6, 6, 4]


def test_subprograms_call_each_other() -> None:
    assert lines("G01\nM98 P1\nM02\nN1 X1\nM98 P2\nX2\nM99\nN2 X3\nM99") == [5, 9, 7]


def test_a_label_behind_the_end_counts_before_a_block_number_of_the_same_value() -> None:
    assert lines("N1 G01 X1\nN2 X2\nM98 P1\nM02\nN1 X3\nM99") == [2, 3, 6]


def test_a_program_number_is_a_label_too() -> None:
    assert lines("G01 X1\nM98 P0012\nM02\nO0012\nX5\nM99") == [2, 6]


def test_motion_and_return_in_one_block_are_both_done() -> None:
    assert lines("G01\nM98 P1\nX1\nM02\nN1 X2 M99\nX9") == [6, 4]


def test_an_end_in_a_subprogram_ends_the_program() -> None:
    assert lines("G01 X1\nM98 P1 L5\nX2\nM30\nN1 X3\nM02") == [2, 6]


def test_stops_count_the_rows_before_them_once_a_call() -> None:
    stops = path("G91 G92 X0 Y0\nG01\nM98 P1 L2\nM02\nN1 X1 M00\nM99").stops
    assert stops == (Stop("pause", 1, 5), Stop("pause", 2, 5), Stop("end", 2, 4))


def test_calls_may_be_nested_ten_deep_and_no_deeper() -> None:
    assert not findings(nested(10), "ISO400")
    assert len(path(nested(10))) == 1
    assert [one.values["what"] for one in findings(nested(11), "ISO400")] == ["call-too-deep"]


def test_a_subprogram_known_from_shallow_calls_is_too_deep_in_deep_ones() -> None:
    text = nested(10).replace("M02", "M98 P99\nM02") + "\nN99 M98 P1\nM99"
    assert [(one.line, one.values["what"]) for one in findings(text, "ISO400")] == [(25, "call-too-deep")]
    assert len(path(text)) == 1


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("M98 P9\nM02", "call-without-label"),
        ("M98\nM02", "call-without-number"),
        ("M98 P1\nM02\nN1 M98 P1\nM99", "call-recursive"),
        ("M98 P1\nM02\nN1 M98 P2\nM99\nN2 M98 P1\nM99", "call-recursive"),
        ("M98 P1\nM02\nN1 G91 G01 X1", "call-without-return"),
        ("G91 G01 X1\nM98 P1 L999\nM02\nN1 X1\nX-1\nM99", "call-too-long"),
    ],
)
def test_calls_that_cannot_be_followed_are_told_and_leave_the_path_in_doubt(
    text: str, what: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(flow, "LONGEST", 1000)
    program = read(text)
    assert [one.values["what"] for one in program.findings if one.code == "ISO400"] == [what]
    assert program.reading.damages
    assert len(program.toolpath) <= flow.LONGEST
    assert not [one for one in program.findings if one.code == "ISO109"]


def test_calls_of_calls_are_followed_up_to_a_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flow, "LONGEST", 1000)
    subprograms = "".join(f"N{one} M98 P{one + 1} L99\nM99\n" for one in range(1, 9))
    program = read(f"G91 G01\nM98 P1\nM02\n{subprograms}N9 X1\nM99")
    assert {one.values["what"] for one in program.findings if one.code == "ISO400"} == {"call-too-long"}
    assert len(program.toolpath) <= flow.LONGEST


@pytest.mark.deeper
def test_calls_that_run_millions_of_blocks_take_little_memory() -> None:
    text = "G91 G01\nM98 P1 L999\nM02\nN1 M98 P2 L999\nM99\nN2 X1\nX-1\nG02 X2 Y0 I1 J0\nM99"
    tracemalloc.start()
    try:
        program = read(text)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert [each.values["what"] for each in program.findings if each.code == "ISO400"] == ["call-too-long"]
    assert most < 200e6


def test_a_motion_word_counts_from_when_it_runs() -> None:
    text = "G91 G92 X0 Y0\nM98 P1\n{}\nX5\nM02\nN1 {}X1000\nM99"
    assert not findings(text.format("", "G01 "), "ISO110")
    assert path(text.format("", "G01 ")).source.line.tolist() == [6, 4]
    program = read(text.format("G01", ""))
    assert [(one.line, one.values["what"]) for one in program.findings if one.code == "ISO110"] == [
        (6, "no-motion-yet")
    ]
    assert [one.after for one in program.reading.damages] == [0]


def test_a_long_text_without_calls_runs_to_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flow, "LONGEST", 5)
    assert len(path("G91 G01\n" + "X1\n" * 9 + "M02")) == 9


def test_damage_that_never_runs_leaves_nothing_in_doubt() -> None:
    assert not read("G91 G01 X1\nM02\nX1..2").reading.damages
    assert [one.after for one in read("G91 G01 X1\nX1..2\nX3\nM02").reading.damages] == [1]


def test_text_behind_the_end_is_told_once_a_stretch() -> None:
    assert [one.line for one in findings("G91 G01 X1\nM02\nX2\nX3", "ISO108")] == [3]
    assert [one.line for one in findings("%\nG91 G01 X1\nM02\n%\nX2", "ISO108")] == [5]


def test_subprograms_that_nothing_calls_are_told_apart_from_it() -> None:
    text = "G91 G01 X1\nM98 P1\nM02\nN1 X2\nM99\nN2 X3\nM99\nN3 X4\nM99\nX5"
    assert [one.line for one in findings(text, "ISO401")] == [6, 8]
    assert [one.line for one in findings(text, "ISO108")] == [10]


def test_a_label_without_a_return_is_no_subprogram() -> None:
    text = "G91 G01 X1\nM98 P1\nM02\nN1 X2\nM99\nN2 X3"
    assert [one.line for one in findings(text, "ISO108")] == [6]
    assert not findings(text, "ISO401")


def test_a_label_used_twice_is_no_subprogram_without_a_call() -> None:
    text = "G91 G01\nM98 P1\nM02\nN1 X2\nM99\nN1 X3\nM99"
    assert [one.code for one in read(text).findings if one.code in {"ISO121", "ISO401"}] == ["ISO121"]
    assert findings("G91 G01\nN1 X1\nM02\nN1 X3\nM99", "ISO401")


def test_a_program_without_end_code_gets_one_where_its_text_ends() -> None:
    (found,) = findings("G91 G01 X1\n(last)", "ISO109")
    assert [edit.text for edit in found.edits] == ["\nM02"]
    assert not findings("G91 G01 X1\nM30", "ISO109")


def test_an_end_code_stands_before_what_dos_fills_the_last_sector_with() -> None:
    text = "G91 G01 X1\nX-1" + "\0" * 5
    edits = [edit for found in parse_program(text).findings for edit in found.edits]
    assert edited(text, edits) == "G91 G01 X1\nX-1\nM02" + "\0" * 5


def test_a_return_that_nothing_called_gets_no_end_code_written() -> None:
    (found,) = findings("G91 G01 X1\nM99\nX2", "ISO109")
    assert (found.line, found.edits) == (2, ())


@pytest.mark.parametrize(
    ("block", "column"), [("M00 M02", 5), ("M02 X1", 5), ("M01 M00", 5), ("G01 X1 M02 Y1 M30", 12)]
)
def test_stops_and_ends_that_are_not_last_are_told_at_the_word_behind_them(block: str, column: int) -> None:
    assert [one.column for one in findings(f"G91 G01 X1\n{block}", "ISO208")] == [column]


@pytest.mark.parametrize("block", ["G01 X1 M02", "X1 Y1 M00", "M02"])
def test_motion_before_a_stop_in_its_block_is_nothing_to_tell(block: str) -> None:
    assert not findings(f"G91 G01 X1\n{block}\nM02", "ISO208")
