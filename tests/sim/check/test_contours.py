"""Contours: which are told apart, which close, and what is said of those that do not."""

import pytest
from line_words import line_words
from runs import codes, run_text

from controller.stepping.steps import interpolate
from parser.findings.findings import Finding
from parser.program import parse_program
from parser.shape.contours import find_contours
from sim.check.closures import ruled_count_axis
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

HOLE = "B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B9900GXL3"
SQUARE = "B10000B0B10000GXL1 B0B10000B10000GYL2 B10000B0B10000GXL3 B0B10000B10000GYL4"
JUMP = "D B30000B0B30000GXL1 D"


CLOSED = [
    HOLE,
    f"B2000B0B2000GXL1 {SQUARE}",  # ends where its lead-in ended
    f"B0B2000B2000GYL2 {SQUARE} B500B0B500GXL1",  # runs on past that, along its first side
    "B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B2400GYNR1",  # a circle cut past its start
    "B15241B0B15241GXL3 B73215B15463B299320GYNR4",  # a circle off the axes, left where it began
    SQUARE.replace("B0B10000B10000GYL4", "D B0B10000B10000GYL4"),  # a pause before the last cut
]


@pytest.mark.parametrize("text", CLOSED)
def test_closed_contours_are_silent(text: str) -> None:
    assert _codes(text) == []


FIRST = "B0B5000B5000GYL2 B5000B0B5000GXL3 B0B10000B10000GYL2 B10000B0B10000GXL1 B0B10000B10000GYL4 B5000B0B5000GXL3"
FIRST += " B0B5000B5000GYL4"
BESIDE = "D B5000B7000B7000GYL1 D B0B2000B2000GYL4 B10000B0B10000GXL1 B0B10000B10000GYL2 B10000B0B10000GXL3"
BESIDE += " B0B2000B2000GYL4"
"""A square, and a part that has its right side in common with it: threaded in its kerf, round, and back into it."""


def test_a_contour_that_begins_and_ends_in_the_kerf_of_another_one_is_closed() -> None:
    assert _codes(f"{FIRST} {BESIDE}") == []
    alone = BESIDE.removeprefix("D B5000B7000B7000GYL1 D ")
    assert _closure_codes(alone) == ["3B301"]


@pytest.mark.parametrize(
    ("written", "wrong"),
    [
        ("B10000B0B10000GXL3", "B10000B0B9500GXL3"),  # it ends beside the kerf
        ("B10000B0B10000GXL3", "B10000B0B10500GXL3"),
        ("D B5000B7000B7000GYL1 D", "D B6000B7000B7000GYL1 D"),  # it begins beside it
    ],
)
def test_one_that_begins_or_ends_beside_the_kerf_is_open(written: str, wrong: str) -> None:
    assert _closure_codes(f"{FIRST} {wrong.join(BESIDE.rsplit(written, 1))}") == ["3B301"]


OPEN = [
    HOLE.replace("GXL3", "GXL1"),
    HOLE.replace("B9900B0B39600GYNR1", "B9900B0B39000GYNR1"),  # short of its start
    SQUARE.replace("B10000B0B10000GXL3", "B10000B0B9000GXL3"),
    f"B0B2000B2000GYL2 {SQUARE} B500B500B500GYL1",  # in from outside, out into the part
]


@pytest.mark.parametrize("text", OPEN)
def test_open_contours_are_named(text: str) -> None:
    assert _closure_codes(text) == ["3B301"]


@pytest.mark.parametrize("lead_out", ["B9900B0B5000GXL3", "B9000B3000B9000GXL3", "B9000B3000B9000GXL2"])
def test_a_lead_out_that_ends_elsewhere_in_the_waste_is_a_note(lead_out: str) -> None:
    found = _checked(f"{HOLE.replace('B9900B0B9900GXL3', lead_out)} DD")
    assert [(f.code, f.block) for f in found if f.code.startswith("3B3")] == [("3B311", 1), ("3B311", 3)]


@pytest.mark.parametrize("lead", [("", ""), ("B3000B0B3000GXL3 ", " B3000B0B3000GXL1")])
@pytest.mark.parametrize(("last", "found"), [(9998, []), (9997, ["3B301"]), (9996, ["3B301"])])
def test_a_contour_of_lines_closes_to_2_um(last: int, found: list[str], lead: tuple[str, str]) -> None:
    short = SQUARE.replace("B0B10000B10000GYL4", f"B0B{last}B{last}GYL4")
    assert _closure_codes(f"{lead[0]}{short}{lead[1]}") == found


FRAME = "B0B10000B10000GYL2 B10000B0B10000GXL1 B0B20000B20000GYL4 B10000B0B10000GXL3"


@pytest.mark.parametrize(
    ("into", "out"),
    [
        ("B3000B0B3000GXL1", "B0B10000B10000GYL2 B3000B4000B4000GYL3"),
        ("B3000B0B3000GXL1", "B0B10500B10500GYL2 B3000B0B3000GXL3"),  # 500 µm cut twice
        ("B3000B0B3000GXL1", "B0B11000B11000GYL2 B3000B0B3000GXL3"),
        ("B3000B0B3000GXL1", "B0B10000B10000GYL2 B0B1000B1000GYL2 B3000B0B3000GXL3"),
        ("B0B3000B3000GYNR4", "B0B10000B10000GYL2 B3000B0B3000GXNR1"),  # in and out on arcs that mirror each other
        ("B0B3000B3000GYNR4", "B0B10500B10500GYL2 B3000B0B3000GXNR1"),
    ],
)
def test_a_closed_loop_left_elsewhere_is_no_fault(into: str, out: str) -> None:
    assert set(_codes(f"{into} {FRAME} {out}")) == {"3B311"}


@pytest.mark.parametrize("figure", [HOLE.replace("B39600GYNR1", "B39000GYNR1"), SQUARE])
def test_a_figure_that_does_not_close_is_named_and_the_jump_stays_a_jump(figure: str) -> None:
    broken = figure.rsplit("B", 1)[0] + "B5000" + figure[-4:]
    text = f"{broken} {JUMP} {HOLE}"
    assert _closure_codes(text) == ["3B301"]
    toolpath = parse_program(text).toolpath
    assert toolpath.is_jump.sum() == 1
    found = find_contours(toolpath, interpolate(toolpath).corner_um)
    assert [(c.first, c.is_open) for c in found] == [(1, True), (len(figure.split()) + 2, False)]


def test_a_figure_that_does_not_close_is_named_though_one_pause_hides_the_jump() -> None:
    broken = HOLE.replace("B9900B0B9900GXL3", "B9900B0B5000GXL3")
    assert "3B301" in _codes(f"{broken} D B30000B0B30000GXL1 {HOLE}")


def test_one_micrometre_for_each_arc_past_the_fifth() -> None:
    # Eight quarter arcs round a square with round corners, the last of them 7 µm short.
    corner = "B0B1000B1000GYNR4 B1000B0B1000GXNR1 B0B1000B1000GYNR2 B1000B0B1000GXNR3"
    short = f"{corner} B1000B0B1000GXL1 B1007B0B1007GXL3"
    assert _closure_codes(short) == ["3B301"]
    assert "3B301" not in _codes(f"{corner} {corner} {short}")


def test_wrong_count_axis_names_the_right_one() -> None:
    finding = next(f for f in _checked(f"{HOLE.replace('GYNR1', 'GXNR1')} DD") if f.code == "3B204")
    assert finding.block == 2
    assert (finding.values["axis"], finding.values["ruled"]) == ("X", "Y")
    assert finding.values["cost"] == pytest.approx(140.0, abs=0.5)  # docs/3b.md §4
    line = _checked("B1000B3B3GYL1 B1000B3B3GYL3 DD")
    assert [(f.code, f.values["ruled"]) for f in line] == [("3B204", "X")] * 2


def test_a_long_way_round_may_miss_by_more() -> None:
    turns = _codes("B13B14B760GXSR4")  # ten turns, each a little off
    assert "3B303" not in turns
    assert "3B210" in turns


def test_rule_of_the_count_axis() -> None:
    toolpath = parse_program("B100B30B100GXL1 B30B100B100GYL2 B0B500B400GXNR4 B0B500B480GXNR4 DD").toolpath
    assert ruled_count_axis(toolpath).tolist() == [0, 1, 1, 1]


@pytest.mark.parametrize(
    ("dx", "dy", "axis", "quadrant"),
    [
        (5, 5, "Y", 1),
        (-5, 5, "X", 2),
        (-5, -5, "Y", 3),
        (5, -5, "X", 4),
        (7, 0, "X", 1),
        (0, 7, "Y", 2),
        (-7, 0, "X", 3),
        (0, -7, "Y", 4),
        (3, -7, "Y", 4),
        (0, 0, "X", 1),
    ],
)
def test_words_of_a_line(dx: int, dy: int, axis: str, quadrant: int) -> None:
    words = line_words(dx, dy)
    assert (words.count_um, words.quadrant) == (max(abs(dx), abs(dy)), quadrant)
    assert words.count_axis.name == axis or dx == dy == 0


@pytest.mark.parametrize(
    ("start_mm", "text"),
    [
        ((399.0, 250.0), "B2000B0B2000GXL1"),
        ((1.0, 250.0), "B2000B0B2000GXL3"),
        ((200.0, 499.0), "B0B2000B2000GYL2"),
        ((200.0, 1.0), "B0B2000B2000GYL4"),
    ],
)
def test_each_edge_of_the_travel_is_watched(start_mm: tuple[float, float], text: str) -> None:
    header = "Start Point = 50.0 , 60.0\n"  # where the program says it is does not move it on the table
    # At the stop the motors lose steps.
    assert codes(run_text(f"{header}{text} DD", start_mm=start_mm, past_stop=True)) == ["3B401", "3B402"]
    assert codes(run_text(f"{header}{text.replace('2000', '900')} DD", start_mm=start_mm)) == []


def _checked(text: str) -> tuple[Finding, ...]:
    return check_file(Job("program.3b", text.encode(), CheckSettings())).findings


def _codes(text: str) -> list[str]:
    return [finding.code for finding in _checked(f"{text} DD")]


def _closure_codes(text: str) -> list[str]:
    """Codes of what is said about whether contours close, without their suspects."""
    return [code for code in _codes(text) if code in ("3B301", "3B302")]


@pytest.mark.parametrize("text", [CLOSED[1], CLOSED[-1], OPEN[2], OPEN[3]])
def test_a_run_says_of_contours_what_a_check_says(text: str) -> None:
    assert codes(run_text(f"{text} DD")) == _codes(text)


def _leaning(lines: int, circles: int = 0) -> str:
    """A triangle whose long side is stepped 2 µm short in X by each of its lines, which count on the shorter side.

    Full circles at its start close in steps too.
    """
    long_side = " ".join(["B1100B500B500GYL1"] * lines)
    way = f"B{1100 * lines}B0B{1100 * lines}GXL3 B0B{500 * lines}B{500 * lines}GYL4"
    return f"{'B0B5000B20000GXNR2 ' * circles}{long_side} {way} DD"


@pytest.mark.parametrize(
    ("lines", "circles", "limit_um"),
    [(6, 0, None), (7, 0, 12.0), (9, 1, None), (10, 1, 18.0), (12, 4, None), (13, 4, 24.0)],
)
def test_stepped_closure_is_12_um_and_6_for_each_root_of_the_arcs(
    lines: int, circles: int, limit_um: float | None
) -> None:
    found = [finding for finding in _checked(_leaning(lines, circles)) if finding.code == "3B302"]
    expected = [] if limit_um is None else [(2.0 * lines, limit_um)]
    assert [(finding.values["gap"], finding.values["limit"]) for finding in found] == expected


def test_two_lines_that_miss_each_other_are_no_figure_with_a_wrong_word() -> None:
    assert _codes("B9000B3000B9000GXL1 B9000B3000B9000GXL4") == []
    assert "3B304" in _codes("B9000B3000B9000GXL1 B9000B3000B9000GXL4 B18000B0B18000GXL1")


@pytest.mark.parametrize(("gap", "found"), [(3, "3B301"), (5, "3B301"), (6, "3B311"), (1414, "3B311")])
def test_a_contour_that_ends_within_5_um_of_its_start_was_to_end_there(gap: int, found: str) -> None:
    # Behind a closed loop a lead-out may end elsewhere in the waste, but not some µm beside the start.
    codes = _codes(f"B0B3000B3000GYL2 {SQUARE} B{gap}B3000B3000GYL4")
    assert {"3B301", "3B311"} & set(codes) == {found}


def test_suspects_are_looked_for_in_the_first_fifty_open_contours() -> None:
    triangle = "B5000B0B5000GXL1 B0B5000B5000GYL2 B5000B5000B5000GYL1 D B0B90000B90000GYL2 D"
    named = [finding for finding in _checked(f"{' '.join([triangle] * 51)} DD") if finding.code == "3B304"]
    assert sorted({finding.values["first"] for finding in named}) == [1 + 4 * number for number in range(50)]


@pytest.mark.parametrize(("arc", "is_open"), [("B0B5000B15000GYNR4", True), ("B0B5000B5000GYNR4", False)])
def test_an_arc_of_more_than_half_a_turn_turns_back_though_its_ends_do_not(arc: str, *, is_open: bool) -> None:
    # Three quarters of a circle behind a line end across it; a quarter runs on as a parting cut does.
    assert ("3B301" in _codes(f"B9000B0B9000GXL1 {arc}")) == is_open
