"""Compensation told by programs: changes while it is on, jumps, whole contours, and what holds for any program."""

import cmath
import math
import random
from dataclasses import replace

import numpy as np
import pytest
import shapely
from compensating import LINUXCNC, TEXTBOOK, To, area_mm2, drawn_mm, moves_mm, told
from depth import examples
from drawings import Line
from hypothesis import given, settings
from hypothesis import strategies as st
from paths import Pen
from plain_compensation import Leg, plain_path
from sound_shapes import SHAPES, Shape, run_round

from controller.offset.chain import OffsetPath, RowOrigin
from controller.offset.compensate import compensate
from controller.offset.joints import JointKind, joint_kinds
from controller.offset.programmed import Compensated, compensated
from controller.offset.shifted import OffsetSection, Side
from controller.offset.stretches import AlarmKind
from parser.controller_words import CompensationRules
from parser.geometry.along import places_at
from parser.geometry.curves import CurveKind, Curves
from parser.toolpath import Toolpath

SAME_UM = 1e-6
LENGTHEN = CompensationRules(outer="lengthen")
ROUND = CompensationRules(outer="arc")


def ends_mm(made: Compensated) -> list[tuple[float, float]]:
    return [(round(move.x, 6), round(move.y, 6)) for move in moves_mm(made.path.curves)]


def alarms(made: Compensated) -> list[tuple[AlarmKind, int, bool]]:
    return [tuple(alarm) for alarm in made.alarms]


def line(*places: tuple[float, float]) -> Toolpath:
    """Lines from the first place in mm through the others."""
    return drawn_mm(places[0], [To(*place) for place in places[1:]]).path()


# Changes while compensation is on


def test_a_block_with_another_offset_begins_at_the_old_and_ends_at_the_new() -> None:
    path = line((-5, 0), (0, 0), (10, 0), (20, 0), (20, 10), (20, 20))
    made = compensated(told(path, 1, [1000.0, 1000.0, 500.0, 500.0, 200.0]))
    assert ends_mm(made) == [(0, 1), (10, 1), (19.5, 0.5), (19.5, 10), (19.8, 20)]
    assert alarms(made) == [
        (AlarmKind.OFFSET_CHANGED, 2, False),
        (AlarmKind.OFFSET_CHANGED, 4, False),
        (AlarmKind.NO_CANCEL, 4, False),
    ]
    assert made.path.made.tolist() == [RowOrigin.LEAD, *[RowOrigin.SHIFTED] * 4]


def test_a_change_stops_a_controller_that_takes_none() -> None:
    path = line((-5, 0), (0, 0), (10, 0), (20, 0), (30, 0))
    made = compensated(told(path, [1, 1, 1, -1], [1000.0, 1000.0, 500.0, 500.0], LINUXCNC))
    assert [alarm for alarm in alarms(made) if alarm[2]] == [
        (AlarmKind.OFFSET_CHANGED, 2, True),
        (AlarmKind.SIDE_CHANGED, 3, True),
    ]


def test_the_block_behind_a_set_up_may_have_another_offset() -> None:
    """As programs approach at a small offset and cut the contour at that of the pass."""
    path = line((0, -5), (0, 0), (10, 0), (10, 10), (20, 10))
    made = compensated(told(path, [1, 1, 1, 0], [10.0, 200.0, 200.0, 0.0]))
    assert ends_mm(made) == [(0, 0.01), (9.8, 0.2), (9.8, 10), (20, 10)]


def test_an_arc_with_another_offset_begins_at_its_own() -> None:
    path = drawn_mm((-5, 0), [To(0, 0), To(10, 0), To(15, 5, 10, 5, 1)]).path()
    made = compensated(told(path, 1, [1000.0, 1000.0, 500.0]))
    assert ends_mm(made) == [(0, 1), (10, 1), (10, 0.5), (14.5, 5)]
    assert made.path.made.tolist() == [RowOrigin.LEAD, RowOrigin.SHIFTED, RowOrigin.BRIDGE, RowOrigin.SHIFTED]
    assert made.path.source_row.tolist() == [0, 1, 1, 2]


def test_a_change_to_nothing_and_back_is_a_wedge() -> None:
    path = line((-5, 0), (0, 0), (10, 0), (20, 0), (30, 0), (40, 0))
    made = compensated(told(path, 1, [1000.0, 1000.0, 0.0, 0.0, 1000.0]))
    assert ends_mm(made) == [(0, 1), (10, 1), (20, 0), (30, 0), (40, 1)]


def test_a_new_side_crosses_over_between_two_blocks() -> None:
    made = compensated(told(line((-5, 0), (0, 0), (10, 0), (20, 0)), [1, 1, -1], 1000.0))
    assert ends_mm(made) == [(0, 1), (10, 1), (10, -1), (20, -1)]
    assert alarms(made)[0] == (AlarmKind.SIDE_CHANGED, 2, False)
    assert made.stretches == ((0, 3, -1),)


def test_a_pass_back_on_the_other_side_stays_on_one_side_of_the_contour() -> None:
    """Skims run back and forth: the side changes where the way turns back, and nothing lies between."""
    there = [(0, 0), (10, 0), (10, 10), (20, 10)]
    path = line((-5, 0), *there, *there[-2::-1], (-5, 0))
    made = compensated(told(path, [1, 1, 1, 1, -1, -1, -1, 0], 200.0))
    assert ends_mm(made) == [
        *[(0, 0.2), (9.8, 0.2), (9.8, 10.2), (20, 10.2)],
        *[(9.8, 10.2), (9.8, 0.2), (0, 0.2), (-5, 0)],
    ]
    assert RowOrigin.BRIDGE not in made.path.made


@pytest.mark.parametrize("by_um", [200.0, 1e-7])
def test_a_pass_back_along_an_arc_leaves_no_gap(by_um: float) -> None:
    moves = [To(0, 0), To(3, 1, 0.3, 4.1, 1), To(0, 0, 0.3, 4.1, -1), To(-5, 0)]
    path = compensated(told(drawn_mm((-5, 0), moves).path(), [1, 1, -1, 0], by_um)).path
    assert np.array_equal(path.curves.start_um[1:], path.curves.end_um[:-1])
    assert path.curves.length_um[path.made == RowOrigin.BRIDGE].sum() == 0.0


# Jumps


def test_a_jump_is_compensated_as_any_block() -> None:
    path = Pen(-5000, 0).to(0, 0).to(10_000, 0).jump(10_000, 10_000).to(20_000, 10_000).path()
    made = compensated(told(path, 1, 1000.0))
    assert ends_mm(made) == [(0, 1), (9, 1), (9, 11), (20, 11)]
    assert made.path.curves.kind.tolist() == [CurveKind.LINE, CurveKind.LINE, CurveKind.JUMP, CurveKind.LINE]


@pytest.mark.parametrize("rules", [TEXTBOOK, LENGTHEN, ROUND])
def test_nothing_is_inserted_beside_a_jump(rules: CompensationRules) -> None:
    path = Pen(-5000, 0).to(0, 0).to(10_000, 0).jump(0, -10_000).to(10_000, -10_500).path()
    made = compensated(told(path, 1, 1000.0, rules))
    assert RowOrigin.BRIDGE not in made.path.made
    assert ends_mm(made)[1] == (10, 1)
    assert made.path.curves.kind[2] == CurveKind.JUMP


def test_no_jump_takes_a_cut_away() -> None:
    """The jump turns so sharply that its joint with the short cut lies beyond the begin of that one."""
    path = Pen(-5000, 0).to(0, 0).to(10_000, 0).to(10_000, 3000).jump(9000, -20_000).to(0, -20_000).path()
    made = compensated(told(path, 1, 1000.0))
    assert len(made.path.vanished) == 0
    assert ends_mm(made)[2] == (9, 3)


def test_jumps_set_up_and_cancel_as_jumps() -> None:
    path = Pen(-5000, 0).jump(0, 0).to(10_000, 0).jump(10_000, -5000).path()
    made = compensated(told(path, [1, 1, 0], 1000.0))
    assert ends_mm(made) == [(0, 1), (10, 1), (10, -5)]
    assert made.path.curves.kind.tolist() == [CurveKind.JUMP, CurveKind.LINE, CurveKind.JUMP]
    assert made.path.made.tolist() == [RowOrigin.LEAD, RowOrigin.SHIFTED, RowOrigin.LEAD]


# Stretches


def test_a_program_without_a_side_stays_as_it_is() -> None:
    path = line((0, 0), (10, 0), (10, 10))
    made = compensated(told(path, 0, 0.0))
    assert np.array_equal(made.path.curves.end_um, path.end_um)
    assert made.path.made.tolist() == [RowOrigin.AS_IT_IS] * 2
    assert (made.alarms, made.stretches) == ((), ())


def test_a_toolpath_that_tells_of_none_is_no_input() -> None:
    with pytest.raises(ValueError, match="compensation"):
        compensated(line((0, 0), (1, 0)))


def test_each_stretch_is_by_itself() -> None:
    path = line((0, 0), (10, 0), (20, 0), (20, 5), (30, 5), (40, 5), (40, 10), (50, 10))
    made = compensated(told(path, [1, 1, 0, -1, -1, 0, 0], [500.0, 500.0, 0.0, 200.0, 200.0, 0.0, 0.0]))
    assert ends_mm(made) == [(10, 0.5), (20, 0.5), (20, 5), (30, 4.8), (40, 4.8), (40, 10), (50, 10)]
    assert made.stretches == ((0, 2, 2), (3, 5, 5))
    assert alarms(made) == []


def test_a_plain_outline_stays_as_it_is_beside_its_compensated_twin() -> None:
    outline = ((0, 0), (0, 10), (10, 10), (10, 0), (0, 0), (-5, 0))
    path = line((-5, 0), *outline, *outline)
    made = compensated(told(path, [0] * 6 + [1] * 5 + [0], [0.0] * 6 + [100.0] * 5 + [0.0]))
    beside = [(-0.1, 0), (-0.1, 10.1), (10.1, 10.1), (10.1, -0.1), (0, -0.1), (-5, 0)]
    assert ends_mm(made) == [*outline, *beside]
    assert made.path.made.tolist() == [
        *[RowOrigin.AS_IT_IS] * 6,
        RowOrigin.LEAD,
        *[RowOrigin.SHIFTED] * 4,
        RowOrigin.LEAD,
    ]
    assert alarms(made) == []


@pytest.mark.parametrize("rules", [TEXTBOOK, LINUXCNC])
def test_a_set_up_without_a_block_behind_it_ends_on_its_own_normal(rules: CompensationRules) -> None:
    made = compensated(told(line((0, 0), (10, 0), (10, -10)), [1, 0], 500.0, rules))
    assert ends_mm(made) == [(10, 0.5), (10, -10)]
    assert made.stretches == ((0, 1, 1),)


def test_blocks_without_length_neither_set_up_nor_cancel() -> None:
    path = line((0, 0), (0, 0), (0, 5), (10, 5), (10, 5), (10, 0), (10, 0))
    made = compensated(told(path, [1, 1, 1, 0, 0, 0], [500.0] * 3 + [0.0] * 3))
    assert made.stretches == ((1, 3, 4),)
    assert ends_mm(made) == [(0, 5.5), (10, 5.5), (10, 0), (10, 0)]
    assert made.path.vanished.tolist() == [0, 3]
    assert alarms(made) == []


def test_a_stretch_without_a_value_stays_as_it_is_and_says_so() -> None:
    path = line((0, 0), (10, 0), (20, 0), (20, 5), (30, 5), (40, 5), (40, 10))
    made = compensated(told(path, [1, 1, 0, -1, -1, 0], [500.0, math.nan, 0.0, 200.0, 200.0, 0.0]))
    assert ends_mm(made) == [(10, 0), (20, 0), (20, 5), (30, 4.8), (40, 4.8), (40, 10)]
    assert alarms(made) == [(AlarmKind.UNKNOWN, 1, False)]
    assert made.stretches == ((3, 5, 5),)


def test_each_register_without_a_value_is_told() -> None:
    path = told(line((0, 0), (10, 0), (20, 0), (20, 5), (30, 5)), 1, math.nan)
    named = replace(path.compensation, register=("D1", "D1", "D2", "D1"))
    made = compensated(replace(path, compensation=named))
    assert alarms(made) == [(AlarmKind.UNKNOWN, row, False) for row in (0, 2, 3)]


def test_an_arc_larger_than_the_offset_may_vanish_between_its_neighbours() -> None:
    """Of radius 2 mm at an offset of 1 mm, but shorter than what its two corners take of it."""
    moves = [To(0, 0), To(10, 0), To(10.4, 0.4, 8.8, 1.6, 1), To(10.4, 10)]
    made = compensated(told(drawn_mm((-5, 0), moves).path(), 1, 1000.0))
    assert ends_mm(made) == [(0, 1), (9.4, 1), (9.4, 10)]
    assert alarms(made)[0] == (AlarmKind.VANISHED, 2, False)


# Whole contours

SQUARE = [To(10, 0), To(10, 10), To(0, 10), To(0, 0)]
L_SHAPE = [To(20, 0), To(20, 10), To(10, 10), To(10, 20), To(0, 20), To(0, 0)]
WEDGE = [To(10, 0), To(10, 3), To(0, 0)]
ROUNDED = [
    *[To(18, 0), To(20, 2, 18, 2, 1), To(20, 8), To(18, 10, 18, 8, 1)],
    *[To(2, 10), To(0, 8, 2, 8, 1), To(0, 2), To(2, 0, 2, 2, 1)],
]
HALF_DISC = [To(5, 0), To(-5, 0, 0, 0, 1)]
SMALL_CORNER = [To(10, 0), To(10.05, 0.05, 10, 0.05, 1), To(10.05, 10), To(0, 10), To(0, 0)]
CONTOURS = [
    # Figures in mm and mm², equal to 6 digits by two other programs, for an offset of 0.1 mm.
    ("square", SQUARE, -1, LENGTHEN, 40.8, 104.04),
    ("square", SQUARE, -1, ROUND, 40.628319, 104.031416),
    ("square", SQUARE, 1, TEXTBOOK, 39.2, 96.04),
    ("L", L_SHAPE, -1, TEXTBOOK, 80.8, 308.04),
    ("L", L_SHAPE, -1, ROUND, 80.585398, 308.029270),
    ("L", L_SHAPE, 1, TEXTBOOK, 79.2, 292.04),
    ("L", L_SHAPE, 1, ROUND, 79.157080, 292.042146),
    ("wedge", WEDGE, -1, TEXTBOOK, 24.250216, 17.386482),
    ("wedge", WEDGE, -1, ROUND, 24.068625, 17.375447),
    ("wedge", WEDGE, 1, TEXTBOOK, 21.608813, 12.747544),
    *(("rounded", ROUNDED, -1, rules, 57.194689, 202.254423) for rules in (TEXTBOOK, LENGTHEN, ROUND)),
    ("rounded", ROUNDED, 1, TEXTBOOK, 55.938052, 190.941149),
    ("half disc", HALF_DISC, -1, ROUND, 26.336282, 41.872120),
    ("half disc", HALF_DISC, 1, TEXTBOOK, 24.991749, 36.734888),
    ("small corner", SMALL_CORNER, -1, LENGTHEN, 40.835619, 104.545171),
    ("small corner", SMALL_CORNER, -1, ROUND, 40.706858, 104.538733),
    ("small corner", SMALL_CORNER, 1, TEXTBOOK, 39.3, 96.53),
]


def around(contour: list[To], side: int) -> Toolpath:
    """A contour that begins with a line, begun amid that line, behind a set-up from the wire's side."""
    first, last = contour[0], contour[-1]
    x, y = 0.5 * (first.x + last.x), 0.5 * (first.y + last.y)
    to_left = -(first.y - last.y), first.x - last.x
    by = 0.2 * side / math.hypot(*to_left)
    return drawn_mm((x + by * to_left[0], y + by * to_left[1]), [To(x, y), *contour, To(x, y)]).path()


def without_leads(path: OffsetPath) -> Curves:
    return path.curves.picked(path.made != RowOrigin.LEAD)


@pytest.mark.parametrize(
    ("contour", "side", "rules", "length_mm", "area"),
    [pytest.param(*row[1:], id=f"{row[0]} {'right' if row[2] < 0 else 'left'} {row[3].outer}") for row in CONTOURS],
)
def test_closed_contours(contour: list[To], side: int, rules: CompensationRules, length_mm: float, area: float) -> None:
    made = compensated(told(around(contour, side), side, 100.0, rules))
    ring = without_leads(made.path)
    assert ring.end_um[-1] == pytest.approx(ring.start_um[0], abs=SAME_UM)
    assert 0.001 * ring.length_um.sum() == pytest.approx(length_mm, abs=1e-6)
    assert area_mm2(ring) == pytest.approx(area, abs=1e-6)


def test_a_neck_is_run_through_as_a_controller_does() -> None:
    """It looks at neighbours alone: the path runs 50 µm into both walls of a neck of 0.15 mm."""
    neck = [To(12, 0), To(12, 4), To(8, 4), To(8, 2.05), To(4, 2.05), To(4, 4), To(0, 4), To(0, 0), To(4, 0)]
    neck = [To(4, 0), To(4, 1.9), To(8, 1.9), To(8, 0), *neck[:-2], To(0, 0)]
    made = compensated(told(around(neck, 1), 1, 100.0))
    assert len(made.path.vanished) == 0
    assert 0.001 * without_leads(made.path).length_um.sum() == pytest.approx(38.9, abs=1e-6)
    made = compensated(told(around(neck, -1), -1, 100.0))
    assert 0.001 * without_leads(made.path).length_um.sum() == pytest.approx(40.5, abs=1e-6)
    assert area_mm2(without_leads(made.path)) == pytest.approx(36.61, abs=1e-6)


# Against other ways of working it out


def wandering(rng: random.Random) -> tuple[complex, list[Leg]]:
    """Long lines with turns of up to 150°, and all that a program may tell along them."""
    start = place = complex(rng.uniform(-1e4, 1e4), rng.uniform(-1e4, 1e4))
    heading, left, legs = rng.uniform(0.0, 6.0), None, [Leg(place + 8000.0, None)]
    place, heading = legs[0].to, 0.0
    for _ in range(rng.randint(2, 15)):
        # What is lengthened up to 90° may turn half a degree more, for whole µm.
        heading += math.radians(rng.choice((rng.uniform(0.5, 90.0), rng.uniform(91.0, 150.0)))) * rng.choice((-1, 1))
        place += cmath.rect(rng.uniform(8000.0, 2e4), heading)
        left = rng.choice((left, left, left, None, rng.uniform(50.0, 400.0), rng.uniform(-400.0, -50.0)))
        legs.append(Leg(place, left, rng.random() < 0.15))
    return start, legs


@pytest.mark.alike(2)
@pytest.mark.parametrize("rules", [TEXTBOOK, LENGTHEN, ROUND, LINUXCNC, CompensationRules(startup="own-normal")])
def test_agrees_with_a_plain_way_from_corner_to_corner(rules: CompensationRules) -> None:
    for seed in range(80):
        start, legs = wandering(random.Random(seed))
        pen = Pen(start.real, start.imag)
        for leg in legs:
            pen.to(leg.to.real, leg.to.imag, CurveKind.JUMP if leg.is_jump else CurveKind.LINE)
        side = [0 if leg.left_um is None else 1 for leg in legs]
        made = compensated(told(pen.path(), side, [leg.left_um or 0.0 for leg in legs], rules))
        ends = made.path.curves.end_um
        wanted = plain_path(start, legs, rules)
        assert len(ends) == len(wanted), seed
        assert np.abs(ends[:, 0] + 1j * ends[:, 1] - np.array(wanted)).max() <= SAME_UM, seed


def lead_in(shape: Shape, side: Side) -> Toolpath:
    """A shape that is begun amid its first line, as `around` does; a shape that begins with an arc at its start."""
    before = shape.moves[-1].to
    first = shape.moves[0]
    amid = shape.start
    if isinstance(first, Line):
        amid = 0.5 * (before[0] + first.to[0]), 0.5 * (before[1] + first.to[1])
    pen = Pen(amid[0] - 5000.0, amid[1] - 3000.0).to(*amid)
    run_round(pen, shape)
    return (pen.to(*amid) if amid != shape.start else pen).path()


def chords(curves: Curves) -> shapely.Polygon:
    number = np.where(curves.is_arc, np.ceil(np.abs(curves.sweep_rad) * 30.0), 1).astype(np.int64)
    row = np.repeat(np.arange(len(curves)), number)
    at = np.arange(len(row)) - np.repeat(np.cumsum(number) - number, number)
    return shapely.Polygon(places_at(curves, row, at / number[row] * curves.length_um[row]))


def test_agrees_with_the_buffer_of_shapely() -> None:
    compared = 0
    for seed in range(60):
        rng = random.Random(seed)
        shape = SHAPES[seed % len(SHAPES)](rng, rng.uniform(5000.0, 50_000.0))
        offset, side = rng.uniform(20.0, 200.0), rng.choice(list(Side))
        path = lead_in(shape, side)
        made = compensated(told(path, side, offset, ROUND)).path
        if len(made.vanished) or shape.neck < 2.0 * offset or not isinstance(shape.moves[0], Line):
            continue
        wanted = chords(path.picked(slice(1, None))).buffer(-side * offset, quad_segs=16)
        ours = chords(without_leads(made))
        # Chords of 1/30 rad lie r / 7200 within an arc, on both contours, and those round a corner by 0.3 µm.
        radius = np.nanmax(path.radius_um, initial=0.0)
        assert ours.hausdorff_distance(wanted) <= 1.0 + 3e-4 * (radius + offset), seed
        compared += 1
    assert compared > 20


def test_one_stretch_is_what_an_offset_of_the_user_makes() -> None:
    for seed in range(100):
        rng = random.Random(seed)
        shape = SHAPES[seed % len(SHAPES)](rng, rng.uniform(1000.0, 50_000.0))
        offset, side = rng.choice((rng.uniform(10.0, 200.0), rng.uniform(200.0, 3000.0))), rng.choice(list(Side))
        path = lead_in(shape, side)
        made = compensated(told(path, side, offset, LENGTHEN)).path
        wanted = compensate(path, [OffsetSection(1, len(path) - 1, closed=False)], offset, side)
        # That one leads out by itself, and takes the first block for a lead without offset.
        assert wanted.made[-1] == RowOrigin.LEAD
        for name in ("start_um", "end_um", "center_um", "radius_um", "sweep_rad", "length_um", "kind"):
            one, other = getattr(made.curves, name), getattr(wanted.curves, name)[:-1]
            assert np.array_equal(one, other, equal_nan=True), (seed, name)


@pytest.mark.parametrize("rules", [TEXTBOOK, ROUND])
def test_what_is_told_of_a_corner_is_what_the_path_does(rules: CompensationRules) -> None:
    inserted = 0
    for seed in range(100):
        rng = random.Random(seed)
        shape = SHAPES[seed % len(SHAPES)](rng, rng.uniform(5000.0, 50_000.0))
        side = rng.choice(list(Side))
        path = told(lead_in(shape, side), side, rng.uniform(20.0, 200.0), rules)
        made = compensated(path).path
        if len(made.vanished):
            continue
        kinds = joint_kinds(path, path.compensation)
        wanted = [row for row, kind in enumerate(kinds) if kind == JointKind.INSERTED]
        bridged = 1 + np.unique(made.source_row[made.made == RowOrigin.BRIDGE])
        assert wanted == bridged.tolist(), seed
        inserted += len(wanted)
    assert inserted > 2


# Anything


@st.composite
def programs(draw: st.DrawFn) -> Toolpath:
    """Lines, arcs and jumps end to end with anything told of them."""
    pen = Pen()
    unit = draw(st.sampled_from((1.0, 20.0, 1000.0)))
    length = st.integers(-6, 6)
    for _ in range(draw(st.integers(1, 8))):
        dx, dy = unit * draw(length), unit * draw(length)
        kind = draw(st.sampled_from("lllaaj"))
        if kind == "a" and (dx or dy):
            pen.arc(pen.x + dx, pen.y + dy, draw(st.sampled_from((-1, 1))) * draw(st.floats(0.05, 2.0 * math.pi)))
        else:
            pen.to(pen.x + dx, pen.y + dy, CurveKind.JUMP if kind == "j" else CurveKind.LINE)
    n = len(pen.rows)
    side = draw(st.lists(st.sampled_from((0, 1, 1, 1, -1)), min_size=n, max_size=n))
    by = draw(st.lists(st.sampled_from((100.0, 100.0, 100.0, 40.0, -40.0, 0.0, math.nan)), min_size=n, max_size=n))
    rules = CompensationRules(
        outer=draw(st.sampled_from(("chamfer", "lengthen", "arc"))),
        startup=draw(st.sampled_from(("next-normal", "own-normal"))),
    )
    return told(pen.path(), side, by, rules)


@settings(max_examples=examples(150))
@given(programs())
def test_any_program_has_a_path_of_one_piece(toolpath: Toolpath) -> None:
    made = compensated(toolpath)
    path = made.path
    curves = path.curves
    assert np.array_equal(curves.start_um[1:], curves.end_um[:-1])
    for column in (curves.start_um, curves.end_um, curves.length_um, curves.sweep_rad):
        assert np.isfinite(column).all()
    assert (np.diff(path.source_row) >= 0).all()
    assert np.array_equal(np.union1d(path.source_row, path.vanished), np.arange(len(toolpath)))
    assert [alarm.row for alarm in made.alarms] == sorted(alarm.row for alarm in made.alarms)
    told_of = toolpath.compensation
    assert told_of is not None
    without = np.flatnonzero(told_of.side == 0)
    own = (path.made == RowOrigin.AS_IT_IS) | (path.made == RowOrigin.LEAD)
    # Wherever a row has no side, the wire is where the program says at its end.
    last = np.searchsorted(path.source_row, without, side="right") - 1
    there = np.isin(without, path.source_row)
    assert np.array_equal(curves.end_um[last[there]], toolpath.end_um[without[there]])
    assert own[last[there]].all()
