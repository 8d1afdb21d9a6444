"""Arcs: centres on the bisector, senses, full circles, R, and what makes none."""

import math

import numpy as np
import pytest

from parser.findings.codes import Severity
from parser.geometry.curves import CurveKind
from parser.iso.path.rows import ROUNDING, arcs_about
from tests.tools.iso_reading import findings, path, read

HEAD = "G92 X0 Y0\nG90\n"


def rounded_arcs(count: int, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Start, end, centre rounded to 1 µm, turn and true sweep of arcs on circles of 0.05 to 50 mm."""
    rng = np.random.default_rng(seed)
    center, radius = rng.uniform(-1e5, 1e5, (count, 2)), 10 ** rng.uniform(1.7, 4.7, count)
    first, sweep, turn = rng.uniform(0, 2 * np.pi, count), rng.uniform(0.05, 6.2, count), rng.choice([-1.0, 1.0], count)
    start, end = (
        center + radius[:, None] * np.column_stack([np.cos(at), np.sin(at)]) for at in (first, first + turn * sweep)
    )
    return np.rint(start), np.rint(end), np.rint(center), turn, sweep


def test_rounded_arcs_keep_their_ends_and_stay_near_their_circles() -> None:
    start, end, center, turn, sweep = rounded_arcs(5000, seed=3)
    arcs = arcs_about(start, end, center, turn)
    radii = np.hypot(*(start - center).T)
    assert (np.abs(arcs.differ_um) <= ROUNDING).all()
    assert (np.sign(arcs.sweep_rad) == turn).all()
    assert (np.abs(np.abs(arcs.sweep_rad) - sweep) * radii <= 8.0 + 0.01 * radii).all()
    for at in (start, end):
        assert (np.abs(np.hypot(*(at - arcs.center_um).T) - arcs.radius_um) <= ROUNDING / 2 + 1e-9).all()


def test_short_arcs_end_exactly_on_their_circles() -> None:
    start, end, center, turn, sweep = rounded_arcs(5000, seed=4)
    short = (sweep < np.pi) & (np.hypot(*(end - start).T) > 20)
    arcs = arcs_about(start[short], end[short], center[short], turn[short])
    for at in (start[short], end[short]):
        assert np.allclose(np.hypot(*(at - arcs.center_um).T), arcs.radius_um, rtol=1e-12)


def test_long_arcs_stay_within_a_few_roundings_of_the_circle_that_is_written() -> None:
    start, end, center, turn, sweep = rounded_arcs(5000, seed=5)
    long = sweep > np.pi
    arcs = arcs_about(start[long], end[long], center[long], turn[long])
    shift = np.hypot(*(arcs.center_um - center[long]).T)
    assert (shift <= 2 * np.abs(arcs.differ_um) + 1e-9).all()


@pytest.mark.parametrize(("word", "sweep"), [("G02", -math.pi / 2), ("G03", 3 * math.pi / 2)])
def test_the_sense_is_that_of_the_word(word: str, sweep: float) -> None:
    toolpath = path(f"{HEAD}{word} X10 Y10 I10\nM02")
    assert toolpath.sweep_rad[0] == pytest.approx(sweep)
    assert toolpath.center_um[0].tolist() == [10.0, 0.0]
    assert toolpath.length_um[0] == pytest.approx(10 * abs(sweep))


@pytest.mark.parametrize("end", ["", "X0 Y0 ", "X0 "])
def test_an_arc_back_to_its_start_is_a_whole_circle(end: str) -> None:
    toolpath = path(f"{HEAD}G03 {end}I-10\nM02")
    assert toolpath.sweep_rad[0] == 2 * math.pi
    assert toolpath.length_um[0] == pytest.approx(20 * math.pi)


@pytest.mark.parametrize(("radius", "sweep"), [("R10", math.pi / 2), ("R-10", 3 * math.pi / 2)])
def test_a_negative_radius_is_the_longer_way(radius: str, sweep: float) -> None:
    toolpath = path(f"G92 X30 Y-7\nG91 G03 X10 Y10 {radius}\nM02")
    assert toolpath.sweep_rad[0] == pytest.approx(sweep)
    assert toolpath.radius_um[0] == pytest.approx(10.0)


@pytest.mark.parametrize(("chord", "is_arc"), [(20, True), (22, True), (23, False)])
def test_a_radius_may_be_short_by_rounding_only(chord: int, is_arc: bool) -> None:
    text = f"{HEAD}G02 X{chord} Y0 R10\nM02"
    assert path(text).is_arc.tolist() == [is_arc]
    assert [one.values for one in findings(text, "ISO213")] == ([] if is_arc else [{"chord": 23.0, "reach": 20.0}])


@pytest.mark.parametrize(
    ("block", "code", "column"),
    [
        ("G02 X10 Y10", "ISO210", 1),
        ("G02 X10 Y0 I0 J0", "ISO211", 12),
        ("G02 X10 Y0 R0", "ISO211", 12),
        ("G02 X100 Y0 R10", "ISO213", 13),
        ("G02 X0 Y0 R10", "ISO214", 11),
        ("G90.1 G02 X10 Y10 I10", "ISO210", 1),
    ],
)
def test_what_makes_no_arc_is_told_at_its_word_and_leaves_the_path_in_doubt(block: str, code: str, column: int) -> None:
    program = read(f"{HEAD}{block}\nM02")
    of_arcs = [one for one in program.findings if one.code.startswith("ISO21") and one.code != "ISO216"]
    assert [(one.code, one.line, one.column, one.block) for one in of_arcs] == [(code, 3, column, 1)]
    assert program.toolpath.kind.tolist() == [CurveKind.LINE]
    assert [one.after for one in program.reading.damages] == [0]


def test_of_a_block_that_is_told_to_be_a_line_and_an_arc_only_that_is_said() -> None:
    program = read(f"{HEAD}G01 G02 X10000 Y0\nG02 X20000 Y0\nM02")
    assert [(one.code, one.line) for one in program.findings if one.code != "ISO112"] == [("ISO200", 3), ("ISO210", 4)]
    assert len(program.reading.damages) == 2


@pytest.mark.parametrize(
    ("first", "severity"),
    [(5001, None), (5002, Severity.WARNING), (5010, Severity.WARNING), (5011, Severity.ERROR)],
)
def test_radii_that_differ_are_silent_a_warning_or_an_error(first: int, severity: Severity | None) -> None:
    text = f"{HEAD}G02 X10000 Y0 I{first}\nM02"
    assert [one.severity for one in findings(text, "ISO212")] == ([severity] if severity else [])
    toolpath = path(text)
    assert toolpath.end_um[0].tolist() == [10_000.0, 0.0]
    assert toolpath.center_um[0].tolist() == [5000.0, 0.0]


def test_the_difference_of_radii_is_told_with_both() -> None:
    (found,) = findings(f"{HEAD}G02 X10000 Y0 I5020\nM02", "ISO212")
    assert {name: found.values[name] for name in ("start", "end", "off")} == {
        "start": 5020.0,
        "end": 4980.0,
        "off": 40.0,
    }
    assert (found.line, found.column) == (3, 15)
    assert found.values["limit"] == pytest.approx(2 * math.sqrt(2), abs=1e-3)


@pytest.mark.parametrize(
    ("blocks", "codes"),
    [
        ("G01 X5000 Y..5\nG03 X-3000 Y5000 I-4000 J0", []),
        ("G01 X5000 Y..5\nG03 X-3000 Y5000 R3000", []),
        ("G01 X5000 Y..5\nG01 X5000 Y5000\nG03 X-3000 Y5000 I-4020 J0", ["ISO212"]),
        ("G01 X5000 Y..5\nG91 G03 X-8000 I-4020", ["ISO212"]),
        ("G01 X5000 Y..5\nG03 X-3000 Y5000", ["ISO210"]),
    ],
)
def test_an_arc_is_judged_by_places_only_where_they_are_known(blocks: str, codes: list[str]) -> None:
    of_arcs = [one.code for one in read(f"{HEAD}{blocks}\nM02").findings if one.code.startswith("ISO21")]
    assert [code for code in of_arcs if code != "ISO216"] == codes


def test_an_arc_in_a_subprogram_is_told_once() -> None:
    text = f"{HEAD}G91\nM98 P1 L3\nM02\nN1 G02 X10000 Y0 I5020\nM99"
    assert [(one.line, one.block) for one in findings(text, "ISO212")] == [(6, 1)]


@pytest.mark.parametrize(
    ("body", "what"),
    [
        ("G01 X1\nG03 X1 Y0 I-5000\nG01 X2", "circle-for-tiny"),
        ("G01 X2\nG03 X2 Y0 I-5000\nG01 X2000", "circle-for-tiny"),
        ("G01 X2000\nG03 X2000 Y0 I-5000\nG01 X2002", "circle-for-tiny"),
        ("G01 X5000\nG03 X5000 Y1 I-5000\nG01 X0 Y0", "tiny-for-circle"),
    ],
)
def test_circles_and_arcs_of_nothing_that_may_be_each_other_are_told(body: str, what: str) -> None:
    (found,) = findings(f"{HEAD}{body}\nM02", "ISO217")
    assert found.values["what"] == what
    assert found.values["full"] == pytest.approx(math.tau * 5000)


@pytest.mark.parametrize(
    "body",
    [
        "G01 X5000\nG03 X5000 Y0 I-5000\nG01 X0",
        "G01 X3\nG03 X3 Y0 I-5000\nG01 X6",
        "G01 X5000\nG03 I-5000\nG01 X5001",
        "G01 X5000\nG03 X5000 Y2 I-5000\nG01 Y900",
    ],
)
def test_circles_between_leads_and_short_arcs_on_their_way_are_sound(body: str) -> None:
    assert not findings(f"{HEAD}{body}\nM02", "ISO217")
