"""Loops of drawings: each curve once, each loop by itself, whatever is drawn twice, beside itself or touching."""

import math
import random
import time
from pathlib import Path

import numpy as np
import pytest
import shapely
from drawings_dxf import drawn, points_on
from drawn_loops import Piece, arc, circle, curves_of, drawing_of, polygon, square
from ezdxf.layouts import Modelspace

from parser.drawing.loops.once import drawn_once
from parser.drawing.model import Drawing, running
from parser.drawing.read import read_drawing
from parser.findings.catalogue import remark_text


def _areas(drawing: Drawing) -> list[float]:
    """Areas in mm² of the closed loops, by points on them."""
    rings = [running(drawing.curves, loop.row, loop.backwards) for loop in drawing.loops if loop.closed]
    return sorted(shapely.Polygon(points_on(ring, 500)).area / 1e6 for ring in rings)


def _open(drawing: Drawing) -> int:
    return sum(not loop.closed for loop in drawing.loops)


def _separate(*entities: list[Piece]) -> list[list[Piece]]:
    return [[piece] for entity in entities for piece in entity]


# Once


@pytest.mark.parametrize("seed", range(20))
def test_what_is_left_of_random_lines_and_arcs_is_their_union_drawn_once(seed):
    """On one line and on one circle; the union is that of intervals."""
    rng = random.Random(seed)
    spans = [sorted(rng.uniform(0, 100) for _ in range(2)) for _ in range(rng.randint(2, 12))]
    lines = [[Piece((a, 3.0), (b, 3.0))] for a, b in spans]
    turns = [(rng.uniform(0, 360), rng.uniform(5, 200)) for _ in range(rng.randint(2, 6))]
    arcs = [arc(500.0, 0.0, 20.0, begin, begin + reach) for begin, reach in turns]
    entities = [[one[0].turned()] if rng.random() < 0.5 else one for one in [*lines, *arcs]]
    rng.shuffle(entities)
    once = drawn_once(curves_of([one[0] for one in entities]), np.arange(len(entities)))
    line = once.curves.picked(~once.curves.is_arc)
    union = shapely.union_all([shapely.LineString([(a, 0), (b, 0)]) for a, b in spans])
    assert line.length_um.sum() / 1e3 == pytest.approx(union.length, abs=1e-8)
    covered = np.zeros(36_000, dtype=int)
    for begin, reach in turns:
        covered[(np.arange(36_000) / 100.0 - begin) % 360.0 < reach] = 1
    swept = np.degrees(np.abs(once.curves.sweep_rad)).sum()
    assert swept == pytest.approx(covered.sum() / 100.0, abs=0.02 * len(turns))


@pytest.mark.parametrize("seed", range(10))
def test_what_is_kept_is_the_same_whatever_the_order_of_the_entities(seed):
    rng = random.Random(seed)
    entities = [[Piece((rng.randint(0, 20), y), (rng.randint(21, 40), y))] for y in (0, 0, 0, 7, 7, 7.0004, 9, 9.0009)]
    entities += [circle(0, 0, 5), circle(0, 0, 5.0004), arc(0, 0, 5, 10, 80)]
    kept = []
    for _ in range(5):
        rng.shuffle(entities)
        drawn_so = [[one[0].turned()] if rng.random() < 0.5 else one for one in entities]
        curves = drawn_once(curves_of([one[0] for one in drawn_so]), np.arange(len(entities))).curves
        ends = np.sort(np.stack([curves.start_um, curves.end_um], axis=1), axis=1).reshape(-1, 4)
        kept.append(np.unique(np.round(np.column_stack([ends, curves.length_um]), 6), axis=0))
    assert all(np.array_equal(kept[0], other) for other in kept[1:])


def test_entities_that_close_upon_themselves_stay_whole():
    neighbours = [square(0, 0, 10), square(10, 0, 10), square(10, 10, 10), square(0, 10, 10)]
    drawing = drawing_of(neighbours)
    assert (_areas(drawing), _open(drawing), drawing.left_out) == (pytest.approx([100] * 4), 0, ())
    partly = drawing_of([square(0, 0, 30), square(30, 5, 10)])
    assert (_areas(partly), partly.left_out) == (pytest.approx([100, 900]), ())


def test_a_closed_entity_within_four_others_is_no_duplicate_of_any():
    around = [square(10, 0, 10), square(20, 10, 10), square(10, 20, 10), square(0, 10, 10)]
    assert _areas(drawing_of([*around, square(10, 10, 10)])) == pytest.approx([100] * 5)


@pytest.mark.parametrize("turned", [False, True])
def test_a_closed_entity_drawn_again_is_one_whatever_it_starts_with_and_however_it_is_split(turned):
    first = polygon([(0, 0), (20, 0), (20, 10), (0, 10)])
    again = polygon([(20, 10), (8, 10), (0, 10), (0, 0), (7, 0), (20, 0)])
    near = polygon([(20.0004, 10), (0, 10.0003), (0, 0), (20, -0.0004)])
    for drawn_so in (again, near, [*first[2:], *first[:2]]):
        other = [piece.turned() for piece in drawn_so[::-1]] if turned else drawn_so
        for entities in ([first, other], [other, first]):
            drawing = drawing_of(entities)
            assert _areas(drawing) == pytest.approx([200], rel=1e-4)
            assert [(left.why, _open(drawing)) for left in drawing.left_out] == [("drawn-twice", 0)]


def test_loose_lines_upon_a_closed_entity_go_wherever_they_stand_in_the_file():
    for entities in (
        [square(0, 0, 10), *_separate(square(0, 0, 10))],
        [*_separate(square(0, 0, 10)), square(0, 0, 10)],
    ):
        drawing = drawing_of(entities)
        assert (_areas(drawing), len(drawing.curves), len(drawing.left_out)) == (pytest.approx([100]), 4, 4)


def test_lines_beside_each_other_farther_than_a_micrometre_are_two():
    assert len(drawing_of([[Piece((0, 0), (20, 0))], [Piece((0, 0.002), (20, 0.002))]]).curves) == 2
    assert len(drawing_of([[Piece((0, 0), (20, 0))], [Piece((0, 0.0009), (20, 0.0009))]]).curves) == 1


def test_a_needle_is_not_taken_for_a_line_drawn_twice():
    """Its flanks lie within 1 µm of each other over its last 0.1 mm."""
    needle = [Piece((0, -0.5), (50, 0)), Piece((50, 0), (0, 0.5)), Piece((0, 0.5), (0, -0.5))]
    assert _areas(drawing_of(_separate(needle))) == pytest.approx([25])


def test_what_runs_there_and_back_within_one_entity_stays():
    assert len(drawing_of([[Piece((0, 0), (10, 0)), Piece((10, 0), (0, 0))]]).curves) == 2


def test_the_reader_tells_what_it_left_out_and_where(tmp_path: Path):
    def draw(space: Modelspace) -> None:
        space.add_circle((0, 0), 5)
        space.add_arc((0, 0), 5, 0, 180)
        space.add_line((50, 0), (64, 0))
        space.add_line((70, 0), (56, 0))

    drawing = read_drawing(drawn(tmp_path, draw))
    assert [(left.entity.kind, left.why) for left in drawing.left_out] == [("ARC", "drawn-twice"), ("LINE", "overlaps")]
    np.testing.assert_allclose([left.place_um for left in drawing.left_out], [(0, 5000), (60_000, 0)], atol=1e-6)
    assert [remark_text(note) for note in drawing.notes] == [
        "1 of the curves left out: drawn twice",
        "1 of the curves shortened, where others run over them",
    ]


# Apart


@pytest.mark.parametrize("seed", range(8))
def test_loops_that_touch_in_a_point_are_loops_of_their_own(seed):
    """Squares in a diagonal row, each at a corner of the next; with a gap of 3 µm there, too."""
    rng = random.Random(seed)
    off = rng.choice([0.0, 0.002])
    entities = _separate(*(square(10 * at + off * at, 10 * at, 10) for at in range(4)))
    rng.shuffle(entities)
    entities = [[one[0].turned()] if rng.random() < 0.5 else one for one in entities]
    drawing = drawing_of(entities)
    assert (_areas(drawing), _open(drawing)) == (pytest.approx([100] * 4), 0)


def test_a_figure_eight_and_a_loop_with_a_tail_are_parted_within_one_entity():
    eight = polygon([(0, 0), (5, 5), (10, 10), (10, 0), (5, 5), (0, 10)])
    assert _areas(drawing_of([eight])) == pytest.approx([25, 25])
    drawing = drawing_of([[Piece((-5, 0), (0, 0)), *square(0, 0, 10)]])
    assert (_areas(drawing), _open(drawing)) == (pytest.approx([100]), 1)


def test_a_clover_of_four_loops_at_one_place_is_four():
    turns = ((0.1, 1.4), (1.7, 3.0), (3.3, 4.5), (4.9, 6.1))
    tips = [[(9 * math.cos(turn), 9 * math.sin(turn)) for turn in pair] for pair in turns]
    leaves = [polygon([(0, 0), *ends]) for ends in tips]
    expected = sorted(40.5 * math.sin(d) for d in (1.3, 1.3, 1.2, 1.2))
    assert _areas(drawing_of(_separate(*leaves))) == pytest.approx(expected)
    assert _areas(drawing_of([[piece for leaf in leaves for piece in leaf]])) == pytest.approx(expected)


def test_a_slit_there_and_back_keeps_its_loop_whole():
    slit = [(0, 0), (10, 0), (10, 5), (7, 5), (7, 6), (6, 6), (6, 5), (7, 5), (10, 5), (10, 10), (0, 10)]
    assert len(drawing_of([polygon(slit)]).loops) == 1


# Cost


@pytest.mark.deeper
def test_ten_thousand_lines_and_as_many_again_take_a_part_of_a_second():
    entities = _separate(*(square(12 * (at % 50), 12 * (at // 50), 10) for at in range(2500)))
    begin = time.process_time()
    curves = curves_of([one[0] for one in entities] * 2)
    prepared = time.process_time() - begin
    drawing = drawing_of(entities * 2)
    taken_s = time.process_time() - begin - 2.0 * prepared
    assert (len(drawing.loops), len(curves)) == (2500, 20_000)
    assert taken_s < 3.0  # 0.2 s on an idle core
