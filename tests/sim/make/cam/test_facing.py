"""Contours that face each other: pieces that cover both, partners where they belong, and stretches of them."""

import math

import numpy as np
import pytest
from depth import cases
from tilted_paths import contour, random_pair

from parser.geometry.curves import Curves
from sim.make.cam.facing import Facing, facing

SQUARE = contour([(-10, -10), (10, -10), (10, 10), (-10, 10), (-10, -10)])
CIRCLE = contour([(8, 0), (8, 0)], {0: ((0, 0), 2.0 * math.pi)})
TURNED = contour([(0, 6), (0, 6)], {0: ((0, 0), 2.0 * math.pi)})
OCTAGON = contour([(8.0 * math.cos(at), 8.0 * math.sin(at)) for at in np.arange(9) * math.pi / 4.0])
SMALL = contour([(8, 7), (-8, 7), (-8, -8), (8, -8), (8, 7)])
FILLETED = contour(
    [(-8, -10), (8, -10), (10, -8), (10, 10), (-10, 10), (-10, -8), (-8, -10)],
    {1: ((8, -8), math.pi / 2.0), 5: ((-8, -8), math.pi / 2.0)},
)
HOUSE = contour([(-9, -9), (9, -9), (9, 6), (0, 9), (-9, 6), (-9, -9)])


def covers(found: Facing, lower: Curves, upper: Curves) -> None:
    """Both contours are there, all of them and once, in pieces of one curve each."""
    assert len(found.lower) == len(found.upper)
    for pieces, drawn in ((found.lower, lower), (found.upper, upper)):
        assert pieces.length_um.sum() == pytest.approx(drawn.length_um.sum(), abs=1e-3)
        assert np.abs(pieces.end_um - np.roll(pieces.start_um, -1, axis=0)).max() < 1e-3
        corners = np.hypot(*(drawn.start_um[:, None] - pieces.start_um[None]).transpose(2, 0, 1)).min(axis=1)
        assert len(drawn) == 1 or corners.max() < 1e-3


@pytest.mark.parametrize(
    ("lower", "upper", "by", "pieces"),
    [
        (SQUARE, SMALL, "curves", 4),
        (SQUARE, CIRCLE, "nearest", 5),
        (CIRCLE, SQUARE, "nearest", 5),
        (SQUARE, OCTAGON, "nearest", 8),
        (CIRCLE, TURNED, "length", 2),
        (SQUARE, HOUSE, "nearest", 7),
        (FILLETED, SQUARE, "nearest", 8),
    ],
)
def test_contours_are_matched_by_what_they_have_in_common(lower: Curves, upper: Curves, by: str, pieces: int) -> None:
    found = facing(lower, upper)
    covers(found, lower, upper)
    assert (found.by, len(found.lower)) == (by, pieces)


def test_round_on_square_is_the_worked_solid() -> None:
    found = facing(SQUARE, CIRCLE)
    ruled = found.ruled(0.0, 40_000.0)
    assert ruled.volume_um3(np.arange(len(ruled)), 0.0, 40_000.0) * 1e-9 == pytest.approx(11_855.5087, abs=1e-3)
    assert found.most_aside_um() == pytest.approx(10_000.0 * math.sqrt(2.0) - 8_000.0)


@pytest.mark.deep
@pytest.mark.parametrize("seed", cases(10, 300))
def test_pieces_of_random_contours_cover_both(seed: int) -> None:
    (one, other, _), (another, _, _) = random_pair(seed), random_pair(seed + 5000)
    for lower, upper in ((one, other), (one, another), (other, another)):
        drawn = lower.picked(slice(None)), upper.picked(slice(None))
        covers(facing(*drawn), *drawn)


@pytest.mark.parametrize("begin_mm", [0.0, 3.0, 20.0, 77.0])
@pytest.mark.parametrize("way_mm", [80.0, -80.0, 83.0, 12.5, -30.0])
def test_a_stretch_is_the_same_pieces_begun_elsewhere(begin_mm: float, way_mm: float) -> None:
    found = facing(SQUARE, CIRCLE)
    low, high = found.stretch(1000.0 * begin_mm, 1000.0 * way_mm)
    assert low.length_um.sum() == pytest.approx(1000.0 * abs(way_mm))
    for pieces in (low, high):
        assert np.abs(pieces.end_um[:-1] - pieces.start_um[1:]).max(initial=0.0) < 1e-6
        assert (np.sign(pieces.sweep_rad[pieces.is_arc]) == np.sign(way_mm)).all()
    assert np.hypot(*high.start_um.T) == pytest.approx(8000.0)
    if abs(way_mm) == 80.0:
        assert high.length_um.sum() == pytest.approx(2000.0 * math.pi * 8.0)
        assert high.end_um[-1] == pytest.approx(high.start_um[0], abs=1e-6)
