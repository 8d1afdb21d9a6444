"""The laws of the servo and what stops a cut, tick by tick beside plain re-implementations of a few lines."""

import math
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from spark_cuts import straight

from sim.process.cut import job_of, run_sparks, start_state
from sim.process.ticks import chance
from sim.process.ticks import state as ticks
from sim.process.ticks.state import Job
from sim.process.ticks.tick import run_ticks
from sim.process.way import cut_rows
from sim.setup.spark import Law, Spark

TICKS = 4000


def started(spark: Spark) -> tuple[Job, np.ndarray]:
    work = straight(20_000)
    return job_of(work, cut_rows(work), spark, ()), start_state(spark)


def ticks_of(spark: Spark) -> Iterator[tuple[float, float, float, float, float, float]]:
    """Of each tick: time open, on and short in µs, sparks, whether nothing ignites, steps made in it."""
    job, state = started(spark)
    for _ in range(TICKS):
        before = state[ticks.AT]
        assert run_ticks(job, state, 1) == ticks.RUNNING
        is_far = state[ticks.GAP_UM] >= ticks.FAR_UM
        yield (
            *state[[ticks.OPEN_US, ticks.ON_US, ticks.SHORT_US, ticks.TICK_SPARKS]].tolist(),
            float(is_far),
            float(state[ticks.AT] - before),
        )


def by_voltage() -> Callable[..., float]:
    learned = 0.0

    def speed(open_us: float, on_us: float, short_us: float, _sparks: float, is_far: float) -> float:
        nonlocal learned
        error = (open_us + 0.3 * on_us) / 1000.0 - 0.4
        if short_us:
            learned = 0.0
        elif not is_far:
            learned = min(max(learned + 1000.0 * error * 0.001 / 0.2, 0.0), 300.0)
        return min(max(1000.0 * error + learned, -300.0), 300.0) / 1000.0

    return speed


def by_window() -> Callable[..., float]:
    def way(open_us: float, _on_us: float, short_us: float, _sparks: float, _is_far: float) -> float:
        return 1.0 if open_us > 500.0 else -5.0 if short_us > 500.0 else 0.0

    return way


def by_duty() -> Callable[..., float]:
    learned = 0.0

    def speed(_open_us: float, _on_us: float, short_us: float, sparks: float, is_far: float) -> float:
        nonlocal learned
        error = 0.75 - min(sparks * 83.0 / 1000.0, 1.0)
        if short_us:
            learned = 0.0
        elif not is_far:
            learned = min(max(learned + 300.0 * error * 0.001, 5.0), 2000.0)
        return min(max(300.0 * error + learned, 5.0), 2000.0) / 1000.0

    return speed


@pytest.mark.parametrize(
    ("law", "plain", "least_um_s"), [("voltage", by_voltage, None), ("window", by_window, None), ("duty", by_duty, 5.0)]
)
def test_a_law_moves_as_a_plain_one(law: Law, plain: Callable[[], Callable[..., float]], least_um_s: float) -> None:
    """Steps of 1 µm: whole ones of what adds up, forward and back. The first 50 µm of a cut hold all that there is."""
    way_of, rest, at = plain(), 0.0, 0.0
    for *seen, steps in ticks_of(Spark(law=law, least_um_s=least_um_s)):
        rest += way_of(*seen)
        wanted = math.trunc(rest)
        rest -= wanted
        if at + wanted < 0.0:
            wanted, rest = -at, 0.0
        assert steps == wanted
        at += steps


def test_sparks_leave_out_what_their_law_cannot_do() -> None:
    """A lowest feed above what sparks remove pushes the wire into the work: the law by sparks cannot go back."""
    run = run_sparks(straight(5_000), Spark(law="duty"))
    assert run.stopped is not None
    assert run.stopped.kind == "shorted"
    assert run.retreated_um == 0.0


def test_a_set_value_below_every_voltage_shorts_again_and_again() -> None:
    run = run_sparks(straight(2_000), Spark(set_value=0.1))
    assert run.shorts > 50
    assert run.stopped is None
    assert run.mean.gap_um < chance.CLOSE_UM


def test_the_same_seed_gives_the_same_run_and_another_one_another() -> None:
    first, again, other = (run_sparks(straight(3_000), Spark(seed=seed)) for seed in (5, 5, 6))
    assert first.history.tobytes() == again.history.tobytes()
    assert first[1:13] == again[1:13] or first.time_s == again.time_s
    assert first.sparks != other.sparks


def test_random_numbers_are_those_of_lecuyer() -> None:
    """The generator as it is published, in whole numbers of any size; 10^4 of them, from the seeds 1 and 1."""
    state = np.zeros(ticks.STATE_SIZE)
    first = second = state[ticks.SEED_1] = state[ticks.SEED_2] = 1
    for _ in range(10_000):
        first, second = 40014 * int(first) % 2147483563, 40692 * int(second) % 2147483399
        both = first - second
        wanted = (both + 2147483562 if both < 1 else both) / 2147483563
        assert chance.random_share.function(state) == pytest.approx(wanted, rel=1e-15)
