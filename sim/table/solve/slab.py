"""A slab: some hundred thousand ticks in a row, with what the drives are asked for in each."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from sim.setup.machine.table_model import TableModel
from sim.table.physics.motor import Motors
from sim.table.when.ticks import Ticks, parts
from sim.units import engine_force

RATE_WINDOW_S = 0.02
"""Time over which the step rate is taken, to each side; 50 Hz is one step of it."""


class Slab(NamedTuple):
    """n ticks in a row, and one without length after them.

    Attributes
    ----------
    t_s
        (n + 1,), start of each tick.
    length_s, divisor_s
        (n + 1,), of each tick; the divisor is 1 where the length is 0.
    long, from_rest
        (n + 1,), whether a tick is a long one, and whether it comes after one: then the axes stand.
    place_um, speed_um_s
        (n + 1, 2), of the motors: in the middle of the kick of a short tick, at the end of a long one.
    steps, chained
        (n + 1, 2) and (n + 1,), steps of the motors that a long tick goes through; chained where they count from the
        end of the long tick before it, since this one begins while a step is felt.
    limit
        (n + 1, 2), largest force of the drives over the mass they move, µm/s².
    stretch
        (n,), stretch of the ticks that each belongs to.
    """

    t_s: Floats
    length_s: Floats
    divisor_s: Floats
    long: NDArray[np.bool_]
    from_rest: NDArray[np.bool_]
    place_um: Floats
    speed_um_s: Floats
    steps: Floats
    chained: NDArray[np.bool_]
    limit: Floats
    stretch: Ints

    def __len__(self) -> int:
        return len(self.stretch)


class _Stretches(NamedTuple):
    """Stretches of a slab.

    Attributes
    ----------
    borders_s, tick_s
        (n + 1,) and (n,), their borders, and the longest tick in each.
    origin
        (n,), stretch of the run that each is part of.
    since_s
        (n,), time from which on the steps of a long tick count.
    """

    borders_s: Floats
    tick_s: Floats
    origin: Ints
    since_s: Floats


def slab_of(ticks: Ticks, part: slice, motors: Motors, model: TableModel, felt_s: float) -> Slab:
    """The ticks of some stretches, up to a sample; `motors` has the pulses of them."""
    borders, tick_s, origin, since = _calmed(ticks, part, motors, felt_s)
    begins, ends = borders[:-1], borders[1:]
    number = parts(ends - begins, tick_s)
    stretch = np.repeat(np.arange(len(number)), number)
    length = ((ends - begins) / number)[stretch]
    start = begins[stretch] + (np.arange(len(stretch)) - (np.cumsum(number) - number)[stretch]) * length
    long = np.isinf(tick_s)[stretch]
    from_um, until_um = _motor_ways(motors, begins, ends, number, np.isinf(tick_s))
    limit = _limits(motors, begins, ends, number, model)
    before = np.concatenate([[False], long[:-1]])
    return Slab(
        t_s=np.append(start, ends[-1]),
        length_s=np.append(length, 0.0),
        divisor_s=np.append(length, 1.0),
        long=np.append(long, False),
        from_rest=np.append(before, False),
        place_um=_with_last(np.where(long[:, None], until_um, (from_um + until_um) / 2.0)),
        speed_um_s=_with_last((until_um - from_um) / length[:, None]),
        steps=_with_last((motors.commanded_um(ends) - motors.commanded_um(since))[stretch]),
        chained=np.append((since < begins)[stretch], False),
        limit=_with_last(limit),
        stretch=origin[stretch] + part.start,
    )


def _calmed(ticks: Ticks, part: slice, motors: Motors, felt_s: float) -> _Stretches:
    """Stretches of a run, in which each long tick begins and ends while no step is felt.

    Steps that are not slow are cut out of long ticks. Where a long tick would end while a step is felt, it ends before
    that step. The next long tick then begins while the step is felt: it is chained, and its steps count from the end
    of the long tick before it. Where there is none before it, its stretch gets short ticks.
    """
    borders, tick_s, origin = _cut(ticks, part, motors.hasty_s(felt_s))
    long = np.flatnonzero(np.isinf(tick_s[:-1]))
    begins, ends = borders[long], motors.calm_s(borders[long + 1], felt_s)
    # Next to hasty steps, and at the end of a slab, a border is calm as it is.
    chained = motors.calm_s(begins, felt_s) < begins
    chainable = np.append(False, np.diff(long) == 2)[: len(long)]
    good = _unbroken((ends > begins) & (~chained | chainable), chained)
    since = begins.copy()
    since[chained & good] = ends[np.flatnonzero(chained & good) - 1]
    borders[long[good] + 1] = ends[good]
    tick_s[long[~good]] = tick_s[long[~good] + 1]
    since_s = borders[:-1].copy()
    since_s[long[good]] = since[good]
    return _Stretches(borders, tick_s, origin, since_s)


def _cut(ticks: Ticks, part: slice, windows: Floats) -> tuple[Floats, Floats, Ints]:
    """Borders (n + 1,), longest ticks and origins (n,) of stretches, cut at windows (m, 2) that hold no long tick."""
    borders = np.concatenate([[ticks.t_s[part.start - 1] if part.start else 0.0], ticks.t_s[part]])
    edges = windows.ravel()
    edges = edges[np.isinf(ticks.tick_s[part])[np.clip(np.searchsorted(borders, edges) - 1, 0, len(borders) - 2)]]
    cuts = np.union1d(borders, edges[(edges > borders[0]) & (edges < borders[-1])])
    middle = (cuts[:-1] + cuts[1:]) / 2.0
    origin = np.searchsorted(borders, middle) - 1
    tick_s, window = ticks.tick_s[part][origin], np.searchsorted(windows[:, 0], middle) - 1
    hasty = (window >= 0) & (middle < np.append(windows[:, 1], -np.inf)[window])
    return cuts, np.where(hasty & np.isinf(tick_s), ticks.step_tick_s, tick_s), origin


def _unbroken(good: NDArray[np.bool_], chained: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which long ticks (n,) are good, and so are all that they are chained to, back to one that is not chained."""
    bad = np.cumsum(~good)
    first = np.maximum.accumulate(np.where(chained, 0, np.arange(len(good))))
    unbroken: NDArray[np.bool_] = good & (bad == bad[first])
    return unbroken


def _motor_ways(
    motors: Motors, begins: Floats, ends: Floats, number: Ints, long: NDArray[np.bool_]
) -> tuple[Floats, Floats]:
    """Places (n, 2) of the motors at both ends of each kick: half a tick before and after its tick begins.

    Those of a long tick are at its own ends. In a stretch each kick begins where the one before it ended.
    """
    length = (ends - begins) / number
    edges = number + 1
    stretch = np.repeat(np.arange(len(edges)), edges)
    edge = np.arange(len(stretch)) - (np.cumsum(edges) - edges)[stretch]
    t_s = np.where(long, begins, begins - length / 2.0)[stretch] + edge * length[stretch]
    places = motors.at_um(t_s)
    return places[edge < number[stretch]], places[edge > 0]


def _limits(motors: Motors, begins: Floats, ends: Floats, number: Ints, model: TableModel) -> Floats:
    """Force over mass (n, 2) µm/s² that the motors have in each tick, at the step rate about it.

    Stretches of `number` ticks are looked at in shares of no more than the time over which the rate is taken.
    """
    shares = np.minimum(parts(ends - begins, np.full(len(begins), RATE_WINDOW_S)), number)
    share = np.repeat(np.arange(len(shares)), shares)
    within = np.arange(len(share)) - (np.cumsum(shares) - shares)[share]
    t_s = begins[share] + (within + 0.5) * ((ends - begins) / shares)[share]
    rate_hz, force_n = np.array(model.motor.force_curve).T
    moved = motors.at_um(t_s + RATE_WINDOW_S) - motors.at_um(t_s - RATE_WINDOW_S)
    limit_n = np.interp(np.abs(moved) / (2.0 * RATE_WINDOW_S), rate_hz, force_n)
    limits: Floats = engine_force(limit_n) / np.array(model.moved_kg)
    stretch = np.repeat(np.arange(len(number)), number)
    tick = np.arange(len(stretch)) - (np.cumsum(number) - number)[stretch]
    return limits[(np.cumsum(shares) - shares)[stretch] + tick * shares[stretch] // number[stretch]]


def _with_last(rows: Floats) -> Floats:
    return np.concatenate([rows, rows[-1:]])
