"""The circular test of whole runs: what the machine is set to is what the parts say."""

import numpy as np
import pytest
from runs import machine

from parser.controller_words import Axis
from sim.base.progress import silent
from sim.run.ballbar.circle import Ballbar, circle_test, run_test
from sim.run.ballbar.figures import DeviationParts

RADIUS_UM = 10_000.0
FEED_UM_S = 4_000.0
FRICTION_N = (60.0, 30.0)
"""Enough to push every slide against its drive all around: m·v²/R of 320 kg is 0.5 N."""


def ran(feed_um_s: float = FEED_UM_S, radius_um: float = RADIUS_UM, **table: object) -> Ballbar:
    plain = {"friction_n": (0.0, 0.0), "viscous_n_s_mm": (0.0, 0.0), "backlash_um": (0.0, 0.0)}
    return run_test(circle_test(machine(**(plain | table)), radius_um, feed_um_s), silent)


def parts(feed_um_s: float = FEED_UM_S, **table: object) -> DeviationParts:
    done = ran(feed_um_s, **table)
    assert done.losses == ()
    assert done.measured is not None
    return done.measured.parts


def test_a_rigid_table_without_friction_has_no_parts() -> None:
    found = parts()
    assert [*found.step_um, found.lag_um] == pytest.approx([0.0] * 3, abs=0.01)
    assert {reversal.spike_um for reversal in found.reversals} == {0.0}


def test_friction_alone_winds_the_drive_up() -> None:
    """The slide stays back by F/k on either side: 60 N and 30 N on 50 N/µm."""
    assert parts(friction_n=FRICTION_N).step_um == pytest.approx((2.4, 1.2), abs=0.01)


def test_backlash_is_found_as_it_is_set() -> None:
    """On top of 2F/k; a flank only pushes, so that steps throw the slide on within its slack by less than a tenth.

    By how much, ticks of a two-thousandth of a period say: 7.3466 and 4.1213 µm.
    """
    found = parts(friction_n=FRICTION_N, backlash_um=(5.0, 3.0))
    assert found.step_um == pytest.approx((5.0 + 2.4 - 0.0534, 3.0 + 1.2 - 0.0787), abs=0.005)  # µm
    for reversal in found.reversals:
        assert reversal.step_um == pytest.approx((7.3404, 4.1171)[reversal.axis], abs=0.005)


def test_backlash_of_one_axis_is_none_of_the_other() -> None:
    x, y = parts(friction_n=FRICTION_N, backlash_um=(8.0, 0.0)).step_um
    assert (x, y) == pytest.approx((10.4 - 0.0354, 1.2 - 0.0112), abs=0.005)


def test_the_step_is_that_of_the_axis_whatever_the_feed() -> None:
    """At 1 mm/s a slide stands between some of its steps, where it swung to: by a part of a step nearer."""
    slow, fast = (parts(feed, friction_n=FRICTION_N, backlash_um=(5.0, 3.0)).step_um for feed in (1_000.0, 8_000.0))
    assert slow == pytest.approx(fast, abs=0.2)


def test_viscous_friction_makes_its_axis_late() -> None:
    """c·v/k: 10 N s/mm at 4 mm/s on 50 N/µm is 0.8 µm, of X behind Y; the other way round of Y."""
    assert parts(viscous_n_s_mm=(10.0, 0.0)).lag_um == pytest.approx(0.8, abs=0.01)
    assert parts(viscous_n_s_mm=(0.0, 10.0)).lag_um == pytest.approx(-0.8, abs=0.01)
    assert parts(viscous_n_s_mm=(10.0, 10.0)).lag_um == pytest.approx(0.0, abs=0.01)


def test_the_masses_swing_out() -> None:
    """By m·ω²/k of the radius where ω is far below the drive's own: on soft drives of 5 N/µm and at 20 mm/s that is

    R·320·4/5e6 = 2.56 µm in X and 1.12 µm in Y.
    """
    omega = 20_000.0 / RADIUS_UM
    x, y = (RADIUS_UM * mass * omega**2 / 5e6 for mass in (320.0, 140.0))
    found = parts(20_000.0, drive_stiffness_n_um=5.0)
    assert found.radius_um == pytest.approx(((x + y) / 2.0,) * 2, abs=0.02)
    assert found.diameters_um == pytest.approx(2.0 * (x - y), abs=0.03)


def test_a_slide_let_go_fast_on_a_weakly_damped_drive_overshoots() -> None:
    """The slide starts at the motor's speed v sin φ: it swings by no more than that over its natural frequency."""
    calm, ringing = (
        parts(25_000.0, friction_n=FRICTION_N, backlash_um=(6.0, 6.0), drive_damping_ratio=ratio)
        for ratio in (1.0, 0.1)
    )
    flat = np.arccos(1.0 - (6.0 + 2.4) / RADIUS_UM)
    most = 25_000.0 * np.sin(flat) / np.sqrt(50e6 / 320.0)
    assert calm.spike_um(Axis.X) < 0.5 * most
    assert 0.3 * most < ringing.spike_um(Axis.X) <= most + ringing.rest_um


def test_both_directions_are_mirror_images() -> None:
    done = ran(friction_n=FRICTION_N, backlash_um=(5.0, 3.0)).measured
    assert done is not None
    assert done.figures.ccw == pytest.approx(done.figures.cw, abs=0.02)


def test_steps_lost_fail_the_test_and_move_the_circle() -> None:
    """A drive that cannot overcome its friction slips."""
    done = ran(
        radius_um=500.0, friction_n=(1500.0, 30.0), motor=machine().table.motor._replace(force_curve=((0.0, 1400.0),))
    )
    assert {loss.axis for _, loss in done.losses} == {Axis.X}
    assert not done.passes(None)


def test_a_servo_that_trips_leaves_no_figures() -> None:
    motor = machine().table.motor._replace(kind="servo", following_error_limit_um=20.0)
    done = ran(radius_um=500.0, friction_n=(1500.0, 30.0), motor=motor)
    assert {loss.kind for _, loss in done.losses} == {"trip"}
    assert done.measured is None
    assert not done.passes(None)
