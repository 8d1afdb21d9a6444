"""What the drives cannot do: force over mass bounds acceleration, steppers slip by whole periods, servos trip."""

import math

import numpy as np
import pytest
from table_runs import (
    MODEL,
    MOVED_KG,
    STEPPER,
    TICK_S,
    Drawn,
    draw,
    even_ticks,
    motion,
    moved,
    pulses_of,
    still,
    strong,
)

from controller.motion.limits import Feeds
from sim.setup.machine.machine import Machine, load_machine
from sim.setup.machine.motor import Motor
from sim.setup.machine.table import TableModel
from sim.table.losses import Loss

DAMPED = MODEL._replace(drive_damping_ratio=0.7)
SERVO = Motor("servo", 0.002, 6.0, 20.0, ((0.0, 1e5),))


def lost_um(drawn: Drawn, axis: int) -> float:
    return sum(loss.amount_um for loss in drawn.moved.losses if loss.axis == axis)


@pytest.mark.parametrize("axis", [0, 1])
def test_acceleration_is_never_above_force_over_mass(axis: int) -> None:
    ways = [still, still]
    ways[axis] = lambda t: np.where(t < 0.2, 10_000.0 * t, 4000.0 - 10_000.0 * t)
    drawn = draw(DAMPED._replace(motor=strong(50.0)), pulses_of(*ways, 0.3), even_ticks(0.29))
    acceleration = np.abs(np.diff(drawn.at_um[:, axis], 2)).max() / TICK_S**2
    limit = 50.0 / MOVED_KG[axis] * 1e6  # µm/s²
    assert 0.99 * limit < acceleration < 1.01 * limit


def test_the_force_falls_along_the_curve_with_the_step_rate() -> None:
    # Past the last point of the curve the force stays.
    weak = STEPPER._replace(force_curve=((0.0, 200.0), (40_000.0, 100.0), (60_000.0, 60.0)))
    for rate_hz, force_n in ((20_000.0, 150.0), (40_000.0, 100.0), (90_000.0, 60.0)):
        drawn = draw(DAMPED._replace(motor=weak), pulses_of(still, lambda t, v=rate_hz: v * t, 0.2), even_ticks(0.15))
        pulled = np.diff(drawn.at_um[:, 1], 2)[500:] / TICK_S**2 * MOVED_KG[1] / 1e6
        assert pulled.max() == pytest.approx(force_n, abs=0.5) if rate_hz > 80_000.0 else pulled.max() < 1.01 * force_n


def steady(acceleration_mm_s2: float, table: TableModel) -> Machine:
    """A machine whose jumps speed up evenly, and so softly begun that nothing rings."""
    machine = load_machine("dk7740")
    limits = machine.controller.limits._replace(acceleration_um_s2=acceleration_mm_s2 * 1e3, jerk_um_s3=1e8)
    return machine._replace(table=table, controller=machine.controller._replace(limits=limits))


@pytest.mark.parametrize("resisting", [False, True])
def test_a_plan_that_asks_for_more_than_the_force_loses_steps_and_one_that_asks_for_less_never_does(
    resisting: bool,
) -> None:
    force_n, feed_mm_s = 100.0, 150.0
    table = DAMPED._replace(motor=strong(force_n))
    if resisting:
        table = table._replace(friction_n=(30.0, 30.0), viscous_n_s_mm=(0.02, 0.02))
    text, feeds = "B0B90000B90000GYL2 DD", Feeds(feed_mm_s * 1e3, feed_mm_s * 1e3)
    low, high = 100.0, 3000.0
    for _ in range(10):
        middle = math.sqrt(low * high)
        if moved(motion(text, steady(middle, table), feeds, spacing_um=1000.0)).losses:
            high = middle
        else:
            low = middle
    # Speeding up, at the end of it viscous friction is nearly that of the full feed.
    closed = (force_n - (30.0 + 0.02 * feed_mm_s if resisting else 0.0)) / MOVED_KG[1] * 1e3
    assert low == pytest.approx(closed, rel=0.02)  # mm/s²


def slipped(axis: int = 0) -> Drawn:
    """A jerk forward that asks for more than the motor has, and slowly on."""
    ways = [still, still]
    ways[axis] = lambda t: np.where(t < 0.05, 2000.0 * t, np.minimum(100.0 + 60_000.0 * (t - 0.05), 400.0))
    return draw(DAMPED._replace(motor=strong(100.0)), pulses_of(*ways, 0.2), even_ticks(0.5))


@pytest.mark.parametrize("axis", [0, 1])
def test_a_stepper_slips_by_whole_periods_and_stays_behind_by_them(axis: int) -> None:
    drawn = slipped(axis)
    lost = lost_um(drawn, axis)
    assert lost > 0.0
    assert lost % 6.0 == 0.0
    assert drawn.at_um[-1, axis] == pytest.approx(400.0 - lost, abs=0.01)  # µm
    assert drawn.at_um[-1, 1 - axis] == 0.0
    assert {(loss.kind, int(loss.axis)) for loss in drawn.moved.losses} == {("lost-steps", axis)}
    (loss,) = drawn.moved.losses
    assert 0.05 < loss.t_s < 0.07
    reached = np.interp(loss.t_s, drawn.t_s, drawn.at_um[:, axis])
    assert (loss.x_um, loss.y_um)[axis] == pytest.approx(reached, abs=0.1)  # µm


def test_a_slip_comes_where_the_train_is_wound_up_by_its_force_and_half_a_period_and_slack() -> None:
    # The motor runs off at 2 mm/s while friction holds the table: its lag is its way.
    held = DAMPED._replace(friction_n=(1000.0, 1000.0), backlash_um=(4.0, 4.0), motor=strong(100.0))
    drawn = draw(held, pulses_of(lambda t: 2000.0 * t, still, 0.1), even_ticks(0.09))
    first = drawn.moved.losses[0]
    lag = 2000.0 * (first.t_s - STEPPER.step_time_s / 2.0)
    assert lag == pytest.approx(100.0 / 20.0 + 2.0 + 3.0, abs=0.8)  # µm; steps of 1 µm
    assert np.array_equal(drawn.at_um, np.zeros_like(drawn.at_um))


def test_steps_beyond_the_travel_are_losses_and_the_way_back_is_shifted_by_them() -> None:
    # Room for 100 µm; out 140 and back to -50.
    out_and_back = lambda t: np.interp(t, [0.0, 0.35, 0.83, 1.0], [0.0, 140.0, -50.0, -50.0])  # noqa: E731
    model = DAMPED._replace(motor=strong(100.0))
    drawn = draw(model, pulses_of(out_and_back, still, 0.95, 1e-5), even_ticks(0.94), (399_900.0, 250_000.0))
    lost = lost_um(drawn, 0)
    assert drawn.at_um[:, 0].max() == pytest.approx(100.0, abs=1e-6)  # µm
    assert lost == pytest.approx(40.0 - 8.0, abs=6.0)  # µm: past the stop, less the lag at which it slips
    assert lost % 6.0 == 0.0
    assert drawn.at_um[-1, 0] == pytest.approx(-50.0 - lost, abs=0.01)  # µm


@pytest.mark.parametrize("corner", [0.0, 1.0])
def test_the_stops_hold_at_both_ends_of_both_axes(corner: float) -> None:
    room, away = 50.0, 1.0 if corner else -1.0
    start = (corner * 400_000.0 - away * room, corner * 500_000.0 - away * room)
    pulses = pulses_of(lambda t: away * 5000.0 * t, lambda t: away * 3000.0 * t, 0.1)
    drawn = draw(DAMPED._replace(motor=strong(1000.0)), pulses, even_ticks(0.12), start)
    assert np.abs(drawn.at_um).max() == pytest.approx(room, abs=1e-6)  # µm
    assert np.abs(drawn.at_um[-1]) == pytest.approx([room, room], abs=0.01)


def largest_lag_um(model: TableModel) -> float:
    (peak,) = (p for p in draw(model, *RUSH).moved.peaks if p.quantity == "lag" and p.axis == 0)
    return peak.value


RUSH = (
    pulses_of(lambda t: np.minimum(20_000.0 * t, 1500.0), lambda t: np.minimum(500.0 * t, 50.0), 0.12),
    even_ticks(0.25),
)


def limited(limit_um: float) -> TableModel:
    return DAMPED._replace(motor=SERVO._replace(following_error_limit_um=limit_um), friction_n=(20.0, 20.0))


def test_a_servo_trips_at_its_limit_and_not_before() -> None:
    most = largest_lag_um(limited(1e6))
    assert most > 10.0
    assert draw(limited(1.001 * most), *RUSH).moved.losses == ()
    (trip,) = draw(limited(0.999 * most), *RUSH).moved.losses
    assert (trip.kind, int(trip.axis)) == ("trip", 0)
    assert trip.amount_um == pytest.approx(most, rel=2e-3)


def test_after_a_trip_both_axes_come_to_rest_and_stay() -> None:
    drawn = draw(limited(5.0), *RUSH)
    (trip,) = drawn.moved.losses
    assert abs(trip.amount_um) == pytest.approx(5.0)
    after = drawn.at_um[drawn.t_s > trip.t_s + 0.05]
    assert np.ptp(after, axis=0) == pytest.approx([0.0, 0.0], abs=1e-3)  # µm
    assert np.hypot(*(after[-1] - (trip.x_um, trip.y_um))) < 200.0  # µm; it was to go 1500


def test_losses_of_a_block_are_one_in_order_of_time() -> None:
    losses: tuple[Loss, ...] = slipped().moved.losses
    assert [loss.t_s for loss in losses] == sorted(loss.t_s for loss in losses)
    assert len({(loss.row, loss.axis) for loss in losses}) == len(losses)
