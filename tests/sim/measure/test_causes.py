"""Deviation by cause: each cause alone is found with its size and place, and all together bound the whole."""

import math
from dataclasses import replace

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from paths import Pen
from places import SCENARIOS
from plain_deviation import plain_deviation
from runs import machine, plain_scenario, run_text, scenario_run

from controller.motion.plan import Plan
from parser.program import read_program
from parser.toolpath import Toolpath
from sim.base.progress import silent
from sim.measure.causes import (
    NOTHING,
    Deviations,
    Stage,
    added,
    cut_off,
)
from sim.measure.deviation import DeviationMeter, across_um, summed
from sim.run.dryrun import DryRun
from sim.run.running import dry_run
from sim.setup.machine.machine import read_controller
from sim.setup.scenario import load_scenario
from sim.setup.wire import DEFAULT_WIRE
from sim.table.trace import Trace

RING = "B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B9900GXL3 DD"
TURNED = "B9900B0B39600GXNR1 B9900B0B39600GYNR1 DD"  # the first counts on the wrong axis
SQUARE = "B3000B1000B3000GXL1 B1000B3000B3000GYL2 B3000B1000B3000GXL3 B1000B3000B3000GYL4 DD"
FAST = {"path_acceleration_mm_s2": 5000.0, "cut_step_limit_hz": 1e6, "jump_feed_mm_s": 5.0}


def at_rate(path: Toolpath, along: np.ndarray) -> tuple[Trace, np.ndarray]:
    """A trace whose command is exactly on the path at these lengths, 1 µm/s."""
    before = np.concatenate([[0.0], np.cumsum(path.length_um)])
    row = np.clip(np.searchsorted(before, along, side="right") - 1, 0, len(path) - 1)
    share = ((along - before[row]) / path.length_um[row])[:, None]
    line = path.start_um[row] + (path.end_um[row] - path.start_um[row]) * share
    angle = path.start_angle_rad[row] + path.sweep_rad[row] * share[:, 0]
    arc = path.center_um[row] + path.radius_um[row, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    place = np.where(path.is_arc[row][:, None], arc, line)
    return Trace(along, place, place, place, row), along


def steady(path: Toolpath, speed: float) -> Plan:
    length = float(path.length_um.sum())
    one = np.zeros(1)
    return Plan(np.array([0.0, length]), np.array([0.0, length / speed]), one + speed, one, one)


@pytest.mark.parametrize("turn", [1.0, -1.0])
def test_places_left_of_the_path_are_positive(turn: float) -> None:
    path = Pen(0.0, 0.0).to(100.0, 0.0).arc(100.0, turn * 50.0, turn * math.pi).to(0.0, turn * 100.0).path()
    trace, along = at_rate(path, np.linspace(1.0, path.length_um.sum() - 1.0, 300))
    inward = np.where(trace.row == 1, 0.0, 1.0)[:, None] * [0.0, turn] * np.where(trace.row == 2, -1.0, 1.0)[:, None]
    on_arc = trace.row == 1
    inward[on_arc] = (path.center_um[1] - trace.commanded_um[on_arc]) / 50.0
    for off in (3.0, -2.0):
        found = across_um(path, trace, trace.commanded_um + off * inward, along)
        assert found == pytest.approx(np.full(300, turn * off), abs=1e-9)


@pytest.mark.parametrize("turn_deg", [10.0, 90.0, 135.0, 180.0])
def test_a_place_that_trails_round_a_corner_counts_on_the_block_before(turn_deg: float) -> None:
    angle = math.radians(turn_deg)
    path = Pen(0.0, 0.0).to(100.0, 0.0).to(100.0 + 80.0 * math.cos(angle), 80.0 * math.sin(angle)).path()
    trace, along = at_rate(path, np.arange(60.0, 180.0))
    late, _ = at_rate(path, np.arange(60.0, 180.0) - 12.0)
    assert np.abs(across_um(path, trace, late.commanded_um, along)).max() < 1e-9  # µm


@given(turn_deg=st.floats(91.0, 179.9), lag=st.floats(2.0, 200.0))
@settings(max_examples=examples(40), deadline=None)
def test_a_wire_that_stands_in_its_own_slot_counts_on_the_block_that_it_stands_in(turn_deg: float, lag: float) -> None:
    """The wire dragged by a rope past a sharp point, beside its distance from both lines (150°, 35 µm: 11.31 µm)."""
    angle = math.radians(turn_deg)
    path = Pen(0.0, 0.0).to(1000.0, 0.0).to(1000.0 + 900.0 * math.cos(angle), 900.0 * math.sin(angle)).path()
    trace, along = at_rate(path, np.arange(0.0, 1000.0 + 3.0 * lag, lag / 100.0))
    wire = [complex(0.0, 0.0)]
    for x, y in trace.commanded_um[1:].tolist():
        behind = complex(x, y) - wire[-1]
        wire.append(wire[-1] + behind * max(1.0 - lag / abs(behind), 0.0) if behind else wire[-1])
    place = np.array([[at.real, at.imag] for at in wire])
    rest = place - [1000.0, 0.0]
    first = np.hypot(np.maximum(rest[:, 0], 0.0), rest[:, 1])
    ahead = np.maximum(rest @ [math.cos(angle), math.sin(angle)], 0.0)[:, None]
    second = np.hypot(*(rest - ahead * [math.cos(angle), math.sin(angle)]).T)
    nearest = np.where(trace.row == 0, first, np.minimum(first, second))
    assert np.abs(across_um(path, trace, place, along)).max() == pytest.approx(nearest.max(), abs=1e-6)  # µm


def test_a_place_far_from_the_corner_does_not_count_on_the_block_before() -> None:
    path = Pen(0.0, 0.0).to(500.0, 0.0).to(500.0, 10.0).to(0.0, 10.0).path()
    trace, along = at_rate(path, np.array([505.0, 530.0, 800.0]))
    place = trace.commanded_um - [0.0, 6.0]  # 6 µm off, and 4 µm from the first block
    assert np.abs(across_um(path, trace, place, along))[1:] == pytest.approx([6.0, 6.0])


def test_of_two_blocks_as_near_the_running_one_tells_the_side() -> None:
    path = Pen(0.0, 0.0).to(100.0, 0.0).to(0.0, 0.0).path()
    trace, along = at_rate(path, np.linspace(101.0, 130.0, 50))
    place = trace.commanded_um - np.array([0.0, 5.0])  # left on the way back, right of the way there
    late = replace(trace, commanded_um=trace.commanded_um + np.array([20.0, 0.0]))
    assert across_um(path, late, place, along) == pytest.approx(np.full(50, 5.0))


def test_a_table_that_stays_behind_for_good_is_measured_in_bounded_work() -> None:
    pen = Pen(0.0, 0.0)
    for k in range(1, 401):
        pen.to(5.0 * k, 0.0)
    path = pen.path()
    trace, along = at_rate(path, np.arange(1.0, 2000.0))
    stuck = np.zeros((len(along), 2))
    assert np.abs(across_um(path, trace, stuck, along)).max() == pytest.approx(1999.0 - 50.0 * 5.0, abs=5.0)


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=examples(30), deadline=None)
def test_samples_are_summed_as_the_meter_of_steps_does(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = Pen(0.0, 0.0).to(400.0, 100.0).arc(400.0, 300.0, 2.5).to(-100.0, 200.0).path()
    trace, along = at_rate(path, np.sort(rng.uniform(0.0, path.length_um.sum(), 200)))
    # At the far side of the blocks' middles no other block is near: both measure from the same one.
    place = trace.commanded_um + rng.normal(0.0, 0.3, (200, 2))
    exact = replace(trace, commanded_um=place)
    found = summed(path, exact, place, across_um(path, exact, place, along))
    meter = DeviationMeter(path)
    meter.add(trace.row, place[:, 0].copy(), place[:, 1].copy(), trace.t_s)
    wanted = meter.result()
    assert [found.max_um, found.rms_um] == pytest.approx([wanted.max_um, wanted.rms_um], abs=1e-6)  # µm
    assert found.p95_um == pytest.approx(wanted.p95_um, rel=2e-3)
    assert found.where == wanted.where
    assert found.by_row_um == pytest.approx(wanted.by_row_um, abs=1e-6, nan_ok=True)


def test_a_part_is_the_way_across_with_its_place() -> None:
    path = Pen(0.0, 0.0).to(100.0, 0.0).path()
    trace, _ = at_rate(path, np.arange(0.0, 101.0))
    before = np.full(101, 0.5)
    across = before.copy()
    across[40] = -1.5
    aside = np.array([[0.0, 1.0]])
    stage = Stage(trace.commanded_um + across[:, None] * aside, across)
    command = Stage(trace.commanded_um + before[:, None] * aside, before)
    part = added(trace, stage, command)
    assert part.max_um == 2.0
    assert part.where == (1, 40.0, -1.5, 40.0)
    assert added(trace, command, command) == NOTHING


def test_a_side_that_changes_past_the_end_of_a_block_adds_nothing() -> None:
    path = Pen(0.0, 0.0).to(100.0, 0.0).path()
    trace, along = at_rate(path, np.array([100.0]))
    # 94 µm past the end, on either side of the line prolonged, 2 µm apart: 188 µm by the sides alone.
    left, right = (np.array([[194.0, y]]) for y in (1.0, -1.0))
    one, other = (Stage(place, across_um(path, trace, place, along)) for place in (left, right))
    assert abs(one.off_um[0] - other.off_um[0]) == pytest.approx(188.0, abs=0.1)
    assert added(trace, one, other).max_um == pytest.approx(0.0, abs=1e-9)


def missing_their_ends(seed: int) -> str:
    """Lines and arcs of which some are counted on the axis along which they hardly run, and so end off their ends."""
    rng = np.random.default_rng(seed)

    def block() -> str:
        x, y = rng.integers(1, 250, 2)
        axis = rng.choice(["X", "Y"])
        if rng.random() < 0.3:
            return f"B{x}B{y}B{rng.integers(1, 500)}G{axis}{rng.choice(['NR', 'SR'])}{rng.integers(1, 5)}"
        if rng.random() < 0.4:
            x, y = (rng.integers(1, 5), y) if axis == "X" else (x, rng.integers(1, 5))
        return f"B{x}B{y}B{x if axis == 'X' else y}G{axis}L{rng.integers(1, 5)}"

    return " ".join([*(block() for _ in range(8)), "DD"])


@pytest.mark.parametrize("lag", [0.0, 20.0])
def test_no_stage_adds_more_than_it_moves_where_blocks_miss_their_ends(lag: float) -> None:
    for seed in range(6):
        run = run_text(missing_their_ends(seed), wire=replace(DEFAULT_WIRE, lag=lag))
        assert_causes_bound_the_whole(run.deviations)
        causes, trace = run.deviations.by_cause, run.cut
        most = np.hypot(*(trace.table_um - trace.commanded_um).T).max() + math.sqrt(
            2.0
        )  # of samples; a step of each axis
        assert causes.table.max_um <= most + 1e-6  # µm
        assert causes.wire.max_um <= np.hypot(*(trace.wire_um - trace.table_um).T).max() + 1e-6
        missed = run.stepped.corner_um[:-1] - run.toolpath.start_um
        assert causes.carried.max_um <= np.hypot(*missed.T).max() + 1e-6


@pytest.mark.parametrize("text", [RING, SQUARE, TURNED])
@pytest.mark.parametrize("interpolation", ["point-by-point", "card"])
def test_the_most_that_the_table_adds_is_that_of_all_moments_and_not_of_samples(text: str, interpolation: str) -> None:
    shipped = machine(backlash_um=(3.0, 2.0))
    changed = shipped._replace(controller=shipped.controller._replace(interpolation=interpolation))
    most = run_text(text, machine=changed).deviations.by_cause.table.max_um

    closely = run_text(text, machine=changed, trace_spacing_um=0.1)
    along = closely.plan.at(closely.cut.t_s).along_um
    commanded, table = (
        Stage(place, across_um(closely.toolpath, closely.cut, place, along))
        for place in (closely.cut.commanded_um, closely.cut.table_um)
    )
    assert abs(added(closely.cut, table, commanded).max_um - most) < 0.06  # µm


def chords_away(path: Toolpath, plan: Plan, period: float) -> float:
    """Largest distance from the path of many points on the chords between the ends of periods."""
    times = np.arange(0.0, plan.duration_s + period, period)
    along = plan.at(times).along_um
    trace, _ = at_rate(path, along)
    share = np.linspace(0.0, 1.0, 101)[:, None, None]
    points = trace.commanded_um[:-1] + share * np.diff(trace.commanded_um, axis=0)
    away = np.full(points.shape[:2], np.inf)
    for row in range(len(path)):
        rows = np.full(points.shape[1], row)
        for k, on_chords in enumerate(points):
            away[k] = np.minimum(away[k], plain_deviation(path, rows, on_chords[:, 0].copy(), on_chords[:, 1].copy()))
    return float(away.max())


@given(
    turn=st.floats(-175.0, 175.0).filter(lambda turn: abs(turn) > 1.0),
    period=st.floats(0.5, 30.0),
    first=st.floats(200.0, 300.0),
)
@settings(max_examples=examples(60), deadline=None)
def test_a_corner_between_two_periods_is_cut_off_by_the_closed_form(turn: float, period: float, first: float) -> None:
    angle = math.radians(turn)
    path = Pen(0.0, 0.0).to(first, 0.0).to(first + 300.0 * math.cos(angle), 300.0 * math.sin(angle)).path()
    plan = steady(path, 1.0)
    trace, _ = at_rate(path, np.arange(0.0, first + 300.0))
    part = cut_off(path, trace, plan, period)
    assert part.max_um == pytest.approx(chords_away(path, plan, period), abs=0.02 * period + 1e-6)  # µm: 101 points
    if part.where is not None:
        assert [part.where.x_um, part.where.y_um, part.where.t_s] == pytest.approx([first, 0.0, first])


@pytest.mark.parametrize(("radius", "period"), [(100.0, 5.0), (1000.0, 40.0)])
def test_an_arc_between_two_periods_is_cut_off_by_the_sagitta(radius: float, period: float) -> None:
    path = Pen(0.0, 0.0).to(100.0, 0.0).arc(100.0, radius, 2.0).path()
    plan = steady(path, 1.0)
    trace, _ = at_rate(path, np.arange(0.0, plan.duration_s))
    part = cut_off(path, trace, plan, period)
    assert part.max_um == pytest.approx(chords_away(path, plan, period), rel=1e-3)
    assert part.max_um == pytest.approx(period**2 / (8.0 * radius), rel=1e-3)
    assert part.where is not None
    assert part.where.block == 2


def by_the_card(text: str, **controller: float) -> DryRun:
    settings = FAST | {"interpolator": "card"} | controller
    fast = machine()._replace(controller=read_controller({"controller": settings}, "test"), area_rate_mm2_min=10_000.0)
    return run_text(text, machine=fast, thickness_mm=0.05)


def test_planning_is_of_the_card_alone_and_grows_with_its_period() -> None:
    assert run_text(RING).deviations.by_cause.planning == NOTHING
    short, long = (by_the_card(SQUARE, servo_period_us=period) for period in (200.0, 2000.0))
    speed = short.plan.speed_um_s.max()
    assert 0.0 < short.deviations.by_cause.planning.max_um <= speed * 200e-6 / 4.0
    assert short.deviations.by_cause.planning.max_um < long.deviations.by_cause.planning.max_um <= speed * 2e-3 / 4.0
    for run in (short, long):
        assert run.deviations.by_cause.interpolation.max_um <= 0.5 * 2**0.5 + 1e-6  # µm: rounding alone
        causes = run.deviations.by_cause
        # The ends are rounded by half a step on each axis, and the steps between them come up to a step late on each.
        assert run.deviations.interpolation.max_um <= causes.planning.max_um + 1.5 * 2**0.5 + 1e-6  # µm


def test_what_blocks_before_missed_is_carried() -> None:
    causes = run_text(TURNED).deviations.by_cause
    assert causes.carried.max_um == pytest.approx(140.0, abs=2.0)  # µm
    assert causes.carried.where is not None
    assert causes.carried.where.block == 2
    assert causes.interpolation.max_um == pytest.approx(1.0, abs=0.1)
    assert run_text(RING).deviations.by_cause.carried == NOTHING


@pytest.mark.parametrize("interpolator", ["point-by-point", "card"])
def test_a_start_between_two_micrometres_is_carried_and_not_rounded(interpolator: str) -> None:
    by = machine().stepping_by(interpolator)  # type: ignore[arg-type]
    causes = run_text("Start Point = 0 , 10.0004\nB100B0B100GXL1 DD", machine=by).deviations.by_cause
    assert causes.carried.max_um == pytest.approx(0.4, abs=1e-9)  # µm
    assert causes.interpolation.max_um == pytest.approx(0.0, abs=1e-9)


def test_the_wire_adds_its_lag_squared_over_the_diameter_on_a_circle() -> None:
    radius, lag = 1000.0, 100.0
    # Without play: where a table stands at a reversal, its wire falls behind by as much more.
    free = machine(friction_n=(0.0, 0.0), viscous_n_s_mm=(0.0, 0.0), backlash_um=(0.0, 0.0))
    run = run_text("B1000B0B4000GYNR1 DD", wire=replace(DEFAULT_WIRE, lag=lag), machine=free)
    causes = run.deviations.by_cause
    assert causes.wire.max_um == pytest.approx(radius - math.sqrt(radius**2 - lag**2), abs=1.0)  # µm, and a step
    assert run_text("B1000B0B4000GYNR1 DD").deviations.by_cause.wire == NOTHING


def test_without_lag_the_wire_is_the_table() -> None:
    run = scenario_run("round-hole")
    assert run.deviations.wire is run.deviations.table
    assert run.trace.wire_um is run.trace.table_um


@pytest.mark.alike(4)
@pytest.mark.parametrize("lag", [0.0, 35.0])
@pytest.mark.parametrize("interpolator", ["point-by-point", "card"])
@pytest.mark.parametrize(
    "text", [RING, TURNED, SQUARE, "B30B40B40GYL2 B0B500B500GYL4 D B500B0B500GXL1 D B50B0B200GYSR2 DD"]
)
def test_no_deviation_exceeds_the_sum_of_the_causes_up_to_it(text: str, interpolator: str, lag: float) -> None:
    by = machine().stepping_by(interpolator)  # type: ignore[arg-type]
    assert_causes_bound_the_whole(run_text(text, machine=by, wire=replace(DEFAULT_WIRE, lag=lag)).deviations)


def assert_causes_bound_the_whole(found: Deviations) -> None:
    causes = found.by_cause
    steps = causes.interpolation.max_um + causes.carried.max_um + causes.planning.max_um
    assert found.steps.max_um <= steps + 1e-3  # µm: of what lies between two samples
    assert found.table.max_um <= steps + causes.table.max_um + 1e-3
    assert found.wire.max_um <= steps + causes.table.max_um + causes.wire.max_um + 1e-3


@pytest.mark.deeper
def test_a_lag_leaves_steps_and_table_as_they_are() -> None:
    case = load_scenario(SCENARIOS / "round-hole")
    straight, lagging = (
        dry_run(read_program(case.program), replace(case, wire=replace(case.wire, lag=lag)), silent).deviations
        for lag in (0.0, 30.0)
    )
    assert plain_scenario().wire_lag_um == 0.0
    assert straight.steps.max_um == lagging.steps.max_um
    # Behind corners samples lie closer where the wire lags: the same motion is seen at more of its places.
    for table, seen_closer in (
        (straight.table.max_um, lagging.table.max_um),
        (straight.by_cause.table.max_um, lagging.by_cause.table.max_um),
    ):
        assert table <= seen_closer == pytest.approx(table, abs=1e-3)
    assert lagging.wire.max_um > straight.wire.max_um + 5.0  # µm: corners are cut off


@pytest.mark.parametrize(
    ("table", "low_um", "high_um"),
    [
        ({"backlash_um": (10.0, 10.0), "friction_n": (5.0, 5.0), "viscous_n_s_mm": (0.0, 0.0)}, 4.95, 5.05),
        ({"backlash_um": (0.0, 0.0), "friction_n": (200.0, 200.0), "viscous_n_s_mm": (0.0, 0.0)}, 3.75, 4.0),
        ({"backlash_um": (10.0, 10.0), "friction_n": (200.0, 200.0), "viscous_n_s_mm": (0.0, 0.0)}, 8.75, 9.0),
    ],
)
def test_half_the_backlash_and_friction_over_stiffness_add_to_what_the_table_adds(
    table: dict[str, object], low_um: float, high_um: float
) -> None:
    """As docs/report.md says: b/2 of 10 µm, F/k of 200 N and 50 N/µm."""
    along_axes = "B3000B0B3000GXL1 B0B3000B3000GYL2 B3000B0B3000GXL3 B0B3000B3000GYL4 DD"
    assert low_um <= run_text(along_axes, machine=machine(**table)).deviations.by_cause.table.max_um <= high_um
