"""Deviation from the ideal geometry, against the nearest of many points set on the curve."""

import math

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from plain_deviation import plain_deviation
from strategies import program_text, programs

from parser.geometry.curves import CurveKind
from parser.program import parse_program
from parser.toolpath import Block, Toolpath
from sim.measure.curve_rows import curve_rows
from sim.measure.deviation import DeviationMeter, away_from_path

SPOTS = 4001


def curve(block: Block) -> np.ndarray:
    """Points along a block, (SPOTS, 2) µm."""
    share = np.linspace(0.0, 1.0, SPOTS)[:, None]
    if block.kind is not CurveKind.ARC:
        return np.array(block.start_um) + share * (np.array(block.end_um) - np.array(block.start_um))
    angle = block.start_angle_rad + share[:, 0] * block.sweep_rad
    return np.array(block.center_um) + block.radius_um * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def nearest(toolpath: Toolpath, rows: set[int], place: tuple[float, float]) -> float:
    spots = np.concatenate([curve(toolpath.block(row)) for row in rows if 0 <= row < len(toolpath)])
    return float(np.hypot(*(spots - np.array(place)).T).min())


@settings(max_examples=examples(80))
@given(programs, st.data())
def test_distance_lies_between_nearest_neighbour_and_own_block(program: list, data: st.DataObject) -> None:
    toolpath = parse_program(program_text(program)).toolpath
    row = data.draw(st.integers(0, len(toolpath) - 1))
    x, y = data.draw(st.floats(-600, 600)), data.draw(st.floats(-600, 600))
    x, y = x + toolpath.start_um[row, 0], y + toolpath.start_um[row, 1]
    found = away_from_path(curve_rows(toolpath), row, x, y)
    spacing = float(toolpath.length_um.max()) / SPOTS
    assert found >= nearest(toolpath, {row - 1, row, row + 1}, (x, y)) - spacing
    assert found <= nearest(toolpath, {row}, (x, y)) + 1e-6


CORNER = parse_program("B100B0B100GXL1 B0B100B100GYL2 DD").toolpath
HALF = parse_program("B0B50B100GXSR1 DD").toolpath  # from (0, 50) of its centre clockwise to (0, −50)


@pytest.mark.parametrize(
    ("toolpath", "row", "place", "expected"),
    [
        (CORNER, 0, (50.0, 3.0), 3.0),
        (CORNER, 0, (-3.0, 4.0), 5.0),
        (CORNER, 0, (102.0, 50.0), 2.0),  # past the end of block 1, on block 2's side
        (CORNER, 1, (97.0, 0.0), 3.0),  # level with the corner: block 2 is not passed
        (CORNER, 1, (97.0, -1.0), 1.0),  # before the start of block 2, beside block 1
        (HALF, 0, (53.0, -50.0), 3.0),
        (HALF, 0, (-4.0, 0.0), 4.0),
        (HALF, 0, (-4.0, -97.0), 5.0),
        (HALF, 0, (0.0, -50.0), 50.0),
    ],
)
def test_distance_in_plain_cases(toolpath: Toolpath, row: int, place: tuple[float, float], expected: float) -> None:
    assert away_from_path(curve_rows(toolpath), row, *place) == pytest.approx(expected)


@settings(max_examples=examples(50))
@given(st.lists(st.floats(0.0, 1000.0), min_size=1, max_size=200), st.integers(1, 50))
def test_meter_sums_up_as_numpy_does(offsets: list[float], size: int) -> None:
    meter = DeviationMeter(CORNER)
    y = -np.array(offsets)
    x, row, t_s = np.full_like(y, 50.0), np.zeros(len(y), dtype=np.int64), np.arange(len(y), dtype=np.float64)
    for low in range(0, len(y), size):
        part = slice(low, low + size)
        meter.add(row[part], x[part], y[part], t_s[part])
    found = meter.result()
    assert found.max_um == max(offsets)
    assert found.where is not None
    assert found.where.t_s == offsets.index(max(offsets))
    assert found.rms_um == pytest.approx(math.sqrt(np.mean(np.square(offsets))), abs=1e-12)
    ranked = sorted(offsets)[math.ceil(0.95 * len(offsets)) - 1]
    assert found.p95_um == pytest.approx(ranked, rel=1.1e-3, abs=2e-6)
    assert found.by_row_um[0] == max(offsets)
    assert math.isnan(found.by_row_um[1])


def test_an_empty_meter_has_no_place() -> None:
    assert DeviationMeter(CORNER).result().where is None


def test_past_the_end_of_an_arc_the_next_block_counts() -> None:
    # A quarter turn from (0, 0) to (100, 100), then straight up.
    toolpath = parse_program("B0B100B100GYNR4 B0B50B50GYL2 DD").toolpath
    assert toolpath.end_um[0] == pytest.approx([100.0, 100.0])
    blocks = curve_rows(toolpath)
    assert away_from_path(blocks, 0, 103.0, 120.0) == pytest.approx(3.0)
    assert away_from_path(blocks, 1, 98.0, 99.0) == pytest.approx(abs(math.hypot(98.0, 1.0) - 100.0))


@settings(max_examples=examples(60))
@given(programs, st.integers(0, 2**32 - 1))
def test_the_meter_measures_as_whole_arrays_do(program: list, seed: int) -> None:
    toolpath = parse_program(program_text(program)).toolpath
    rng = np.random.default_rng(seed)
    row = np.sort(rng.integers(0, len(toolpath), 40))
    near = toolpath.start_um[row] + rng.normal(0.0, 30.0, (40, 2))
    drift = rng.uniform(-1.0, 1.0, (len(toolpath), 2))
    meter, back = DeviationMeter(toolpath, drift), near - drift[row]
    meter.add(row, near[:, 0], near[:, 1], np.arange(40.0))
    found, wanted = meter.result(), plain_deviation(toolpath, row, *back.T)
    by_row = [wanted[row == own].max() if own in row else math.nan for own in range(len(toolpath))]
    assert found.by_row_um == pytest.approx(by_row, abs=1e-9, nan_ok=True)  # µm
    assert found.rms_um == pytest.approx(math.sqrt(np.mean(wanted**2)), abs=1e-9)
    assert found.where is not None
    assert np.hypot(*(back - (found.where.x_um, found.where.y_um)).T).min() < 1e-9


def test_of_positions_at_the_same_time_the_last_counts() -> None:
    meter = DeviationMeter(CORNER)
    row, x, t_s = np.zeros(3, dtype=np.int32), np.array([10, 11, 11], dtype=np.int32), np.array([0.0, 1.0, 1.0])
    meter.add(row, x, np.array([0, -5, -1], dtype=np.int32), t_s)
    assert meter.result().max_um == 1.0
    assert meter.result().rms_um == pytest.approx(math.sqrt(0.5))
