"""Words of lines and arcs in columns: they decode to what they tell, by the trade's rules."""

import math
import random

import numpy as np
import pytest
from drawings import Arc
from plain import PlainBlock, motion_quadrant, plain_steps
from sound_cam import arc_block, line_block

from parser.controller_words import Axis, StepWords
from parser.step_words.words import arc_ends, words_of_arcs, words_of_lines

SENSE = {0: "L", 1: "NR", -1: "SR"}


def block(words: StepWords, row: int) -> PlainBlock:
    x, y, count, axis, quadrant, turn = (
        int(column[row])
        for column in (words.x_um, words.y_um, words.count_um, words.count_axis, words.quadrant, words.turn)
    )
    return PlainBlock(x, y, count, Axis(axis).name, SENSE[turn], quadrant)


def random_arcs(seed: int, least_um: float, most_um: float, n: int = 400) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Starts and ends about their centres, and sweeps of up to a turn."""
    rng = np.random.default_rng(seed)
    radius = np.exp(rng.uniform(math.log(least_um), math.log(most_um), n))[:, None]
    angle, sweep = rng.uniform(-4.0, 4.0, n), rng.uniform(0.05, 6.2, n) * rng.choice((-1.0, 1.0), n)
    start, end = (np.stack([np.cos(a), np.sin(a)], axis=1) * radius for a in (angle, angle + sweep))
    return start, end, sweep


def test_lines_are_told_as_a_cam_tells_them() -> None:
    rng = random.Random(1)
    ways = [(x, y) for x in (-7, -5, 0, 5, 7) for y in (-7, -5, 0, 5, 7) if x or y]
    ways += [(rng.uniform(-9000, 9000), rng.uniform(-9000, 9000)) for _ in range(300)]
    words = words_of_lines(np.array(ways, dtype=float))
    assert [block(words, k) for k in range(len(ways))] == [line_block((0.0, 0.0), way) for way in ways]
    assert set(words.radius_um.tolist()) == {-1}
    assert set(words.curve.tolist()) == {0}


def test_a_line_of_nothing_has_no_count() -> None:
    words = words_of_lines(np.array([[0.4, -0.4]]))
    assert block(words, 0) == PlainBlock(0, 0, 0, "Y", "L", 1)


def test_arcs_from_whole_um_are_told_as_a_cam_tells_them() -> None:
    rng = random.Random(2)
    for _ in range(300):
        x, y = rng.randint(-20_000, 20_000), rng.randint(-20_000, 20_000)
        turn, turned = rng.choice((1, -1)), rng.uniform(0.05, 5.5)
        angle = math.atan2(y, x) + turn * turned
        end = math.hypot(x, y) * math.cos(angle), math.hypot(x, y) * math.sin(angle)
        words = words_of_arcs(np.array([[x, y]], dtype=float), np.array([end]), np.array([turn * turned]))
        assert block(words, 0) == arc_block((x, y), (x, y), Arc(end, (0.0, 0.0), turn))


@pytest.mark.parametrize("seed", range(5))
def test_arcs_decode_to_their_ends(seed: int) -> None:
    start, end, sweep = random_arcs(seed, 50.0, 1e6)
    words = words_of_arcs(start, end, sweep)
    place = np.stack([words.x_um, words.y_um], axis=1) * words.signs
    ends = arc_ends(place, words.count_um, words.count_axis, words.turn)
    off = ends.end_um - ends.start_um - (end - start)
    counted = np.where(words.count_axis == Axis.X, off[:, 0], off[:, 1])
    assert np.abs(counted).max() <= 0.5 + 1e-6
    # Half a µm of the centre on each axis, seen from both ends, and half a count, across a slope of 45°.
    assert np.hypot(off[:, 0], off[:, 1]).max() < 4.0
    assert ends.sweep_rad == pytest.approx(sweep, abs=0.03)
    for k in range(len(sweep)):
        told = block(words, k)
        assert told.quadrant == motion_quadrant(*place[k].tolist(), told.sense)


def test_a_start_off_the_circle_does_not_carry_over_to_the_end() -> None:
    start, end, sweep = random_arcs(9, 500.0, 20_000.0)
    away = start * (1.0 + 4.0 / np.hypot(start[:, 0], start[:, 1]))[:, None]
    words = words_of_arcs(away, end, sweep)
    place = np.stack([words.x_um, words.y_um], axis=1) * words.signs
    ends = arc_ends(place, words.count_um, words.count_axis, words.turn)
    off = np.hypot(*(ends.end_um - ends.start_um - (end - away)).T)
    short = np.abs(sweep) < 1.8 * np.pi
    assert off[short].max() < 4.0
    assert np.median(off) < 1.0


@pytest.mark.parametrize("turn", [1, -1])
@pytest.mark.parametrize(("x", "y"), [(5000, 0), (0, 5000), (-5000, 0), (0, -5000), (3000, -4000)])
def test_a_circle_counts_four_radii(x: int, y: int, turn: int) -> None:
    place = np.array([[x, y]], dtype=float)
    told = block(words_of_arcs(place, place, np.array([turn * 2.0 * math.pi])), 0)
    assert told == PlainBlock(abs(x), abs(y), 20_000, "Y" if abs(x) > abs(y) else "X", SENSE[turn], told.quadrant)
    assert told.quadrant == motion_quadrant(x, y, told.sense)
    assert max(abs(c) for c in plain_steps(told)[-1]) <= 2


@pytest.mark.parametrize(
    ("start", "end", "sweep"),
    [
        ((0.7, 0.1), (-0.1, 0.7), math.pi / 2),  # a radius below 1 µm
        ((1.2, 0.0), (0.0, 1.2), math.pi / 2),
        ((5000.0, 0.0), (5000.0, 0.3), 6e-5),  # no count
        ((5000.0, 3.0), (5000.0, 0.0), 6e-4),  # the steps before it have gone past its end
        ((0.0, 3.0), (6.0, 3.0), 1.0),  # no circle of about this radius through both
    ],
)
def test_what_leaves_no_arc_is_told_as_a_line(
    start: tuple[float, float], end: tuple[float, float], sweep: float
) -> None:
    words = words_of_arcs(np.array([start]), np.array([end]), np.array([sweep]))
    by = np.array([end]) - np.array([start])
    assert block(words, 0) == block(words_of_lines(by), 0)
