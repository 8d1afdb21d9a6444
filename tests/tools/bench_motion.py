"""From text to the time of every step, beside a plain loop and other planners; and through the emulated card."""

import importlib.util
import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from bench_path import LENGTH_UM
from plain import PlainBlock, plain_steps

from controller.card.core.settings import CardSettings
from controller.host.entries import Drive, Interpolation
from controller.host.host import Host
from controller.motion.limits import Feeds, JunctionDeviation, MotionLimits, row_limits
from controller.motion.planner import plan_rows
from controller.stepping.interpolators import PointByPoint
from controller.stepping.steps import interpolate
from parser.program import read_program

FEEDS = Feeds(cut_um_s=43.75, jump_um_s=500.0)
LIMITS = MotionLimits(acceleration_um_s2=1e5, axis_acceleration_um_s2=(8e4, 9e4), junction=JunctionDeviation(0.01))
_ROUNDS = 3


class Stages(NamedTuple):
    """Seconds to read and decode, to plan and count, to step and time; and the number of steps."""

    read_s: float
    planned_s: float
    stepped_s: float
    steps: int


def read_plan_step(path: Path) -> Stages:
    """A program from its file to the time of every step."""
    began = time.process_time()
    toolpath = read_program(path).toolpath
    read = time.process_time()
    plan = plan_rows(row_limits(toolpath, FEEDS, LIMITS))
    stepping = PointByPoint(interpolate(toolpath), plan, 0.0, (0, 0))
    planned = time.process_time()
    steps = sum(len(pulses.t_s) for pulses in stepping.pulses(math.inf))
    return Stages(read - began, planned - read, time.process_time() - planned, steps)


def motion_lines(path: Path, made: list[PlainBlock]) -> Iterator[str]:
    """What the stages of a path take, in lines to print."""
    n = len(made)
    read, planned, stepped, steps = min((read_plan_step(path) for _ in range(_ROUNDS)), key=lambda one: sum(one[:3]))
    total = read + planned + stepped
    plain = _plain_ns_per_step(made[: max(1, n // 100)])
    per_step = stepped / steps * 1e9
    yield f"path                {n:,} blocks, {n * LENGTH_UM / 1e6:g} m, {steps:,} steps"
    yield f"read and decode     {read:.3f} s   {n / read:,.0f} blocks/s"
    yield f"plan and count      {planned:.3f} s"
    yield f"step and time       {stepped:.3f} s   {per_step:.1f} ns per step"
    yield f"in all              {total:.3f} s   {n / total:,.0f} blocks/s, {total / steps * 1e9:.1f} ns per step"
    yield f"plain loop          {plain:.0f} ns per step (steps only), {plain / per_step:.1f} times as long"
    yield from _planner_lines(path)
    by_words, by_card = _driven_s(path, "point-by-point"), _driven_s(path, "card")
    yield f"through the card    {by_words:.2f} s point by point, {by_card:.2f} s at equal times"


def _driven_s(path: Path, interpolation: Interpolation) -> float:
    """Seconds to drive the path through the emulated card, call by call, until its last pulse."""
    toolpath = read_program(path).toolpath
    limits = row_limits(toolpath, FEEDS, LIMITS)
    host = Host(Drive(toolpath, limits, plan_rows(limits), (0, 0), interpolation), CardSettings())
    began = time.process_time()
    for _ in host.pulses():
        pass  # nobody looks at them here
    return time.process_time() - began


def _planner_lines(path: Path) -> list[str]:
    """What the planner takes beside others, on machines that ruckig is made for."""
    if importlib.util.find_spec("ruckig") is None:
        return ["planner             no ruckig here to compare with"]
    from bench_planner import compare

    times = compare(row_limits(read_program(path).toolpath, FEEDS, LIMITS))
    plain, other = times.plain_s / times.ours_s, times.ruckig_s / times.ours_jerk_s
    return [
        f"planner             {times.ours_s:.3f} s, a plain planner {plain:.0f} times as long",
        f"planner, S-curves   {times.ours_jerk_s:.3f} s, ruckig row by row {other:.0f} times as long",
    ]


def _plain_ns_per_step(blocks: list[PlainBlock]) -> float:
    began = time.process_time()
    steps = sum(len(plain_steps(block)) for block in blocks)
    return (time.process_time() - began) / steps * 1e9
