"""The in-repo benchmark: ``make bench``. Writes its own path, runs it whole, and a plain loop beside it.

Path: 100 000 blocks of 0.1 mm, two lines to one arc, in all directions; 10 m and about 12.8 million steps. Times are
of one process on one core, the fastest of three; the ratio to the plain loop is the figure to compare machines by.
"""

import argparse
import importlib.util
import math
import random
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bench_compare import compare_lines
from bench_offset import offset_lines
from bench_table import add_options, table_lines
from line_words import line_words
from places import SCENARIOS
from plain import PlainBlock, counted_way, plain_steps

from controller.card.core.settings import CardSettings
from controller.host.entries import Drive, Interpolation
from controller.host.host import Host
from controller.motion.junctions import JunctionDeviation
from controller.motion.limits import Feeds, MotionLimits, row_limits
from controller.motion.planner import plan_rows
from controller.stepping.interpolators import PointByPoint
from controller.stepping.pulses import Pulses
from controller.stepping.words import interpolate
from parser.program import read_program
from sim.check.batch import Job, check_file
from sim.check.settings import CheckSettings

KEYHOLE = SCENARIOS / "keyhole" / "program.3b"

LENGTH_UM = 100.0
FEEDS = Feeds(cut_um_s=43.75, jump_um_s=500.0)
LIMITS = MotionLimits(acceleration_um_s2=1e5, axis_acceleration_um_s2=(8e4, 9e4), junction=JunctionDeviation(0.01))


def line(rng: random.Random) -> PlainBlock:
    angle = rng.uniform(0.0, 2.0 * math.pi)
    words = line_words(LENGTH_UM * math.cos(angle), LENGTH_UM * math.sin(angle))
    return PlainBlock(words.x_um, words.y_um, words.count_um, words.count_axis.name, "L", words.quadrant)


def arc(rng: random.Random) -> PlainBlock:
    """An arc of 0.1 mm on a radius of 0.05 to 2 mm, counted on the axis that is stepped last."""
    radius, start, turn = rng.uniform(50.0, 2000.0), rng.uniform(0.0, 2.0 * math.pi), rng.choice((1, -1))
    x0, y0 = round(radius * math.cos(start)), round(radius * math.sin(start))
    start, radius = math.atan2(y0, x0), math.hypot(x0, y0)
    end = start + turn * LENGTH_UM / radius
    x1, y1 = radius * math.cos(end), radius * math.sin(end)
    axis = "Y" if abs(x1) > abs(y1) else "X"
    count = counted_way(start, end, radius, axis)
    quadrant = int((start + turn * 1e-9) % (2.0 * math.pi) // (math.pi / 2.0)) + 1
    return PlainBlock(abs(x0), abs(y0), max(1, round(count)), axis, "NR" if turn > 0 else "SR", quadrant)


def write_path(path: Path, blocks: int) -> list[PlainBlock]:
    rng = random.Random(20260101)
    made = [arc(rng) if row % 3 == 2 else line(rng) for row in range(blocks)]
    path.write_text("\n".join(block.text() for block in made) + "\nDD\n", encoding="ascii")
    return made


def whole(path: Path) -> tuple[float, float, float, int]:
    """Seconds to read and decode, to plan and count, to step and time; and the number of steps."""
    began = time.perf_counter()
    toolpath = read_program(path).toolpath
    read = time.perf_counter()
    plan = plan_rows(row_limits(toolpath, FEEDS, LIMITS))
    stepping = PointByPoint(interpolate(toolpath), plan, 0.0, (0, 0))
    planned = time.perf_counter()
    steps = sum(len(pulses.t_s) for pulses in stepping.pulses(math.inf))
    done = time.perf_counter()
    return read - began, planned - read, done - planned, steps


def driven(path: Path, interpolation: Interpolation) -> float:
    """Seconds to drive the path through the emulated card, call by call, until its last pulse."""
    toolpath = read_program(path).toolpath
    limits = row_limits(toolpath, FEEDS, LIMITS)

    def drop(pulses: Pulses) -> None:
        """Nobody looks at them here."""

    host = Host(Drive(toolpath, limits, plan_rows(limits), (0, 0), interpolation), CardSettings(), drop)
    began = time.perf_counter()
    host.run()
    return time.perf_counter() - began


def planner_lines(path: Path) -> list[str]:
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


def checked(path: Path, times: int) -> float:
    """Seconds to check a file with every rule, the fastest of three rounds of `times`."""
    job = Job(path.name, path, CheckSettings(wire_diameter_um=180.0))
    rounds = []
    for _ in range(3):
        began = time.perf_counter()
        for _ in range(times):
            check_file(job)
        rounds.append((time.perf_counter() - began) / times)
    return min(rounds)


def start_ratio(path: Path) -> tuple[float, float]:
    """Seconds from the start to the end of ``drycut check`` of a small file, and of a Python that imports numpy."""
    commands = ([sys.executable, "-m", "sim.cli", "check", str(path)], [sys.executable, "-c", "import numpy"])
    taken: list[list[float]] = [[], []]
    for _ in range(15):  # in turns, so that both meet the same noise
        for times, command in zip(taken, commands, strict=True):
            began = time.perf_counter()
            subprocess.run(command, capture_output=True, check=False)
            times.append(time.perf_counter() - began)
    check, numpy = (statistics.median(times) for times in taken)
    return check, numpy


def plain_ns_per_step(blocks: list[PlainBlock]) -> float:
    began = time.perf_counter()
    steps = sum(len(plain_steps(block)) for block in blocks)
    return (time.perf_counter() - began) / steps * 1e9


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--blocks", type=int, default=100_000)
    add_options(options)
    given = options.parse_args()
    n = given.blocks
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "path.3b"
        blocks = write_path(path, n)
        read, planned, stepped, steps = min((whole(path) for _ in range(3)), key=lambda times: sum(times[:3]))
        check = checked(path, 1)
        cards = [driven(path, "point-by-point"), driven(path, "card")]
        planners = planner_lines(path)
    small = checked(KEYHOLE, 100)
    start, numpy = start_ratio(KEYHOLE)
    total = read + planned + stepped
    plain = plain_ns_per_step(blocks[: max(1, n // 100)])
    peak_kib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"path                {n:,} blocks, {n * LENGTH_UM / 1e6:g} m, {steps:,} steps")
    print(f"read and decode     {read:.3f} s   {n / read:,.0f} blocks/s")
    print(f"plan and count      {planned:.3f} s")
    print(f"step and time       {stepped:.3f} s   {stepped / steps * 1e9:.1f} ns per step")
    print(f"in all              {total:.3f} s   {n / total:,.0f} blocks/s, {total / steps * 1e9:.1f} ns per step")
    print(
        f"plain loop          {plain:.0f} ns per step (steps only), {plain / (stepped / steps * 1e9):.1f} times as long"
    )
    for planned_line in planners:
        print(planned_line)
    print(f"through the card    {cards[0]:.2f} s point by point, {cards[1]:.2f} s at equal times")
    for offset_line in offset_lines(min(n, 10_000)):
        print(offset_line)
    print(f"check               {check:.3f} s   {n / check:,.0f} blocks/s, every rule")
    print(f"check a small file  {small * 1e3:.1f} ms, {start * 1e3:.0f} ms with its start")
    print(f"start of a check    {start / numpy:.2f} times a Python that imports numpy")
    print(f"peak memory         {peak_kib / 1024:.0f} MiB", file=sys.stdout)
    for table_line in table_lines(given.length, given.part):
        print(table_line)
    for compare_line in compare_lines(10_000):
        print(compare_line)


if __name__ == "__main__":
    main()
