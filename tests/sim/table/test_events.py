"""From event to event the table is where ticks of some nanoseconds take it, on any machine and under any load."""

import time

import fine_table
import numpy as np
import pytest
from depth import cases
from fine_table import Fine, fine_axis
from loaded_tables import SAMPLE_S, UNTIL_S, boundless_model, pulses_of, random_model, random_steps
from table_runs import Drawn, draw, even_ticks

from sim.setup.machine.table import TableModel
from sim.table.history import QUANTITIES

WITHIN_UM = 0.02
PEAKS_WITHIN = 2e-3
SLOWEST_S = 5.0
"""Of processor time for 0.15 s of motion; each takes less than 0.02 s."""


def farthest(drawn: Drawn, axis: int) -> list[float]:
    """How far velocity, µm/s, lag, µm, and force, N, come from 0 by the history of a run."""
    history = drawn.moved.history
    envelopes = (history.velocity_um_s, history.lag_um, history.force_n)
    return [float(max(-envelope.low[:, axis].min(), envelope.high[:, axis].max())) for envelope in envelopes]


def run_of(seed: int) -> tuple[TableModel, Drawn, list[Fine]]:
    """A random table under a random load, and both axes of it in fine ticks."""
    rng = np.random.default_rng(seed)
    model, axes = random_model(rng), [random_steps(rng) for _ in range(2)]
    drawn = draw(model, pulses_of(axes), even_ticks(UNTIL_S, SAMPLE_S))
    return model, drawn, [fine_table.followed(fine_axis(model, axis), *axes[axis], drawn.t_s) for axis in range(2)]


@pytest.mark.alike(2)
@pytest.mark.parametrize("seed", cases(16, 1000))
def test_any_table_under_any_load_is_where_fine_ticks_take_it_and_loses_the_same_steps(seed: int) -> None:
    model, drawn, axes = run_of(seed)
    for axis, fine in enumerate(axes):
        if fine.settled:
            lost_um = sum(loss.amount_um for loss in drawn.moved.losses if loss.axis == axis)
            assert np.abs(drawn.at_um[:, axis] - fine.at_um).max() < WITHIN_UM
            assert lost_um == fine.lost_um
            speed, lag_um, force = farthest(drawn, axis)
            assert speed == pytest.approx(fine.farthest[0], rel=PEAKS_WITHIN, abs=0.1)  # µm/s
            assert lag_um == pytest.approx(fine.farthest[1], rel=PEAKS_WITHIN, abs=WITHIN_UM)
            assert force == pytest.approx(
                fine.farthest[2] * fine_axis(model, axis).mass_kg / 1e6, rel=0.01, abs=0.01
            )  # N


@pytest.mark.alike(20)
@pytest.mark.parametrize("seed", cases(100, 2000))
def test_any_machine_within_the_bounds_of_files_comes_to_an_end_with_finite_figures(seed: int) -> None:
    rng = np.random.default_rng(seed)
    model, axes = boundless_model(rng), [random_steps(rng) for _ in range(2)]
    start_um = (float(rng.choice([20.0, 200_000.0])), 250_000.0)  # now and then beside a stop of the travel
    begin_s = time.process_time()
    drawn = draw(model, pulses_of(axes), even_ticks(UNTIL_S, SAMPLE_S), start_um)
    assert time.process_time() - begin_s < SLOWEST_S
    assert np.isfinite(drawn.at_um).all()
    history = drawn.moved.history
    assert all(np.isfinite(column).all() for name in QUANTITIES for column in getattr(history, name))
