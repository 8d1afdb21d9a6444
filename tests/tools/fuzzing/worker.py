"""A process that tries inputs one by one, each in bounded time and memory; it may die of one.

A watchdog of `faulthandler` ends the process where an input takes too long, even in code that never comes back to
Python, and leaves where it was. What is slow, but comes back, is told by its processor time: that of a busy machine
proves nothing.
"""

import contextlib
import faulthandler
import re
import shutil
import sys
import time
import traceback
from collections import Counter
from ctypes import c_int64
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

from places import ROOT

from fuzzing.target import Input, Judged, Target

if sys.platform != "win32":
    import resource

MOST_WALL_S = 60.0
"""After so long an input hangs."""
ADDRESS_SPACE = 6 << 30
"""Bytes that a worker may map; what asks for more gets a MemoryError."""
TWICE_EVERY = 25
"""One in so many inputs is tried twice, and must be answered alike."""
STACK = "stack.txt"
"""File in the worker's folder in which it leaves where it was when it died."""
_PEAK_MB = 1e-6 if sys.platform == "darwin" else 1024e-6  # ru_maxrss is in bytes there, in KiB elsewhere


class Task(NamedTuple):
    """Inputs `low` to `past` of a target; or one input, given instead of made from the number `low`."""

    target: Target
    seed: int
    low: int
    past: int
    given: Input | None = None
    most_wall_s: float = MOST_WALL_S


class Failure(NamedTuple):
    """A promise that was broken by an input."""

    target: Target
    seed: int
    number: int
    promise: str


class Done(NamedTuple):
    """What is told at the end of a task: inputs, processor time in s, the slowest input and how inputs ended."""

    task: Task
    inputs: int
    took_s: float
    slowest: tuple[float, int]
    reached: Counter[str]


def work(connection: Connection, position: "c_int64", folder: Path) -> None:
    """Do tasks that come over the connection until None comes; `position` is the number of the input being tried."""
    if sys.platform != "win32":
        resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    with (folder / STACK).open("w", encoding="utf-8") as stack:
        faulthandler.enable(stack)
        while (task := connection.recv()) is not None:
            slowest, took, reached = (0.0, task.low), 0.0, Counter[str]()
            for number in range(task.low, task.past):
                position.value = number
                faulthandler.dump_traceback_later(task.most_wall_s, exit=True, file=stack)
                begin = time.process_time()
                broken, ending = tried(task, number, folder / "input")
                used = time.process_time() - begin
                faulthandler.cancel_dump_traceback_later()
                for promise in broken:
                    connection.send(Failure(task.target, task.seed, number, promise))
                slowest, took = max(slowest, (used, number)), took + used
                reached[ending] += 1
            connection.send(Done(task, task.past - task.low, took, slowest, reached))


def tried(task: Task, number: int, folder: Path) -> tuple[list[str], str]:
    """Promises that an input breaks, and how it ended."""
    target = task.target
    before_mb, begin = _peak_mb(), time.process_time()
    judged = _judged(task, number, folder)
    took, more_mb = time.process_time() - begin, _peak_mb() - before_mb
    broken = list(dict.fromkeys(judged.broken))
    if took > target.most_s:
        broken.append(f"took {took:.1f} s of processor time")
    if more_mb > target.most_mb:
        broken.append(f"took {more_mb:.0f} MB more than any before")
    if number % TWICE_EVERY == 0 and not broken and _judged(task, number, folder).answer != judged.answer:
        broken.append("was answered otherwise the second time")
    return broken, judged.reached


def _judged(task: Task, number: int, folder: Path) -> Judged:
    """The judgement in a folder that is empty; an exception that gets out is a broken promise."""
    if not folder.is_dir() or any(folder.iterdir()):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
    try:
        data = task.target.input(task.seed, number) if task.given is None else task.given
        return task.target.judge(data, number, folder)
    except (Exception, SystemExit) as error:
        return Judged("", [raised(error)], type(error).__name__)


def raised(error: BaseException) -> str:
    """An exception on one line, with the place that raised it and the last place of drycut on the way there."""
    frames = traceback.extract_tb(error.__traceback__)
    places = [_place(frame) for frame in frames]
    own = [place for place in places if place.startswith(("parser/", "controller/", "sim/"))]
    places = list(dict.fromkeys((*own[-1:], *places[-1:])))
    return f"{type(error).__name__}: {str(error)[:200]!r} at {', '.join(places)}"


def _place(frame: traceback.FrameSummary) -> str:
    path = Path(frame.filename)
    return f"{path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else path.name}:{frame.lineno}"


def _peak_mb() -> float:
    """The most memory that this process ever held, MB; 0 where no one tells.

    Linux counts what the process before `exec` held into `ru_maxrss`: here that of a test session. Not so VmHWM.
    """
    with contextlib.suppress(OSError):
        found = re.search(r"VmHWM:\s+(\d+) kB", Path("/proc/self/status").read_text(encoding="utf-8"))
        if found:
            return int(found[1]) * 1024e-6
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * _PEAK_MB if sys.platform != "win32" else 0.0


def death(folder: Path, code: int | None) -> str:
    """What a dead worker left in its folder, as a broken promise: where it was, the innermost places first."""
    stack = (folder / STACK).read_text(encoding="utf-8", errors="replace").rstrip()
    lines = stack[max(stack.rfind("Timeout"), stack.rfind("Fatal"), 0) :].splitlines()
    places = [line.strip().removeprefix("File ") for line in lines if line.startswith("  File ")]
    what = "never came back" if lines and lines[0].startswith("Timeout") else f"killed the process (exit code {code})"
    return f"{what}: {lines[0] if lines else 'no word'}{' at ' if places else ''}{' < '.join(places[:6])}"
