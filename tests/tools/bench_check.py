"""The check: of a long path, of a small file, from the start of its process, and what the search for mends costs."""

import re
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from bench_cpu import DRYCUT, cpu_of, in_turns, used_by
from bench_path import contour_text
from bench_peers import in_iso
from places import SCENARIOS

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

KEYHOLE = SCENARIOS / "keyhole" / "program.3b"
_SIZES = 100, 10_000
_SMALL_TIMES = 100
_ROUNDS = 3


def check_lines(path: Path, blocks: int) -> Iterator[str]:
    """What checks take, in lines to print."""
    settings = CheckSettings(wire_diameter_um=180.0)
    long, small = Job(path.name, path, settings), Job(KEYHOLE.name, KEYHOLE, settings)
    check, many = in_turns(_ROUNDS, partial(_cpu_s, long, 1), partial(_cpu_s, small, _SMALL_TIMES))
    start, numpy = in_turns(
        _ROUNDS,
        lambda: used_by((*DRYCUT, "check", str(KEYHOLE))).cpu_s,
        lambda: used_by((sys.executable, "-c", "import numpy")).cpu_s,
    )
    contour = path.with_name("contour.3b")
    contour.write_text(contour_text(blocks, crosses=False), encoding="ascii")
    iso = in_iso(contour)
    (closed,) = in_turns(_ROUNDS, partial(_cpu_s, Job(iso.name, iso, CheckSettings()), 1))
    yield f"check               {check:.3f} s   {blocks / check:,.0f} blocks/s, every rule"
    yield f"check of ISO        {closed:.3f} s   {blocks / closed:,.0f} blocks/s, a closed contour"
    yield f"check a small file  {many / _SMALL_TIMES * 1e3:.1f} ms, {start * 1e3:.0f} ms with its start"
    yield f"start of a check    {start / numpy:.2f} times a Python that imports numpy"


def sound_and_unsound() -> Iterator[tuple[str, Callable[[], object], Callable[[], object]]]:
    """Checks of a sound program and of the same with one wrong count: what they are of, and both."""
    keyhole = KEYHOLE.read_text("utf-8")
    texts = {"the keyhole": keyhole, **{f"{size:,} blocks": contour_text(size, crosses=False) for size in _SIZES}}
    for name, text in texts.items():
        times = _SMALL_TIMES if len(text) < 10_000 else 1
        yield name, partial(_check, text, times), partial(_check, _with_a_fault(text), times)


def _with_a_fault(text: str) -> str:
    """A digit doubled in the count of the block in the middle."""
    blocks = list(re.finditer(r"B\d+\s*B\d+\s*B(\d+)", text))
    at = blocks[len(blocks) // 2].end(1)
    return text[:at] + text[at - 1] + text[at:]


def _check(text: str, times: int) -> None:
    job = Job("contour.3b", text.encode(), CheckSettings())
    for _ in range(times):
        check_file(job)


def _cpu_s(job: Job, times: int) -> float:
    return cpu_of(lambda: [check_file(job) for _ in range(times)])
