"""The history of a run: lowest, highest and mean of what the table did in each bin of time, and of nothing else."""

from itertools import pairwise

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from places import SCENARIOS
from plain_table import TICK_S, PlainAxis, plain_motor, plain_places
from runs import run_folder
from table_runs import MODEL, STEPPER, draw, even_ticks, motion, moved, pulses_of

from controller.motion.limits import Feeds
from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from sim.setup.machine.machine import load_machine
from sim.table.bodies import Values, binned
from sim.table.history import (
    BINS,
    LEAST_BINS,
    QUANTITIES,
    Bins,
    Envelope,
    History,
)

WAVES = pulses_of(lambda t: 400.0 * np.sin(20.0 * t), lambda t: 300.0 * np.sin(31.0 * t), 0.5)
HELD = MODEL._replace(friction_n=(30.0, 20.0), backlash_um=(3.0, 2.0), drive_damping_ratio=0.7)


def envelopes(history: History) -> dict[str, Envelope]:
    return {name: getattr(history, name) for name in QUANTITIES}


def plainly(t_s: Floats, edges_s: Floats, values: Floats) -> Envelope:
    """Envelope (b, 2) of values (n, 2) that hold between edges (n + 1,), by going over every tick in every bin."""
    low, high, mean = [], [], []
    for begin, end in pairwise(t_s):
        inside = [
            (max(begin, edges_s[k]), min(end, edges_s[k + 1]), value)
            for k, value in enumerate(values)
            if edges_s[k] < end and edges_s[k + 1] > begin
        ]
        low.append(np.min([value for _, _, value in inside], axis=0))
        high.append(np.max([value for _, _, value in inside], axis=0))
        mean.append(sum((until - since) * value for since, until, value in inside) / (end - begin))
    return Envelope(np.array(low), np.array(high), np.array(mean))


@settings(max_examples=examples(30))
@given(st.integers(0, 2**32 - 1), st.integers(1, 120))
def test_every_tick_counts_in_each_bin_that_it_covers_for_as_long_as_it_does(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    # From far shorter than a bin to many bins long; now and then on a border of bins.
    edges = np.concatenate([[0.0], np.cumsum(10.0 ** rng.uniform(-4.0, 1.0, n))])
    edges[1:-1] = np.sort(
        np.where(rng.random(n - 1) < 0.2, np.round(edges[1:-1] / edges[-1], 2) * edges[-1], edges[1:-1])
    )
    edges, number = np.unique(edges), 0
    border_s, cells = np.linspace(0.0, edges[-1], LEAST_BINS + 1), LEAST_BINS * len(QUANTITIES)
    bins = Bins(border_s, np.full(cells, np.inf), np.full(cells, -np.inf), np.zeros(cells))
    values = rng.normal(size=(len(edges) - 1, len(QUANTITIES)))
    for since, until, row in zip(edges, edges[1:], values, strict=False):
        number = binned(bins, number, since, until, Values(*row))
    plain = plainly(border_s, edges, values)
    low, high, area = (column.reshape(LEAST_BINS, -1) for column in bins[1:])
    assert low == pytest.approx(plain.low)
    assert high == pytest.approx(plain.high)
    assert area / np.diff(border_s)[:, None] == pytest.approx(plain.mean, rel=1e-6, abs=1e-6 * np.abs(values).max())


UNTIL_S, FINE_S = 0.1, 5e-5
WITHIN = {  # where steps of 1 µm come to 500 µm/s, 0.25 m/s², 25 N
    "velocity_um_s": 8.0,
    "acceleration_um_s2": 8e3,
    "lag_um": 0.03,
    "following_error_um": 0.06,
    "force_n": 0.6,
}
STEPS_S = [0.0104, 0.0144, 0.0174, 0.0204, 0.0604, 0.0634]  # inside of bins of 1 ms
PLACES_UM = [1, 2, 3, 4, 3, 2]


def plain_history(axis: PlainAxis, bins: int) -> dict[str, Envelope]:
    """The same of one axis of a plain table without friction, in its own tiny ticks."""
    motor = plain_motor(STEPS_S, PLACES_UM, STEPPER.step_time_s, UNTIL_S + TICK_S)
    at = np.array(plain_places(axis, motor)[0])
    velocity = np.diff(at) / TICK_S
    acceleration = np.diff(velocity, prepend=0.0) / TICK_S
    commanded = np.array([0, *PLACES_UM])[np.searchsorted(STEPS_S, TICK_S * np.arange(1, len(at)))]
    lag = np.array(motor)[: len(velocity)] - at[:-1]
    force = axis.mass_kg * acceleration / 1e6
    values = dict(zip(QUANTITIES, (velocity, acceleration, lag, commanded - at[1:], force), strict=True))
    binned = {name: value[: round(UNTIL_S / TICK_S)].reshape(bins, -1) for name, value in values.items()}
    return {name: Envelope(value.min(axis=1), value.max(axis=1), value.mean(axis=1)) for name, value in binned.items()}


def test_it_is_what_a_plain_table_does() -> None:
    t_s, x = np.array(STEPS_S), np.array(PLACES_UM, dtype=np.int32)
    pulses = Pulses(t_s, x, x, np.zeros_like(x))
    ticks = even_ticks(UNTIL_S, FINE_S)
    sparse = ticks._replace(t_s=ticks.t_s[19::20], row=ticks.row[19::20])
    history = draw(MODEL, pulses, sparse).moved.history
    bins = len(history.t_s) - 1
    assert bins == LEAST_BINS
    for axis, mass_kg in enumerate(MODEL.moved_kg):
        plain = plain_history(PlainAxis(mass_kg, MODEL.drive_stiffness_n_um, MODEL.drive_damping_ratio), bins)
        for name, envelope in envelopes(history).items():
            for of, plainly_so in zip(envelope, plain[name], strict=True):
                assert of[:, axis] == pytest.approx(plainly_so, abs=WITHIN[name]), name


def test_the_mean_velocity_is_the_way_and_the_mean_acceleration_the_change_of_velocity() -> None:
    drawn = draw(HELD, WAVES, even_ticks(0.48))
    history = drawn.moved.history
    width_s = np.diff(history.t_s)[:, None]
    way = np.cumsum(history.velocity_um_s.mean * width_s, axis=0)
    at = np.stack([np.interp(history.t_s[1:], drawn.t_s, column) for column in drawn.at_um.T], axis=1)
    assert way == pytest.approx(at, abs=0.1)  # µm; lanes meet within that
    gained = (history.acceleration_um_s2.mean * width_s).sum(axis=0)
    last = np.diff(drawn.at_um[-2:], axis=0)[0] / np.diff(drawn.t_s[-2:])
    assert gained == pytest.approx(last, abs=30.0)  # µm/s of some thousand; the same


def test_after_a_trip_there_is_no_more() -> None:
    run = run_folder(SCENARIOS / "servo-trip")
    (trip,), history = run.losses, run.history
    assert history.t_s[-1] == trip.t_s
    assert len(history.t_s) - 1 < LEAST_BINS * 10
    assert history.lag_um.high[-1, 0] == pytest.approx(trip.amount_um)
    # The table swings on and the card steps on, but no more than the lag and the delay of the motor are told.
    assert history.following_error_um.high[:, 0].max() < trip.amount_um + 10.0


def test_what_the_motors_lost_stays_in_the_following_error_and_not_in_the_lag() -> None:
    run = run_folder(SCENARIOS / "lost-steps")
    assert run.losses[0].amount_um == 36.0
    assert run.history.following_error_um.mean[-1] == pytest.approx([36.0, 0.0], abs=1.5)  # µm
    assert run.history.following_error_um.low[-300:, 0].min() > 33.0
    assert run.history.lag_um.mean[-1] == pytest.approx([0.0, 0.0], abs=1.5)  # µm


def test_it_has_no_gaps_and_no_more_bins_however_long_the_run() -> None:
    chosen = motion("B1500B0B1500GXL1 B0B700B700GYL2 DD", load_machine("dk7732"), Feeds(180.0, 180.0), 0.5)
    history = moved(chosen).history
    assert len(history.t_s) == BINS + 1
    assert history.t_s[-1] == chosen.ticks.t_s[-1]
    for name, envelope in envelopes(history).items():
        assert all(column.shape == (BINS, 2) and np.isfinite(column).all() for column in envelope), name
        assert (envelope.low <= envelope.high).all(), name


def test_a_creeping_slide_follows_half_the_time_of_a_step_late() -> None:
    slow = MODEL._replace(motor=STEPPER._replace(step_time_s=0.02), drive_damping_ratio=0.7)
    machine = load_machine("dk7740")._replace(table=slow)
    chosen = motion("B100B0B100GXL1 DD", machine, Feeds(15.0, 15.0), spacing_um=25.0)
    error = moved(chosen).history.following_error_um
    assert error.mean[10:80, 0].mean() == pytest.approx(15.0 * 0.02 / 2.0, abs=0.02)  # µm
    assert error.high[10:80, 0].max() == pytest.approx(1.0, abs=0.05)  # µm, as soon as a step is commanded
