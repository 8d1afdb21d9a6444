"""How the work of every room grows with the blocks of a contour: the exponent e of its CPU time, blocks to the e.

A profiler tells whose functions take the time: what numpy and other libraries take is the caller's. Each size is
measured in a process of its own.
"""

import cProfile
import json
import math
import pstats
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from bench_path import contour_text
from places import ROOT

GOAL = 1.15
_FEW, _MANY = 1_000, 10_000
_LEAST_S = 0.05  # at the many blocks: the growth of what takes less is noise
_ROOMS = ("parser", "controller", "sim")


def growth_lines(few: int = _FEW, many: int = _MANY, rounds: int = 2) -> Iterator[str]:
    """What grows how, in lines to print: the rooms by their exponents, the worst first."""
    for name in ("plain", "crossing"):
        by_few, by_many = (_least(name, blocks, rounds) for blocks in (few, many))
        found = {
            room: math.log(by_many[room] / max(by_few.get(room, 0.0), 1e-6)) / math.log(many / few)
            for room in by_many
            if by_many[room] >= _LEAST_S
        }
        yield f"growth, {name} contour, {few:,} to {many:,} blocks, exponents at most {GOAL}:"
        for room, exponent in sorted(found.items(), key=lambda item: -item[1]):
            reached = "reached" if exponent <= GOAL else "not reached"
            yield f"  {room:<30} {by_few.get(room, 0.0):7.3f} s {by_many[room]:8.3f} s  {exponent:5.2f}  {reached}"


def _least(name: str, blocks: int, rounds: int) -> dict[str, float]:
    """Seconds by room, the least of some rounds."""
    taken = [_measured(name, blocks) for _ in range(rounds)]
    return {room: min(one.get(room, math.inf) for one in taken) for room in taken[0]}


def _measured(name: str, blocks: int) -> dict[str, float]:
    command = [sys.executable, __file__, name, str(blocks)]
    done = subprocess.run(command, capture_output=True, check=True, text=True, cwd=ROOT)
    seconds: dict[str, float] = json.loads(done.stdout)
    return seconds


def _profile(name: str, blocks: int) -> dict[str, float]:
    """Seconds by room of a run with kerf and files; loops are compiled, and modules loaded, by a first small run."""
    with tempfile.TemporaryDirectory() as folder:
        _run(Path(folder), name, 20)
        profiler = cProfile.Profile(time.process_time)
        profiler.enable()
        _run(Path(folder), name, blocks)
        profiler.disable()
    return by_room(pstats.Stats(profiler))


def _run(folder: Path, name: str, blocks: int) -> None:
    from dataclasses import replace

    from drycut import load_scenario, read_program, run_into

    path = folder / "contour.3b"
    path.write_text(contour_text(blocks, crosses=name == "crossing"), encoding="ascii")
    run_into(folder / "files", read_program(path), replace(load_scenario(path), kerf=True))


def by_room(stats: pstats.Stats) -> dict[str, float]:
    """Seconds of a profile by room, such as ``sim/cut/kerf``: of its functions, and of what they call outside of it."""
    seconds: dict[str, float] = {}
    for function, (_, _, own, _, callers) in stats.stats.items():  # type: ignore[attr-defined]
        room = _room(function[0])
        if room:
            seconds[room] = seconds.get(room, 0.0) + own
            continue
        for caller, (_, _, _, below) in callers.items():
            by = _room(caller[0])
            if by:
                seconds[by] = seconds.get(by, 0.0) + below
    seconds["all"] = stats.total_tt  # type: ignore[attr-defined]
    return seconds


def _room(file: str) -> str:
    """Room of a file of ours, two or three folders deep; empty for any other file."""
    try:
        parts = Path(file).relative_to(ROOT).parts[:-1]
    except ValueError:
        return ""
    return "/".join(parts[:3]) if parts and parts[0] in _ROOMS else ""


if __name__ == "__main__":
    print(json.dumps(_profile(sys.argv[1], int(sys.argv[2]))))
