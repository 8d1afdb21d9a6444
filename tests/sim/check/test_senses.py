"""Reversed arcs: sound shapes are silent, and the same with one arc the other way round name that arc."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from paths import Pen
from runs import codes, run_text

from parser.findings.codes import Severity
from parser.program import parse_program
from parser.shape.contours import contour_rows
from sim.check.file_check import check_program
from sim.check.geometry import ReversedArcs, retraced_arcs, reversed_arcs

HALF = math.pi / 2


def found(pen: Pen) -> ReversedArcs:
    path = pen.path()
    return reversed_arcs(path, contour_rows(path))


def rounded(reverse: int | None = None, lead: bool = True, back: bool = True) -> Pen:
    """A square of 10 mm with corners R 2, counter-clockwise; its corner number `reverse` runs the other way round."""
    pen = Pen(5000, 3000, cam=True) if lead else Pen(5000, 0, cam=True)
    if lead:
        pen.to(5000, 0)
    for i, (x, y, cx, cy, ex, ey) in enumerate(
        [
            (8000, 0, 8000, 2000, 10000, 2000),
            (10000, 8000, 8000, 8000, 8000, 10000),
            (2000, 10000, 2000, 8000, 0, 8000),
            (0, 2000, 2000, 2000, 2000, 0),
        ]
    ):
        pen.to(x, y).arc_to(ex, ey, cx, cy, -1 if i == reverse else 1)
    pen.to(5000, 0)
    return pen.to(5000, 3000) if lead and back else pen


@pytest.mark.parametrize("lead", [True, False])
@pytest.mark.parametrize("corner", range(4))
def test_a_reversed_corner_is_named(corner: int, lead: bool) -> None:
    arcs = found(rounded(corner, lead))
    assert arcs.row.tolist() == [2 * corner + 1 + lead]
    assert arcs.is_major.tolist() == [True]
    assert arcs.at_both_ends.tolist() == [True]
    assert arcs.sweep_rad == pytest.approx([-3 * HALF], abs=1e-2)
    assert arcs.other_sweep_rad == pytest.approx([HALF], abs=1e-2)


@given(st.floats(0.3, 6.0), st.floats(0.3, 6.0), st.floats(50, 9000), st.integers(0, 1), st.booleans())
def test_an_arc_between_tangents(turned: float, heading: float, radius: float, which: int, left: bool) -> None:
    """Line, arc, line, all smooth: silent; the arc the other way round: named."""
    assume(abs(turned - math.pi) > 0.1)
    side = 1 if left else -1
    pen = Pen().to(3000 * math.cos(heading), 3000 * math.sin(heading))
    normal = heading + side * HALF
    center = pen.x + radius * math.cos(normal), pen.y + radius * math.sin(normal)
    sweep = side * turned
    pen.arc(*center, sweep - side * 2 * math.pi if which else sweep)
    pen.to(pen.x + 2500 * math.cos(heading + sweep), pen.y + 2500 * math.sin(heading + sweep))
    assert found(pen).row.tolist() == ([1] if which else [])


def half_circles() -> Pen:
    return Pen(0, 0).to(5000, 0).arc(0, 0, math.pi).arc(0, 0, math.pi).to(0, 0)


def astroid() -> Pen:
    pen = Pen(0, 0).to(5000, 0)
    for x, y, cx, cy in (
        (0, 5000, 5000, 5000),
        (-5000, 0, -5000, 5000),
        (0, -5000, -5000, -5000),
        (5000, 0, 5000, -5000),
    ):
        pen.arc_to(x, y, cx, cy, -1)
    return pen


def tangent_lead(back: bool) -> Pen:
    """A half disc, entered by an arc at its corner and left along the same arc."""
    pen = Pen(-1000, -1000).arc(-1000, 0, HALF).to(0, 4000)  # arrives going up
    pen.arc(0, 2000, -math.pi)
    return pen.arc(-1000, 0, -HALF) if back else pen


@pytest.mark.parametrize(
    "pen",
    [
        rounded(),
        rounded(lead=False),
        rounded(back=False),
        half_circles(),
        astroid(),
        astroid().to(0, 0),
        tangent_lead(back=False),
        tangent_lead(back=True),
        Pen().arc(1000, 0, 1.0).arc(1000, 0, -1.0),  # slit along an arc
        Pen().arc(1000, 0, 2 * math.pi),
        Pen().to(1000, 0).to(0, 0),
        Pen().to(1000, 0).jump(0, 0),
    ],
)
def test_sound_shapes_are_silent(pen: Pen) -> None:
    assert found(pen).row.tolist() == []


def test_the_minor_arc_for_the_major_one() -> None:
    # A teardrop whose round end bulges inward.
    angle = math.radians(30)
    x, y = 1000 * math.sin(angle), 1000 * math.cos(angle)
    pen = Pen(2000, 0).to(x, y).arc_to(x, -y, 0, 0, -1).to(2000, 0)
    assert found(pen).row.tolist() == [1]
    assert found(pen).is_major.tolist() == [False]
    assert found(Pen(2000, 0).to(x, y).arc_to(x, -y, 0, 0, 1).to(2000, 0)).row.tolist() == []


LEAD, BACK = "B9900B0B9900GXL1", "B9900B0B9900GXL3"


@pytest.mark.parametrize(
    ("arcs", "block"),
    [
        ("B9900B0B19800GYSR4 B9900B0B19800GYNR3", 3),
        ("B9900B0B9900GXNR1 B0B9900B9900GYNR2 B9900B0B9900GXSR2 B0B9900B9900GYSR1", 4),
    ],
)
def test_a_hole_of_which_one_half_is_cut_there_and_back_is_named(arcs: str, block: int) -> None:
    findings = [f for f in run_text(f"{LEAD} {arcs} {BACK} DD").findings if f.code == "3B306"]
    assert [f.block for f in findings] == [block]


@pytest.mark.parametrize(
    "arcs",
    [
        "B9900B0B39600GYNR1 B9900B0B39600GYSR4",
        "B9900B0B19800GYNR1 B9900B0B19800GYNR3 B9900B0B19800GYSR4 B9900B0B19800GYSR2",
        "B9900B0B9900GXNR1 B0B9900B9900GYSR1",  # a slit
    ],
)
def test_a_second_pass_back_and_a_slit_are_silent(arcs: str) -> None:
    assert codes(run_text(f"{LEAD} {arcs} {BACK} DD")) == []


def arcs_of_a_circle(*sweeps: float, radius: float = 1000.0, off_um: float = 0.0) -> list[int]:
    """Where arcs about one centre turn back, in a circle that is cut in several."""
    pen = Pen(radius + 5000.0, 0.0).to(radius, 0.0)
    for number, sweep in enumerate(sweeps):
        pen.arc(0.0, off_um * number, sweep)
    path = pen.path()
    return retraced_arcs(path, contour_rows(path)).tolist()


@pytest.mark.parametrize(
    ("sweeps", "at"),
    [
        ((math.pi, -math.pi), [2]),
        ((-math.pi, math.pi), [2]),
        ((HALF, HALF, -HALF, -HALF), [3]),
        ((2.0, math.pi - 2.0, -math.pi), [3]),
        ((math.pi, math.pi), []),  # a circle
        ((HALF, -HALF), []),  # a slit of a quarter, there and back
        ((2 * math.pi, -2 * math.pi), []),  # two passes, there and back
        ((HALF, -HALF, HALF, -HALF), []),  # turns back three times
        ((math.pi, -HALF), []),
        ((math.pi,), []),
    ],
)
def test_one_turn_there_and_back_is_a_circle_half_of_which_runs_the_wrong_way(
    sweeps: tuple[float], at: list[int]
) -> None:
    assert arcs_of_a_circle(*sweeps) == at


@pytest.mark.parametrize(("miss_um", "is_told"), [(19.0, True), (-19.0, True), (21.0, False), (-21.0, False)])
def test_there_and_back_may_miss_by_20_um(miss_um: float, *, is_told: bool) -> None:
    radius = 5000.0
    assert arcs_of_a_circle(math.pi, -math.pi + miss_um / radius, radius=radius) == [2] * is_told


@pytest.mark.parametrize(("miss_um", "is_told"), [(9.0, True), (11.0, False)])
def test_of_a_small_circle_it_may_miss_by_a_tenth_of_the_radius(miss_um: float, *, is_told: bool) -> None:
    assert arcs_of_a_circle(math.pi, -math.pi + miss_um / 100.0, radius=100.0) == [2] * is_told


@pytest.mark.parametrize(("off_um", "is_told"), [(9.0, True), (11.0, False)])
def test_arcs_are_of_one_circle_where_their_centres_lie_within_10_um(off_um: float, *, is_told: bool) -> None:
    assert arcs_of_a_circle(math.pi, -math.pi, radius=5000.0, off_um=off_um) == [2] * is_told


def test_a_jump_parts_two_circles() -> None:
    pen = Pen(1000, 0).arc(0, 0, math.pi).jump(-1000, 0).arc(0, 0, -math.pi)
    path = pen.path()
    assert retraced_arcs(path, contour_rows(path)).tolist() == []
    both = (
        Pen(1000, 0).arc(0, 0, math.pi).arc(0, 0, -math.pi).jump(9000, 0).arc(8000, 0, -math.pi).arc(8000, 0, math.pi)
    )
    assert retraced_arcs(both.path(), contour_rows(both.path())).tolist() == [1, 4]


def test_an_arc_turns_at_both_its_ends_or_at_none() -> None:
    # One smooth joint tells that the arc runs as it was meant to.
    pen = Pen(0, -1000).to(3000, -1000).arc(3000, 0, -math.pi).to(9000, 1000)
    assert found(pen).row.tolist() == []


@pytest.mark.parametrize(("sense", "severity"), [("NR2", []), ("SR1", [(4, Severity.ERROR)])])
def test_a_cusp_at_both_ends_is_an_error(sense: str, severity: list[tuple[int, Severity]]) -> None:
    program = f"B5000B0B5000GXL1 B0B2900B5800GXNR4 B10000B0B10000GXL3 B0B2900B5800GX{sense} B5000B0B5000GXL1 DD"
    findings = check_program(parse_program(program)).findings
    assert [(each.block, each.severity) for each in findings if each.code == "3B306"] == severity


def test_of_a_cusp_at_one_end_alone_it_is_told() -> None:
    arcs = found(Pen().to(9000, 0).arc(9000, 3000, -math.pi))
    assert arcs.row.tolist() == [1]
    assert arcs.at_both_ends.tolist() == [False]


def test_an_overcut_on_a_circle_there_and_back_is_silent() -> None:
    """In whole µm the arc back has its centre 14 µm beside that of the arc there; the arcs lie within 1 µm."""
    circle = "B1400B0B1400GXL3 B1400B0B5600GYNR3 B1386B0B25GYNR3 B1400B25B25GYSR3 B1400B0B1400GXL1 DD"
    assert [each.code for each in check_program(parse_program(circle)).findings if each.code == "3B306"] == []
