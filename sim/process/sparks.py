"""Closed forms of the spark model: mean voltage, rates and feed at a gap, the gap where a set value settles.

All of it follows from the mean delay of a spark (`sim.process.ticks`); craters are those of WEDM-Learning-Environment
(``area_corrected.json``, brass wire in deionised water). The loop comes to the same by sparks one by one.
"""

from typing import Final, NamedTuple

from parser.units import mm
from sim.process.ticks.chance import CLOSE_UM, mean_delay_us
from sim.process.ticks.state import ARC_SHARE, FAR_UM
from sim.setup.spark import Spark

_NEAR_UM: Final = 1e-9


class Crater(NamedTuple):
    """Volume of craters of a mode, µm³: mean and standard deviation."""

    mean_um3: float
    spread_um3: float


CRATERS: Final = {
    "I1": Crater(2_164.0, 448.0),
    "I5": Crater(4_867.0, 899.0),
    "I9": Crater(6_219.0, 1_284.0),
    "I13": Crater(8_914.0, 2_949.0),
    "I15": Crater(26_469.0, 6_472.0),
    "I17": Crater(59_550.0, 8_998.0),
}


class Steady(NamedTuple):
    """A cut that goes on at one gap.

    Attributes
    ----------
    gap_um
        Distance from the wire to the front.
    rate_hz
        Sparks a second.
    voltage_share
        Mean voltage over the open one.
    volume_mm3_min
        What is removed.
    area_rate_mm2_min
        The same over the width of the cut.
    feed_um_s
        The same over the height of the work.
    """

    gap_um: float
    rate_hz: float
    voltage_share: float
    volume_mm3_min: float
    area_rate_mm2_min: float
    feed_um_s: float


def voltage_share(spark: Spark, gap_um: float) -> float:
    """Mean voltage over the open one at a gap: open until the spark, an arc while it is on, none in the pause."""
    delay_us = mean_delay_us(gap_um)
    return (delay_us + ARC_SHARE * spark.on_us) / (delay_us + spark.on_us + spark.off_us)


def steady(spark: Spark, gap_um: float, width_um: float, height_um: float) -> Steady:
    """A cut of some width in work of some height at a gap in µm."""
    period_us = mean_delay_us(gap_um) + spark.on_us + spark.off_us
    volume_mm3_min = 60e6 / period_us * CRATERS[spark.mode].mean_um3 * 1e-9
    area_rate = volume_mm3_min / mm(width_um)
    return Steady(
        gap_um=gap_um,
        rate_hz=1e6 / period_us,
        voltage_share=voltage_share(spark, gap_um),
        volume_mm3_min=volume_mm3_min,
        area_rate_mm2_min=area_rate,
        feed_um_s=area_rate / 60.0 * 1e6 / height_um,
    )


def settled_gap_um(spark: Spark, set_share: float) -> float | None:
    """Gap at which the mean voltage is the set value; None where no gap of a cut has it, or the law goes by another.

    The voltage grows with the gap from `CLOSE_UM` on: the gap is found by halving.
    """
    low, high = CLOSE_UM, FAR_UM
    if spark.law != "voltage" or not voltage_share(spark, low) < set_share < voltage_share(spark, high):
        return None
    while high - low > _NEAR_UM:
        middle = (low + high) / 2.0
        low, high = (middle, high) if voltage_share(spark, middle) < set_share else (low, middle)
    return low
