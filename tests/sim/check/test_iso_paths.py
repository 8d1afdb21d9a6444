"""What is said of the paths of ISO programs: rapids, tabs, passes that stray; and sound programs that are near them."""

import random

import pytest
from iso_programs import FAMILIES, program

from parser.dialect.reader import Choices
from parser.program import load_program
from sim.check.path_checks import Demands, run_checks

ALWAYS = {"ISO112"}
HOLE = ("G01 X5000 Y0", "G03 I-5000 J0", "G01 X0 Y0")
SECOND = ("G01 X25000 Y0", "G03 X25000 Y0 I-5000 J0", "G01 X20000 Y0")
THERE = ("G01 X10000 Y10000", "G01 X-10000 Y10000", "G01 X-10000 Y-10000", "G01 X10000 Y-10000", "G01 X10000 Y0")
BACK = ("G01 X10000 Y-10000", "G01 X-10000 Y-10000", "G01 X-10000 Y10000", "G01 X10000 Y10000", "G01 X10000 Y0")


def found(*lines: str) -> dict[str, list[tuple[int, dict[str, object]]]]:
    """Lines and values of findings by code, those left out that every program has."""
    read = load_program("\n".join([*lines, "M02"]).encode(), "part.iso")
    by_code: dict[str, list[tuple[int, dict[str, object]]]] = {}
    for one in run_checks(read, Demands()).findings:
        if one.code not in ALWAYS:
            by_code.setdefault(one.code, []).append((one.line, dict(one.values)))
    return by_code


def two_holes(*between: str) -> dict[str, list[tuple[int, dict[str, object]]]]:
    return found("G92 X0 Y0", "G90", *HOLE, *between, *SECOND)


def two_passes(back: tuple[str, ...], *, side: str = "G42", second: str = "110") -> dict[str, object]:
    return dict(
        found(
            "H001=200",
            f"H002={second}",
            "G92 X0 Y0",
            "G90",
            "G41 G01 X10000 Y0 H001",
            *THERE,
            "G40 G01 X9000 Y0",
            f"{side} G01 X10000 Y0 H002",
            *back,
            "G40 G01 X0 Y0",
        )
    )


def test_a_rapid_from_hole_to_hole_with_the_wire_threaded_is_named() -> None:
    assert two_holes("G00 X20000 Y0") == {"ISO301": [(6, {"length": 20000.0, "rapid": "G00"})]}


@pytest.mark.parametrize(
    "between",
    [
        ("M00", "G00 X20000 Y0"),
        ("M01", "G00 X20000 Y0"),
        ("M21", "G00 X20000 Y0", "M20"),
        ("G00 X20000 Y0", "M00"),
        ("M00", "G92 X20000 Y0"),
    ],
)
def test_a_rapid_beside_a_stop_or_a_threading_is_sound(between: tuple[str, ...]) -> None:
    assert "ISO301" not in two_holes(*between)


def test_a_rapid_back_through_the_lead_in_is_sound() -> None:
    assert found("G92 X-9000 Y0", "G90", "G01 X-5000 Y0", "G02 I5000 J0", "G00 X-9000 Y0") == {}


def test_a_rapid_within_the_hole_that_was_cut_is_sound() -> None:
    assert found("G92 X0 Y0", "G90", "G01 X5000 Y0", "G03 I-5000 J0", "G00 X-3000 Y2000") == {}


def test_a_rapid_out_of_the_hole_that_was_cut_is_named() -> None:
    assert "ISO301" in found("G92 X0 Y0", "G90", "G01 X5000 Y0", "G03 I-5000 J0", "G00 X6000 Y0")


def test_a_rapid_before_the_first_cut_is_sound() -> None:
    assert found("G92 X0 Y0", "G90", "G00 X20000 Y0", *SECOND) == {}


def test_each_unsafe_rapid_of_a_program_is_named() -> None:
    third = ("G01 X45000 Y0", "G03 I-5000 J0", "G01 X40000 Y0")
    lines = found("G92 X0 Y0", "G90", *HOLE, "G00 X20000 Y0", *SECOND, "G00 X40000 Y0", *third)["ISO301"]

    assert [line for line, _ in lines] == [6, 10]


def test_the_first_rapid_under_compensation_is_named_with_how_many_follow() -> None:
    hole = ("G01 X5000 Y0", "G03 I-5000 J0", "M00")
    told = found("H001=100", "G92 X0 Y0", "G90", "G41 H001", *hole, "G00 X20000 Y0", "G00 X21000 Y0", *SECOND)

    assert told["ISO302"] == [(8, {"more": 1, "rapid": "G00"})]


def test_passes_there_and_back_over_one_contour_are_sound() -> None:
    assert two_passes(BACK) == {}


def test_a_corner_that_the_pass_back_has_elsewhere_is_named_with_how_far() -> None:
    strayed = tuple(line.replace("X-10000 Y10000", "X-9950 Y10000") for line in BACK)
    ((line, values),) = two_passes(strayed)["ISO306"]  # type: ignore[misc]

    assert line == 8  # the side that runs down to the corner, in the first pass
    assert values["number"] == 1
    assert values["by"] == pytest.approx(50.0 * 5.0 / 6.0, abs=1.0)


def test_a_drift_of_some_um_between_passes_is_sound() -> None:
    assert two_passes(tuple(line.replace("X-10000", "X-9996") for line in BACK)) == {}


def test_fillets_that_a_trim_has_in_its_corners_are_sound() -> None:
    rounded = (
        "G01 X10000 Y-9500",
        "G02 X9500 Y-10000 I-500 J0",
        *BACK[1:],
    )
    assert "ISO306" not in two_passes(rounded)


def test_an_offset_that_rises_is_named() -> None:
    ((_, values),) = two_passes(BACK, second="250")["ISO307"]  # type: ignore[misc]

    assert values["by"] == pytest.approx(50.0, abs=0.5)


def test_offsets_that_a_program_tells_are_held_to_the_um() -> None:
    assert two_passes(BACK, second="200") == {}
    assert "ISO307" in two_passes(BACK, second="201")


def test_a_side_that_does_not_turn_with_the_direction_is_named() -> None:
    assert "ISO308" in two_passes(BACK, side="G41")


def test_a_stop_before_the_last_of_a_loop_tells_the_tab() -> None:
    told = found("G92 X0 Y0", "G90", "G01 X10000 Y0", *THERE[:-1], "G01 X10000 Y-2000", "M01", THERE[-1], "G01 X0 Y0")

    assert told == {"ISO309": [(10, {"left": 2000.0})]}


@pytest.mark.parametrize(("stop", "told"), [("M01", {"ISO309": [(21, {"left": 2000.0})]}), ("M80", {})])
def test_a_stop_before_a_pass_over_the_tab_tells_its_length(stop: str, told: object) -> None:
    there = (*THERE[:-1], "G01 X10000 Y-2000", "G40 G01 X9000 Y-2000")
    back = ("G42 G01 X10000 Y-2000 H002", *BACK, "G40 G01 X9000 Y0")
    tab = (stop, "G42 G01 X10000 Y0 H002", "G01 X10000 Y-2000", "G40 G01 X0 Y0")

    assert found("H001=200", "H002=110", "G92 X0 Y0", "G90", "G41 G01 X10000 Y0 H001", *there, *back, *tab) == told


@pytest.mark.parametrize("at", [2, 3, 9])
def test_a_stop_elsewhere_is_no_tab(at: int) -> None:
    lines = ["G92 X0 Y0", "G90", "G01 X10000 Y0", *THERE, "G01 X0 Y0"]
    lines.insert(at, "M00")

    assert found(*lines) == {}


def test_a_reversed_arc_has_the_code_of_iso() -> None:
    lines = ["G01 X0 Y0", "G01 X5000 Y0", "G03 X5000 Y5800 I0 J2900", "G01 X-5000 Y5800", "G02 X-5000 Y0 I0 J-2900"]
    told = found("G92 X0 Y2900", "G90", *lines, "G01 X0 Y0")

    assert {code: [line for line, _ in of] for code, of in told.items()} == {"ISO219": [7]}


@pytest.mark.parametrize(("side", "second"), [("G42", "110"), ("G41", "-110")])
def test_a_pass_back_along_the_arc_that_the_pass_there_ended_with_is_sound(side: str, second: str) -> None:
    there = ("G41 G01 X10000 Y0 H001", "X-10000", "G02 Y20000 J10000", "G01 X10000", "G02 Y0 J-10000")
    back = (f"{side} G03 Y20000 J10000 H002", "G01 X-10000", "G03 Y0 J-10000", "G01 X10000")
    told = found("H001=200", f"H002={second}", "G92 X10000 Y8000", "G90", *there, *back, "G40 G01 X10000 Y8000")

    assert not {"ISO219", "ISO308"} & set(told)


def test_an_approach_there_and_back_before_the_contour_is_no_figure() -> None:
    square = ("X5000 Y0", "X5000 Y5000", "X-5000 Y5000", "X-5000 Y-5000", "X5000 Y-5000", "X5000 Y0")
    approach = ("G41 H000 G01 X500 Y500", "H001", "G01 X0 Y0")

    assert "3B310" not in found("H000=10", "H001=169", "G92 X0 Y0", "G90", *approach, *square, "G40 X0 Y0")


@pytest.mark.alike(4)
@pytest.mark.parametrize("family", FAMILIES)
def test_sound_programs_of_every_family_turn_no_arc_and_stray_nowhere(family: str) -> None:
    for seed in range(8):
        one = program(random.Random(seed), family)
        choices = Choices(dialect=one.family, registers=(("D0", 100.0), ("D1", 100.0)))
        checked = run_checks(load_program(one.text.encode(), "part.iso", choices), Demands())

        assert not {"ISO219", "ISO300", "ISO306", "ISO307", "3B310"} & {each.code for each in checked.findings}, seed


def test_a_program_in_3b_has_no_rapids_to_be_named() -> None:
    text = "B1000 B0 B1000 GX L1\nD\nB9000 B0 B9000 GX L1\nD\nB1000 B0 B1000 GX L1\nDD\n"
    checked = run_checks(load_program(text.encode(), "part.3b"), Demands())

    assert not [one for one in checked.findings if one.code.startswith("ISO")]
