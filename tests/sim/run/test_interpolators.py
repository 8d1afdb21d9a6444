"""A run by either interpolator: what each costs against the ideal path, and what machine and scenario say of it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from places import SCENARIOS
from runs import machine as shipped
from runs import run_folder, run_text, silent

from parser.findings.errors import SettingsError
from parser.program import read_program
from sim.run.report import build_report
from sim.run.running import dry_run
from sim.setup.machine.machine import read_controller
from sim.setup.scenario import load_scenario

RING = "B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B9900GXL3 DD"
FAST = {"path_acceleration_mm_s2": 500.0, "cut_step_limit_hz": 1e6, "jump_feed_mm_s": 5.0}


def by_card(text: str, **changes: object):
    return run_text(text, machine=shipped().stepping_by("card"), **changes)


def test_the_card_keeps_within_half_a_step_of_the_plan_on_each_axis() -> None:
    run = by_card(RING)
    assert run.deviations.sampling is not None
    assert max(run.deviations.sampling.axis_um) == pytest.approx(0.5, abs=1e-3)  # µm: it comes near, and no farther
    assert max(run.deviations.sampling.axis_um) <= 0.5 + 1e-6  # µm
    assert run.deviations.steps.max_um <= 0.5 * 2**0.5 + 1e-6  # µm, of both axes together
    assert run.deviations.interpolation.max_um == run.deviations.steps.max_um


def test_point_by_point_keeps_within_a_step_of_the_path() -> None:
    run = run_text(RING)
    assert run.deviations.sampling is None
    assert 0.9 < run.deviations.interpolation.max_um <= 1.0 + 1e-6  # µm


def test_chord_error_is_that_of_the_closed_form() -> None:
    stops = {"junction": "stop"}  # a corner at full speed is cut off between two periods
    controller = read_controller(
        {"controller": FAST | stops | {"servo_period_us": 10_000.0, "interpolator": "card"}}, "test"
    )
    fast = shipped()._replace(controller=controller, area_rate_mm2_min=10_000.0)
    run = run_text(RING, machine=fast, thickness_mm=0.05)
    feed = fast.feeds(0.05).cut_um_s
    top = min(feed, (3**0.5 / 2 * 500e3 * 9900.0) ** 0.5)
    assert run.deviations.sampling is not None
    assert run.deviations.sampling.chord_um == pytest.approx((top * 0.01) ** 2 / (8 * 9900.0), rel=1e-3)
    assert run.deviations.steps.max_um < 0.5 * 2**0.5 + run.deviations.sampling.chord_um + 1.0  # µm


@pytest.mark.deeper
def test_the_card_carries_nothing_from_block_to_block() -> None:
    scenario = load_scenario(SCENARIOS / "keyhole")
    run = dry_run(
        read_program(scenario.program), replace(scenario, machine=scenario.machine.stepping_by("card")), silent
    )
    assert run.contours[0].closure_stepped_um == 0.0
    assert np.abs(run.stepped.corner_um[1:] - run.toolpath.end_um).max() <= 0.5  # µm
    report = build_report(run)
    assert report["interpolator"]["name"] == "card"
    assert report["interpolator"]["servo_period_s"] == pytest.approx(200e-6)


def test_both_interpolators_take_the_time_of_the_plan() -> None:
    runs = [run_text(RING), by_card(RING)]
    assert runs[0].plan.duration_s == runs[1].plan.duration_s
    for run in runs:
        total = float(run.block_time_s.sum())
        assert total == pytest.approx(run.plan.duration_s, abs=1e-6)  # s
        assert build_report(run)["contours"][0]["time_s"] == pytest.approx(total, abs=1e-6)


def test_a_scenario_chooses_the_interpolator(tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_text(RING, "utf-8")
    (tmp_path / "scenario.toml").write_text('interpolator = "card"\n[expect]\n"interpolator.name" = "card"\n', "utf-8")
    run = run_folder(tmp_path)
    assert run.findings == ()
    assert run.deviations.sampling is not None


@pytest.mark.parametrize(
    ("changed", "complaint"),
    [
        ({"interpolator": "dda"}, "interpolator is one of point-by-point, card; found 'dda'"),
        ({"junction": "fast"}, "junction is one of through, slow, stop, deviation; found 'fast'"),
        ({"junction": "slow"}, "junction = 'slow' needs corner_feed_mm_s"),
        (
            {"corner_feed_mm_s": 1.0},
            "junction = 'through' takes no corner_feed_mm_s, which belongs to junction = 'slow'",
        ),
        ({"junction": "slow", "junction_deviation_um": 1.0, "corner_feed_mm_s": 1.0}, "takes no junction_deviation_um"),
        ({"corner_wait_ms": 0.5}, "corner_wait_ms is a whole number; found 0.5"),
        ({"axis_feed_x_mm_s": 0.0}, "axis_feed_x_mm_s is 0; it must lie between 0.001 and 1000"),
        ({"axis_fed_x_mm_s": 1.0}, "unknown key 'axis_fed_x_mm_s'; did you mean axis_feed_x_mm_s"),
        ({"jerk_mm_s3": "much"}, "jerk_mm_s3 is a number; found 'much'"),
    ],
)
def test_bad_controllers_are_refused(changed: dict[str, object], complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        read_controller({"controller": FAST | changed}, "m.toml")


def test_corners_cost_what_the_rule_says() -> None:
    square = "B500B0B500GXL1 B0B500B500GYL2 B500B0B500GXL3 B0B500B500GYL4 DD"
    times = {}
    for rule in (
        {"junction": "through"},
        {"junction": "slow", "corner_feed_mm_s": 0.01},
        {"junction": "stop"},
        {"junction": "stop", "corner_wait_ms": 500.0},
    ):
        controller = read_controller({"controller": FAST | {"path_acceleration_mm_s2": 1.0} | rule}, "test")
        run = run_text(square, machine=shipped()._replace(controller=controller))
        times[len(times)] = run.plan.duration_s
    feed, a = 43.75, 1000.0
    ramps = [0.0, 3 * (feed - 10.0) ** 2 / (feed * a), 3 * feed / a, 3 * feed / a + 1.5]
    plain = 2000.0 / feed + feed / a  # s: the way at the feed, and the ramps of both ends
    assert list(times.values()) == pytest.approx([plain + ramp for ramp in ramps], rel=1e-9)


@pytest.mark.parametrize("interpolator", ["point-by-point", "card"])
def test_a_start_between_two_micrometres_shifts_all_steps_alike(interpolator: str) -> None:
    text = "Start Point =  12.34540 ,  -3.45640  ;  X , Y\nB30B40B40GYL2\nB0B5000B5000GYL4\nDD\n"
    run = run_text(text, machine=shipped().stepping_by(interpolator))
    assert run.toolpath.start_um[0] == pytest.approx([12345.4, -3456.4])
    assert run.stepped.corner_um.tolist() == [[12345, -3456], [12315, -3416], [12315, -8416]]
    if run.deviations.sampling is not None:
        assert max(run.deviations.sampling.axis_um) <= 0.5 + 1e-6  # µm


def test_waits_at_corners_keep_the_table_with_the_plan() -> None:
    square = "B100B0B100GXL1 B0B100B100GYL2 B100B0B100GXL3 B0B100B100GYL4 DD"
    slow = FAST | {"corner_wait_ms": 1.0, "servo_period_us": 10_000.0, "interpolator": "card"}
    controller = read_controller({"controller": slow}, "test")
    run = run_text(square, machine=shipped()._replace(controller=controller, area_rate_mm2_min=1000.0))
    assert run.deviations.sampling is not None
    assert max(run.deviations.sampling.axis_um) <= 0.5 + 1e-6  # µm
    assert run.trace.commanded_um[-1].tolist() == [0.0, 0.0]
    assert float(run.block_time_s.sum()) == pytest.approx(run.plan.duration_s, rel=1e-12)
