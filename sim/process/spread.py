"""How long a cut takes where things happen at random: between which times most runs of it lie."""

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np

from sim.process.events import drawn_ticks, with_own_breaks
from sim.process.ticks.state import TICK_S
from sim.setup.spark import Event, Spark

LEVEL: Final = 0.9
"""Share of runs whose time lies between the ends."""
_DRAWS: Final = 20_000
_STREAM: Final = 1_000_003  # of the random numbers here: none of those of an event


class TimeWithin(NamedTuple):
    """Times between which `LEVEL` of all runs lie, s."""

    least_s: float
    most_s: float


class _Loss(NamedTuple):
    """What happens so often an hour, costs so many seconds each time, and came so often in this run."""

    per_h: float
    each_s: float
    times: int


def time_within(
    spark: Spark, events: Sequence[Event], times_s: tuple[float, float], length_um: float, drawn_for_s: float
) -> TimeWithin | None:
    """Between which times runs of a cut lie whose seeds differ; None where nothing comes at random.

    What came in this run is taken off its time, and as much put on as comes in others: how often something comes in a
    time is Poisson's, and each time costs about the same. `times_s` are that of the run and what of it was cutting,
    `length_um` is the path, `drawn_for_s` the time for which random events were drawn.
    """
    time_s, cut_s = times_s
    losses = list(_losses(spark, events, cut_s, length_um, drawn_for_s))
    if not losses:
        return None
    steady_s = max(time_s - sum(loss.each_s * loss.times for loss in losses), 0.0)
    random = np.random.Generator(np.random.PCG64(np.random.SeedSequence([spark.seed, _STREAM])))
    lost_s = sum(loss.each_s * random.poisson(loss.per_h * cut_s / 3600.0, _DRAWS) for loss in losses)
    least, most = np.quantile(lost_s, [0.5 - LEVEL / 2.0, 0.5 + LEVEL / 2.0]).tolist()
    return TimeWithin(steady_s + least, steady_s + most)


def _losses(
    spark: Spark, events: Sequence[Event], cut_s: float, length_um: float, drawn_for_s: float
) -> Iterator[_Loss]:
    for number, event in enumerate(with_own_breaks(spark, events)):
        if event.per_h is not None:
            drawn = drawn_ticks(event, spark.seed, number, drawn_for_s)
            times = sum(tick * TICK_S < cut_s for tick in drawn)
            yield _Loss(event.per_h, _seconds_of(event, spark, length_um), times)


def _seconds_of(event: Event, spark: Spark, length_um: float) -> float:
    """About how long an event holds a cut up, s; a broken wire on average from the middle of the path."""
    if event.kind in {"break", "pump-off", "drum-off"}:
        return spark.thread_s + length_um / spark.jog_um_s * (spark.threading == "start")
    if event.kind == "short":
        return min(2.0 * event.clear_um / spark.back_um_s, event.for_s)
    return {"power": spark.restart_s, "pause": event.for_s, "sparks-off": event.for_s}.get(event.kind, 0.0)
