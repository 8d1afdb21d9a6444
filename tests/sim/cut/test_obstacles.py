"""Clamps, arm and workpiece: first contacts against closed forms and a plain walk, and what counts as leaving."""

import math
import time
from itertools import pairwise

import numpy as np
import pytest
from depth import cases, examples
from hypothesis import example, given, settings
from hypothesis import strategies as st
from runs import plain_scenario

from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.geometry.curves import CurveKind, Floats
from parser.program import Program, parse_program
from parser.shape.contours import find_contours
from parser.toolpath import Point
from sim.cut.findings import missed_work_findings, obstacle_findings
from sim.cut.obstacles import Touch, grown, swept, touches, triangles, way_of
from sim.setup.machine.machine import load_machine
from sim.setup.obstacles import Clamp, Outline, read_outline
from sim.table.trace import Trace

RADIUS_UM = 90.0  # of the wire that the plain scenario has
EXACT_UM = 1e-3
SPEED_UM_S = 50.0


def outline(*points_um: tuple[float, float]) -> Outline:
    return read_outline({"outline_mm": [[x / 1000.0, y / 1000.0] for x, y in points_um]}, "test")


def box(left: float, bottom: float, right: float, top: float) -> Outline:
    return outline((left, bottom), (right, bottom), (right, top), (left, top))


def traced(program: Program, spacing_um: float = 5.0, aside_um: float = 0.0) -> Trace:
    """A trace exactly on the path at constant speed; the table stands beside the wire by so much in Y."""
    path = program.toolpath
    places, rows = [path.start_um[:1]], [np.zeros(1, dtype=np.int64)]
    for row, block in enumerate(path):
        share = np.arange(1, max(round(block.length_um / spacing_um), 1) + 1) / max(
            round(block.length_um / spacing_um), 1
        )
        if block.center_um is None:
            place = path.start_um[row] + share[:, None] * (path.end_um[row] - path.start_um[row])
        else:
            angle = block.start_angle_rad + share * block.sweep_rad
            place = path.center_um[row] + block.radius_um * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        places.append(place)
        rows.append(np.full(len(share), row))
    return trace_of(np.concatenate(places), np.concatenate(rows), aside_um)


def trace_of(wire_um: Floats, row: np.ndarray, aside_um: float = 0.0) -> Trace:
    along = np.cumsum(np.hypot(*np.diff(wire_um, axis=0, prepend=wire_um[:1]).T))
    return Trace(along / SPEED_UM_S, wire_um, wire_um + np.array([0.0, aside_um]), wire_um, row)


def found(
    text: str, *clamps: Outline, work: Outline | None = None, arm: Outline | None = None, **trace: float
) -> list[Finding]:
    """Findings of a program run exactly at 50 µm/s past clamps that are named a, b, c …"""
    program = parse_program(text)
    named = tuple(Clamp(name, clamp) for name, clamp in zip("abcdef", clamps, strict=False))
    scenario = plain_scenario(clamps=named, work_um=work, machine=load_machine("dk7740")._replace(arm_um=arm))
    corners = np.rint(np.concatenate([program.toolpath.start_um[:1], program.toolpath.end_um])).astype(np.int64)
    contours = find_contours(program.toolpath, corners)
    return obstacle_findings(program, traced(program, **trace), contours, scenario)


def place_um(finding: Finding) -> tuple[float, float]:
    return finding.values["x_mm"] * 1000.0, finding.values["y_mm"] * 1000.0


# Contacts in closed form


def test_a_wall_is_touched_when_the_centre_is_a_radius_away() -> None:
    (touch,) = found("B10000B0B10000GXL1 DD", box(5000, -1000, 6000, 1000))
    assert (touch.code, touch.block, touch.values["body"], touch.values["name"]) == ("3B404", 1, "wire", "a")
    assert place_um(touch) == pytest.approx((5000 - RADIUS_UM, 0), abs=EXACT_UM)
    assert touch.values["t_s"] == pytest.approx((5000 - RADIUS_UM) / SPEED_UM_S, abs=1e-6)


def test_a_corner_is_touched_on_a_circle_round_it() -> None:
    (touch,) = found("B10000B0B10000GXL1 DD", box(5000, 50, 6000, 1000))
    assert place_um(touch) == pytest.approx((5000 - math.sqrt(RADIUS_UM**2 - 50**2), 0), abs=EXACT_UM)


def test_a_clamp_that_the_wire_passes_by_a_hair_is_not_touched() -> None:
    assert found("B10000B0B10000GXL1 DD", box(5000, RADIUS_UM + 0.01, 6000, 1000)) == []
    assert len(found("B10000B0B10000GXL1 DD", box(5000, RADIUS_UM - 0.01, 6000, 1000))) == 1


def test_along_an_arc_the_contact_is_to_a_micron() -> None:
    # From (0, 0) round (-9900, 0) counter-clockwise; the wall lies across the circle on its far side.
    (touch,) = found("B9900B0B39600GYNR1 DD", box(-20000, -8000, -18000, 8000))
    x = -18000 + RADIUS_UM
    assert place_um(touch) == pytest.approx((x, math.sqrt(9900**2 - (x + 9900) ** 2)), abs=0.1)
    angle = math.acos((x + 9900) / 9900)
    assert touch.values["t_s"] == pytest.approx(9900 * angle / SPEED_UM_S, abs=1.0 / SPEED_UM_S)


def test_the_mouth_of_a_concave_clamp_is_open() -> None:
    u = outline(
        (5000, -1000), (9000, -1000), (9000, 1000), (5000, 1000), (5000, 500), (8000, 500), (8000, -500), (5000, -500)
    )
    (touch,) = found("B10000B0B10000GXL1 DD", u)
    assert place_um(touch) == pytest.approx((8000 - RADIUS_UM, 0), abs=EXACT_UM)


def test_a_cut_that_starts_in_a_clamp_touches_at_once() -> None:
    (touch,) = found("B10000B0B10000GXL1 DD", box(-500, -500, 500, 500))
    assert (place_um(touch), touch.values["t_s"]) == ((0.0, 0.0), 0.0)


def test_the_arm_touches_with_its_own_outline_where_the_table_stands() -> None:
    arm = outline((-300, -200), (2000, 0), (-300, 200))  # its tip 2 mm ahead of the wire
    (touch,) = found("B10000B0B10000GXL1 DD", box(5000, 100, 6000, 1000), arm=arm, aside_um=100.0)
    assert (touch.values["body"], touch.values["name"]) == ("arm", "a")
    assert place_um(touch) == pytest.approx((3000, 100), abs=EXACT_UM)


def test_a_jump_moves_the_arm_past_a_clamp_and_no_wire() -> None:
    text = "B1000B0B1000GXL1 D B9000B0B9000GXL1 D B0B1000B1000GYL2 DD"
    clamp, arm = box(5000, -100, 6000, 100), box(-50, -50, 50, 50)
    assert parse_program(text).toolpath.kind[1] == CurveKind.JUMP
    assert found(text, clamp) == []
    (touch,) = found(text, clamp, arm=arm)
    assert (touch.block, touch.values["body"]) == (2, "arm")
    assert place_um(touch) == pytest.approx((4950, 0), abs=EXACT_UM)


def test_each_clamp_tells_its_first_touch_by_each_body() -> None:
    there_and_back = "B9000B0B9000GXL1 B9000B0B9000GXL3 DD"
    first, second, far = box(2000, 0, 2100, 100), box(7000, 0, 7100, 100), box(0, 5000, 100, 6000)
    found_ = found(there_and_back, second, far, first, arm=box(-120, -120, 120, 120))
    assert [(f.block, f.values["name"], f.values["body"]) for f in found_] == [
        (1, "a", "wire"),
        (1, "a", "arm"),
        (1, "c", "wire"),
        (1, "c", "arm"),
    ]
    assert [round(place_um(f)[0], 3) for f in found_] == [6910, 6880, 1910, 1880]


# Against a plain walk


@st.composite
def outlines(draw: st.DrawFn, reach_um: int = 3000) -> Outline:
    """Stars round a place, convex or not, corners in one line now and then, at any angle and in either sense."""
    corners = draw(st.integers(3, 9))
    radii = draw(st.lists(st.integers(reach_um // 10, reach_um), min_size=corners, max_size=corners))
    x, y, turn = draw(st.integers(-3000, 3000)), draw(st.integers(-3000, 3000)), draw(st.integers(0, 360))
    angle = np.radians(turn) + 2.0 * np.pi * np.arange(corners) / corners
    points = np.array([x, y]) + np.array(radii)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    if draw(st.booleans()):
        points = np.insert(points, 1, points[:2].mean(axis=0), axis=0)
    return outline(*points[:: draw(st.sampled_from([1, -1]))].tolist())


@st.composite
def ways(draw: st.DrawFn) -> Floats:
    """Some points joined by straight moves of at most 30 µm."""
    ends = np.array(
        draw(st.lists(st.tuples(st.integers(-5000, 5000), st.integers(-5000, 5000)), min_size=2, max_size=4))
    )
    parts = [ends[:1].astype(np.float64)]
    for start, end in pairwise(ends):
        count = max(int(np.hypot(*(end - start)) / 30.0), 1)
        parts.append(start + np.arange(1, count + 1)[:, None] / count * (end - start))
    return np.concatenate(parts)


def depth_um(place: Floats, polygon: Outline) -> Floats:
    """Distance (n,) of places (n, 2) from a polygon, negative inside: every side, then a ray to the right."""
    corners = np.array(polygon)
    side = np.roll(corners, -1, axis=0) - corners
    to = place[:, None] - corners
    share = np.clip((to * side).sum(axis=2) / (side**2).sum(axis=1), 0.0, 1.0)
    off = to - share[..., None] * side
    above = to[..., 1] >= 0.0
    straddles = above != np.roll(above, -1, axis=1)
    right = (to[..., 1] * side[:, 0] - to[..., 0] * side[:, 1]) * np.sign(side[:, 1]) > 0.0
    inside = (straddles & right).sum(axis=1) % 2 == 1
    distance = np.hypot(off[..., 0], off[..., 1]).min(axis=1)
    return np.where(inside, -distance, distance)


def first(place: Floats, pieces: object) -> tuple[Touch | None, Floats]:
    """The first touch, and the way up to it, single points no further than 1 µm apart."""
    touch = next(touches(way_of(place, np.zeros(len(place), dtype=np.int64)), pieces), None)
    if touch is not None:
        sample, share = touch
        at = place[sample - 1] + share * (place[sample] - place[sample - 1])
        place = np.concatenate([place[:sample], at[None, :]])
    return touch, np.concatenate(
        [place[:-1] + part / 30.0 * np.diff(place, axis=0) for part in range(30)] + [place[-1:]]
    )


@settings(max_examples=examples(100))
@given(outlines(), ways())
def test_wire_touches_first_where_a_plain_walk_says(clamp: Outline, way: Floats) -> None:
    touch, before = first(way, grown(clamp, RADIUS_UM))
    distance = depth_um(before, clamp)
    assert touch == (1, 0.0) or (distance[:-1] >= RADIUS_UM - EXACT_UM).all()
    if touch is None:
        assert distance[-1] > RADIUS_UM
    elif touch == (1, 0.0):
        assert distance[-1] <= RADIUS_UM + EXACT_UM
    else:
        assert distance[-1] == pytest.approx(RADIUS_UM, abs=EXACT_UM)


@pytest.mark.deep
@settings(max_examples=len(cases(10, 1000)))
@given(outlines(), outlines(reach_um=1000), ways())
def test_arm_touches_first_where_a_plain_walk_says(clamp: Outline, arm: Outline, way: Floats) -> None:
    touch, before = first(way, swept(clamp, arm))
    gaps = np.array([gap_um(clamp, np.array(arm) + place) for place in before[:: max(len(before) // 300, 1)]])
    at_touch = gap_um(clamp, np.array(arm) + before[-1])
    if touch is None:
        assert min(gaps.min(), at_touch) > 0.0
    elif touch == (1, 0.0):
        assert at_touch <= EXACT_UM
    else:
        assert gaps[:-1].min() >= 0.0 if len(gaps) > 1 else True
        assert at_touch == pytest.approx(0.0, abs=EXACT_UM)


def gap_um(still: Outline, moved: Floats) -> float:
    """Distance of two polygons, −1 where they overlap: sides that cross, or one in the other."""
    other = tuple(Point(x, y) for x, y in moved.tolist())
    apart = min(depth_um(moved, still).min(), depth_um(np.array(still), other).min())
    return -1.0 if apart < -EXACT_UM or crosses(np.array(still), moved) else max(float(apart), 0.0)


def crosses(one: Floats, other: Floats) -> bool:
    def hands(a: Floats, b: Floats) -> Floats:
        side, to = np.roll(a, -1, axis=0) - a, b[None] - a[:, None]
        across = (side[:, None, 0] * to[..., 1] - side[:, None, 1] * to[..., 0]) / np.hypot(*side.T)[:, None]
        return np.where(np.abs(across) < EXACT_UM, 0.0, np.sign(across))

    def apart(a: Floats, b: Floats) -> Floats:
        hand = hands(a, b)
        return hand * np.roll(hand, -1, axis=1) < 0.0

    return bool((apart(one, other) & apart(other, one).T).any())


# Outlines cut up


def area_um2(corners: Floats) -> float:
    x, y = np.asarray(corners).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0


@given(outlines())
def test_triangles_fill_their_outline(polygon: Outline) -> None:
    pieces = triangles(polygon)
    areas = [area_um2(piece) for piece in pieces]
    assert min(areas) > 0.0
    assert sum(areas) == pytest.approx(area_um2(np.array(polygon)), rel=1e-9)
    assert (depth_um(pieces.mean(axis=1), polygon) <= EXACT_UM).all()


@example([1, 2, 2, 1, 3, 1, 4], 51)
@given(st.lists(st.integers(1, 4), min_size=1, max_size=12), st.integers(0, 360))
def test_triangles_fill_plates_with_steps_that_lie_askew(steps: list[int], degrees: int) -> None:
    # Corners in one line and right angles, rounded: pymunk's own decomposition crashes on some of these.
    top = [point for at in range(len(steps) - 1, -1, -1) for point in ((at + 1, steps[at]), (at, steps[at]))]
    points = np.array([(0, 0), (len(steps), 0), *top]) * 1000.0 / 3.0
    turn = math.radians(degrees)
    points = points @ np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    repeats = np.hypot(*np.diff(points, axis=0, prepend=points[-1:]).T) < 1.0
    polygon = outline(*points[~repeats].tolist())
    pieces = triangles(polygon)
    assert sum(area_um2(piece) for piece in pieces) == pytest.approx(sum(steps) * (1e6 / 9.0), rel=1e-9)
    assert (depth_um(pieces.mean(axis=1), polygon) <= EXACT_UM).all()


# Leaving the work

PLATE = box(-1000, -1000, 9000, 9000)
SQUARE_OUT = "B12000B0B12000GXL1 B0B5000B5000GYL2 B12000B0B12000GXL3 B0B5000B5000GYL4 DD"


def test_a_cut_that_leaves_the_work_is_told_once_a_contour() -> None:
    (left,) = found("B0B2000B2000GYL2" + SQUARE_OUT, work=PLATE)
    assert (left.code, left.block) == ("3B405", 2)
    assert place_um(left) == pytest.approx((9000, 2000), abs=EXACT_UM)
    assert left.values["t_s"] == pytest.approx(11000 / SPEED_UM_S, abs=1e-6)


def test_each_contour_tells_where_it_leaves() -> None:
    text = f"{SQUARE_OUT.removesuffix(' DD')} D B0B1000B1000GYL2 D {SQUARE_OUT}"
    lefts = found(text, work=PLATE)
    assert [(f.code, f.block) for f in lefts] == [("3B405", 1), ("3B405", 6)]


def missed(text: str, work: Outline) -> list[Finding]:
    program = parse_program(text)
    return missed_work_findings(program, traced(program), plain_scenario(work_um=work))


def test_a_program_cut_wholly_outside_of_the_work_misses_it() -> None:
    (finding,) = missed("B0B2000B2000GYL2" + SQUARE_OUT, box(-1000, 20_000, 9000, 30_000))
    assert (finding.code, finding.block, finding.severity) == ("3B408", 1, Severity.ERROR)
    assert place_um(finding) == pytest.approx((0, 0), abs=EXACT_UM)
    assert finding.values["t_s"] == 0.0


@pytest.mark.parametrize("text", [SQUARE_OUT, "D B0B20000B20000GYL4 D " + SQUARE_OUT])
def test_a_program_of_which_one_cut_meets_the_work_does_not_miss_it(text: str) -> None:
    assert missed(text, box(11_000, -90_000, 19_000, 90_000)) == []


@pytest.mark.parametrize(("low", "codes"), [(5099.0, []), (5101.0, ["3B408"])])
def test_a_program_whose_kerf_just_reaches_the_work_does_not_miss_it(low: float, codes: list[str]) -> None:
    text = "B5000B0B5000GXL1 B0B5000B5000GYL2 B5000B0B5000GXL3 B0B5000B5000GYL4 DD"
    assert [f.code for f in missed(text, box(low, -1000, 9000, 9000))] == codes


def test_leaving_on_an_arc_is_to_a_micron() -> None:
    (left,) = found("B0B100B100GYL2 B9900B0B39600GYNR1 B0B100B100GYL4 DD", work=box(-15000, -12000, 1000, 12000))
    x = -15000.0
    assert place_um(left) == pytest.approx((x, 100 + math.sqrt(9900**2 - (x + 9900) ** 2)), abs=0.1)


def test_lead_in_from_outside_and_lead_out_are_no_leaving() -> None:
    in_and_out = "B3000B0B3000GXL1 B0B3000B3000GYL2 B3000B0B3000GXL1 B0B3000B3000GYL4 B6000B0B6000GXL3 DD"
    assert found(in_and_out, work=box(2000, -5000, 9000, 5000)) == []
    across = "B12000B0B12000GXL1 DD"
    assert found(across, work=box(2000, -5000, 9000, 5000)) == []
    onwards = across.replace("DD", "B1000B0B1000GXL1 B1000B0B1000GXL1 DD")
    assert found(onwards, work=box(2000, -5000, 9000, 5000)) == []


def test_a_first_block_that_begins_in_the_work_may_not_leave_it() -> None:
    (left,) = found("B12000B0B12000GXL1 B12000B0B12000GXL3 DD", work=box(-2000, -5000, 9000, 5000))
    assert (left.block, place_um(left)) == (1, pytest.approx((9000, 0), abs=EXACT_UM))


@pytest.mark.parametrize("above_um", [-2.5, 0.0, 2.5])
def test_a_cut_along_the_edge_does_not_leave(above_um: float) -> None:
    # 12 mm along the upper edge, by which steps stray from it.
    text = "B0B4000B4000GYL2 B12000B0B12000GXL1 B0B4000B4000GYL4 B12000B0B12000GXL3 DD"
    assert found(text, work=box(-1000, -1000, 13000, 4000 + above_um)) == []
    assert len(found(text, work=box(-1000, -1000, 13000, 3990))) == 1


@pytest.mark.parametrize("above_um", [-0.5, 0.0, 0.5])
def test_a_lead_out_may_begin_on_the_edge(above_um: float) -> None:
    text = "B3000B0B3000GXL1 B0B4000B4000GYL2 B0B4000B4000GYL2 DD"
    assert found(text, work=box(-1000, -1000, 13000, 4000 + above_um)) == []
    assert len(found(text, work=box(-1000, -1000, 13000, 3990))) == 1


def test_a_notch_in_the_work_is_left_at_its_edge() -> None:
    notched = outline(
        (-1000, -5000),
        (9000, -5000),
        (9000, 5000),
        (5000, 5000),
        (5000, -500),
        (4000, -500),
        (4000, 5000),
        (-1000, 5000),
    )
    (left,) = found("B0B10B10GYL2 B8000B0B8000GXL1 B0B10B10GYL4 DD", work=notched)
    assert (left.block, place_um(left)) == (2, pytest.approx((4000, 10), abs=EXACT_UM))


@given(outlines(), ways())
def test_leaving_is_where_a_plain_walk_says(work: Outline, way: Floats) -> None:
    program = parse_program("B100B0B100GXL1 " * 3 + "DD")
    row = np.minimum(np.arange(len(way)) * 4 // len(way), 2)
    contours = find_contours(program.toolpath, np.zeros((4, 2), dtype=np.int64))
    scenario = plain_scenario(work_um=work)
    lefts = obstacle_findings(program, trace_of(way, row), contours, scenario)
    expected = plain_leaving(depth_um(way, work), row)
    assert [f.block - 1 for f in lefts] == [int(row[sample]) for sample in expected]
    for left, sample in zip(lefts, expected, strict=True):
        assert depth_um(np.array([place_um(left)]), work) == pytest.approx(0.0, abs=EXACT_UM)
        along = np.hypot(*np.diff(way[: sample + 1], axis=0).T)
        assert along[:-1].sum() - 1e-6 <= left.values["t_s"] * SPEED_UM_S <= along.sum() + 1e-6


def plain_leaving(depth: Floats, row: np.ndarray) -> list[int]:
    """Sample of the leaving by going from sample to sample; three blocks of one contour."""
    inside = depth[0] <= 0.0
    quiet, crossing = {2} if inside else {0, 2}, 0
    for sample in range(1, len(depth)):
        if depth[sample - 1] <= 0.0 < depth[sample]:
            crossing = sample
        if abs(depth[sample]) > 3.0:
            if inside and depth[sample] > 0.0 and not quiet & {int(row[crossing]), int(row[sample])}:
                return [crossing]
            inside = depth[sample] < 0.0
    return []


def test_jumps_leave_no_work() -> None:
    text = "B1000B0B1000GXL1 D B20000B0B20000GXL1 D B1000B0B1000GXL1 DD"
    assert found(text, work=PLATE) == []


# Speed and order


def long_trace(samples: int) -> tuple[Program, Trace]:
    """A circle of 100 mm radius over 20 blocks."""
    program = parse_program("B100B0B100GXL1 " * 20 + "DD")
    angle = np.linspace(0.0, 2.0 * np.pi, samples)
    circle = 1e5 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return program, trace_of(circle, np.arange(samples) * 20 // samples)


def timed(clamps: tuple[Clamp, ...], trace: Trace, program: Program) -> tuple[float, list[Finding]]:
    scenario = plain_scenario(clamps=clamps)
    start = time.process_time()
    found_ = obstacle_findings(program, trace, (), scenario)
    return time.process_time() - start, found_


def test_half_a_million_samples_are_looked_at_in_time() -> None:
    program, trace = long_trace(500_000)
    far = tuple(Clamp(str(x), box(x, 200_000, x + 20_000, 220_000)) for x in (0, 30_000, 60_000))
    seconds, found_ = timed(far, trace, program)
    assert (seconds < 0.5, found_) == (True, [])
    angle = 2.0 * np.pi * np.arange(48) / 48
    ring = 1e5 * 0.998 * np.stack([np.cos(angle), np.sin(angle)], axis=1)  # its corners 0.2 mm inside the circle
    seconds, found_ = timed((Clamp("inside", outline(*ring.tolist())),), trace, program)
    assert (seconds < 5.0, found_) == (True, [])


def test_nothing_in_the_way_costs_and_finds_nothing() -> None:
    assert found("B10000B0B10000GXL1 DD", arm=box(-50, -50, 50, 50)) == []
