"""Sparks: closed forms as published, the loop beside them, and beside a Monte Carlo in steps of 1 µs."""

import math
from itertools import product

import numpy as np
import pytest
from spark_cuts import HEIGHT_UM, WIDTH_UM, straight

from sim.process.cut import run_sparks
from sim.process.sparks import CRATERS, settled_gap_um, steady, voltage_share
from sim.process.ticks.walls import side_gap_ratio
from sim.setup.spark import Mode, Spark

PUBLISHED = {  # facts of the open model: gap µm, mean delay µs, sparks/s, voltage, mm³/min, mm²/min; mode I17, 40 mm
    5.0: (11.0, 10_642, 0.126, 38.02, 116.5),
    10.0: (36.3, 8_383, 0.312, 29.95, 91.8),
    15.0: (96.2, 5_579, 0.542, 19.94, 61.1),
    20.0: (190.8, 3_652, 0.700, 13.05, 40.0),
}
SETTLED = {0.2: (7.564, 106.7), 0.3: (9.761, 93.37), 0.4: (11.796, 80.03), 0.5: (13.981, 66.69)}


@pytest.mark.parametrize("gap_um", PUBLISHED)
def test_closed_forms_are_those_of_the_table(gap_um: float) -> None:
    _, rate, voltage, volume, area = PUBLISHED[gap_um]
    found = steady(Spark(), gap_um, WIDTH_UM, HEIGHT_UM)
    assert found.rate_hz == pytest.approx(rate, abs=0.5)
    assert found.voltage_share == pytest.approx(voltage, abs=5e-4)
    assert found.volume_mm3_min == pytest.approx(volume, abs=6e-3)
    assert found.area_rate_mm2_min == pytest.approx(area, abs=0.06)


@pytest.mark.parametrize(
    ("mode", "area"), [("I1", 3.4), ("I5", 7.6), ("I9", 9.7), ("I13", 13.8), ("I15", 40.8), ("I17", 91.8)]
)
def test_area_rate_of_each_mode_at_ten_micrometres(mode: Mode, area: float) -> None:
    kerf_um = {"I1": 320 + 3.0, "I15": 320 + 6.2, "I17": 320 + 6.26}.get(
        mode, 320 + 4.5
    )  # wire + 0.12 mm + the depth of a crater
    assert steady(Spark(mode), 10.0, kerf_um, HEIGHT_UM).area_rate_mm2_min == pytest.approx(area, abs=0.12)


@pytest.mark.parametrize("set_value", SETTLED)
def test_the_law_by_voltage_settles_where_the_table_says(set_value: float) -> None:
    gap_um, area = SETTLED[set_value]
    assert settled_gap_um(Spark(), set_value) == pytest.approx(gap_um, abs=6e-4)
    assert steady(Spark(), gap_um, WIDTH_UM, HEIGHT_UM).area_rate_mm2_min == pytest.approx(area, abs=0.05)


def test_no_gap_settles_at_a_voltage_that_no_gap_has() -> None:
    assert settled_gap_um(Spark(), 0.1) is None
    assert settled_gap_um(Spark(), 0.99) is None


SETTINGS = list(product(("I15", "I17"), (40e3, 80e3), (0.2, 0.35, 0.5)))


@pytest.mark.parametrize(("mode", "height_um", "set_value"), SETTINGS)
def test_a_cut_of_sparks_one_by_one_comes_to_the_closed_form(mode: Mode, height_um: float, set_value: float) -> None:
    """Gap within 0.05 µm, rate of sparks within 0.3 %, feed within 1 %: of 10^6 sparks and more."""
    spark = Spark(mode, set_value=set_value)
    run = run_sparks(straight(14_000 if mode == "I17" else 7_000, height_um=height_um), spark)
    gap_um = settled_gap_um(spark, set_value)
    assert gap_um is not None
    wanted = steady(spark, gap_um, WIDTH_UM, height_um)
    assert run.sparks > 1e6
    assert run.mean.gap_um == pytest.approx(gap_um, abs=0.05)
    assert run.mean.rate_hz == pytest.approx(wanted.rate_hz, rel=3e-3)
    assert run.mean.voltage_share == pytest.approx(set_value, abs=2e-3)
    assert run.mean.feed_um_s == pytest.approx(wanted.feed_um_s, rel=1e-2)
    assert run.mean.area_rate_mm2_min == pytest.approx(wanted.area_rate_mm2_min, rel=1e-2)


def test_a_monte_carlo_of_single_microseconds_has_the_same_rate_and_voltage() -> None:
    """A million sparks at one gap, each microsecond a draw of its own: as the open model is written."""
    random, gap_um, n = np.random.default_rng(7), 10.0, 1_000_000
    chance = math.log(2.0) / (0.48 * gap_um**2 - 3.69 * gap_um + 14.05)
    delays = random.geometric(chance, n)
    time_us = delays.sum() + 83.0 * n
    wanted = steady(Spark(), gap_um, WIDTH_UM, HEIGHT_UM)
    assert n / time_us * 1e6 == pytest.approx(wanted.rate_hz, rel=3e-3)
    assert (delays.sum() + 0.9 * n) / time_us == pytest.approx(wanted.voltage_share, rel=3e-3)
    crater = CRATERS["I17"]
    volume = random.normal(crater.mean_um3, crater.spread_um3, n).sum()
    assert volume / time_us * 0.06 == pytest.approx(wanted.volume_mm3_min, rel=3e-3)


def test_voltage_grows_with_the_gap() -> None:
    shares = [voltage_share(Spark(), gap_um) for gap_um in np.linspace(3.84, 50.0, 200).tolist()]
    assert shares == sorted(shares)


def test_a_wall_recedes_by_the_cube_root_of_its_time() -> None:
    """By small steps: where the delay is 0.48 g² / ln 2, the wall recedes by a constant over it."""
    gap = other = 1.0
    for _ in range(20_000):
        gap += 10.0 / (0.48 * gap**2)
    for _ in range(160_000):
        other += 10.0 / (0.48 * other**2)
    assert other / gap == pytest.approx(side_gap_ratio(8.0), rel=4e-3)
