"""A closed position loop does what its law says: against fine ticks on any machine, and against closed forms."""

import fine_table
import numpy as np
import pytest
from depth import cases
from fine_table import fine_axis
from loaded_tables import SAMPLE_S, UNTIL_S, pulses_of, random_loop, random_model, random_steps
from table_runs import MODEL, draw, even_ticks, still
from table_runs import pulses_of as pulses_along

from parser.geometry.curves import Floats
from sim.setup.machine.motor import Feedback, Motor, PositionLoop
from sim.setup.machine.table import TableModel

WITHIN_UM = 0.02
SPEED_UM_S, LASTS_S, STRONG = 2000.0, 1.0, ((0.0, 1e6),)
BACKLASH_UM, FRICTION_N = 5.0, 10.0
LOST_UM = BACKLASH_UM / 2.0 + FRICTION_N / MODEL.drive_stiffness_n_um


def closed(loop: PositionLoop, model: TableModel = MODEL, trips_um: float = 1e6) -> TableModel:
    return model._replace(motor=Motor("servo", 0.002, 6.0, trips_um, STRONG, loop))


def loop(gain_per_s: float = 50.0, forward: float = 0.0, feedback: Feedback = "motor") -> PositionLoop:
    return PositionLoop(gain_per_s, forward, 0.001, feedback, 0.0)


LOOSE = MODEL._replace(
    drive_damping_ratio=1.0, backlash_um=(BACKLASH_UM, BACKLASH_UM), friction_n=(FRICTION_N, FRICTION_N)
)


def behind_um(model: TableModel) -> float:
    """How far the slide of X is behind an even feed at last."""
    drawn = draw(model, pulses_along(lambda t_s: SPEED_UM_S * t_s, still, LASTS_S), even_ticks(LASTS_S, 1e-3))
    return float(SPEED_UM_S * drawn.t_s[900] - drawn.at_um[900, 0])


@pytest.mark.alike(2)
@pytest.mark.parametrize("seed", cases(16, 1000))
def test_any_loop_on_any_table_takes_it_where_fine_ticks_do(seed: int) -> None:
    rng = np.random.default_rng(seed)
    model, axes = closed(random_loop(rng), random_model(rng)), [random_steps(rng) for _ in range(2)]
    drawn = draw(model, pulses_of(axes), even_ticks(UNTIL_S, SAMPLE_S))
    for axis in range(2):
        fine = fine_table.followed(fine_axis(model, axis), *axes[axis], drawn.t_s)
        if fine.settled:
            assert np.abs(drawn.at_um[:, axis] - fine.at_um).max() < WITHIN_UM


@pytest.mark.parametrize("gain", [20.0, 50.0, 200.0])
@pytest.mark.parametrize("forward", [0.0, 0.6, 1.0])
def test_a_loop_stays_behind_an_even_feed_by_what_its_gain_and_feed_forward_leave(gain: float, forward: float) -> None:
    lag_um = SPEED_UM_S * (1.0 - forward) / gain
    assert behind_um(closed(loop(gain, forward), LOOSE)) == pytest.approx(lag_um + LOST_UM, abs=0.01)


@pytest.mark.parametrize("forward", [0.0, 1.0])
def test_a_scale_takes_backlash_and_what_the_drive_gives_way_into_the_loop(forward: float) -> None:
    lag_um = SPEED_UM_S * (1.0 - forward) / 50.0
    assert behind_um(closed(loop(50.0, forward, "scale"), LOOSE)) == pytest.approx(lag_um, abs=0.01)


def test_of_a_way_each_look_leaves_what_the_gain_leaves_of_it() -> None:
    """A step of 100 µm at once, on a drive so stiff that the slide stands where its motor does."""
    stiff = MODEL._replace(drive_stiffness_n_um=1e4, drive_damping_ratio=1.0)
    drawn = draw(
        closed(loop(100.0), stiff), pulses_along(lambda t_s: 100.0 * (t_s > 0.01), still, 0.1), even_ticks(0.1, 1e-3)
    )
    left_um: Floats = 100.0 - drawn.at_um[20:60, 0]
    assert left_um[1:] / left_um[:-1] == pytest.approx(1.0 - 100.0 * 0.001, abs=1e-3)


def test_a_loop_trips_by_what_it_looks_at_not_by_the_lag_of_its_slide() -> None:
    feed = pulses_along(lambda t_s: SPEED_UM_S * t_s, still, LASTS_S)
    run = draw(closed(loop(50.0), LOOSE, 30.0), feed, even_ticks(LASTS_S, 1e-3))
    (trip,) = run.moved.losses
    assert (trip.kind, trip.axis.name) == ("trip", "X")
    assert 30.0 < trip.amount_um < 30.0 + SPEED_UM_S * 0.001  # it looks once a period
    assert not draw(closed(loop(50.0), LOOSE, 41.0), feed, even_ticks(LASTS_S, 1e-3)).moved.losses  # 40 µm behind


def test_near_enough_to_a_command_that_stands_the_motor_stands_too() -> None:
    near = PositionLoop(50.0, 0.0, 0.001, "scale", 0.5)
    forth = pulses_along(lambda t_s: np.minimum(SPEED_UM_S * t_s, 100.0), still, LASTS_S)
    drawn = draw(closed(near, LOOSE), forth, even_ticks(LASTS_S, 1e-3))
    assert np.ptp(drawn.at_um[600:, 0]) == 0.0
    assert abs(100.0 - drawn.at_um[-1, 0]) <= 0.5


def test_bodies_of_pymunk_close_the_same_loop() -> None:
    forth = pulses_along(lambda t_s: np.minimum(SPEED_UM_S * t_s, 40.0), still, 0.12)
    for feedback in ("motor", "scale"):
        model = closed(loop(80.0, 0.5, feedback), LOOSE)
        exact, bodies = (draw(model, forth, even_ticks(0.12, 2e-5), engine=engine) for engine in ("compiled", "pymunk"))
        assert np.abs(exact.at_um - bodies.at_um).max() < 0.1
