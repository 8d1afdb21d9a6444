"""Which places of a stretch have another stretch beside them, and how far aside that lies."""

import math

import numpy as np
import pytest
from paths import Pen

from parser.shape.parallel_runs import RunBeside, Stretches, neighbours, run_beside

SAMPLES = 16  # of a stretch: here one each 20 µm of 320, from 10 µm on


def beside(pen: Pen, split: int) -> RunBeside:
    """How the rows behind a jump, the row `split`, have those before it beside them, as one pair of stretches."""
    path = pen.path()
    stretches = Stretches(np.array([0, split + 1]), np.array([split - 1, len(path) - 1]))
    return run_beside(path, stretches, np.array([0]), np.array([1]))


@pytest.mark.parametrize(("end_um", "number"), [(197.0, 13), (193.0, 12)])
def test_a_stretch_is_beside_a_little_past_its_end(end_um: float, number: int) -> None:
    """By half of what it lies aside and 5 µm: 100 µm aside 55 µm, so the place at 250 µm is the last one or not."""
    found = beside(Pen().to(end_um, 0).jump(0, 100).to(160, 100).to(320, 100), 1)
    assert found.share.tolist() == [number / SAMPLES]
    assert (found.sense.tolist(), found.aside_um.tolist()) == ([1.0], [-100.0])


@pytest.mark.parametrize(("degrees", "number"), [(25.0, SAMPLES), (27.0, 0), (90.0, 0)])
def test_ways_run_beside_each_other_where_the_cosine_of_their_angle_is_nine_tenths(degrees: float, number: int) -> None:
    x, y = 160 * math.cos(math.radians(degrees)), 160 * math.sin(math.radians(degrees))
    found = beside(Pen(-2000, 0).to(2000, 0).jump(-x, -y).to(x, y), 1)
    assert (found.share[0] > 0.0) == (number > 0)


@pytest.mark.parametrize(("farther_um", "number"), [(61.0, SAMPLES), (63.0, 11)])
def test_what_lies_unlike_most_of_a_stretch_is_not_beside_it(farther_um: float, number: int) -> None:
    """Most of it lies 40 µm aside: 10 µm and three tenths of that more, 62 µm, are like it."""
    found = beside(Pen().to(200, 0).jump(200, 40 - farther_um).to(320, 40 - farther_um).jump(0, 40).to(320, 40), 3)
    assert found.share.tolist() == [number / SAMPLES]
    assert found.aside_um.tolist() == [-40.0]


@pytest.mark.parametrize(("end_um", "aside_um"), [(320.0, -60.0), (260.0, -40.0)])
def test_how_far_a_stretch_lies_aside_is_the_lower_median_of_what_is_nearest(end_um: float, aside_um: float) -> None:
    """Eight places lie 40 µm off and eight 60 µm, or seven: farther than 35 µm past its end nothing is beside it."""
    pen = Pen(0, -20).to(end_um, -20).jump(end_um, -5000).jump(0, -5000).jump(0, 0).to(140, 0)
    found = beside(pen.jump(0, 40).to(320, 40), 5)
    assert found.aside_um.tolist() == [aside_um]
    assert found.share.tolist() == [1.0 if end_um > 300 else 15 / SAMPLES]


def test_a_stretch_with_nothing_beside_it_lies_nowhere_aside() -> None:
    path = Pen().to(320, 0).jump(0, 9000).to(320, 9000).jump(0, 9040).to(320, 9040).path()
    stretches = Stretches(np.array([0, 2, 4]), np.array([0, 2, 4]))
    found = run_beside(path, stretches, np.array([1, 0, 0, 1]), np.array([2, 1, 2, 2]))
    assert found.share.tolist() == [1.0, 0.0, 0.0, 1.0]
    assert found.sense.tolist() == [1.0, 0.0, 0.0, 1.0]
    assert found.aside_um.tolist() == [-40.0, 0.0, 0.0, -40.0]


def test_a_block_of_no_length_is_beside_nothing() -> None:
    path = Pen().to(320, 0).to(320, 0).to(320, 5).path()
    found = neighbours(path, np.arange(3), np.array([[320.0, 0.0]]), np.array([[1.0, 0.0]]))
    assert found.row.tolist() == [0]
    assert beside(Pen().to(320, 0).to(320, 0).jump(0, 40).to(320, 40), 2).aside_um.tolist() == [-40.0]
