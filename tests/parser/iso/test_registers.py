"""Offsets in force: registers of each family, sums, what is set in the order of execution, and what is not known."""

import math

import pytest

from tests.tools.iso_reading import path, read

SKD2 = """
H001=110
H002=-90
G92 X0 Y0
G90
H001
M98 P0001
M00
H002
M98 P0001
M02
N0001
G01 X0 Y5000
G41
G01 X0 Y9000
X5000
G40
X0 Y0
M99
"""

SODICK = """
H000 = +000000.0100 ;
H001 = +000000.2130 ;
G90 ;
G92 X0.0 Y0.0 Z0 ;
G41 H000 G01 X5.0 Y0.0 ;
H001 C001 ;
M98 P0001 ;
M199 ;
N0001 ;
G01 Y5.0 ;
G01 G40 H000 X0.0 ;
M99 ;
"""

MITSUBISHI = """
%
L001
H175=.0005
H1 =.00995 + H175
H2 =.00725 + H175
N1 G90 G92 X0. Y0.
G41 H1 G1 Y-.5
X1.
G40 Y0.
G42 H2 X.5
X0.
M02
%
"""


def offsets(text: str, dialect: str, **told: dict[str, float]) -> list[tuple[int, float, str]]:
    compensation = path(text, dialect, **told).compensation
    assert compensation is not None
    return list(zip(compensation.side.tolist(), compensation.by_um.tolist(), compensation.register, strict=True))


def test_skd2_selects_a_register_before_each_pass() -> None:
    passed = [(0, 0.0), (1, 110.0), (1, 110.0), (0, 0.0)]
    first, second = offsets(SKD2, "skd2")[:4], offsets(SKD2, "skd2")[4:]
    assert [one[:2] for one in first] == passed
    assert [one[:2] for one in second] == [(side, -90.0 * side) for side, _ in passed]
    assert {one[2] for one in second} == {"H2"}


def test_sodick_changes_the_register_while_it_is_on() -> None:
    assert offsets(SODICK, "sodick") == [(1, 10.0, "H0"), (1, 213.0, "H1"), (0, 0.0, "H0")]


def test_mitsubishi_sums_registers_in_inches() -> None:
    found = offsets(MITSUBISHI, "mitsubishi", unit="inch")
    assert [(side, name) for side, _, name in found] == [(1, "H1"), (1, "H1"), (0, "H1"), (-1, "H2"), (-1, "H2")]
    assert found[0][1] == pytest.approx(0.01045 * 25_400)
    assert found[3][1] == pytest.approx(0.00775 * 25_400)


@pytest.mark.parametrize(
    ("dialect", "unit", "by"), [("classroom", "", 100.0), ("skd2", "", 100.0), ("common", "inch", 254.0)]
)
def test_whole_numbers_have_the_scale_of_registers(dialect: str, unit: str, by: float) -> None:
    text = "H1 = 100\nG92 X0 Y0\nG91 G41 H1 G01 X9\nM02"
    assert offsets(text, dialect, unit=unit)[0][1] == pytest.approx(by)


def test_registers_follow_a_unit_word() -> None:
    text = "G20\nH1 = 100\nH2 = .01\nG92 X0 Y0\nG91 G41 H1 G01 X9\nH2\nX9\nM02"
    assert [by for _, by, _ in offsets(text, "common")] == pytest.approx([254.0, 254.0])


def test_values_count_from_where_they_are_set() -> None:
    text = "D1 = 50\nG92 X0 Y0\nG91 G41 D1 G01 X9\nX9\nD1 = 60 + D1\nX9\nM02"
    assert [by for _, by, _ in offsets(text, "common")] == [50.0, 50.0, 110.0]


@pytest.mark.parametrize(("dialect", "by"), [("fanuc", 0.0), ("robofil", 100.0)])
def test_register_0_is_off_for_fanuc_and_a_register_for_robofil(dialect: str, by: float) -> None:
    text = "G92 X0. Y0.\nG90 G41 D0 G01 X9.\nM02"
    assert offsets(text, dialect, registers={"D0": 100.0}) == [(1, by, "D0")]


def test_what_the_program_sets_counts_before_what_is_told() -> None:
    text = "G92 X0 Y0\nG91 G41 D1 G01 X9\nD1 = 70\nX9\nM02"
    assert [by for _, by, _ in offsets(text, "common", registers={"D1": 40.0})] == [40.0, 70.0]


def test_a_value_that_nothing_tells_is_not_known() -> None:
    assert math.isnan(offsets("G92 X0 Y0\nG91 G41 D7 G01 X9\nM02", "common")[0][1])
    assert math.isnan(offsets("H1 = 5 + H9\nG92 X0 Y0\nG91 G41 H1 G01 X9\nM02", "common")[0][1])


@pytest.mark.parametrize(
    ("told", "lacking"),
    [
        ("H1 = 5 + H9", {"H1": "H9"}),
        ("H2 = 5 + H9\nH1 = 1 + H2", {"H2": "H9", "H1": "H9"}),
        ("H9 = 3\nH1 = 5 + H9", {}),
        ("H1 = 5 + H1", {"H1": "H1"}),
        ("H1 = 5", {}),
    ],
)
def test_the_register_that_a_sum_lacks_is_known(told: str, lacking: dict[str, str]) -> None:
    compensation = path(f"{told}\nG92 X0 Y0\nG91 G41 H1 G01 X9\nM02", "common").compensation
    assert compensation is not None
    assert compensation.lacking == lacking


def test_the_only_register_is_taken_where_none_is_selected_and_it_is_said() -> None:
    text = "H001=110\nG92 X0 Y0\nG91 G41\nG01 X9\nM02"
    assert offsets(text, "skd2") == [(1, 110.0, "H1")]
    assert ("assumed-register", "H1") in {(one.what, one.taken) for one in read(text, "skd2").reading.assumptions}


def test_of_two_registers_none_is_taken() -> None:
    ((side, by, name),) = offsets("H001=110\nH002=90\nG92 X0 Y0\nG91 G41\nG01 X9\nM02", "skd2")
    assert (side, name) == (1, "")
    assert math.isnan(by)


def test_a_program_without_a_side_on_its_path_compensates_nothing() -> None:
    program = read("D1 = 50\nG92 X0 Y0\nG91 G40 D1 G01 X9\nG41\nM02")
    assert program.toolpath.compensation is None
    assert not program.reading.is_drawing


def test_jumps_are_compensated_like_cuts() -> None:
    assert [side for side, _, _ in offsets("D1=5\nG92 X0 Y0\nG91 G42 D1 G01 X9\nG00 X9\nM02", "common")] == [-1, -1]


@pytest.mark.parametrize("told", ["", "D1 = 40\n"])
def test_a_register_may_be_a_term_of_its_own_sum(told: str) -> None:
    ((_, by, _),) = offsets(f"{told}D1 = D1 + 10\nG92 X0 Y0\nG91 G41 D1 G01 X9\nM02", "common")
    assert math.isnan(by) if not told else by == 50.0
