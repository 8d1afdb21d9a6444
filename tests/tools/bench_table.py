"""The table at work: CPU time for a step, hours of cutting, a rapid run, a circular test, a trace's memory.

The contour is 300 mm of lines and arcs, a rounded square in whole µm, in 40 mm steel. A small square is run through the
reference engine, too.
"""

import argparse
import math
import resource
import subprocess
import sys
import time
from typing import NamedTuple

from controller.host.host import Host
from controller.motion.limits import Feeds
from parser.program import parse_program
from sim.base.progress import silent
from sim.run.ballbar.circle import circle_test, run_test
from sim.setup.machine.machine import Machine, load_machine
from sim.setup.machine.table import TableEngine
from sim.table.follow import Following
from sim.table.motion import Motion, Moved, TableRun, driven, motion_of
from sim.table.ticks import Sampling

THICKNESS_MM = 40.0
RADIUS_UM = 5_000
RAPID_UM_S = 10_000.0
STEPPER, SERVO = "dk7740", "servo-400x500"


def contour(length_mm: float) -> str:
    """A rounded square about so long, counter-clockwise, its corners quarter circles."""
    side = round((length_mm * 1e3 - 2.0 * math.pi * RADIUS_UM) / 4.0)
    r = RADIUS_UM
    lines = (f"B{side}B0B{side}GXL1", f"B0B{side}B{side}GYL2", f"B{side}B0B{side}GXL3", f"B0B{side}B{side}GYL4")
    arcs = (f"B0B{r}B{r}GYNR4", f"B{r}B0B{r}GXNR1", f"B0B{r}B{r}GYNR2", f"B{r}B0B{r}GXNR3")
    return " ".join(block for pair in zip(lines, arcs, strict=True) for block in pair) + " DD"


def corners(count: int) -> str:
    """Lines of 5 to 10 mm that meet at sharp corners."""
    sides = [(10_000, 0, 1), (3000, 7000, 2), (8000, 2000, 3), (1000, 6000, 4)]
    return " ".join(f"B{x}B{y}B{max(x, y)}G{'X' if x >= y else 'Y'}L{q}" for x, y, q in sides * count) + " DD"


def motion(text: str, machine: Machine, feeds: Feeds, spacing_um: float = 5.0) -> Motion:
    """Motion of a program from the middle of the travel."""
    middle = machine.table.travel_x_mm * 500.0, machine.table.travel_y_mm * 500.0
    return motion_of(parse_program(text).toolpath, feeds, machine, middle, Sampling(spacing_um))


def cutting(length_mm: float, spacing_um: float = 5.0) -> Motion:
    """The contour in 40 mm steel."""
    machine = load_machine(STEPPER)
    return motion(contour(length_mm), machine, machine.feeds(THICKNESS_MM), spacing_um)


def rapid() -> Motion:
    """Sharp corners at 10 mm/s."""
    return motion(corners(3), load_machine(SERVO), Feeds(RAPID_UM_S, RAPID_UM_S))


def timed(run: Motion) -> tuple[float, Moved]:
    """Seconds to simulate, and what came of it."""
    began = time.perf_counter()
    table = TableRun(run)
    for _ in table.followed(driven(run)):
        pass  # nobody looks at the pulses
    moved = table.moved
    return time.perf_counter() - began, moved


class Followed(NamedTuple):
    """What a table took for the pulses of a motion: CPU seconds, at best, steps and courses."""

    cpu_s: float
    steps: int
    courses: int


def followed(run: Motion, times: int = 5) -> Followed:
    """CPU time of the table alone, without card and host: the least of some times."""
    stretches = list(Host(run.drive, run.card).pulses())
    taken = []
    for _ in range(times):
        table, began = Following(run.table, run.ticks), time.process_time()
        for pulses in stretches:
            table.take(pulses)
        table.finish()
        taken.append(time.process_time() - began)
    return Followed(min(taken), sum(len(pulses.t_s) for pulses in stretches), table.courses)


def step_lines() -> list[str]:
    """What a step takes, how that grows, and how many times as long the reference takes."""
    runs = {length: followed(cutting(length)) for length in (36.0, 108.0, 324.0)}
    small, large = runs[36.0], runs[324.0]
    slower = followed(small_in("pymunk"), 1).cpu_s / followed(small_in("compiled")).cpu_s
    return [
        f"{'table, a step':<20}{large.cpu_s / large.steps * 1e9:.0f} ns, {large.courses / large.steps:.3f} courses",
        f"{'table, growth':<20}exponent {math.log(large.cpu_s / small.cpu_s) / math.log(9.0):.2f} from 36 to 324 mm",
        f"{'table, in pymunk':<20}{slower:,.0f} times as long",
    ]


def small_in(engine: TableEngine) -> Motion:
    """A square of 0.2 mm through an engine."""
    machine = load_machine(STEPPER)._replace(engine=engine)
    square = "B200B0B200GXL1 B0B200B200GYL2 B200B0B200GXL3 B0B200B200GYL4 DD"
    return motion(square, machine, machine.feeds(THICKNESS_MM))


def circle_line() -> str:
    """A circular test at a feed of cutting."""
    test = circle_test(load_machine(STEPPER), 20_000.0, 100.0)
    began = time.process_time()
    run_test(test, silent)
    return f"{'circular test':<20}{time.process_time() - began:.2f} s of CPU for 20 mm at 6 mm/min"


def speed_line(name: str, run: Motion, least: float) -> str:
    """How much faster than real time a run is."""
    taken, moved = timed(run)
    simulated = float(moved.trace.t_s[-1])
    times = simulated / taken
    return f"{name:<20}{taken:.2f} s   {simulated:,.0f} s of it, {times:,.0f} times real time (asked for {least:,.0f})"


def peak_mib(spacing_um: float, length_mm: float) -> float:
    """Peak memory of a process that simulates the contour with samples so far apart."""
    options = [sys.executable, __file__, "--memory", str(spacing_um), "--length", str(length_mm)]
    done = subprocess.run(options, capture_output=True, check=True, text=True)
    return float(done.stdout)


def table_lines(length_mm: float) -> list[str]:
    """All that is measured, in lines to print."""
    memory = ", ".join(f"{peak_mib(spacing, length_mm):.0f} MiB at {spacing:g} µm" for spacing in (5.0, 50.0))
    return [
        *step_lines(),
        circle_line(),
        speed_line("table, cutting", cutting(length_mm), 1000.0),
        speed_line("table, rapid", rapid(), 20.0),
        f"{'table, memory':<20}{memory} of trace spacing",
    ]


def add_options(options: argparse.ArgumentParser) -> None:
    """How much is run."""
    options.add_argument("--length", type=float, default=300.0, help="mm of contour")


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    add_options(options)
    options.add_argument("--memory", type=float, help="simulate with this spacing, and print the peak memory in MiB")
    given = options.parse_args()
    if given.memory:
        timed(cutting(given.length, given.memory))
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0)
        return
    print("\n".join(table_lines(given.length)))


if __name__ == "__main__":
    main()
