"""The path: place, direction and bend at any length along lines and arcs."""

import math

import numpy as np
import pytest
from paths import Pen
from random_motion import random_toolpath

from controller.motion.limits import path_of

SHARES = (0.0, 0.3, 1.0)


def test_rows_start_and_end_where_their_blocks_do() -> None:
    for seed in range(100):
        toolpath = random_toolpath(np.random.default_rng(seed))
        path = path_of(toolpath)
        rows = np.arange(len(path))
        size = 1.0 + np.abs(toolpath.end_um).max()
        assert np.abs(path.place(rows, np.zeros(len(path))) - toolpath.start_um).max() <= 1e-12 * size
        assert np.abs(path.place(rows, path.length_um) - toolpath.end_um).max() <= 1e-10 * size


def test_direction_is_the_slope_of_place_and_bend_that_of_direction() -> None:
    step = 1e-4
    for seed in range(50):
        toolpath = random_toolpath(np.random.default_rng(seed))
        path = path_of(toolpath)
        rows = np.flatnonzero(path.length_um > 1.0)
        for share in SHARES:
            s = share * path.length_um[rows]
            slope = (path.place(rows, s + step) - path.place(rows, s - step)) / (2.0 * step)
            turning = (path.direction(rows, s + step) - path.direction(rows, s - step)) / (2.0 * step)
            assert slope == pytest.approx(path.direction(rows, s), abs=1e-6)
            assert turning == pytest.approx(path.bend(rows, s), rel=1e-6, abs=1e-8)


def test_directions_are_unit_vectors_and_rows_without_length_have_none() -> None:
    path = path_of(Pen().to(3.0, 4.0).to(3.0, 4.0).arc(0.0, 0.0, -5.0).path())
    assert np.linalg.norm(path.tangent, axis=1) == pytest.approx([1.0, 0.0, 1.0])
    assert np.linalg.norm(path.leaving, axis=1) == pytest.approx([1.0, 0.0, 1.0])
    assert path.before_um == pytest.approx([0.0, 5.0, 5.0, 30.0])
    assert path.normal[:2].tolist() == [[0.0, 0.0], [0.0, 0.0]]


def test_an_arc_bends_toward_its_centre() -> None:
    for turn in (1.0, -1.0):
        path = path_of(Pen(10.0, 0.0).arc(0.0, 0.0, turn * math.pi).path())
        middle = np.array([5.0 * math.pi])
        rows = np.zeros(1, dtype=np.int64)
        assert path.place(rows, middle)[0] == pytest.approx([0.0, 10.0 * turn], abs=1e-12)
        assert path.direction(rows, middle)[0] == pytest.approx([-1.0, 0.0], abs=1e-12)
        assert path.bend(rows, middle)[0] == pytest.approx([0.0, -0.1 * turn], abs=1e-12)


def test_the_rest_of_a_path_runs_through_the_same_places() -> None:
    path = path_of(Pen(10.0, 0.0).arc(0.0, 0.0, 2.0).to(50.0, 20.0).path())
    rest = path.rest(7.0)
    assert rest.length_um == pytest.approx(path.length_um - [7.0, 0.0])
    for row, s in ((0, 0.0), (0, 6.0), (1, 0.0), (1, 20.0)):
        rows, there, here = np.array([row]), np.array([s + 7.0 * (row == 0)]), np.array([s])
        for ask in ("place", "direction", "bend"):
            assert getattr(rest, ask)(rows, here) == pytest.approx(getattr(path, ask)(rows, there), abs=1e-12)


def test_the_rest_of_a_line_is_a_line() -> None:
    rest = path_of(Pen().to(30.0, 40.0).path()).rest(10.0)
    assert rest.start_um.tolist() == [[6.0, 8.0]]
    assert rest.normal.tolist() == [[0.0, 0.0]]
    assert rest.length_um.tolist() == [40.0]


def test_the_rest_of_a_path_keeps_the_rows_behind_the_first_as_they_are() -> None:
    path = path_of(Pen(10.0, 0.0).arc(0.0, 0.0, 2.0).arc(1.0, 1.0, -1.0).to(50.0, 20.0).path())
    rest = path.rest(7.0)
    for name in ("start_um", "tangent", "normal", "curvature", "length_um"):
        assert getattr(rest, name)[1:].tolist() == getattr(path, name)[1:].tolist()
