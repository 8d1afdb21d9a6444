"""The table: held by its guides, moved by force over mass, lagging as springs do, stopped by its travel."""

import numpy as np
import pytest
from plans import plan_toolpath

from controller.motion.limits import Feeds, MotionLimits
from parser.program import parse_program
from sim.machine import TableModel, load_machine
from sim.table import Table, drives, ringing
from sim.ticks import SPACING_UM, choose_ticks

MODEL = TableModel(
    travel_x_mm=400.0,
    travel_y_mm=500.0,
    saddle_mass_kg=100.0,
    carriage_mass_kg=60.0,
    drive_stiffness_n_um=20.0,
    drive_damping_ratio=0.2,
    drive_force_limit_n=50.0,
)
CENTRE = (200_000.0, 250_000.0)
DT = 1e-4


def follow(model: TableModel, command: np.ndarray, dt: float = DT) -> np.ndarray:
    return np.array(list(Table(model, CENTRE).follow(np.full(len(command), dt), command)))


@pytest.mark.parametrize("axis", [0, 1])
def test_acceleration_is_force_over_mass_where_the_drive_is_at_its_limit(axis: int) -> None:
    command = np.zeros((2000, 2))
    command[:, axis] = 100_000.0  # a jump of 100 mm: the drive pulls with all it has
    at = follow(MODEL, command)[:, axis]
    t = DT * np.arange(1, 2001)
    limit = 50.0 / (160.0, 60.0)[axis] * 1e6  # µm/s²
    assert at == pytest.approx(limit * t * (t + DT) / 2, rel=1e-9)  # the tick's own share is a t dt / 2
    acceleration = np.diff(at, 2) / DT**2
    assert acceleration.max() <= limit * (1 + 1e-6)


def test_the_axes_do_not_pull_at_one_another() -> None:
    command = np.zeros((2000, 2))
    command[:, 0] = 1000.0
    assert np.abs(follow(MODEL, command)[:, 1]).max() < 1e-6  # µm


def test_step_rings_at_the_natural_frequency_with_the_closed_form_overshoot() -> None:
    command = np.zeros((8000, 2))
    command[:, 1] = 1.0
    at = follow(MODEL._replace(drive_force_limit_n=1e6), command, dt=1e-5)[:, 1]
    omega = (20.0 * 1e6 / 60.0) ** 0.5
    zeta = 0.2
    damped = omega * (1 - zeta**2) ** 0.5
    peak = int(np.argmax(at))
    t = 1e-5 * np.arange(1, 8001)
    kick = 2 * zeta * omega / damped  # the damper passes the jump on as an impulse: velocity 2ζω, over ω_d
    expected = 1 - np.exp(-zeta * omega * t) * (
        np.cos(damped * t) + (zeta * omega / damped - kick) * np.sin(damped * t)
    )
    assert at == pytest.approx(expected, abs=0.01)  # µm
    assert at[peak] > 1.2


def test_constant_velocity_leaves_no_lag_and_constant_acceleration_m_a_over_k() -> None:
    t = DT * np.arange(1, 5001)
    command = np.zeros((5000, 2))
    command[:, 1] = 500.0 * t
    assert follow(MODEL, command)[-1, 1] == pytest.approx(command[-1, 1], abs=0.01)  # µm
    command[:, 1] = 100_000.0 * t**2 / 2
    lag = command[-1, 1] - follow(MODEL, command)[-1, 1]
    assert lag == pytest.approx(60.0 * 100_000.0 / (20.0 * 1e6), rel=0.02)  # µm


def test_the_drives_stall_at_the_end_of_the_travel() -> None:
    command = np.zeros((6000, 2))
    command[:, 0] = np.linspace(0.0, 250_000.0, 6000)
    at = follow(MODEL._replace(drive_force_limit_n=2000.0), command, dt=1e-3)
    assert at[-1, 0] == pytest.approx(200_000.0, abs=0.01)
    assert at[:, 0].max() < 200_000.0 + 100.0  # µm, the swing of stopping from 42 mm/s: v / ω is 106


@pytest.mark.parametrize("dt", [1e-4, 1e-3, 0.02, 0.5])
def test_no_tick_is_too_long_to_be_stable(dt: float) -> None:
    command = np.zeros((200, 2))
    command[50:] = 3.0
    at = follow(MODEL, command, dt=dt)
    assert np.abs(at).max() < 6.0
    if dt >= 1e-3:
        assert at[-1] == pytest.approx([3.0, 3.0], abs=0.01)


def test_shipped_machine_has_the_ringing_of_its_numbers() -> None:
    model = load_machine("dk7740").table
    rate = ringing(model)
    assert rate.frequency == pytest.approx((50e6 / 320.0) ** 0.5)
    assert rate.decay == pytest.approx(0.7 * rate.frequency)
    assert drives(model)[1].mass == 140.0


FEEDS = Feeds(50.0, 10_000.0)
LIMITS = MotionLimits(100_000.0)


def test_ticks_rise_end_at_every_block_and_keep_their_spacing() -> None:
    toolpath = parse_program("B1000B0B1000GXL1 B0B333B333GYL2 B100B0B400GYNR1 DD").toolpath
    plan = plan_toolpath(toolpath, FEEDS, LIMITS)
    ticks = choose_ticks(toolpath, plan, ringing(MODEL))
    assert np.diff(ticks.t_s, prepend=0.0).min() > 0.0
    borders = plan.time_at(np.cumsum(toolpath.length_um))
    assert np.abs(ticks.t_s[:, None] - borders).min(axis=0).max() < 1e-6
    running = ticks.t_s < plan.duration_s
    assert np.diff(ticks.t_s[running]).max() <= SPACING_UM / FEEDS.cut_um_s * 1.01
    assert np.array_equal(np.unique(ticks.row), [0, 1, 2])
    assert ticks.t_s[-1] > plan.duration_s


def test_ticks_are_fine_where_the_drives_are_shaken() -> None:
    toolpath = parse_program("B5B0B5GXL1B5B0B20GYNR1B5B0B5GXL3 D B90000B0B90000GXL1 D B5B0B5GXL1B5B0B20GYNR1").toolpath
    plan = plan_toolpath(toolpath, FEEDS, LIMITS)
    ticks = choose_ticks(toolpath, plan, ringing(MODEL))
    begins = plan.time_at(np.cumsum(toolpath.length_um))[2]  # of the jump: 0.1 s up to its feed
    ramp = (begins < ticks.t_s) & (ticks.t_s < begins + 0.1)
    assert ramp.sum() > 100
    assert np.diff(ticks.t_s[ramp]).max() <= ringing(MODEL).tick_s * 1.01


def test_following_in_slices_changes_nothing() -> None:
    command = np.cumsum(np.random.default_rng(3).integers(-1, 2, (400, 2)), axis=0).astype(np.float64)
    whole, table = follow(MODEL, command), Table(MODEL, CENTRE)
    parts = [list(table.follow(np.full(len(part), DT), part)) for part in np.array_split(command, 7)]
    assert np.array_equal(whole, np.array([place for part in parts for place in part]))


def test_steps_beyond_the_travel_are_lost_for_good() -> None:
    out = np.linspace(0.0, 700.0, 3000)
    command = np.zeros((6000, 2))
    command[:, 0] = np.concatenate([out, out[::-1]])
    table = Table(MODEL, (400_000.0 - 500.0, 250_000.0))  # room for 500 µm
    at = np.array(list(table.follow(np.full(6000, 1e-3), command)))
    assert at[:, 0].max() == pytest.approx(500.0, abs=1.0)  # µm
    assert at[-1, 0] == pytest.approx(-200.0, abs=0.3)  # µm


@pytest.mark.parametrize(
    ("text", "fine"),
    [
        ("B90000B0B90000GXL1 B90000B0B90000GXL1", False),  # straight on
        ("B90000B0B90000GXL1 B0B9000B9000GXSR1", False),  # into a clockwise arc without a corner
        ("B90000B0B90000GXL1 B0B90000B90000GYL2", True),  # round a corner
        ("B90000B0B90000GXL1 B0B9000B9000GXSR3", True),  # into a clockwise arc, straight back
    ],
)
def test_ticks_are_fine_at_corners_alone(text: str, fine: bool) -> None:
    toolpath = parse_program(f"{text} DD").toolpath
    plan = plan_toolpath(toolpath, Feeds(1000.0, 1000.0), MotionLimits(100.0))
    rate = ringing(MODEL)
    ticks = choose_ticks(toolpath, plan, rate)
    corner = plan.time_at(toolpath.length_um[:1])[0]
    after = ticks.t_s[(ticks.t_s > corner + 1e-6) & (ticks.t_s < corner + rate.settled_s)]
    assert (np.diff(after).max() <= rate.tick_s * 1.01) is np.bool_(fine)
