"""A swing that is repeated is the one that its events make; at the feeds of cutting nearly all are repeated."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from depth import cases
from table_runs import MODEL, even_ticks

from controller.compiled.loops import compiled
from parser.controller_words import Axis as AxisName
from parser.geometry.curves import Floats
from sim.setup.machine.machine import load_machine
from sim.setup.machine.motor import Motor
from sim.setup.machine.table import TableModel
from sim.table.axis import Axis, AxisDemand, Leg, State, next_leg, turned_to
from sim.table.history import PEAK_COLUMNS, VALUES, Record
from sim.table.losses import Slip
from sim.table.recording import recorded
from sim.table.run import AxisRun, ByEvents, axis_of
from sim.table.swings import due_s, waited
from sim.table.ticks import Ticks

WITHIN_UM = 1e-4
LOOSE_WITHIN_UM = 0.02
"""Of a slide that coasts between the flanks of its nut, or whose motor slips: there neighbouring inputs part."""
LENGTHS = slice(2, 4)
"""Of the columns of bins: lag and following error, µm."""


class Steps(NamedTuple):
    """Pulses of one axis, and when its run ends."""

    t_s: Floats
    place_um: Floats
    until_s: float


@compiled("(Axis, AxisDemand, State, Record)", Axis, AxisDemand, State, Record)
def event_by_event(axis: Axis, demand: AxisDemand, state: State, record: Record) -> State:
    """What `sim.table.swings.followed` does, without any swing."""
    while due_s(axis, demand, state) < demand.until_s and state.noted.slip < len(record.slip_s):
        if state.tripped_s < demand.braked_s:
            break
        if state.rests:
            state = recorded(axis, demand, state, waited(state, due_s(axis, demand, state)), record)
            begins = Leg(state.course, state.course, 0.0, turned_to(axis, demand, state))
            state = recorded(axis, demand, state, begins, record)
        else:
            state = recorded(axis, demand, state, next_leg(axis, demand, state), record)
    return state


class Plainly(ByEvents):
    """An axis that goes from event to event and repeats no swing."""

    def followed(self, demand: AxisDemand, state: State, record: Record) -> State:
        return event_by_event(self._axis, demand, state, record)


def ran(model: TableModel, steps: Steps, ticks: Ticks, engine: type[ByEvents]) -> tuple[AxisRun, list[Slip]]:
    """X after its pulses, which come in two parts, and its slips."""
    axis = axis_of(model, AxisName.X, np.array([-150.0, 1e5]), 1e4)
    run = AxisRun(axis, 0, ticks, engine(axis))
    slips, half = [], len(steps.t_s) // 2
    for part in (slice(None, half), slice(half, None)):
        run.take(steps.t_s[part], steps.place_um[part])
        slips += run.follow(steps.t_s[part][-1] - run.ahead_s, math.inf)
    slips += run.follow(steps.until_s, math.inf)
    run.rest(steps.until_s, math.inf)
    return run, slips


def ticks_of(until_s: float, sample_s: float) -> Ticks:
    """Samples of a run; its ticks are not looked at."""
    return even_ticks(until_s, sample_s)


def random_case(rng: np.random.Generator) -> tuple[TableModel, Steps]:
    """Any table, steppers that slip among them; steps there and back, some slow enough to rest between, some not."""
    servo = rng.random() < 0.3
    motor = Motor(
        kind="servo" if servo else "stepper",
        step_time_s=float(rng.choice([0.0, 5e-4, 2e-3, 5e-3])),
        electrical_period_um=6.0,
        following_error_limit_um=60.0 if servo else np.inf,
        force_curve=((0.0, 10.0 ** rng.uniform(1.3, 4.0)), (2000.0, 10.0 ** rng.uniform(1.3, 3.5))),
    )
    model = MODEL._replace(
        saddle_mass_kg=rng.uniform(5.0, 300.0),
        drive_stiffness_n_um=10.0 ** rng.uniform(0.3, 2.0),
        drive_damping_ratio=rng.uniform(0.05, 1.5),
        friction_n=(float(rng.choice([0.0, 5.0, 20.0, 60.0])), 0.0),
        viscous_n_s_mm=(float(rng.choice([0.0, 2.0, 8.0])), 0.0),
        backlash_um=(float(rng.choice([0.0, 0.5, 3.0])), 0.0),
        motor=motor,
    )
    count = 400
    gaps = np.full(count, 10.0 ** rng.uniform(-2.7, -1.0)) * rng.choice([1.0, 1.0, 1.3], count)
    ways = np.where(np.arange(count) // int(rng.integers(20, 250)) % 2, -1.0, 1.0)
    t_s = np.cumsum(gaps)
    return model, Steps(t_s, np.cumsum(ways), float(t_s[-1]) + 0.5)


@pytest.mark.deep
@pytest.mark.parametrize("seed", cases(15, 4000))
def test_an_axis_does_what_its_events_do(seed: int) -> None:
    rng = np.random.default_rng(seed)
    model, steps = random_case(rng)
    ticks = ticks_of(steps.until_s, float(rng.choice([1e-3, 0.013, 0.2])))
    (ours, our_slips), (plain, slips) = (ran(model, steps, ticks, engine) for engine in (ByEvents, Plainly))
    assert ours.state.noted[:-1] == plain.state.noted[:-1], "but for the courses"
    assert ours.state.tripped_s == pytest.approx(plain.state.tripped_s, abs=1e-9)
    within_um = LOOSE_WITHIN_UM if slips or model.backlash_um[0] else WITHIN_UM
    assert [slip.amount_um for slip in our_slips] == [slip.amount_um for slip in slips]
    assert [slip.at_um for slip in our_slips] == pytest.approx([slip.at_um for slip in slips], abs=within_um)
    assert ours.record.sampled_um == pytest.approx(plain.record.sampled_um, abs=within_um)
    for name in ("low", "high"):
        columns = [getattr(run.record.bins, name).reshape(-1, VALUES)[:, LENGTHS] for run in (ours, plain)]
        assert columns[0] == pytest.approx(columns[1], abs=within_um), name
    area = [run.record.bins.area.reshape(-1, VALUES)[:, LENGTHS] for run in (ours, plain)]
    assert area[0] == pytest.approx(area[1], abs=within_um * steps.until_s)
    peaks = [run.record.peaks.reshape(-1, PEAK_COLUMNS)[:, 1:3] for run in (ours, plain)]
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-2, abs=within_um)


@pytest.mark.parametrize("name", ["dk7732", "dk7740", "dk7750"])
def test_at_the_feeds_of_cutting_nearly_all_swings_are_repeated(name: str) -> None:
    """In 40 mm steel a step comes every 20 ms: event by event each takes three courses."""
    model = load_machine(name).table
    number = np.arange(1.0, 5001.0)
    t_s = 0.02 * number
    steps = Steps(t_s, np.where(number < 3000.0, number, 6000.0 - number), 101.0)
    ticks = Ticks(np.array([101.0]), np.zeros(1, dtype=np.int64), np.empty((0, 2)), *[(1.0, 1.0)] * 3)
    ours, plain = (ran(model, steps, ticks, engine)[0].state.noted.courses for engine in (ByEvents, Plainly))
    assert plain > 2.9 * len(t_s)
    assert ours < 0.1 * len(t_s)
