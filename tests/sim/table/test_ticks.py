"""Ticks: fine where the drives are shaken, long where nothing happens, and the table as in fine ticks all the way."""

from itertools import pairwise

import numpy as np
import pytest
from plans import plan_toolpath
from runs import scenario_recording
from table_runs import MODEL, Drawn, draw, even_ticks, farthest_um, fixed, motion, moved, pulses_of

from controller.motion.limits import Feeds, MotionLimits
from controller.stepping.steps import interpolate
from parser.program import parse_program
from sim.cut.wire_lag import bowed
from sim.setup.machine.machine import load_machine
from sim.table import follow
from sim.table.history import QUANTITIES
from sim.table.motion import Moved, motion_of
from sim.table.ticks import MOST_PROBES, SPACED, Sampling, Ticks, _windows, choose_ticks, probes_of, rhythm
from sim.table.trace import Trace

BEATS = rhythm(MODEL._replace(drive_damping_ratio=0.7))


def ticks_of(text: str, feeds: Feeds, limits: MotionLimits, spacing_um: float = 5.0) -> tuple[Ticks, np.ndarray]:
    """Ticks of a program, and the times at which its blocks end."""
    toolpath = parse_program(f"{text} DD").toolpath
    plan = plan_toolpath(toolpath, feeds, limits)
    return choose_ticks(toolpath, plan, BEATS, Sampling(spacing_um)), plan.time_at(np.cumsum(toolpath.length_um))


def test_ticks_rise_sample_the_end_of_every_block_and_keep_their_spacing() -> None:
    text = "B1000B0B1000GXL1 B0B333B333GYL2 B100B0B400GYNR1"
    ticks, borders = ticks_of(text, Feeds(50.0, 10_000.0), MotionLimits(100_000.0))
    sampled = ticks.t_s
    assert np.diff(sampled, prepend=0.0).min() > 0.0
    assert np.abs(sampled[:, None] - borders).min(axis=0).max() < 1e-6
    assert np.diff(sampled[sampled < borders[-1]]).max() <= 5.0 / 50.0 * 1.01
    assert np.array_equal(np.unique(ticks.row), [0, 1, 2])
    assert sampled[-1] == pytest.approx(borders[-1] + BEATS.died_s)


@pytest.mark.parametrize(
    ("text", "fine"),
    [
        ("B90000B0B90000GXL1 B90000B0B90000GXL1", False),  # straight on
        ("B90000B0B90000GXL1 B0B9000B9000GXSR1", False),  # into a clockwise arc without a corner
        ("B90000B0B90000GXL1 B0B90000B90000GYL2", True),  # round a corner
        ("B90000B0B90000GXL1 B0B9000B9000GXSR3", True),  # into a clockwise arc, straight back
    ],
)
def test_ticks_are_finest_at_corners_alone(text: str, fine: bool) -> None:
    ticks, borders = ticks_of(text, Feeds(1000.0, 1000.0), MotionLimits(100.0))
    at_the_corner = (ticks.shaken_s[:, 0] <= borders[0]) & (ticks.shaken_s[:, 1] > borders[0] + 0.9 * BEATS.died_s)
    assert at_the_corner.any() is np.bool_(fine)


@pytest.mark.parametrize("lag_um", [5.0, 20.0, 150.0])
def test_behind_a_corner_samples_show_how_far_a_wire_that_lags_cuts_it_off(lag_um: float) -> None:
    """A right angle is cut off by 0.482 lag (`sim.cut.wire_lag`), whatever the spacing on the rest of the path."""
    toolpath = parse_program("B3000B0B3000GXL1 B0B3000B3000GYL2 DD").toolpath
    plan = plan_toolpath(toolpath, Feeds(50.0, 50.0), MotionLimits(100_000.0))
    ticks = choose_ticks(toolpath, plan, BEATS, Sampling(5.0, lag_um))
    along = np.append(0.0, plan.at(ticks.t_s).along_um)
    guides = np.stack([np.minimum(along, 3000.0), np.maximum(along - 3000.0, 0.0)], axis=1)
    trace = Trace(np.append(0.0, ticks.t_s), guides, guides, guides, np.append(0, ticks.row))
    wire = bowed(trace, toolpath, np.full(len(toolpath), lag_um)).wire_um
    off = np.minimum(np.abs(wire[:, 1]), np.abs(wire[:, 0] - 3000.0)).max()
    assert off == pytest.approx(0.482 * lag_um, rel=2e-3)
    assert len(ticks.t_s) < len(choose_ticks(toolpath, plan, BEATS, Sampling(5.0)).t_s) + 201


def test_samples_behind_many_corners_are_bounded() -> None:
    toolpath = parse_program("B10B0B10GXL1 B0B10B10GYL2 " * 4000 + "DD").toolpath
    plan = plan_toolpath(toolpath, Feeds(50.0, 50.0), MotionLimits(100_000.0))
    ticks = choose_ticks(toolpath, plan, BEATS, Sampling(5.0, 20.0))
    assert len(ticks.t_s) < 2 * SPACED
    assert np.diff(ticks.t_s).min() > 0.0


SQUARE = "B300B0B300GXL1 B0B300B300GYL2 B300B0B300GXL3 B0B300B300GYL4 B100B0B400GYNR1 DD"
RAPID = "B3000B0B3000GXL1 B0B2000B2000GYL2 B1000B1000B2000GYNR4 B2500B0B2500GXL3 B700B1900B1900GYL1 DD"
WANDERING = """B37B11B37GXL1 B41B29B41GXL1 B23B44B44GYL1 B18B50B50GYL2 B51B13B51GXL2
B33B40B40GYL3 B60B7B60GXL3 B12B45B45GYL4 B55B20B55GXL4 B47B31B47GXL1 DD"""


@pytest.mark.parametrize(
    ("name", "text", "feed_um_s"),
    [
        ("dk7732", SQUARE, 180.0),
        ("dk7740", SQUARE, 180.0),
        ("dk7750", WANDERING, 180.0),
        ("dk7750", RAPID, 500.0),
        ("dk7740", WANDERING, 43.75),
        ("dk7740", RAPID, 500.0),
        ("servo-400x500", WANDERING, 180.0),
        ("servo-400x500", RAPID, 10_000.0),
    ],
)
def test_chosen_ticks_leave_the_trace_within_a_tenth_of_a_um_of_fine_ticks_all_the_way(
    name: str, text: str, feed_um_s: float
) -> None:
    chosen = motion(text, load_machine(name), Feeds(feed_um_s, feed_um_s))
    assert farthest_um(moved(chosen), moved(fixed(chosen))) < 0.1


LOOSE = MODEL._replace(
    friction_n=(30.0, 20.0), viscous_n_s_mm=(2.0, 1.5), backlash_um=(3.0, 2.0), drive_damping_ratio=0.7
)
WEAK = LOOSE._replace(motor=LOOSE.motor._replace(force_curve=((0.0, 150.0),)))
WAVES = pulses_of(lambda t: 400.0 * np.sin(20.0 * t), lambda t: 300.0 * np.sin(31.0 * t), 0.5)
TICKS = even_ticks(0.48)


def in_parts(parts: int) -> Drawn:
    following = follow.Following(follow.Setup(WEAK, (200_000.0, 250_000.0), (0, 0)), TICKS)
    borders = np.linspace(0, len(WAVES.t_s), parts + 1).astype(int).tolist()
    for since, until in pairwise(borders):
        following.take(WAVES.part(since, until))
    moved = Moved(*following.finish())
    assert moved.losses
    return Drawn(moved.trace.t_s, moved.trace.table_um, moved)


def test_the_run_is_the_same_to_the_byte_however_its_pulses_are_cut() -> None:
    whole = in_parts(1)
    for parts in (1, 2, 7, 60):
        cut = in_parts(parts)
        assert cut.at_um.tobytes() == whole.at_um.tobytes()
        assert cut.moved.losses == whole.moved.losses
        assert cut.moved.peaks == whole.moved.peaks
        for name in QUANTITIES:
            assert np.array_equal(getattr(cut.moved.history, name), getattr(whole.moved.history, name))


def test_axes_do_not_pull_at_one_another() -> None:
    both = draw(LOOSE, WAVES, TICKS, (200_000.0, 250_000.0)).at_um
    none = np.zeros_like(WAVES.x_um)
    alone = [draw(LOOSE, WAVES._replace(**{other: none}), TICKS).at_um for other in ("y_um", "x_um")]
    assert both[:, 0] == pytest.approx(alone[0][:, 0], abs=0.01)  # µm
    assert both[:, 1] == pytest.approx(alone[1][:, 1], abs=0.01)  # µm
    assert not alone[0][:, 1].any()
    assert not alone[1][:, 0].any()


def test_at_a_stop_as_much_is_lost_in_chosen_ticks_as_in_fine_ones() -> None:
    machine, beyond = load_machine("dk7740"), "B500B0B500GXL1 B500B0B500GXL3 DD"
    toolpath, feeds = parse_program(beyond).toolpath, machine.feeds(40.0)
    chosen = motion_of(toolpath, feeds, machine, (399_950.0, 250_000.0), Sampling(5.0))  # 50 µm from the stop
    run, fine = moved(chosen), moved(fixed(chosen))
    assert [(loss.row, loss.amount_um) for loss in run.losses] == [(loss.row, loss.amount_um) for loss in fine.losses]
    assert sum(loss.amount_um for loss in run.losses) == 132.0
    apart = np.abs(run.trace.table_um - fine.trace.table_um)
    assert apart[-1] == pytest.approx([0.0, 0.0], abs=0.1)  # µm
    assert apart.max() < 0.5  # µm, where it meets the stop


@pytest.mark.parametrize("scenario", ["keyhole", "gear"])
def test_pulses_that_are_looked_at_are_pulses_of_the_run_and_lie_around_borders(scenario: str) -> None:
    recording = scenario_recording(scenario)
    run, steps = recording.run, np.unique(recording.steps.t_s)
    probes = probes_of(interpolate(run.toolpath), run.plan, None)

    assert (np.diff(probes) >= 0.0).all()
    nearest = np.minimum(np.searchsorted(steps, probes), len(steps) - 1)
    assert np.minimum(np.abs(steps[nearest] - probes), np.abs(steps[nearest - 1] - probes)).max() < 1e-9
    for border_s in run.border_s[1:-1] if scenario == "keyhole" else ():  # the gear has more than are looked at
        assert np.abs(probes - border_s).min() < 0.1  # s: a step takes some ms


def test_of_few_pulses_all_are_looked_at() -> None:
    assert _windows(MOST_PROBES, np.array([0, 7, MOST_PROBES])) == [(0, MOST_PROBES)]
    windows = _windows(3 * MOST_PROBES, np.arange(0, 3 * MOST_PROBES + 1, 100))
    flat = [number for window in windows for number in window]
    assert flat == sorted(flat)
    assert flat[0] >= 0
    assert flat[-1] <= 3 * MOST_PROBES
    assert sum(past - first for first, past in windows) < 1.5 * MOST_PROBES
