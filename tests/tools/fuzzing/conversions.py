"""Target `convert`: programs of every language changed a little, and converted: proved and written, or not written."""

import random
from pathlib import Path

from fuzzing import iso_text, program_text
from fuzzing.ran import answer_of, broken_by, leftovers, ran
from fuzzing.target import Input, Judged
from parser.findings.codes import Severity
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings

_REGISTERS = ("--offset", "D0=0.1mm", "--offset", "D1=0.05mm", "--offset", "D11=0.1mm")
_OPTIONS = (
    ("part.3b",),
    ("part.3b", "--form", "detailed"),
    ("part.4b",),
    ("part.iso",),
    ("part.iso", "--dialect", "robofil", "--compensation", "worked-in"),
    ("part.iso", "--dialect", "mitsubishi", "--unit", "inch", "--crlf"),
    ("part.iso", "--dialect", "fanuc", "--distance", "absolute", "--tape"),
    ("part.iso", "--dialect", "sodick", "--decimals", "4", "--number-step", "10"),
    ("part.iso", "--centers", "absolute", "--unit", "um"),
    ("part.pmc",),
    ("part.pmc", "--pmac", "gcode", "--card", "power"),
)


_CALLED_OPEN = (b"drycut check will call it open", b"its contour stays open, as it was")
"""What is said of a contour that only the kerf closes, and of one that is as open as its source."""


def make(rng: random.Random) -> Input:
    """A program, as it is or with something in it changed."""
    if rng.random() < 0.3:
        text = rng.choice(program_text.SEEDS)
        return (program_text.changed(rng, text) if rng.random() < 0.6 else text).encode()
    text = rng.choice(iso_text.SEEDS)
    return (iso_text.changed(rng, text) if rng.random() < 0.7 else text).encode()


def judge(data: Input, number: int, folder: Path) -> Judged:
    """What is written is proved: it has no error, and is open only where the command says so."""
    assert isinstance(data, bytes)
    (folder / "given").write_bytes(data)
    name, *options = _OPTIONS[number % len(_OPTIONS)]
    done = ran(("convert", "given", "-o", name, *options, *_REGISTERS), folder)
    broken = [*broken_by(done, folder, "file"), *leftovers(folder)]
    written = folder / name
    if written.exists() != (not done.returncode):
        broken.append(f"exit {done.returncode} {'with' if written.exists() else 'without'} a file")
    if written.exists():
        is_open = any(said in b" ".join(done.stdout.split()) for said in _CALLED_OPEN)
        broken += _of_written(written.read_bytes(), name, may_stay_open=is_open)
    answer = answer_of(done, folder) + (repr(written.read_bytes()) if written.exists() else "")
    return Judged(answer, broken, f"exit {done.returncode or 0}")


def _of_written(data: bytes, name: str, *, may_stay_open: bool) -> list[str]:
    """What is wrong with a program that was written."""
    result = _checked(name, data, may_stay_open=may_stay_open)
    errors = {found.code for found in result.findings if found.severity is Severity.ERROR}
    return [f"writes a program with {' '.join(sorted(errors))}"] if errors else []


def _checked(name: str, data: bytes, *, may_stay_open: bool = False) -> CheckResult:
    known = (("D0", 100.0), ("D1", 50.0), ("D11", 100.0))
    return check_file(Job(name, data, CheckSettings(registers=known, may_stay_open=may_stay_open)))
