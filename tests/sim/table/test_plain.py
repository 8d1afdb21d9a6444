"""The table does what a plain table in tiny ticks does, whatever its masses, friction, slack, force and steps."""

from dataclasses import replace

import numpy as np
from depth import cases
from hypothesis import given, settings
from hypothesis import strategies as st
from plain_table import TICK_S, PlainAxis, plain_motor, plain_places
from table_runs import STEPPER, draw, even_ticks

from controller.stepping.pulses import Pulses
from sim.setup.machine.table import TableModel

UNTIL_S, LAST_S, FINE_S = 0.1, 0.08, 5e-5
FINER_S = 2e-5  # where it slips: a slip comes up to a tick late
STIFFNESS = 30.0

Runs = list[tuple[int, float, int]]


def axes(slack_um: tuple[float, ...], friction_n: tuple[float, ...]) -> st.SearchStrategy[PlainAxis]:
    return st.builds(
        PlainAxis,
        mass_kg=st.floats(20.0, 200.0),
        stiffness_n_um=st.just(STIFFNESS),
        ratio=st.just(0.0),
        friction_n=st.sampled_from(friction_n),
        viscous_n_s_mm=st.sampled_from([0.0, 3.0]),
        backlash_um=st.sampled_from(slack_um),
    )


tight = axes((0.0,), (0.0, 5.0, 20.0, 60.0))
loose = axes((0.5, 3.0), (10.0, 20.0, 60.0))  # what swings in its slack without friction tells nothing
runs = st.lists(
    st.tuples(st.integers(1, 12), st.floats(30.0, 3000.0), st.sampled_from([-1, 1])), min_size=1, max_size=6
)


def steps_of(runs: Runs) -> tuple[list[float], list[int]]:
    """Times and places of runs of steps: how many, at what rate, which way."""
    t_s, place = 0.001, 0
    times, places = [], []
    for count, rate_hz, way in runs:
        for _ in range(count):
            t_s, place = t_s + 1.0 / rate_hz, place + way
            if t_s < LAST_S:
                times.append(t_s)
                places.append(place)
    return times, places


def pulses_of_both(x_runs: Runs, y_runs: Runs) -> Pulses:
    events = sorted(
        (t_s, axis, place)
        for axis, run in enumerate((x_runs, y_runs))
        for t_s, place in zip(*steps_of(run), strict=True)
    )
    at, rows = [0, 0], []
    for _, axis, place in events:
        at[axis] = place
        rows.append(tuple(at))
    places = np.array(rows, dtype=np.int32).reshape(-1, 2)
    return Pulses(np.array([t_s for t_s, _, _ in events]), *places.T, np.zeros(len(rows), dtype=np.int32))


def table_of(
    saddle: PlainAxis, carriage: PlainAxis, ratio: float, force_n: float
) -> tuple[TableModel, list[PlainAxis]]:
    """A table, and its axes: the Y drive moves the carriage, the X drive that and the saddle."""
    x = replace(saddle, mass_kg=saddle.mass_kg + carriage.mass_kg, ratio=ratio, force_n=force_n)
    y = replace(carriage, ratio=ratio, force_n=force_n)
    model = TableModel(
        travel_x_mm=400.0,
        travel_y_mm=500.0,
        saddle_mass_kg=saddle.mass_kg,
        carriage_mass_kg=carriage.mass_kg,
        drive_stiffness_n_um=STIFFNESS,
        drive_damping_ratio=ratio,
        motor=STEPPER._replace(force_curve=((0.0, force_n),)),
        friction_n=(x.friction_n, y.friction_n),
        viscous_n_s_mm=(x.viscous_n_s_mm, y.viscous_n_s_mm),
        backlash_um=(x.backlash_um, y.backlash_um),
    )
    return model, [x, y]


def apart_um(model: TableModel, axes: list[PlainAxis], axis_runs: tuple[Runs, Runs], fine_s: float = FINE_S) -> float:
    """Largest distance between both tables on either axis, at the end of each tick; their slips are the same."""
    drawn = draw(model, pulses_of_both(*axis_runs), even_ticks(UNTIL_S, fine_s))
    farthest = 0.0
    for number, (axis, run) in enumerate(zip(axes, axis_runs, strict=True)):
        motor = plain_motor(*steps_of(run), STEPPER.step_time_s, UNTIL_S + TICK_S)
        places, slips = plain_places(axis, motor)
        lost = sum(slips) or sum(map(abs, slips))  # where slips back make good those forth, all of their way
        assert sum(loss.amount_um for loss in drawn.moved.losses if loss.axis == number) == lost
        plain = np.array(places)[:: round(fine_s / TICK_S)]
        farthest = max(farthest, float(np.abs(plain - drawn.at_um[:, number]).max()))
    return farthest


@settings(max_examples=len(cases(6, 15)))
@given(tight, tight, st.floats(0.1, 1.5), runs, runs)
def test_without_slack_it_agrees_with_a_plain_table(
    saddle: PlainAxis, carriage: PlainAxis, ratio: float, x_runs: Runs, y_runs: Runs
) -> None:
    assert apart_um(*table_of(saddle, carriage, ratio, 1e5), (x_runs, y_runs)) < 0.02  # µm


@settings(max_examples=len(cases(6, 15)))
@given(loose, loose, st.floats(0.1, 1.5), runs, runs)
def test_with_slack_it_agrees_with_a_plain_table(
    saddle: PlainAxis, carriage: PlainAxis, ratio: float, x_runs: Runs, y_runs: Runs
) -> None:
    assert apart_um(*table_of(saddle, carriage, ratio, 1e5), (x_runs, y_runs)) < 0.15  # µm


@settings(max_examples=len(cases(4, 10)))
@given(tight, tight, st.floats(60.0, 200.0), runs, runs)
def test_at_the_limit_of_its_force_it_agrees_with_a_plain_table(
    saddle: PlainAxis, carriage: PlainAxis, force_n: float, x_runs: Runs, y_runs: Runs
) -> None:
    assert apart_um(*table_of(saddle, carriage, 0.7, force_n), (x_runs, y_runs), FINER_S) < 0.05  # µm


def test_it_slips_when_a_plain_table_does() -> None:
    axis = PlainAxis(60.0, STIFFNESS, 0.0, friction_n=20.0, backlash_um=2.0)
    burst = [(40, 3000.0, 1)]
    model, axes = table_of(axis, axis, 0.7, 80.0)
    _, slips = plain_places(axes[0], plain_motor(*steps_of(burst), STEPPER.step_time_s, UNTIL_S))
    assert slips == [6.0]
    assert apart_um(model, axes, (burst, burst)) < 0.3  # µm; it slips up to a tick later
