"""What steppers lose against the stops of the travel, beside a motor that is followed tick by tick."""

import math

import numpy as np
import pytest
from runs import machine, plain_scenario

from parser.program import parse_program
from sim.run.dryrun import dry_run
from sim.table.physics.bodies import Engines
from sim.table.physics.drive import drives_of
from sim.table.solve.lanes import Lanes
from sim.table.solve.march import RunTable, pull_out_um
from sim.table.solve.slab import Slab
from sim.table.solve.slow_step import NO_PLAY
from sim.table.solve.stops import lost_at_stops_um


def slab_at(place_um: np.ndarray, limit: np.ndarray) -> Slab:
    n = len(place_um)
    none, no = np.zeros(n), np.zeros(n, dtype=bool)
    return Slab(none, none, none, no, no, place_um, place_um, place_um, no, limit, np.arange(n - 1))


@pytest.mark.parametrize("seed", range(8))
def test_what_is_lost_at_a_stop_is_that_of_a_motor_followed_tick_by_tick(seed: int) -> None:
    rng = np.random.default_rng(seed)
    model = machine().table
    room = np.array([[-4000.0, -900.0], [500.0, 2500.0]])
    table = RunTable(model, room, NO_PLAY, Engines(model, room))
    before, period = rng.integers(-5, 5, 2) * model.motor.electrical_period_um, model.motor.electrical_period_um
    # A walk that meets no more than one stop of an axis.
    walk = np.cumsum(rng.normal([0.4, -0.3], 3.0, (4000, 2)), axis=0)
    place = np.clip(walk, [-4000.0, -2500.0], [2000.0, 2500.0]) + before
    limit = np.broadcast_to(rng.uniform(3e7, 6e7, (4000, 1)), (4000, 2)).copy()
    found = lost_at_stops_um(slab_at(place, limit), before, table)
    most = pull_out_um(drives_of(model), model, limit.T).T
    lost = before.astype(float)
    for tick in range(len(place)):
        assert found[tick].tolist() == lost.tolist()
        for axis in (0, 1):
            lag = place[tick, axis] - lost[axis] - np.clip(place[tick, axis] - lost[axis], *room[:, axis])
            if abs(lag) > most[tick, axis]:
                lost[axis] += math.copysign(math.ceil((abs(lag) - most[tick, axis]) / period) * period, lag)
    assert (lost != before).any()


def test_a_table_against_its_stop_takes_no_more_passes_than_one_that_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    runs: list[int] = []
    run = Lanes.run

    def counted(lanes: Lanes, which: np.ndarray, begin: object) -> None:
        runs.append(len(which))
        run(lanes, which, begin)  # type: ignore[arg-type]

    monkeypatch.setattr(Lanes, "run", counted)
    program = parse_program("B15000B0B15000GXL1 DD")
    found = dry_run(program, plain_scenario(start_mm=(399.0, 250.0), past_stop=True, may_stay_open=True))
    (loss,) = found.losses
    pull_out_um = 15_700.0 / 50.0 + 1.0 + 3.0  # at the 43.75 Hz of its steps: force over spring, slack, half a period
    assert loss.amount_um == math.ceil((14_000.0 - pull_out_um) / 6.0) * 6.0
    assert len(runs) <= 12
    assert found.trace.table_um[-1, 0] == pytest.approx(1000.0, abs=1e-6)
