"""What drycut shall cost: each figure beside what it was before loops were compiled, and its goal.

All are CPU time, the least of some rounds; those beside a peer are ratios, taken in turns with it.
"""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

from bench_check import sound_and_unsound
from bench_cpu import DRYCUT, cpu_of, in_turns, used_by
from bench_cut import cut_parts, write_holes
from bench_motion import read_plan_step
from bench_path import contour_text, write_path
from bench_peers import KLIPPER_MISSING, RS274_MISSING, in_iso, klipper, klipper_cpu_s, rs274, rs274_used
from bench_table import cutting, followed
from places import SCENARIOS

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

TABLE_PART_MM = 324.0
_HOLES = 1_000
_FEW_ROUNDS = 2  # of runs that take half a minute
_SMALL_SHARE = 10  # of the blocks of a path: the contour that is run with its files


class Goal(NamedTuple):
    """A figure, in its unit; before, now and what it shall be at most. No `now` where `why` says so."""

    what: str
    unit: str
    before: str
    goal: float
    now: float | None
    why: str = ""

    def line(self) -> str:
        """One line of the table of goals."""
        if self.now is None:
            return f"{self.what:<46} {self.before:>10} {'–':>9} {self.goal:>9g}  {self.why}"
        reached = "reached" if self.now <= self.goal else "not reached"
        return f"{self.what:<46} {self.before:>10} {self.now:>9.3g} {self.goal:>9g}  {self.unit}, {reached}"


def goal_lines(folder: Path, blocks: int, rounds: int) -> Iterator[str]:
    """The table of goals, line by line as they are measured."""
    yield f"{'goal':<46} {'before':>10} {'now':>9} {'at most':>9}"
    for part in PARTS:
        for goal in part(folder, blocks, rounds):
            yield goal.line()


def _table(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    table = followed(cutting(TABLE_PART_MM), rounds)
    yield Goal("table", "ns per step", "47,000", 150.0, table.cpu_s / table.steps * 1e9)


def _keyhole(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    command = (*DRYCUT, "run", str(SCENARIOS / "keyhole"), "-o", str(folder / "keyhole"))
    used = [used_by(command) for _ in range(rounds)]
    yield Goal("keyhole with files", "s", "12.5", 2.5, min(one.cpu_s for one in used))
    yield Goal("keyhole with files, on the clock", "s", "13-16", 2.0, min(one.wall_s for one in used))


def _small_files(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    small = blocks // _SMALL_SHARE
    path = folder / "contour.3b"
    path.write_text(contour_text(small, crosses=False), encoding="ascii")
    used = [used_by((*DRYCUT, "run", str(path), "-o", str(folder / "contour"))) for _ in range(rounds)]
    yield Goal(f"contour of {small:,} blocks with files", "s", "> 125", 8.0, min(one.cpu_s for one in used))
    yield Goal(f"contour of {small:,} blocks, memory", "MiB", "", 500.0, max(one.peak_mib for one in used))


def _circle(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    command = (*DRYCUT, "ballbar", "--radius", "20mm", "--feed", "6mm/min")
    used = [used_by(command) for _ in range(rounds)]
    yield Goal("circular test, R 20 mm at 6 mm/min", "s", "161", 5.0, min(one.cpu_s for one in used))


def beside_klipper(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    """A run without files, and the stages before it, on the path that Klipper plans, steps and packs."""
    path = _path(folder, blocks)
    names = f"run of {blocks:,} blocks / Klipper", f"read, plan, step {blocks:,} blocks / Klipper"
    ours = (
        lambda: used_by((*DRYCUT, "run", str(path))).cpu_s,
        lambda: cpu_of(partial(read_plan_step, path)),
    )
    source = klipper()
    if source is None:
        for name, before, goal in zip(names, ("7.2", "0.70"), (1.5, 0.25), strict=True):
            yield Goal(name, "times", before, goal, None, KLIPPER_MISSING)
        return
    run, stepped, theirs = in_turns(rounds, *ours, partial(klipper_cpu_s, source, path))
    yield Goal(names[0], f"times {theirs:.2f} s", "7.2", 1.5, run / theirs)
    yield Goal(names[1], f"times {theirs:.2f} s", "0.70", 0.25, stepped / theirs)


def beside_rs274(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    """A check of the path that rs274 reads and writes; and of a closed contour in ISO, of the very same file."""
    path = _path(folder, blocks)
    name, program = f"check of {blocks:,} blocks / rs274", rs274()
    started, in_words = f"drycut check of {blocks:,} blocks / rs274", f"check of {blocks:,} blocks of ISO / rs274"
    if program is None:
        yield Goal(in_words, "times", "", 1.5, None, RS274_MISSING)
        yield Goal(name, "times", "2.5", 1.5, None, RS274_MISSING)
        return
    command = (*DRYCUT, "check", "--quiet", str(path))
    job = Job(path.name, path, CheckSettings())
    check, process, theirs = in_turns(
        rounds,
        lambda: cpu_of(partial(check_file, job)),
        lambda: used_by(command).cpu_s,
        lambda: rs274_used(program, path).cpu_s,
    )
    yield Goal(name, f"times {theirs:.2f} s", "2.5", 1.5, check / theirs)
    yield Goal(started, f"times {theirs:.2f} s, its start and its report included", "", 1.5, process / theirs)
    contour = folder / "closed.3b"
    contour.write_text(contour_text(blocks, crosses=False), encoding="ascii")
    iso = Job("closed.iso", in_iso(contour), CheckSettings())
    check, theirs = in_turns(
        rounds, lambda: cpu_of(partial(check_file, iso)), lambda: rs274_used(program, contour).cpu_s
    )
    yield Goal(in_words, f"times {theirs:.2f} s", "", 1.5, check / theirs)


def _mends(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    """A file with one wrong word beside the same without it."""
    for name, sound, unsound in sound_and_unsound():
        ours, theirs = in_turns(rounds, partial(cpu_of, unsound), partial(cpu_of, sound))
        yield Goal(f"check of {name} with a fault / without", "times", "", 1.5, ours / theirs)


def _kerf(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    """What `--kerf` adds to runs with their files: pieces for their pictures are worked out without it, too."""
    for part in cut_parts():
        path = folder / "part.3b"
        path.write_text(part.text, encoding="ascii")
        command = (*DRYCUT, "run", str(path), "--open", "-o", str(folder / "part"))
        works = [lambda to=to: used_by(to).cpu_s for to in (command, (*command, "--kerf"))]
        plain, whole = in_turns(min(rounds, _FEW_ROUNDS), *works)
        unit = f"s, run without it {plain:.1f} s"
        yield Goal(f"kerf: {part.name}", unit, part.before, part.goal_s, whole - plain)


def _holes(folder: Path, blocks: int, rounds: int) -> Iterator[Goal]:
    """A program of a drawing, made and proved."""
    path = folder / "holes.dxf"
    write_holes(path, _HOLES)
    used = used_by((*DRYCUT, "program", str(path), "-o", str(folder / "holes.3b")))
    yield Goal(f"program of {_HOLES:,} holes", "s", "93", 20.0, used.cpu_s)
    yield Goal(f"program of {_HOLES:,} holes, memory", "MiB", "3,600", 700.0, used.peak_mib)


def _path(folder: Path, blocks: int) -> Path:
    path = folder / "path.3b"
    if not path.exists():
        write_path(path, blocks)
    return path


PARTS = (_table, _keyhole, _small_files, _circle, beside_klipper, beside_rs274, _mends, _kerf, _holes)
"""What the table of goals is measured by, in its order: each gives one or more goals."""
