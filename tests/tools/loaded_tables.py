"""Random tables under random loads: any machine that a file may describe, and steps at any rate, there and back."""

from typing import NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from sim.setup.machine.motor import Motor, PositionLoop
from sim.setup.machine.table import TableModel

UNTIL_S = 0.15
SAMPLE_S = 7.5e-4


class Steps(NamedTuple):
    """Steps of one axis: when each comes, and the place that it commands."""

    t_s: Floats
    place_um: Floats


def random_model(rng: np.random.Generator) -> TableModel:
    """Any machine that a file may describe, from a light stiff one to a heavy soft one; its motor may be too weak."""

    def between(low: float, high: float) -> float:
        return float(10.0 ** rng.uniform(low, high))

    def often_none(low: float, high: float) -> tuple[float, float]:
        return tuple(float(rng.choice([0.0, between(low, high)])) for _ in range(2))

    step_time_s = float(rng.choice([0.002, between(-5, -2), between(-4, -1.5), 0.0]))
    motor = Motor("stepper", step_time_s, 6.0, np.inf, ((0.0, float(rng.choice([1e6, between(1.5, 3.0)]))),))
    return TableModel(
        travel_x_mm=400.0,
        travel_y_mm=500.0,
        saddle_mass_kg=between(0.0, 3.5),
        carriage_mass_kg=between(0.0, 3.5),
        drive_stiffness_n_um=between(-0.5, 3.0),
        drive_damping_ratio=between(-2.0, 1.0),
        motor=motor,
        friction_n=often_none(0.0, 2.5),
        viscous_n_s_mm=often_none(-1.0, 1.5),
        backlash_um=often_none(-0.5, 1.3),
    )


def random_loop(rng: np.random.Generator) -> PositionLoop:
    """A loop as drives have it, from a soft to a stiff one, which at the worst rings."""
    period_s = float(10.0 ** rng.uniform(-3.7, -2.3))
    return PositionLoop(
        gain_per_s=min(float(10.0 ** rng.uniform(0.7, 2.6)), 1.5 / period_s),
        feed_forward=float(rng.choice([0.0, 1.0, rng.uniform(0.0, 1.2)])),
        period_s=period_s,
        feedback="scale" if rng.random() < 0.5 else "motor",
        in_position_um=float(rng.choice([0.0, rng.uniform(0.1, 2.0)])),
    )


def random_steps(rng: np.random.Generator) -> Steps:
    """Runs of steps at 20 to 16,000 Hz, there and back, with pauses."""
    t_s, place, times, places = 0.001, 0, [], []
    while t_s < 0.8 * UNTIL_S:
        rate_hz, way = 10.0 ** rng.uniform(1.3, 4.2), int(rng.choice([-1, 1]))
        for _ in range(int(rng.integers(1, 60))):
            t_s, place = t_s + 1.0 / rate_hz, place + way
            times.append(t_s)
            places.append(place)
        if rng.random() < 0.3:
            t_s += rng.uniform(0.0, 0.02)
    due = np.array(times) < 0.8 * UNTIL_S
    return Steps(np.array(times)[due], np.array(places, dtype=np.float64)[due])


def pulses_of(axes: list[Steps]) -> Pulses:
    """The steps of both axes in one train."""
    t_s = np.concatenate([steps.t_s for steps in axes])
    order = np.argsort(t_s, kind="stable")
    places = []
    for steps in axes:
        before = np.searchsorted(steps.t_s, t_s[order], side="right")
        places.append(np.append(0.0, steps.place_um)[before].astype(np.int32))
    return Pulses(t_s[order], *places, np.zeros(len(order), dtype=np.int32))


def boundless_model(rng: np.random.Generator) -> TableModel:
    """A machine from anywhere within the bounds of machine files, however absurd."""

    def between(low: float, high: float) -> float:
        return float(10.0 ** rng.uniform(low, high))

    def often_none(low: float, high: float) -> tuple[float, float]:
        return tuple(float(rng.choice([0.0, between(low, high)])) for _ in range(2))

    servo = rng.random() < 0.3
    motor = Motor(
        kind="servo" if servo else "stepper",
        step_time_s=float(rng.choice([0.0, between(-6, 0)])),
        electrical_period_um=between(-1, 4),
        following_error_limit_um=between(-1, 6) if servo else np.inf,
        force_curve=((0.0, between(-1, 6)), (between(1, 4), between(-1, 6))),
        loop=random_loop(rng) if servo and rng.random() < 0.5 else None,
    )
    return TableModel(
        travel_x_mm=400.0,
        travel_y_mm=500.0,
        saddle_mass_kg=between(-2, 5),
        carriage_mass_kg=between(-2, 5),
        drive_stiffness_n_um=between(-3, 5),
        drive_damping_ratio=between(-2, 1),
        motor=motor,
        friction_n=often_none(-3, 6),
        viscous_n_s_mm=often_none(-3, 6),
        backlash_um=often_none(-3, 4),
    )
