"""The table answers as the closed forms of a damped mass on a spring say, with friction and slack where it has them."""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from places import SCENARIOS
from runs import run_folder
from table_runs import MODEL, MOVED_KG, STEPPER, TICK_S, draw, even_ticks, pulses_of, still

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from sim.table import follow
from sim.table.drive import drives_of
from sim.table.kicks import Kick, kicked
from sim.table.turning import motors_um as turned_um

FRICTION_N, VISCOUS_N_S_MM, BACKLASH_UM = (30.0, 20.0), (2.0, 1.5), (3.0, 2.0)
RESISTING = MODEL._replace(friction_n=FRICTION_N, viscous_n_s_mm=VISCOUS_N_S_MM, drive_damping_ratio=0.7)
SLACK = RESISTING._replace(backlash_um=BACKLASH_UM)
STIFFNESS = MODEL.drive_stiffness_n_um


def motors_um(pulses: Pulses, t_s: Floats, step_time_s: float = STEPPER.step_time_s) -> Floats:
    """The motors' places (n, 2): each pulse is a ramp of `step_time_s`, and they add up."""
    place = np.zeros((len(t_s), 2))
    for axis, steps in enumerate((pulses.x_um, pulses.y_um)):
        size = np.diff(steps, prepend=0)
        share = np.clip((t_s[:, None] - pulses.t_s) / step_time_s, 0.0, 1.0)
        place[:, axis] = share @ size
    return place


@pytest.mark.deeper
def test_motors_go_evenly_from_step_to_step_and_fast_steps_add_up() -> None:
    pulses = pulses_of(lambda t: 3000.0 * t, lambda t: 500.0 * np.sin(40.0 * t), 0.2)
    t_s = np.linspace(0.0, 0.21, 3000)
    found = turned_um(pulses, np.zeros(2), STEPPER.step_time_s, t_s)
    assert found == pytest.approx(motors_um(pulses, t_s), abs=1e-6)  # µm


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("feed_um_s", [5_000.0, -20_000.0])
def test_at_constant_velocity_the_lag_is_friction_and_viscous_over_stiffness(axis: int, feed_um_s: float) -> None:
    ways = [still, still]
    ways[axis] = lambda t: feed_um_s * t
    pulses, ticks, late = pulses_of(*ways, 0.4), even_ticks(0.39), slice(-200, None)
    at = draw(RESISTING, pulses, ticks).at_um[1:]
    lag = (motors_um(pulses, ticks.t_s[late]) - at[late])[:, axis].mean() * np.sign(feed_um_s)
    resisting_n = FRICTION_N[axis] + VISCOUS_N_S_MM[axis] * abs(feed_um_s) / 1e3
    assert lag == pytest.approx(resisting_n / STIFFNESS, abs=0.01)  # µm, of 1 to 3.5


def test_slack_adds_half_of_it_to_the_lag() -> None:
    pulses = pulses_of(lambda t: 5000.0 * t, lambda t: -5000.0 * t, 0.4)
    loose, tight = (draw(model, pulses, even_ticks(0.39)).at_um[-200:].mean(axis=0) for model in (SLACK, RESISTING))
    assert tight - loose == pytest.approx([1.5, -1.0], abs=0.01)  # µm


@pytest.mark.parametrize("axis", [0, 1])
def test_constant_acceleration_adds_mass_times_acceleration_over_stiffness(axis: int) -> None:
    acceleration = 1e6  # µm/s²
    ways = [still, still]
    ways[axis] = lambda t: acceleration * t**2 / 2.0
    pulses, ticks, late = pulses_of(*ways, 0.2), even_ticks(0.19), slice(-300, None)
    at = draw(MODEL._replace(drive_damping_ratio=0.7), pulses, ticks).at_um[1:]
    lag = (motors_um(pulses, ticks.t_s[late]) - at[late])[:, axis].mean()
    assert lag == pytest.approx(MOVED_KG[axis] * acceleration / (STIFFNESS * 1e6), abs=0.02)  # µm, of 8 and 3


def free_swing(at_um: float, speed_um_s: float, omega: float, ratio: float, t_s: Floats) -> Floats:
    """Way from rest over time of an oscillator let go at a place with a speed."""
    damped = omega * (1.0 - ratio**2) ** 0.5
    sine = (speed_um_s + ratio * omega * at_um) / damped
    return np.exp(-ratio * omega * t_s) * (at_um * np.cos(damped * t_s) + sine * np.sin(damped * t_s))


@pytest.mark.parametrize(("axis", "ratio"), [(0, 0.05), (0, 0.6), (1, 0.2)])
def test_let_go_it_rings_at_the_damped_frequency_and_dies_at_its_rate(axis: int, ratio: float) -> None:
    ways = [still, still]
    size, tick_s = 100.0, 2e-5
    ways[axis] = lambda t: np.where(t > 0.0, size, 0.0)
    model = MODEL._replace(drive_damping_ratio=ratio, motor=STEPPER._replace(step_time_s=0.02))
    at = draw(model, pulses_of(*ways, 0.1), even_ticks(0.2, tick_s)).at_um[:, axis]
    # The motor comes to its place at an even speed and stops: from there on the table rings freely.
    stop = round(0.02 / tick_s) + 2
    speed = (at[stop + 1] - at[stop - 1]) / (2.0 * tick_s)
    omega = (STIFFNESS * 1e6 / MOVED_KG[axis]) ** 0.5
    expected = size + free_swing(at[stop] - size, speed, omega, ratio, tick_s * np.arange(len(at) - stop))
    assert np.ptp(expected) > 5.0
    assert at[stop:] == pytest.approx(expected, abs=0.02)  # µm, of swings of some 10


@pytest.mark.parametrize("ratio", [0.05, 0.6])
def test_a_single_step_overshoots_by_the_closed_form(ratio: float) -> None:
    # A motor that all but jumps: its damper passes the jump on as an impulse, velocity 2ζω.
    size, tick_s = 100.0, 2e-5
    jumping = MODEL._replace(drive_damping_ratio=ratio, motor=STEPPER._replace(step_time_s=1e-4))
    pulses = pulses_of(still, lambda t: np.where(t > 0.0, size, 0.0), 0.01)
    at = draw(jumping, pulses, even_ticks(0.1, tick_s)).at_um[:, 1]
    omega = (STIFFNESS * 1e6 / MOVED_KG[1]) ** 0.5
    t_s = np.linspace(0.0, 0.1, 100_001)
    closed = size + free_swing(-size, 2.0 * ratio * omega * size, omega, ratio, t_s)
    assert at.max() == pytest.approx(closed.max(), abs=0.1)  # µm, of 100
    assert tick_s * at.argmax() == pytest.approx(
        t_s[closed.argmax()] + 5e-5, abs=4e-5
    )  # s; mean of the jump, two ticks


@pytest.mark.parametrize("turn", [-1, 1])
def test_a_circle_at_constant_feed_has_radius_and_phase_of_the_second_order_response(turn: int) -> None:
    radius, rate, turn_ticks = 5_000.0, 10.0 * np.pi, 2000  # µm, rad/s: 157 mm/s
    ratio, step_s = 0.4, STEPPER.step_time_s
    begun = partial(np.interp, xp=[0.0, 0.2], fp=[0.0, 1.0])
    pulses = pulses_of(
        lambda t: radius * begun(t) * np.cos(rate * t), lambda t: radius * begun(t) * np.sin(turn * rate * t), 0.7
    )
    at = draw(MODEL._replace(drive_damping_ratio=ratio), pulses, even_ticks(0.68)).at_um[-turn_ticks:]
    s = 1j * rate
    wave = np.exp(s * (6801 - turn_ticks + np.arange(turn_ticks)) * TICK_S)
    for axis, asked in ((0, radius), (1, radius * turn / 1j)):
        omega = (STIFFNESS * 1e6 / MOVED_KG[axis]) ** 0.5
        passed = omega**2 + 2.0 * ratio * omega * s
        response = passed / (passed + s**2) * (1.0 - np.exp(-s * step_s)) / (s * step_s)
        got = 2.0 * np.mean(at[:, axis] / wave) / asked
        assert radius * abs(got) == pytest.approx(radius * abs(response), abs=0.05)  # µm; the radius grows by 35 and 12
        assert np.angle(got) == pytest.approx(np.angle(response), abs=1e-5)  # rad; 0.03 late


@pytest.mark.deeper
def test_without_friction_and_damping_energy_drifts_by_less_than_a_percent_over_100_000_ticks() -> None:
    model = MODEL._replace(drive_damping_ratio=0.0)
    for drive in drives_of(model):
        at = velocity = 0.0
        energy = np.empty(100_000)
        for number in range(len(energy)):
            before = velocity
            velocity, _ = kicked(drive, Kick(100.0 - at, 0.0, before, TICK_S, np.inf))
            energy[number] = ((before + velocity) / 2.0) ** 2 + drive.spring * (100.0 - at) ** 2
            at += velocity * TICK_S
        assert np.ptp(energy) < 0.01 * energy[0]


def test_half_the_tick_changes_nothing() -> None:
    pulses = pulses_of(lambda t: 300.0 * np.sin(20.0 * t), lambda t: 200.0 * np.sin(31.0 * t), 0.5)
    whole, half = (draw(SLACK, pulses, even_ticks(0.48, tick_s)).at_um for tick_s in (TICK_S, TICK_S / 2.0))
    assert whole == pytest.approx(half[::2], abs=0.05)  # µm, at up to 9 mm/s


@pytest.mark.alike(1)
@pytest.mark.parametrize("axis", [0, 1])
def test_at_each_reversal_the_table_stands_for_the_backlash_and_twice_the_hold_of_friction(axis: int) -> None:
    # Steps take much longer than they are apart, and the turn is so slow that no mass is felt.
    even = STEPPER._replace(step_time_s=0.05)
    ways = [still, still]
    ways[axis] = lambda t: 100.0 * np.sin(6.0 * t)
    pulses, ticks = pulses_of(*ways, 2.0, grid_s=1e-5), even_ticks(1.95)
    model = SLACK._replace(viscous_n_s_mm=(0.0, 0.0), motor=even)
    at, motor = draw(model, pulses, ticks).at_um[1:, axis], motors_um(pulses, ticks.t_s, 0.05)[:, axis]
    damper_s = 2.0 * model.drive_damping_ratio * (MOVED_KG[axis] / (STIFFNESS * 1e6)) ** 0.5  # over the stiffness
    for begin, end in pairwise([0.0, *(np.pi * (np.arange(3.0) + 0.5) / 6.0 + 0.2)]):
        stretch = slice(*np.searchsorted(ticks.t_s, [begin + 0.05, end]))
        turned, stood = motor[stretch], at[stretch]
        turn = np.flatnonzero(np.abs(turned) > np.abs(turned).max() - 1e-6)[-1]
        rest = turn + np.abs(stood[turn:]).argmax()
        off = rest + np.flatnonzero(np.abs(stood[rest:] - stood[rest]) > 1e-3)[0]
        way = abs(turned[off] - turned[turn]) + damper_s * abs(turned[off + 1] - turned[off]) / TICK_S
        assert off - turn > 50
        assert way == pytest.approx(BACKLASH_UM[axis] + 2.0 * FRICTION_N[axis] / STIFFNESS, abs=0.1)  # µm, of 6 and 4


@pytest.mark.parametrize("name", ["backlash", "servo-trip", "lost-steps"])
def test_axes_side_by_side_move_as_one_after_the_other(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    one_by_one = run_folder(SCENARIOS / name)
    monkeypatch.setattr(follow, "_SIDE_BY_SIDE", 0)
    side_by_side = run_folder(SCENARIOS / name)
    assert np.array_equal(side_by_side.trace.table_um, one_by_one.trace.table_um)
    assert (side_by_side.losses, side_by_side.peaks) == (one_by_one.losses, one_by_one.peaks)
