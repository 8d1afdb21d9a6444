"""Interpolators: each pulse is handed out once, when it is due, however the time is portioned and motion re-planned."""

import itertools
import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from plain import PlainBlock, plain_steps
from strategies import program_text, programs

from controller.motion.limits import path_of
from controller.motion.plan import EMPTY_PLAN, Plan
from controller.motion.planner import RowLimits, plan_rows
from controller.stepping import chunks
from controller.stepping.chunks import StepChunk, chunk_of
from controller.stepping.interpolators import EqualTime, Interpolator, PointByPoint
from controller.stepping.pulses import Pulses, joined, no_pulses
from controller.stepping.steps import Steps, interpolate
from parser.program import parse_program
from parser.toolpath import Toolpath

FEED_UM_S = 500.0
BEGAN_S = 2.5
MAKERS: dict[str, Callable[[Toolpath, Plan], Interpolator]] = {
    "point by point": lambda toolpath, plan: PointByPoint(interpolate(toolpath), plan, BEGAN_S, (7, -3)),
    "equal time": lambda toolpath, plan: EqualTime(path_of(toolpath), plan, BEGAN_S, (0, 0), 2e-4),
}


def toolpath_of(program: list[PlainBlock]) -> Toolpath:
    return parse_program(program_text(program)).toolpath


def plan_of(toolpath: Toolpath, until_um: float = math.inf, since_um: float = 0.0) -> Plan:
    """Rest to rest along a part of a toolpath, with a wait after it."""
    length = np.array([min(until_um, float(toolpath.length_um.sum())) - since_um])
    limits = RowLimits(length, np.array([FEED_UM_S]), np.array([1e4]), np.zeros(2), np.array([0.0, 0.25]))
    return plan_rows(limits)


def portioned(motion: Interpolator, times: list[float]) -> Pulses:
    """All pulses due by the last of these times, asked for at each; none comes late or early."""
    parts: list[Pulses] = []
    before = -math.inf
    for time in times:
        for part in motion.pulses(time):
            assert before < part.t_s[0]
            assert part.t_s[-1] <= time
            assert motion.at_um[:2] == (part.x_um[-1], part.y_um[-1])
            parts.append(part)
        before = time
        assert list(motion.pulses(time)) == []
    return Pulses._make(np.concatenate([np.zeros(0), *columns]) for columns in zip(*parts, strict=True))


def times_from(fractions: list[float], plan: Plan) -> list[float]:
    return sorted({BEGAN_S + fraction * plan.duration_s for fraction in fractions} | {BEGAN_S + plan.duration_s + 1.0})


fractions = st.lists(st.floats(0.0, 1.0), max_size=12)


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS.keys())
@settings(max_examples=examples(40), deadline=None)
@given(program=programs, asked=fractions)
def test_portions_change_no_pulse(
    make: Callable[[Toolpath, Plan], Interpolator], program: list[PlainBlock], asked: list[float]
) -> None:
    toolpath = toolpath_of(program)
    plan = plan_of(toolpath)
    whole = portioned(make(toolpath, plan), [math.inf])
    parts = portioned(make(toolpath, plan), times_from(asked, plan))
    for column, same in zip(parts, whole, strict=True):
        assert np.array_equal(column, same)


@settings(max_examples=examples(40))
@given(program=programs)
def test_steps_come_when_the_plan_reaches_their_feet(program: list[PlainBlock]) -> None:
    toolpath = toolpath_of(program)
    plan, steps = plan_of(toolpath), interpolate(toolpath)
    motion = PointByPoint(steps, plan, BEGAN_S, (7, -3))
    pulses = portioned(motion, [math.inf])
    x, y, walked = 7, -3, []
    for block in program:
        walked += [(x + dx, y + dy) for dx, dy in plain_steps(block)]
        x, y = walked[-1]
    assert list(zip(pulses.x_um.tolist(), pulses.y_um.tolist(), strict=True)) == walked
    assert motion.done == len(walked)
    assert motion.at_um == (x, y)
    feet = chunk_of(steps, 0, len(steps)).along_um
    at = plan.at(pulses.t_s - BEGAN_S).along_um
    assert np.abs(at - np.maximum.accumulate(feet)).max(initial=0.0) <= 1e-6  # µm
    assert np.diff(pulses.t_s).min(initial=0.0) >= 0.0


@settings(max_examples=examples(60))
@given(programs, st.lists(st.floats(0.0, 1.0), min_size=1, max_size=4))
def test_a_stop_and_a_new_plan_lose_no_step(program: list[PlainBlock], stops: list[float]) -> None:
    toolpath = toolpath_of(program)
    steps = interpolate(toolpath)
    total = float(toolpath.length_um.sum())
    bounds = [0.0, *sorted(stop * total for stop in stops), total]
    at, done, began, made = (5, 5), 0, 0.0, []
    for since, until in pairwise(bounds):
        plan = plan_of(toolpath, until, since)
        motion = PointByPoint(steps, plan, began, at, done=done, from_um=since)
        for part in motion.pulses(began + plan.duration_s):
            made += list(zip(part.x_um.tolist(), part.y_um.tolist(), strict=True))
            assert part.t_s[0] >= began
        at, done, began = motion.at_um, motion.done, began + plan.duration_s
        assert done == np.searchsorted(np.maximum.accumulate(chunk_of(steps, 0, len(steps)).along_um), until + 1e-6)
        assert list(motion.pulses(began + 9.0)) == []
    whole = chunk_of(steps, 0, len(steps))
    assert made == list(zip((whole.x_um + 5).tolist(), (whole.y_um + 5).tolist(), strict=True))


def test_no_step_is_worked_out_twice_and_few_ahead(monkeypatch: pytest.MonkeyPatch) -> None:
    worked_out = 0

    def counted(steps: Steps, since: int, until: int) -> StepChunk:
        nonlocal worked_out
        worked_out += until - since
        return chunk_of(steps, since, until)

    monkeypatch.setattr(chunks, "chunk_of", counted)
    toolpath = toolpath_of([PlainBlock(9900, 0, 39600, "Y", "NR", 1)])
    steps, plan = interpolate(toolpath), plan_of(toolpath)
    motion = PointByPoint(steps, plan, 0.0, (0, 0))
    for time in np.linspace(0.0, 1.0, 500):
        list(motion.pulses(float(time)))
    assert worked_out <= 1000  # at 500 µm/s not 650 steps are due by then
    for time in np.linspace(1.0, plan.duration_s + 1.0, 500):
        list(motion.pulses(float(time)))
    assert worked_out == len(steps)


def test_a_long_block_comes_in_bounded_chunks() -> None:
    toolpath = toolpath_of([PlainBlock(1_000_000, 700_000, 1_000_000, "X", "L", 1)])
    motion = PointByPoint(interpolate(toolpath), plan_of(toolpath), 0.0, (0, 0))
    sizes = [len(part.t_s) for part in motion.pulses(math.inf)]
    assert sum(sizes) == 1_700_000
    assert max(sizes) <= 1 << 18


def test_both_end_where_the_path_ends() -> None:
    toolpath = toolpath_of([PlainBlock(300, 400, 400, "Y", "L", 1), PlainBlock(50, 0, 100, "Y", "NR", 1)])
    plan = plan_of(toolpath)
    ends = []
    for make in MAKERS.values():
        motion = make(toolpath, plan)
        list(motion.pulses(BEGAN_S + plan.duration_s + 2e-4))
        ends.append(motion.at_um)
    assert ends == [(7 + 200, -3 + 400), (200, 400)]


def test_nothing_is_due_before_the_plan_begins() -> None:
    toolpath = toolpath_of([PlainBlock(300, 400, 400, "Y", "L", 1)])
    for make in MAKERS.values():
        assert list(make(toolpath, plan_of(toolpath)).pulses(BEGAN_S)) == []


def test_a_plan_without_motion_makes_no_step() -> None:
    steps = interpolate(toolpath_of([PlainBlock(300, 400, 400, "Y", "L", 1)]))
    motion = PointByPoint(steps, EMPTY_PLAN, 0.0, (0, 0), done=5, from_um=5.0)
    assert list(motion.pulses(math.inf)) == []
    assert (motion.done, motion.at_um) == (5, (0, 0))


@pytest.mark.parametrize("number", [1, 7, 100])
def test_joined_pulses_are_the_same_in_parts_of_as_many_as_are_wanted_but_for_the_last(number: int) -> None:
    sizes = [3, 0, 1, 50, 2, 2, 2, 120, 5, 0]
    ends = list(itertools.accumulate(sizes))
    whole = Pulses(np.arange(185.0), *(np.arange(185, dtype=np.int32) + at for at in range(3)))
    parts = list(joined((whole.part(end - size, end) for size, end in zip(sizes, ends, strict=True)), number))
    assert all(len(part.t_s) >= number for part in parts[:-1])
    assert len(parts[-1].t_s) > 0
    for columns, column in zip(zip(*parts, strict=True), whole, strict=True):
        assert np.array_equal(np.concatenate(columns), column)
        assert {each.dtype for each in columns} == {column.dtype}


def test_no_pulses_are_no_part() -> None:
    assert list(joined([no_pulses(), no_pulses()], 1)) == []
