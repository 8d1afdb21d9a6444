"""An outline with fewer corners lies where it lay, within what was asked for."""

import numpy as np
import pytest
import shapely

from sim.measure.compare.rings import coarser


@pytest.mark.alike(3)
@pytest.mark.parametrize("seed", range(8))
def test_no_corner_that_is_left_out_lies_farther_off_than_asked(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = np.linspace(0.0, 2.0 * np.pi, 3000)
    wavy = 5000.0 + rng.normal(0.0, 10.0 ** rng.uniform(-3.0, 0.0), len(turn))
    corner = wavy[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    corner[-1] = corner[0]
    kept = coarser(corner, 0.05)
    assert len(kept) < len(corner)
    assert np.array_equal(kept[[0, -1]], corner[[0, -1]])
    off = shapely.distance(shapely.LinearRing(kept), shapely.points(corner))
    assert off.max() <= 0.05 * (1.0 + 1e-9)


def test_a_straight_side_keeps_its_ends_and_a_turn_back_its_tip() -> None:
    along = np.arange(101.0)
    there = np.column_stack([along, np.zeros_like(along)])
    assert coarser(there, 0.05).tolist() == [[0.0, 0.0], [100.0, 0.0]]
    assert coarser(np.concatenate([there, there[-2::-1]]), 0.05).tolist() == [[0.0, 0.0], [100.0, 0.0], [0.0, 0.0]]
