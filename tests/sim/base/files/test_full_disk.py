"""A disk that is full, met by real writes: one line for people, no file changed, nothing left behind."""

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from command import run_inside

if sys.platform == "win32":
    pytest.skip("Windows has no such limit", allow_module_level=True)

import resource

from parser.findings.errors import FileUnreadableError
from sim.base.files import replace_file

PART = "B500B0B500GXL1\nB500B0B2000GYNR1\nB500B0B500GXL3\nDD\n"


@contextmanager
def room_for(most: int) -> Iterator[None]:
    """A system that takes no more than so many bytes into one file, as a disk that is all but full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize(
    ("command", "most"),
    [
        (("run", "part.3b", "-o", "out"), 20_000),
        (("run", "part.3b", "--card-log", "out/part.log", "--interpolator", "card"), 500),
        (("draw", "part.3b", "-o", "out"), 40_000),
        (("draw", "part.3b", "-o", "out/cut.svg"), 2_000),
        (("ballbar", "--radius", "0.2mm", "-o", "out"), 20_000),
        (("replay", "part.3b", "-o", "out/film.gif", "--seconds", "0.5", "--fps", "2"), 2_000),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else None,
)
def test_a_full_disk_changes_no_output(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: tuple[str, ...], most: int
) -> None:
    (tmp_path / "part.3b").write_text(PART)
    (tmp_path / "out").mkdir()
    for name in ("report.json", "cut.png", "part.log", "cut.svg", "ballbar.png", "film.gif"):
        (tmp_path / "out" / name).write_text("of an earlier run")
    with room_for(most):
        done = run_inside(*command, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    error = done.stderr.decode().splitlines()[-1]
    assert re.fullmatch(r"drycut: error: \S+: cannot be written: File too large", error), done.stderr
    assert {path.read_text() for path in (tmp_path / "out").iterdir()} == {"of an earlier run"}
    assert len(list((tmp_path / "out").iterdir())) == 6


def test_a_full_disk_leaves_a_program_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "part.3b"
    path.write_text(PART)
    with room_for(20), pytest.raises(FileUnreadableError, match=r"part\.3b: cannot be written: File too large"):
        replace_file(path, PART.encode(), b"B" * 100)
    assert (path.read_text(), [path.name for path in tmp_path.iterdir()]) == (PART, ["part.3b"])
