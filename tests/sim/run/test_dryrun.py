"""The dry run as a whole: what it finds, and what its figures mean."""

import numpy as np
import pytest
from places import SCENARIOS
from runs import codes, machine, run_text, scenario_run

from parser.findings.errors import ProgramError
from sim.run.findings import verdict
from sim.setup.machine.machine import Machine

CIRCLE = "B9900B0B9900GXL1 {arc} B9900B0B9900GXL3 DD"
FREE = {"friction_n": (0.0, 0.0), "viscous_n_s_mm": (0.0, 0.0), "backlash_um": (0.0, 0.0)}
SQUARE = "B10000B0B10000GXL1 B0B10000B10000GYL2 B10000B0B10000GXL3 B0B10000B10000GYL4"


def weak_machine(force_n: float) -> Machine:
    """The shipped machine with motors of so little force, and nothing in the guides to hold them up."""
    motor = machine().table.motor
    return machine(**FREE, motor=motor._replace(force_curve=((0.0, force_n),)))


def test_sound_programs_pass() -> None:
    run = run_text(CIRCLE.format(arc="B9900B0B39600GYNR1"))
    assert codes(run) == []
    assert verdict(run.findings) == "pass"


def test_wrong_line_quadrant_opens_the_contour_by_twice_the_line() -> None:
    run = run_text("B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B9900GXL1 DD")
    assert [code for code in codes(run) if code != "3B304"] == ["3B301"]
    assert run.contours[0].closure_exact_um == 19800.0
    assert verdict(run.findings) == "fail"


def test_wrong_count_axis_is_seen_by_the_stepped_run_alone() -> None:
    run = run_text(CIRCLE.format(arc="B9900B0B39600GXNR1"))
    assert run.contours[0].closure_exact_um == 0.0
    assert run.contours[0].closure_stepped_um == pytest.approx(140, abs=2)  # µm
    assert codes(run) == ["3B204"]
    assert verdict(run.findings) == "fail"
    assert run.deviations.steps.max_um == pytest.approx(140, abs=2)
    assert run.deviations.interpolation.max_um < 1.5


@pytest.mark.parametrize(
    "text",
    [
        "B100B0B100GXL1 DD",
        "B100B0B100GXL1 B0B100B100GYL2 DD",
        "B100B0B100GXNR1 DD",
        "B100B0B100GXL1 B0B100B100GYL2 B100B0B100GXL1 B20B100B100GYL1 B9B0B9GXL1 DD",
    ],
)
def test_a_cut_that_encloses_nothing_need_not_close(text: str) -> None:
    run = run_text(text)
    assert codes(run) == []
    assert not run.contours[0].encloses


def test_contours_are_told_apart_by_jumps() -> None:
    run = run_text(f"{SQUARE} D B30000B0B30000GXL1 D {SQUARE} DD")
    assert [(c.first, c.last, c.closure_exact_um) for c in run.contours] == [(1, 4, 0.0), (6, 9, 0.0)]
    assert codes(run) == []
    # 80 mm of cut at 43.75 µm/s, 30 mm of jump at 500 µm/s, three stops and starts at 100 mm/s².
    ramps = 2 * 43.75 / 1e5 + 500 / 1e5
    assert run.plan.duration_s == pytest.approx(80_000 / 43.75 + 30_000 / 500 + ramps)


def test_leaving_the_travel_names_the_first_block_out() -> None:
    run = run_text("B100B0B100GXL1 B60B0B60GXL1 B10B0B10GXL1 DD", start_mm=(399.85, 250.0))
    assert [(f.code, f.block) for f in run.findings] == [("3B401", 2)]
    assert run_text("B100B0B100GXL1 B60B0B60GXL1 DD", start_mm=(10.0, 250.0)).findings == ()


def test_the_table_stops_at_its_travel() -> None:
    run = run_text("B150B0B150GXL1 DD", start_mm=(399.95, 250.0), past_stop=True)
    assert run.trace.table_um[:, 0].max() == pytest.approx(50.0, abs=1.0)
    assert run.trace.table_um[-1, 0] == pytest.approx(50.0, abs=1.0)
    assert run.deviations.table.max_um < 2.0  # where it stands is on the path
    assert run.trace.commanded_um[-1, 0] == 150.0
    assert run.losses == ()  # wound up by 100 µm, the train pulls with 5 kN of the motor's 16


def test_table_follows_at_cutting_speed_within_its_play_and_a_step() -> None:
    run = scenario_run("round-hole")
    table = run.scenario.machine.table
    play = (np.array(table.backlash_um) / 2) + np.array(table.friction_n) / table.drive_stiffness_n_um  # µm
    lag = np.abs(run.trace.table_um - run.trace.commanded_um)
    assert np.all(lag <= play + 1.0 + 0.05)  # µm: a step that the motor still makes; viscous friction
    assert np.all(lag[-1] <= play)
    assert run.deviations.interpolation.max_um <= 1.0 + 1e-9


def test_without_friction_and_play_the_table_comes_to_rest_where_the_steps_end() -> None:
    run = run_text(CIRCLE.format(arc="B9900B0B39600GYNR1"), machine=machine(**FREE))
    lag = np.abs(run.trace.table_um - run.trace.commanded_um)
    assert np.all(lag <= 1.0 + 0.05)  # µm: a step that the motor still makes, and how far it throws the slide
    assert lag[-1].max() < 0.01  # µm: 0.25 % of the last steps still ring


@pytest.mark.deeper
@pytest.mark.parametrize(("name", "at_most_um"), [("keyhole", 3.0), ("round-hole", 1.5)])
def test_without_friction_and_play_the_table_adds_next_to_nothing_to_the_steps(name: str, at_most_um: float) -> None:
    text = (SCENARIOS / name / "program.3b").read_text("utf-8")
    assert run_text(text, machine=machine(**FREE)).deviations.table.max_um <= at_most_um


def test_a_weak_drive_shows_in_the_table_and_not_in_the_steps() -> None:
    strong = run_text(f"{SQUARE} D B30000B0B30000GXL1 D {SQUARE} DD")
    weak = run_text(f"{SQUARE} D B30000B0B30000GXL1 D {SQUARE} DD", machine=weak_machine(1.0))
    assert weak.deviations.steps.max_um == strong.deviations.steps.max_um
    lag = np.abs(weak.trace.table_um - weak.trace.commanded_um).max()
    assert lag > 10 * np.abs(strong.trace.table_um - strong.trace.commanded_um).max()
    assert strong.losses == ()
    assert {loss.kind for loss in weak.losses} == {"lost-steps"}
    assert "3B402" in codes(weak)


def test_acceleration_of_the_trace_stays_within_force_over_mass() -> None:
    limit = 5.0 / 320.0 * 1e6  # µm/s² of the X axis
    run = run_text("B5B0B5GXL1B5B0B20GYNR1B5B0B5GXL3 D B5000B0B5000GXL1 D B5B0B5GXL1", machine=weak_machine(5.0))
    t_s, x = run.trace.t_s, run.trace.table_um[:, 0]
    velocity = np.diff(x) / np.diff(t_s)
    # Velocities are means between samples, so half of the time before and half of that after lies between two of them.
    between_s = (t_s[2:] - t_s[:-2]) / 2
    assert np.all(np.abs(np.diff(velocity)) <= limit * between_s * (1 + 1e-6) + 1e-3)
    assert np.abs(np.diff(velocity) / between_s).max() > 0.9 * limit


def test_blocks_after_the_end_are_not_run() -> None:
    run = run_text("B100B0B100GXL1 DD B100B0B100GXL1")
    assert len(run.stepped) == 100
    assert verdict(run.findings) == "fail"


@pytest.mark.parametrize("text", ["B0B0B1000000000000000GXL1", "B999999999B0B999999999GXL1", "B2B2B999999999GXNR1"])
def test_programs_beyond_any_table_are_refused(text: str) -> None:
    with pytest.raises(ProgramError) as caught:
        run_text(text)
    assert caught.value.finding.code == "3B206"
    assert caught.value.finding.line == 1


def test_cutting_time_is_length_times_thickness_over_area_rate() -> None:
    run = run_text("B30000B0B30000GXL1 DD", thickness_mm=100.0)
    assert run.plan.duration_s == pytest.approx(30.0 * 100.0 / 105.0 * 60.0, rel=1e-5)


def test_a_start_node_off_the_grid_keeps_its_place() -> None:
    run = run_text("Start Point = 0 , 10.0004\nB100B0B100GXL1 DD")
    assert run.trace.table_um[0].tolist() == [0.0, 10000.0]
    assert run.deviations.interpolation.max_um < 1e-6
    assert run.deviations.steps.max_um == pytest.approx(0.4, abs=1e-6)


def test_what_follows_a_trip_is_not_measured() -> None:
    run = scenario_run("servo-trip")
    trip = run.ended
    assert trip is not None
    assert np.isnan(run.deviations.table.by_row_um[trip.row + 1 :]).all()
    assert not np.isnan(run.deviations.table.by_row_um[: trip.row + 1]).any()
    assert run.trace.t_s[-1] > trip.t_s + 40.0
