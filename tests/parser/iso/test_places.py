"""Where blocks begin and end: G90 and G91, G92 in all its places, scales, dwells, modes that go on."""

import pytest

from parser.findings.findings import edited
from parser.geometry.curves import CurveKind
from tests.tools.iso_reading import ends, findings, path, read
from tests.tools.twins import TWIN_ISO


def test_a_published_program_closes_with_the_length_of_its_twin() -> None:
    toolpath = path(TWIN_ISO, "fast-wire")
    assert len(toolpath) == 12
    assert toolpath.is_arc.sum() == 3
    assert toolpath.length_um.sum() == pytest.approx(828_921.0, abs=1.5)
    assert toolpath.start_um[0].tolist() == toolpath.end_um[-1].tolist() == [115_000.0, -10_000.0]
    assert not [one for one in read(TWIN_ISO, "fast-wire").findings if one.code != "ISO112"]


def test_the_first_place_is_the_one_that_g92_names_else_the_origin() -> None:
    assert path("G92 X5 Y7\nG90 G01 X9\nM02").start_um[0].tolist() == [5.0, 7.0]
    assert path("G90 G00 X9 Y1\nG01 X5\nM02").start_um[0].tolist() == [0.0, 0.0]


def test_a_bare_g92_names_the_origin() -> None:
    program = read("G92\nG90 G01 X9\nG92\nX4\nM02")
    assert ends(program.toolpath) == [(9.0, 0.0), (13.0, 0.0)]
    assert "assumed-place" in {one.what for one in program.reading.assumptions}
    assert "assumed-place" not in {one.what for one in read("G92 Z0\nG90 G01 X9\nM02").reading.assumptions}


@pytest.mark.parametrize(
    ("text", "mended"),
    [
        ("N1 G92\nG90 G01 X9\nM00\nG92\nX4\nM02", "N1 G92 X0 Y0\nG90 G01 X9\nM00\nG92 X0 Y0\nX4\nM02"),
        ("G92G90\nG01 X9.\nM02", "G92 X0. Y0.G90\nG01 X9.\nM02"),
    ],
)
def test_a_bare_g92_is_told_and_mended_to_what_was_taken(text: str, mended: str) -> None:
    bare = [one for one in read(text).findings if one.code == "ISO113"]
    assert [one.line for one in bare] == [number for number, line in enumerate(text.split("\n"), 1) if "G92" in line]
    new = edited(text, [edit for one in bare for edit in one.edits])
    assert new == mended
    assert "ISO113" not in {one.code for one in read(new).findings}
    assert ends(path(new)) == ends(path(text))


def test_the_place_of_a_bare_g92_that_ends_the_text_stands_before_the_end_code() -> None:
    found = read("G90 G01 X5\nX0\nG92").findings
    mended = edited("G90 G01 X5\nX0\nG92", [edit for one in found for edit in one.edits])
    assert mended == "G90 G01 X5\nX0\nG92 X0 Y0\nM02"


def test_a_g92_whose_place_cannot_be_read_is_not_mended_to_another() -> None:
    found = read("G91 G92 X-\nG01 X5\nX-5\nM02\n").findings
    assert {one.code for one in found} & {"ISO102", "ISO113"} == {"ISO102"}


def test_two_bare_g92_in_one_block_are_told_and_not_mended() -> None:
    found = read("G91G92I0G91G92I0\nG1X5\nX-5\nM02").findings
    assert [one.edits for one in found if one.code == "ISO113"] == [(), ()]


def test_a_g92_with_a_place_or_one_that_never_runs_is_not_called_bare() -> None:
    told = {one.code for one in read("G92 Z0\nG90 G92 Y1\nG01 X9\nM02\nG92\n").findings}
    assert "ISO113" not in told


def test_missing_axes_stay_in_g90_and_do_not_move_in_g91() -> None:
    assert ends(path("G92 X1 Y2\nG90 G01 X5\nY9\nG91 X5\nY-1\nM02")) == [
        (5.0, 2.0),
        (5.0, 9.0),
        (10.0, 9.0),
        (10.0, 8.0),
    ]


def test_g92_without_a_stop_moves_the_coordinates_and_not_the_wire() -> None:
    text = "G92 X0 Y0\nG90 G01 X10 Y20\nG92 X100 Y0\nX110\nG02 X110 Y0 I5\nM02"
    toolpath = path(text)
    assert ends(toolpath) == [(10.0, 20.0), (20.0, 20.0), (20.0, 20.0)]
    assert toolpath.center_um[2].tolist() == [25.0, 20.0]
    assert [(one.line, one.values["x"], one.values["y"]) for one in findings(text, "ISO303")] == [(3, 90.0, -20.0)]


def test_absolute_centres_are_read_in_the_coordinates_of_their_block() -> None:
    toolpath = path("G92 X0 Y0\nG90 G90.1 G01 X10\nG92 X0\nG02 X20 Y0 I10 J0\nM02")
    assert toolpath.center_um[1].tolist() == [20.0, 0.0]


def test_g92_that_says_what_is_known_is_nothing_to_tell() -> None:
    assert not findings("G92 X0 Y0\nG90 G01 X10\nG92 X10 Y0\nX20\nM02", "ISO303")
    assert [one.block for one in findings("G92 X0 Y0\nG90 G01 X10\nG92 X11\nX20\nM02", "ISO303")] == [0]


@pytest.mark.parametrize("stop", ["M00", "M01", "M21\nM20", "M00\nG54\nT84"])
def test_g92_behind_a_stop_threads_the_wire_where_it_says(stop: str) -> None:
    text = f"G92 X0 Y0\nG90 G01 X10\n{stop}\nG92 X50 Y5\nG01 X60\nM02"
    program = read(text)
    assert ends(program.toolpath) == [(10.0, 0.0), (50.0, 5.0), (60.0, 5.0)]
    assert program.toolpath.kind.tolist() == [CurveKind.LINE, CurveKind.JUMP, CurveKind.LINE]
    assert not [one for one in program.findings if one.code == "ISO303"]
    assert program.reading.threadings == 1
    assert "assumed-threading" in {one.what for one in program.reading.assumptions}


def test_g92_behind_a_stop_where_the_wire_is_makes_no_jump() -> None:
    assert len(path("G92 X0 Y0\nG90 G01 X10\nM00\nG92 X10 Y0\nG01 X20\nM02")) == 2


def test_motion_behind_a_stop_lets_g92_name_coordinates_again() -> None:
    assert ends(path("G92 X0 Y0\nG90 G01 X1\nM00\nX5\nG92 X0\nX5\nM02"))[-1] == (10.0, 0.0)


def test_the_x_of_a_dwell_is_no_way() -> None:
    assert ends(path("G92 X0 Y0\nG90 G01 X10\nG04 X500\nY5\nM02")) == [(10.0, 0.0), (10.0, 5.0)]


def test_motion_goes_on_over_lines_without_it() -> None:
    toolpath = path("G92 X0 Y0\nG90 G03 X0 Y20 J10\nM01\nX0 Y0 J-10\nM02")
    assert toolpath.is_arc.tolist() == [True, True]


def test_words_take_effect_before_the_motion_of_their_block_and_stops_behind_it() -> None:
    toolpath = path("G92 X0 Y0\nM00 X5 G01 G91\nX5\nM02")
    assert ends(toolpath) == [(5.0, 0.0), (10.0, 0.0)]
    assert toolpath.stops[0].after == 1


def test_the_first_word_of_a_text_is_a_word_like_others() -> None:
    assert ends(path("X5 G01\nY7\nM02")) == [(5.0, 0.0), (5.0, 7.0)]


def test_numbers_have_the_scale_of_their_writing_and_unit() -> None:
    toolpath = path("G92 X0 Y0\nG90 G01 X1013\nX1.013\nG20 X.5\nX10000\nG21 X1.\nM02")
    assert ends(toolpath) == [(1013.0, 0.0), (1013.0, 0.0), (12_700.0, 0.0), (25_400.0, 0.0), (1000.0, 0.0)]


def test_a_unit_word_counts_over_the_unit_of_the_family() -> None:
    inches = path("G92 X0. Y0.\nG90 G01 X.5\nG21 X5.\nX700\nM02", "mitsubishi", unit="inch")
    assert ends(inches) == [(12_700.0, 0.0), (5000.0, 0.0), (700.0, 0.0)]


def test_rapids_are_jumps_and_a_cut_of_no_length_is_told() -> None:
    text = "G92 X0 Y0\nG90 G00 X0 Y0\nG01 X0 Y0\nM98 P1 L2\nM02\nN1 G01 X0\nM99"
    assert path(text).kind.tolist() == [CurveKind.JUMP, CurveKind.LINE, CurveKind.LINE, CurveKind.LINE]
    assert [(one.line, one.block) for one in findings(text, "ISO218")] == [(3, 2), (6, 3)]


@pytest.mark.parametrize(
    ("text", "is_told"),
    [
        ("G92 X0 Y0\nG90 G01 X0 Y0\nX9\nM02", True),
        ("G92 X0 Y0\nG90 G01 X0 Y0\nM20\nX9\nM02", False),
        ("G92 X0 Y0\nG90 G01 X9\nM00\nX9\nX5\nM02", False),
        ("G92 X0 Y0\nM01\nG90 G01 X9 M00\nX9\nM02", False),
        ("G92 X0 Y0\nM01\nG90 G01 X9\nX9\nX5 M00\nM02", True),
    ],
)
def test_a_way_to_where_the_wire_is_threaded_is_no_cut_of_no_length(text: str, is_told: bool) -> None:
    assert bool(findings(text, "ISO218")) == is_told


def test_blocks_that_an_operator_may_skip_run_and_it_is_said() -> None:
    program = read("G92 X0 Y0\nG90 G01 X5\n/X7\nM02")
    assert ends(program.toolpath)[-1] == (7.0, 0.0)
    assert "assumed-skips" in {one.what for one in program.reading.assumptions}


@pytest.mark.parametrize(
    ("head", "is_assumed"),
    [("G90 G01 X5", True), ("G92 X0 Y0\nG90 G01 X5", False), ("G90 G00 X5", False), ("G91 G01 X5", False)],
)
def test_a_cut_from_nowhere_is_said_to_start_at_the_origin(head: str, is_assumed: bool) -> None:
    told = {one.what for one in read(f"{head}\nY5\nM02").reading.assumptions}
    assert ("assumed-start" in told) == is_assumed


def test_numbers_finer_than_the_machine_are_told_once() -> None:
    text = "G92 X0 Y0\nG90 G01 X1.0005\nX2.001 Y3.00025\nM02"
    (found,) = findings(text, "ISO207")
    assert (found.line, found.column, found.values["um"], found.values["more"]) == (2, 9, 1000.5, 1)
    assert not findings("G92 X0 Y0\nG90 G01 X1.000500\nX12.340\nM02".replace("0500", "0000"), "ISO207")


def test_coordinates_named_anew_beside_the_contour_are_told() -> None:
    text = "H1 = 5\nG92 X0 Y0\nG90 G41 H1\n{}\nG01 X100\nX200\n{}\nG40 X300\n{}\nM02"
    assert not findings(text.format("G92 X0 Y0", "", "G54"), "ISO511")
    assert [one.line for one in findings(text.format("", "G54", ""), "ISO511")] == [7]


def test_labels_are_the_numbers_of_blocks() -> None:
    assert path("G91 G01\nN0010 X1\nX2\nN20 X3\nM02").source.label == ("N10", "", "N20")
    assert path("G91 G01 X1\nM02").source.label == ("",)


def test_findings_of_words_bear_the_row_that_their_block_makes() -> None:
    (found,) = findings("G92 X0 Y0\nG90 G01 X5\nX9 G01\nM02", "ISO130")
    assert found.block == 2
    assert [one.block for one in findings("G92 X0 Y0\nM05 G90\nG01 X5\nM02", "ISO130")] == [0]
