"""Equal time: the same pulses as a loop over every servo period, though hardly any period is looked at."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from paths import Pen

from controller.motion.limits import Path, path_of
from controller.motion.plan import EMPTY_PLAN, Plan
from controller.motion.planner import RowLimits, plan_rows
from controller.stepping import equal_time
from controller.stepping.equal_time import Clock, SampledMotion, chord_error_um
from controller.stepping.interpolators import EqualTime

Pulse = tuple[float, int, int, int]
HALVES = (0.5, 3.0, 20.5, 101.5, 1e4, 1e7, 1e12)  # radii µm; at .5 the extremes of an arc may lie on half a pulse


def random_path(rng: np.random.Generator, rows: int, axes: int) -> Path:
    """Lines and arcs in any plane, rows without length; often on or beside half pulses, where rounding decides."""
    start = np.round(rng.normal(size=axes) * 20.0 * 2.0) / 2.0 if rng.random() < 0.5 else rng.normal(size=axes) * 20.0
    made: list[tuple] = []
    for _ in range(rows):
        tangent = rng.normal(size=axes)
        if rng.random() < 0.4:  # along an axis, or beside it by rounding
            tangent = np.eye(axes)[rng.integers(axes)] + rng.choice([0.0, 1e-17, 1e-9]) * tangent
        tangent /= np.linalg.norm(tangent)
        length = float(rng.choice([0.0, rng.random() * 50.0, rng.integers(0, 60), 1e-6]))
        normal, bend = np.zeros(axes), 0.0
        if length and rng.random() < 0.5:
            normal = rng.normal(size=axes)
            normal -= tangent * (normal @ tangent)
            normal, bend = normal / np.linalg.norm(normal), 1.0 / float(rng.choice(HALVES))
        columns = (start, tangent * (length > 0.0), normal, bend, length)
        made.append(columns)
        only = Path(*(np.array([column]) for column in columns))
        start = only.place(np.zeros(1, dtype=np.int64), np.array([length]))[0]
    return Path(*(np.array(column) for column in zip(*made, strict=True)))


def random_plan(rng: np.random.Generator, path: Path) -> Plan:
    def log(low: float, high: float, size: int) -> np.ndarray:
        return 10.0 ** rng.uniform(low, high, size)

    n = len(path)
    border = np.where(rng.random(n + 1) < 0.4, 0.0, log(0, 4, n + 1))
    wait = np.where(rng.random(n + 1) < 0.2, log(-4, 0, n + 1), 0.0)
    return plan_rows(RowLimits(path.length_um, log(0, 4, n), log(2, 6, n), border, wait))


def steady(path: Path, speed_um_s: float, acceleration_um_s2: float = 1e5) -> Plan:
    n = len(path)
    border = np.full(n + 1, speed_um_s)
    border[[0, -1]] = 0.0
    speed, acceleration = np.full(n, speed_um_s), np.full(n, acceleration_um_s2)
    return plan_rows(RowLimits(path.length_um, speed, acceleration, border, np.zeros(n + 1)))


def places(path: Path, plan: Plan, began_s: float, period_s: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Every servo period after the beginning to the end: its number, the row and the place of the plan."""
    k = np.arange(int(began_s / period_s) - 1, int((began_s + plan.duration_s) / period_s) + 4)
    k = k[k * period_s > began_s]
    past = k * period_s - began_s >= plan.duration_s
    k = k[: int(np.argmax(past)) + 1]
    along = plan.at(k * period_s - began_s).along_um
    before = path.before_um[:-1]
    row = (before <= along[:, None]).sum(axis=1) - 1
    s = np.minimum(along - before[row], path.length_um[row])
    row[-1], s[-1] = len(path) - 1, path.length_um[-1]
    return k, row, path.place(row, s)


def whole(place: float) -> int:
    """Whole pulse of a place known to 10⁻⁶, half a pulse to the even side."""
    return round(round(place * 1e6) / 1e6)


def every_period(path: Path, plan: Plan, began_s: float, at_um: tuple[int, ...], period_s: float) -> list[Pulse]:
    """Pulses by a plain loop over all servo periods: round, take the difference, spread it."""
    x, y = at_um[:2]
    pulses = []
    for k, row, place in zip(*places(path, plan, began_s, period_s), strict=True):
        new = [whole(p) for p in place.tolist()[:2]]
        begin, end = max((k - 1) * period_s, began_s), k * period_s
        steps = []
        for axis, by in enumerate((new[0] - x, new[1] - y)):
            steps += [(j / abs(by), axis, 1 if by > 0 else -1) for j in range(1, abs(by) + 1)]
        for part, axis, by in sorted(steps):
            x, y = (x + by, y) if axis == 0 else (x, y + by)
            time = begin + part * (end - begin)
            pulses.append((time, x, y, row if part == 1 else row_at(path, plan, time - began_s)))
    return pulses


def row_at(path: Path, plan: Plan, t_s: float) -> int:
    return int((path.before_um[:-1] <= plan.at(t_s).along_um).sum() - 1)


def rows_of(parts: Iterator) -> list[Pulse]:
    return [row for part in parts for row in zip(*(column.tolist() for column in part), strict=True)]


def in_portions(motion: EqualTime, rng: np.random.Generator, until_s: float) -> list[Pulse]:
    """Pulses asked for in portions from none to all."""
    t, pulses = 0.0, []
    while t < until_s:
        t = min(t + until_s * rng.random() ** 4, until_s)
        pulses += rows_of(motion.pulses(t))
        assert all(pulse[0] <= t for pulse in pulses[-100:])
    return pulses


@pytest.fixture(params=["searched", "visited", "small pieces"])
def piecewise(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Half pulses searched for in any stretch; or all periods visited where they are few; or in many pieces."""
    few, at_once = {"searched": (0, 1 << 16), "visited": (2048, 1 << 16), "small pieces": (0, 30)}[request.param]
    monkeypatch.setattr(equal_time, "_FEW", few)
    monkeypatch.setattr(equal_time, "_AT_ONCE", at_once)


@pytest.mark.alike(2)
@pytest.mark.usefixtures("piecewise")
@pytest.mark.parametrize("seed", range(6))
def test_pulses_are_those_of_a_loop_over_every_period(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(15):
        path = random_path(rng, int(rng.integers(1, 8)), int(rng.integers(2, 5)))
        plan = random_plan(rng, path)
        began = float(rng.choice([0.0, rng.random(), 1e4 * rng.random()]))
        period = max(10.0 ** rng.uniform(-5, 0), plan.duration_s / 3000.0)
        at = np.rint(path.start_um[0]).astype(int) + (rng.integers(-3, 4) if rng.random() < 0.2 else 0)
        expected = every_period(path, plan, began, tuple(at.tolist()), period)
        motion = EqualTime(path, plan, began, tuple(at.tolist()), period)
        pulses = in_portions(motion, rng, began + plan.duration_s + 2.0 * period)
        assert [pulse[1:] for pulse in pulses] == [pulse[1:] for pulse in expected]
        assert [p[0] for p in pulses] == pytest.approx([p[0] for p in expected], rel=0, abs=1e-12 + 4e-16 * began)  # s
        assert motion.at_um == tuple(whole(p) for p in places(path, plan, began, period)[2][-1].tolist())


@pytest.mark.parametrize("axes", [2, 4])
def test_command_is_half_a_pulse_from_the_plan_at_most(axes: int) -> None:
    rng = np.random.default_rng(axes)
    for _ in range(10):
        path = random_path(rng, 5, axes)
        plan = random_plan(rng, path)
        period = max(1e-3, plan.duration_s / 200.0)
        motion = EqualTime(path, plan, 0.0, tuple(np.rint(path.start_um[0]).astype(int).tolist()), period)
        for k, _, place in zip(*places(path, plan, 0.0, period), strict=True):
            list(motion.pulses(k * period))
            assert np.abs(np.array(motion.at_um) - place).max() <= 0.5 + 5e-7 + 1e-12  # µm


@settings(max_examples=examples(30))
@given(st.lists(st.tuples(st.integers(-99, 99), st.integers(-99, 99), st.booleans()), min_size=1, max_size=9))
def test_pulses_add_up_to_the_planned_end(ends: list[tuple[int, int, bool]]) -> None:
    pen = Pen()
    for x, y, bent in ends:
        if bent and (x, y) != (pen.x, pen.y):
            pen.arc((pen.x + x) / 2.0, (pen.y + y) / 2.0, math.pi)
        else:
            pen.to(x, y)
    toolpath = pen.path()
    path = path_of(toolpath)
    plan = steady(path, 200.0)
    motion = EqualTime(path, plan, 0.3, (0, 0), 2e-4)
    pulses = rows_of(motion.pulses(math.inf))
    x, y = toolpath.end_um[-1]
    assert motion.at_um == ((pulses[-1][1], pulses[-1][2]) if pulses else (0, 0))
    assert motion.at_um == pytest.approx((x, y), abs=0.5 + 1e-9)  # µm
    moves = np.abs(np.diff([(0, 0), *(pulse[1:3] for pulse in pulses)], axis=0)).sum(axis=1)
    assert set(moves.tolist()) <= {1}


def test_a_contour_on_half_pulses_does_not_flicker() -> None:
    offset = 100.5
    path = path_of(Pen(-offset, offset).to(offset, offset).arc(0.0, offset, -math.pi).path())
    plan = steady(path, 50.0)
    pulses = rows_of(EqualTime(path, plan, 0.0, (-100, 100), 2e-4).pulses(math.inf))
    assert pulses == [
        (pytest.approx(t, abs=1e-12), *rest) for t, *rest in every_period(path, plan, 0.0, (-100, 100), 2e-4)
    ]
    assert {y for _, _, y, row in pulses if row == 0} == {100}


def test_pulses_of_a_fast_period_are_even_and_end_with_it() -> None:
    path = path_of(Pen().to(40.0, 20.0).path())
    plan = Plan(np.array([0.0, math.hypot(40.0, 20.0)]), np.array([0.0, 0.01]), *np.zeros((3, 1)))
    plan = Plan(plan.along_um, plan.time_s, np.array([plan.along_um[1] / 0.01]), np.zeros(1), np.zeros(1))
    (pulses,) = EqualTime(path, plan, 0.0, (0, 0), 0.01).pulses(1.0)
    x = np.flatnonzero(np.diff(pulses.x_um, prepend=0))
    y = np.flatnonzero(np.diff(pulses.y_um, prepend=0))
    assert pulses.t_s[x] == pytest.approx(np.arange(1, 41) / 40 * 0.01, rel=1e-12)
    assert pulses.t_s[y] == pytest.approx(np.arange(1, 21) / 20 * 0.01, rel=1e-12)
    assert pulses.t_s[-2:].tolist() == [0.01, 0.01]
    assert np.diff(pulses.x_um[-2:]) == 0  # X before Y at the same time


def test_a_start_amid_a_period_makes_no_pulse_before_it() -> None:
    path = path_of(Pen().to(9.0, 0.0).path())
    plan = steady(path, 1e5, 1e9)
    pulses = rows_of(EqualTime(path, plan, 0.0105, (0, 0), 0.001).pulses(1.0))
    assert [x for _, x, _, _ in pulses] == list(range(1, 10))
    assert all(0.0105 < t <= 0.011 for t, *_ in pulses)


def test_axes_beyond_y_are_counted_without_pulses() -> None:
    unit = np.array([[0.0, 0.0, 0.6, -0.8]])
    path = Path(np.zeros((1, 4)), unit, np.zeros((1, 4)), np.zeros(1), np.array([100.0]))
    motion = EqualTime(path, steady(path, 50.0), 0.0, (5, 0, 2, 0), 2e-4)
    # X and Z stand beside the path and go to it in the first period, Z at its end.
    assert [pulse[1:3] for pulse in rows_of(motion.pulses(1e-4))] == [(4, 0), (3, 0)]
    assert motion.at_um == (3, 0, 2, 0)
    assert [pulse[1:3] for pulse in rows_of(motion.pulses(1.0))] == [(2, 0), (1, 0), (0, 0)]
    assert motion.at_um == (0, 0, 30, -40)
    assert rows_of(motion.pulses(math.inf)) == []
    assert motion.at_um == (0, 0, 60, -80)


def test_no_motion_makes_no_pulse() -> None:
    none = Path(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    motion = EqualTime(none, EMPTY_PLAN, 1.0, (3, 4), 2e-4)
    assert list(motion.pulses(math.inf)) == []
    assert motion.at_um == (3, 4)


def test_hours_of_slow_cutting_come_in_small_pieces_and_few_periods() -> None:
    path = path_of(Pen().to(300_000.0, 170_000.0).arc(300_000.0, 171_000.0, 9.0).path())
    plan = steady(path, 43.75)
    assert plan.duration_s / 2e-4 > 4e7
    motion = SampledMotion(path, plan, Clock(2e-4, 0.0))
    looked_at = period = 0
    while period < motion.last:
        for periods in motion.periods(period, motion.last):
            looked_at, period = looked_at + len(periods), int(periods[-1])
    sizes = [len(part.t_s) for part in EqualTime(path, plan, 0.0, (0, 0), 2e-4).pulses(math.inf)]
    assert max(sizes) <= 100_000
    assert looked_at <= 1.1 * sum(sizes)


def test_fast_motion_comes_in_small_pieces() -> None:
    path = path_of(Pen().to(1_000_000.0, 0.0).path())
    sizes = [len(part.t_s) for part in EqualTime(path, steady(path, 1e6, 1e8), 0.0, (0, 0), 1e-3).pulses(math.inf)]
    assert sum(sizes) == 1_000_000
    assert max(sizes) <= 100_000


def test_chord_error_is_the_sagitta_at_the_largest_speed_of_each_arc() -> None:
    path = path_of(Pen().to(1000.0, 0.0).arc(1000.0, 500.0, 2.0).arc(1000.0, 400.0, 2.0).path())
    n = len(path)
    speed = np.array([8000.0, 1000.0, 3000.0])
    border = np.array([0.0, 1000.0, 1000.0, 0.0])
    plan = plan_rows(RowLimits(path.length_um, speed, np.full(n, 1e7), border, np.zeros(n + 1)))
    period = 2e-4
    radius = 1.0 / path.curvature[1:]
    errors = radius * (1.0 - np.cos(speed[1:] * period / (2.0 * radius)))
    assert chord_error_um(path, plan, period) == pytest.approx(errors.max(), rel=1e-6)
    assert errors.max() == pytest.approx(3000.0**2 * period**2 / (8.0 * radius[1]), rel=1e-3)


def test_chord_error_covers_the_chords_between_periods() -> None:
    rng = np.random.default_rng(1)
    for _ in range(30):
        path = path_of(Pen().arc(*rng.uniform(20.0, 200.0, 2), rng.uniform(1.0, 6.0)).path())
        plan = random_plan(rng, path)
        period = plan.duration_s / 20.0
        center = path.start_um[0] + path.normal[0] / path.curvature[0]
        ends = np.vstack([path.start_um, places(path, plan, 0.0, period)[2]])
        middles = np.hypot(*((ends[:-1] + ends[1:]) / 2.0 - center).T)
        off = (1.0 / path.curvature[0] - middles).max()
        assert off <= chord_error_um(path, plan, period) + 1e-9  # µm


@pytest.mark.parametrize(("sweep", "error_um"), [(0.5, 10.0 * (1.0 - math.cos(0.25))), (20.0, 20.0)])
def test_a_period_longer_than_an_arc_misses_no_more_than_the_arc(sweep: float, error_um: float) -> None:
    path = path_of(Pen(10.0, 0.0).arc(0.0, 0.0, sweep).path())
    assert chord_error_um(path, steady(path, 1e6, 1e12), 1.0) == pytest.approx(error_um, rel=1e-12)


def test_lines_have_no_chord_error() -> None:
    path = path_of(Pen().to(1000.0, 300.0).path())
    assert chord_error_um(path, steady(path, 1e4), 1e-3) == 0.0


@pytest.mark.parametrize("period_s", [1e-4, 2e-4, 1.0 / 3000.0])
def test_the_clock_finds_the_period_that_a_search_from_far_below_finds(period_s: float) -> None:
    for began_s in (0.0, 7 * period_s, 7.25 * period_s, 12345 * period_s):
        clock = Clock(period_s, began_s)
        for plan_s in (0.0, period_s, 3 * period_s, 3.5 * period_s, 999 * period_s, 1e-12):
            far = max(int((began_s + plan_s) / period_s) - 10, 0)
            ends = range(far, far + 30)
            assert clock.first_from(plan_s) == next(k for k in ends if k * period_s - began_s >= plan_s)
            assert clock.first_after(began_s + plan_s) == next(k for k in ends if k * period_s > began_s + plan_s)
            k = clock.first_from(plan_s)
            assert clock.plan_time_s(np.array([k]))[0] == k * period_s - began_s
