"""Passes over a figure: which way each runs, the tab that is left to the last, and what runs on behind the start."""

import math
import random
from itertools import pairwise

import numpy as np
import pytest
import shapely
from cam_contours import circle, contour, figure, flat, rounded, star

from parser.drawing.model import Entity
from parser.geometry.along import headings_along, places_at
from parser.geometry.curves import Curves, joined
from parser.toolpath import Point
from sim.make.cam.model import CannotCutError, Entry, Figure, FigureCut, PassCut, Thread
from sim.make.cam.passes import figure_cut
from sim.setup.making import LayerWish, Making

PASSES = (180.0, 120.0, 100.0)


def threaded(of: Figure, row: int = 0, share: float = 0.5, lead_um: float = 2000.0) -> Thread:
    """A thread point in the waste across from a place of the contour."""
    rows, along = np.array([row]), np.array([share * float(of.contour.length_um[row])])
    (x, y), way_um = places_at(of.contour, rows, along)[0].tolist(), headings_along(of.contour, rows, along)[0]
    left = 1.0 if of.runs_inside else -1.0
    out = Point(float(-way_um[1] * left), float(way_um[0] * left))
    entry = Entry(row, float(along[0]), Point(x, y), out)
    return Thread(Point(x + lead_um * out.x, y + lead_um * out.y), "chosen", entry)


def way(one: PassCut) -> Curves:
    return joined([one.into, one.along, one.out])


def is_chain(curves: Curves) -> bool:
    return bool(np.abs(curves.end_um[:-1] - curves.start_um[1:]).max(initial=0.0) <= 1e-3)


def turned_rad(along: Curves, center: tuple[float, float]) -> float:
    """How far places along a way turn round a centre."""
    out = flat(along) - np.array(center)
    return float(np.unwrap(np.arctan2(out[:, 1], out[:, 0]))[[0, -1]] @ [-1.0, 1.0])


SQUARE = contour([(0.0, 0.0), (20_000.0, 0.0), (20_000.0, 20_000.0), (0.0, 20_000.0)])
MIDDLE = (10_000.0, 10_000.0)


@pytest.mark.parametrize("inside", [True, False])
@pytest.mark.parametrize("direction", ["one-side", "ccw", "cw"])
def test_passes_run_back_and_forth_round_a_hole_or_one_way(inside: bool, direction: str) -> None:
    of = figure(SQUARE, inside=inside)
    first = 1.0 if direction == "ccw" or (direction == "one-side" and inside) else -1.0
    for returning, senses in (("back", [1, -1, 1]), ("one-way", [1, 1, 1])):
        making = Making(returning=returning, direction=direction)
        cut = figure_cut(of, threaded(of), PASSES, making)
        turns = [turned_rad(one.along, MIDDLE) for one in cut.passes]
        assert turns == pytest.approx([first * sense * 2.0 * math.pi for sense in senses])
        assert [one.is_back for one in cut.passes] == [sense < 0 for sense in senses]
        assert [one.by_um for one in cut.passes] == list(PASSES)
        assert cut.cut_off == ()
        assert all(is_chain(way(one)) for one in cut.passes)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
@pytest.mark.parametrize("seed", range(6))
def test_passes_and_cut_off_are_the_whole_way_and_no_place_of_the_tab_is_cut_before(seed: int, count: int) -> None:
    rng = random.Random(100 * seed + count)
    of = figure(rounded(rng) if seed % 2 else star(rng, 7, arcs=True), inside=False)
    offsets = (240.0, 180.0, 120.0, 100.0)[-count:]
    thread = threaded(of, rng.randrange(len(of.contour)), rng.uniform(0.1, 0.9))
    tab_um = rng.uniform(600.0, 2000.0)
    making = Making(tab_um=tab_um, direction=rng.choice(("ccw", "cw")), overcut_um=rng.choice((0.0, 200.0)))
    cut = figure_cut(of, thread, offsets, making)
    whole = figure_cut(of, thread, offsets, Making(direction=making.direction))
    (last,) = cut.cut_off
    assert is_chain(joined([way(one) for one in (*cut.passes, last)]))
    assert [one.is_back for one in cut.passes] == [number % 2 == 1 for number in range(count)]
    assert (last.by_um, last.is_back) == (offsets[-1], cut.passes[-1].is_back)
    for one, full in zip(cut.passes, whole.passes, strict=True):
        left = float(full.along.length_um.sum() - one.along.length_um.sum())
        assert 0.4 * tab_um <= left <= tab_um + 4.0 * one.by_um + 6.0  # round a corner the way is longer, or shorter
    tab = last.along.length_um.sum() - (0.0 if last.is_back else making.overcut_um)
    assert tab == pytest.approx(whole.passes[-1].along.length_um.sum() - cut.passes[-1].along.length_um.sum(), abs=3.1)
    assert _starts_beside(cut)
    assert flat(last.out)[-1].tolist() == pytest.approx(list(thread.place_um))


def _starts_beside(cut: FigureCut) -> bool:
    """Whether the wire steps aside to each pass by no more than corners of 90° ask for."""
    steps = [
        (math.dist(early.along.end_um[-1], late.along.start_um[0]), early.by_um - late.by_um)
        for early, late in pairwise(cut.passes)
    ]
    return all(by - 1.0 <= length <= 1.6 * by + 6.0 for length, by in steps)


def test_the_cut_off_meets_the_first_cut_from_where_the_last_pass_ended() -> None:
    of = figure(SQUARE, inside=False)
    for count in (1, 2, 3):
        cut = figure_cut(of, threaded(of), PASSES[-count:], Making(tab_um=3000.0, direction="ccw"))
        (off,) = cut.cut_off
        ends = [(6999.0 + 1.0, -100.0), (10_000.0, -100.0)]
        ends = ends[::-1] if count == 2 else ends
        assert [off.along.start_um[0].tolist(), off.along.end_um[-1].tolist()] == [pytest.approx(end) for end in ends]
        assert len(off.into) == 0
        # After an even number of passes the wire is at the far end of the tab, and goes out by its own kerf.
        assert off.out.length_um.sum() == pytest.approx((3000.0 if count == 2 else 0.0) + 1900.0)


def test_a_hole_has_no_tab_and_an_outline_cut_from_within_has_none() -> None:
    for of in (figure(SQUARE, inside=True), figure(SQUARE, inside=False)._replace(runs_inside=True)):
        assert figure_cut(of, threaded(of), PASSES, Making(tab_um=3000.0)).cut_off == ()


@pytest.mark.parametrize(
    ("making", "why"),
    [
        (Making(tab_um=360.0), "tab-too-short"),
        (Making(tab_um=40_001.0), "tab-too-long"),
        (Making(tab_um=3000.0, returning="one-way"), "one-way-tab"),
        (Making(layers=(LayerWish("A", passes_um=(100.0, 120.0)),)), "offset-rises"),
    ],
)
def test_what_does_not_go_together_is_refused_by_name(making: Making, why: str) -> None:
    of = figure(SQUARE, inside=False)._replace(first=Entity("LINE", "1", "a", ""))
    with pytest.raises(CannotCutError) as error:
        figure_cut(of, threaded(of), PASSES, making)
    assert error.value.refusal.why == why


def test_a_layer_has_its_own_passes() -> None:
    of = figure(SQUARE, inside=True)._replace(first=Entity("LINE", "1", "Fine", ""))
    making = Making(layers=(LayerWish("other", passes_um=(50.0,)), LayerWish("FINE", passes_um=(150.0, 90.0))))
    assert [one.by_um for one in figure_cut(of, threaded(of), PASSES, making).passes] == [150.0, 90.0]


@pytest.mark.parametrize("closed", [SQUARE, circle(8000.0)])
def test_the_last_pass_runs_on_behind_its_start_and_back_in_its_own_kerf(closed: Curves) -> None:
    of = figure(closed, inside=True)
    plain, over = (figure_cut(of, threaded(of), PASSES, Making(overcut_um=by)) for by in (0.0, 400.0))
    assert [one.along.length_um.sum() for one in over.passes[:2]] == [
        one.along.length_um.sum() for one in plain.passes[:2]
    ]
    last = over.passes[2]
    assert last.along.length_um.sum() - plain.passes[2].along.length_um.sum() == pytest.approx(400.0)
    assert last.out.length_um.sum() - plain.passes[2].out.length_um.sum() == pytest.approx(400.0)
    assert shapely.LineString(flat(plain.passes[2].along)).distance(shapely.Point(last.along.end_um[-1])) < 0.1
    assert is_chain(way(last))


@pytest.mark.parametrize("share", [0.0, 1e-5, 0.99999, 0.5])
def test_a_way_begun_at_a_joint_leaves_no_slivers(share: float) -> None:
    of = figure(SQUARE, inside=True)
    cut = figure_cut(of, threaded(of, 1, share), (100.0,), Making())
    (one,) = cut.passes
    assert len(one.along) == (5 if share == 0.5 else 4)
    assert one.along.length_um.min() > 1000.0


def test_at_a_sharp_corner_the_wire_comes_to_where_its_way_turns() -> None:
    of = figure(SQUARE, inside=False)
    for row, share in ((0, 1.0), (1, 0.0)):
        (one,) = figure_cut(of, threaded(of, row, share), (100.0,), Making()).passes
        assert one.along.start_um[0].tolist() == pytest.approx([20_100.0, -100.0])


def test_no_offset_is_the_contour_itself() -> None:
    of = figure(SQUARE, inside=False)
    cut = figure_cut(of, threaded(of, lead_um=0.0), (0.0,), Making(tab_um=1000.0))
    assert len(way(cut.passes[0])) == len(cut.passes[0].along)
    both = joined([cut.passes[0].along, cut.cut_off[0].along])
    assert both.length_um.sum() == pytest.approx(80_000.0)
