"""Random rows, toolpaths and limits of motion, from a seeded generator: lines and arcs, tiny and huge, at all rules."""

import math

import numpy as np
from paths import Pen

from controller.motion.limits import (
    CornerTime,
    Feeds,
    Junction,
    JunctionDeviation,
    MotionLimits,
    SlowAt,
    StopEach,
    Through,
)
from controller.motion.planner import RowLimits
from parser.geometry.curves import Floats
from parser.toolpath import Toolpath

TURNS = (0.0, 1e-9, 0.02, 0.5, math.pi / 2, 3.0, math.pi)


def random_rows(rng: np.random.Generator, most: int = 40) -> RowLimits:
    """Limits of rows at any scale, now and then without length, at rest, with a wait, or like their neighbours."""
    n = int(rng.integers(1, most))
    return RowLimits(
        length_um=_often(rng, 0.0, _wide(rng, -6, 6, n), 0.15),
        speed_um_s=_often(rng, 50.0, _wide(rng, -3, 6, n), rng.choice([0.0, 0.9])),
        acceleration_um_s2=_often(rng, 1e3, _wide(rng, 0, 9, n), rng.choice([0.0, 0.9])),
        border_um_s=_often(rng, 0.0, _often(rng, math.inf, _wide(rng, -3, 6, n + 1), 0.7), 0.1),
        wait_s=_often(rng, 0.0, rng.uniform(0.0, 2.0, n + 1), 0.9),
    )


def random_toolpath(rng: np.random.Generator, most: int = 15) -> Toolpath:
    """Lines and arcs that meet at any turn; some jumps, and blocks without length."""
    pen, heading = Pen(*rng.uniform(-1e4, 1e4, 2)), rng.uniform(-math.pi, math.pi)
    for _ in range(int(rng.integers(1, most))):
        heading += rng.choice([-1, 1]) * rng.choice([*TURNS, rng.uniform(0.0, math.pi)])
        size = 10.0 ** rng.uniform(-1, 4)
        if rng.random() < 0.1:
            pen.to(pen.x, pen.y)
        elif rng.random() < 0.4:
            sweep = rng.choice([-1, 1]) * rng.uniform(0.01, 2.0 * math.pi)
            side = heading + math.copysign(math.pi / 2.0, sweep)
            pen.arc(pen.x + size * math.cos(side), pen.y + size * math.sin(side), sweep)
            heading += sweep
        else:
            draw = pen.jump if rng.random() < 0.2 else pen.to
            draw(pen.x + size * math.cos(heading), pen.y + size * math.sin(heading))
    return pen.path()


def random_limits(rng: np.random.Generator, jerk_um_s3: float = math.inf) -> MotionLimits:
    """Limits of motion with any rule of junctions."""
    speeds, accelerations = _wide(rng, 1, 4, 2), _wide(rng, 2, 6, 2)
    return MotionLimits(
        acceleration_um_s2=float(_wide(rng, 2, 6, 1)[0]),
        axis_speed_um_s=tuple(_often(rng, math.inf, speeds, 0.5)),
        axis_acceleration_um_s2=tuple(_often(rng, math.inf, accelerations, 0.5)),
        start_speed_um_s=float(rng.choice([0.0, rng.uniform(0.0, 50.0)])),
        junction=random_rule(rng),
        corner_wait_s=float(rng.choice([0.0, 0.3])),
        jerk_um_s3=jerk_um_s3,
    )


def random_rule(rng: np.random.Generator) -> Junction:
    rules = (Through(), SlowAt(20.0), StopEach(), JunctionDeviation(2.0), CornerTime(0.02, 5000.0))
    return rules[int(rng.integers(len(rules)))]


def random_feeds(rng: np.random.Generator) -> Feeds:
    return Feeds(*map(float, _wide(rng, 1, 4, 2)))


def _wide(rng: np.random.Generator, low: float, high: float, n: int) -> Floats:
    """Numbers of any size between two powers of ten."""
    return 10.0 ** rng.uniform(low, high, n)


def _often(rng: np.random.Generator, value: float, others: Floats, share: float) -> Floats:
    return np.where(rng.random(len(others)) < share, value, others)
