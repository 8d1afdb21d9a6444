"""Where what is lost hangs on chance, it is told what runs that begin a little off lose; else they lose the same."""

import numpy as np
import pytest
from loaded_tables import SAMPLE_S, UNTIL_S, pulses_of, random_model, random_steps
from table_runs import draw, even_ticks

from parser.controller_words import Axis
from parser.findings.catalogue import texts
from parser.program import parse_program
from sim.setup.machine.motor import Motor
from sim.table.losses import Loss, loss_findings

WEAK, SURE = (356, 390), (2, 3, 4, 9, 10, 14)
"""Seeds of tables under loads: two whose losses hang on chance, as tiny shifts of the steps show; others, for sure."""


def losses_of(seed: int, shifts: np.random.Generator | None = None) -> list[Loss]:
    """Losses of a random table under a random load, whose steps come some tenths of a µs early or late, if told so."""
    rng = np.random.default_rng(seed)
    model, axes = random_model(rng), [random_steps(rng) for _ in range(2)]
    if shifts is not None:
        axes = [steps._replace(t_s=np.sort(steps.t_s + shifts.normal(0.0, 2e-7, len(steps.t_s)))) for steps in axes]
    return list(draw(model, pulses_of(axes), even_ticks(UNTIL_S, SAMPLE_S)).moved.losses)


@pytest.mark.parametrize("seed", WEAK)
def test_what_hangs_on_chance_is_told_as_a_range_and_steps_a_little_off_lose_as_differently(
    seed: int,
) -> None:
    (loss,) = (loss for loss in losses_of(seed) if loss.axis == 1)
    assert loss.least_um < loss.most_um
    shifted = {
        sum(other.amount_um for other in losses_of(seed, np.random.default_rng(shift)) if other.axis == 1)
        for shift in range(25)
    }
    assert len(shifted) > 1
    assert loss.amount_um in shifted


@pytest.mark.parametrize("seed", SURE)
def test_neighbours_of_other_runs_lose_the_same(seed: int) -> None:
    losses = losses_of(seed)
    assert losses
    assert all(loss.least_um == loss.most_um == loss.amount_um for loss in losses)


def test_the_finding_tells_the_range_in_both_languages_and_nothing_where_all_lose_the_same() -> None:
    program, motor = parse_program("B3000B0B3000GXL1 DD"), Motor("stepper", 0.002, 6.0, np.inf, ((0.0, 10.0),))
    by_chance, sure = (
        Loss("lost-steps", Axis.X, 0, 1.0, 18.0, 0.0, 0.0, neighbours)
        for neighbours in ((24.0, 18.0, -6.0, 0.0), (18.0,))
    )
    (finding,) = loss_findings(program, (by_chance,), motor)
    assert "loses 18.00 µm up to block 1 (0 to 24 µm in runs that begin 0.002 µm off)" in texts(finding, "en").found
    assert "共丢 18.00 µm（起点相差 0.002 µm 的运行丢 0 至 24 µm）" in texts(finding, "zh").found
    (finding,) = loss_findings(program, (sure,), motor)
    assert texts(finding, "en").found.endswith("up to block 1")
