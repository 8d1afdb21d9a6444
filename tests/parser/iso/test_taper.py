"""How the wire leans by the words of ISO: angles and their units, sides, U and V, and blocks of two contours."""

import numpy as np
import pytest

from parser.dialect.reader import Choices, OwnDialect
from parser.program import Program, parse_program

HEAD = "G92 X0 Y0\nG90\n"


def read(text: str, dialect: str = "common") -> Program:
    return parse_program(text, "part.iso", choices=Choices(dialect=dialect))


def degrees(program: Program) -> list[float]:
    """Angles by row, negative to the right."""
    taper = program.toolpath.taper
    assert taper is not None
    return np.round(np.degrees(taper.side * taper.angle_rad), 9).tolist()


@pytest.mark.parametrize(
    ("words", "dialect", "angle"),
    [
        ("G51 A3.", "common", 3.0),
        ("G51 A3", "common", 3.0),
        ("G51 T3.", "common", 3.0),
        ("G51 T1.5", "fanuc", 1.5),
        ("G52 A3.", "common", -3.0),
        ("G52 A-3.", "common", 3.0),
        ("G51 T3000", "common", 3.0),
        ("G51 A1500", "fast-wire", 1.5),
        ("A1.5 G51", "sodick", 1.5),
    ],
)
def test_an_angle_is_that_of_its_letter_and_unit(words: str, dialect: str, angle: float) -> None:
    assert degrees(read(f"{HEAD}{words} G01 X0 Y5000\nX5000 Y5000\nG50 X0 Y0\nM02\n", dialect)) == [angle, angle, 0.0]


def test_an_angle_holds_until_another_one() -> None:
    text = f"{HEAD}G51 A1. G01 X0 Y5000\nX5000 Y5000 A2.\nX5000 Y-5000\nG52 X-5000\nG50 X0 Y0\nM02\n"
    assert degrees(read(text)) == [1.0, 2.0, 2.0, -2.0, 0.0]


def test_a_dialect_of_ones_own_says_the_unit_of_angles() -> None:
    own = OwnDialect("ours", "common", '{"angle_integer_deg": 0.001}')
    text = f"{HEAD}G51 A30 G01 X0 Y5000\nX5000 Y5000\nG50 X0 Y0\nM02\n"
    assert degrees(parse_program(text, "part.iso", choices=Choices(dialect=own))) == [0.03, 0.03, 0.0]


def test_t_of_another_dialect_switches_where_nothing_leans() -> None:
    assert read(f"{HEAD}T84\nG01 X0 Y5000\nX5000 Y0\nM02\n").toolpath.taper is None


def test_angles_of_0_leave_the_wire_upright() -> None:
    toolpath = read(f"{HEAD}G51 A0 G01 X0 Y5000 U0 V0\nX5000 Y5000\nM02\n").toolpath
    assert (toolpath.taper, toolpath.upper, toolpath.leans) == (None, None, False)


@pytest.mark.parametrize(
    "text",
    [
        "G90 G01 X5. Y0. U1. V.5\nX5. Y5. U2.\nX0. Y0. U0. V0.\n",
        "G91 G01 X5. Y0. U1. V.5\nX0. Y5. U1.\nX-5. Y-5. U-2. V-.5\n",
    ],
)
def test_u_and_v_are_places_or_ways_as_x_and_y_are(text: str) -> None:
    toolpath = read(f"G92 X0. Y0.\n{text}M02\n").toolpath
    assert toolpath.upper is not None
    aside = toolpath.upper.end_um - toolpath.end_um
    assert aside.tolist() == [[1000.0, 500.0], [2000.0, 500.0], [0.0, 0.0]]


def test_an_arc_between_blocks_of_u_and_v_keeps_them() -> None:
    text = "G92 X0. Y0.\nG90 G01 X5. Y0. U1. V0.\nG03 X5. Y4. I0. J2.\nG01 X0. Y0. U0.\nM02\n"
    upper = read(text).toolpath.upper
    assert upper is not None
    assert (upper.center_um[1].tolist(), upper.radius_um[1]) == ([6000.0, 2000.0], 2000.0)


TWO = "G92 X0. Y0.\nG90\nG01 X10. Y0. : G01 X8. Y0.\nG01 X10. Y10. : G03 X0. Y8. I-8. J0.\nG01 X0. Y0.\nM02\n"


@pytest.mark.parametrize(("dialect", "is_first"), [("fast-wire", True), ("sodick", False), ("common", False)])
def test_which_contour_stands_first_is_the_dialects(dialect: str, is_first: bool) -> None:
    program = read(TWO, dialect)
    lines, arcs = [[10_000.0, 0.0], [10_000.0, 10_000.0], [0.0, 0.0]], [[8000.0, 0.0], [0.0, 8000.0], [0.0, 0.0]]
    upper = program.toolpath.upper
    assert upper is not None
    assert [program.toolpath.end_um.tolist(), upper.end_um.tolist()] == ([lines, arcs] if is_first else [arcs, lines])
    assert "assumed-planes" in {each.what for each in program.reading.assumptions}
    assert program.toolpath.source.block_text(1).startswith("G01 X10. Y10." if is_first else "G03")


def test_contours_that_cannot_be_run_together_are_not_known() -> None:
    program = read("G92 X0. Y0.\nG90\nG01 X10. Y0. : G00 X8. Y0.\nG01 X0. Y0.\nM02\n", "fast-wire")
    assert program.toolpath.upper is None
    assert "ISO600" in {finding.code for finding in program.findings}


@pytest.mark.parametrize(
    ("dialect", "on", "off", "side"),
    [
        ("fast-wire", "G41 D1", "G40", 1),
        ("fast-wire", "G151 D1", "G150", 1),
        ("fast-wire", "G40 G152 D1", "G40 G150", -1),
        ("sodick", "G141 H1", "G140", 1),
        ("sodick", "G142 H1", "G140", -1),
    ],
)
def test_two_contours_are_offset_to_one_side(dialect: str, on: str, off: str, side: int) -> None:
    register = on[-2:]
    text = TWO.replace("G90\n", f"G90\n{register}=0.1\n{on}\n").replace("M02", f"{off}\nM02")
    program = read(text, dialect)
    compensation = program.toolpath.compensation
    assert compensation is not None
    assert program.toolpath.upper is not None
    assert compensation.left_um.tolist() == [100.0 * side] * 3
    assert {finding.code for finding in program.findings} == {"ISO112"}


def test_words_of_two_planes_stay_unknown_elsewhere() -> None:
    assert "ISO203" in {finding.code for finding in read("G92 X0 Y0\nG151 D1\nG01 X5. Y0.\nM02\n", "fanuc").findings}


def test_contours_with_offsets_of_their_own_are_not_known() -> None:
    text = TWO.replace("G90\n", "G90\nD1=0.1\nD2=0.2\nG151 D1\n").replace(": G03", ": D2 G03")
    program = read(text, "fast-wire")
    assert program.toolpath.upper is None
    assert "ISO600" in {finding.code for finding in program.findings}


@pytest.mark.parametrize(
    "text",
    [
        "G92 X0 Y0\nU1. V1.\nM02\n",
        "G92 X0. Y0. : G92 X1. Y0.\nM02\n",
        "G92 X0 Y0\nG41 D1\nG01 X5. Y0. : M00\nX9. Y9.\nM02\n",
    ],
)
@pytest.mark.parametrize("dialect", ["common", "fast-wire", "sodick"])
def test_two_contours_of_which_one_or_both_stand_get_an_answer(text: str, dialect: str) -> None:
    program = read(text, dialect)
    upper = program.toolpath.upper
    assert upper is None or len(upper) == len(program.toolpath) > 0
