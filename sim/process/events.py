"""Events of a scenario as the loop of a cut takes them: in order, random ones drawn."""

import math
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np

from sim.process.ticks import state as ticks
from sim.process.ticks.state import Events
from sim.process.way import CutRows
from sim.setup.spark import Event, EventKind, Spark

KINDS: Final[dict[EventKind, int]] = {
    "short": ticks.SHORT,
    "chips": ticks.CHIPS,
    "break": ticks.BREAK,
    "power": ticks.POWER,
    "pause": ticks.PAUSE,
    "sparks-off": ticks.SPARKS_OFF,
    "pump-off": ticks.PUMP_OFF,
    "drum-off": ticks.DRUM_OFF,
    "set": ticks.KNOB,
    "single": ticks.SINGLE,
    "skip": ticks.SKIP,
    "origin": ticks.ORIGIN,
}
"""Kinds of events by the numbers of the loop."""
_MOST_DRAWN: Final = 10_000


class _Timed(NamedTuple):
    """An event, and its step or its tick."""

    at: float
    event: Event


def events_of(rows: CutRows, spark: Spark, events: Sequence[Event], guessed_s: float) -> Events:
    """Events in the order in which they come; random ones are drawn for `guessed_s` of a cut."""
    by_step, by_time, by_cut = list[_Timed](), list[_Timed](), list[_Timed]()
    for number, event in enumerate(with_own_breaks(spark, events)):
        if event.block is not None:
            by_step += [_Timed(step, event) for step in _steps_of(rows, event.block, event.share)]
        elif event.at_s is not None:
            by_time.append(_Timed(_ticks(event.at_s), event))
        else:
            by_cut += [_Timed(tick, event) for tick in drawn_ticks(event, spark.seed, number, guessed_s)]
    both = [each for part in (by_step, by_time, by_cut) for each in sorted(part, key=lambda each: each.at)]
    return Events(
        kind=np.array([KINDS[each.event.kind] for each in both], dtype=np.float64),
        for_s=np.array([each.event.for_s for each in both], dtype=np.float64),
        size=np.array([_size(each.event) for each in both], dtype=np.float64),
        at=np.array([each.at for each in both], dtype=np.float64),
        by_step=np.array([len(by_step)], dtype=np.float64),
        by_time=np.array([len(by_time)], dtype=np.float64),
    )


def _ticks(seconds: float) -> float:
    return float(math.floor(seconds / ticks.TICK_S + 0.5))


def _size(event: Event) -> float:
    sizes = {"short": event.clear_um, "chips": event.factor, "power": float(event.remembers), "single": event.for_s}
    return sizes.get(event.kind, event.set_value or 0.0)


def _steps_of(rows: CutRows, block: int, share: float) -> Iterator[float]:
    """The step at a share of a block, from 1; none where the block makes no step."""
    for index in np.flatnonzero(rows.row == block - 1).tolist():
        first, last = rows.way.before[index : index + 2].tolist()
        yield first + math.floor((last - first) * share)


def with_own_breaks(spark: Spark, events: Sequence[Event]) -> Sequence[Event]:
    """The events of a cut, with the breaks that come without a reason, where there are any."""
    return [*events, Event("break", per_h=spark.breaks_per_h)] if spark.breaks_per_h else events


def drawn_ticks(event: Event, seed: int, number: int, drawn_for_s: float) -> list[float]:
    """Ticks of cutting at which an event comes at random, none for one that has its place; waits are exponential.

    It goes by its own seed, else by that of the cut and its number among the events.
    """
    if event.per_h is None:
        return []
    source = [seed, number] if event.seed is None else [event.seed]
    random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(source)))
    most = min(int(drawn_for_s / 3600.0 * event.per_h * 2.0) + 20, _MOST_DRAWN)
    at_s = np.cumsum(-np.log1p(-random.random(most)) * 3600.0 / event.per_h)
    return [_ticks(each) for each in at_s[at_s < drawn_for_s].tolist()]
