"""Closed streams, full disks and readers that have gone: never a traceback, and the exit code tells the verdict."""

import io
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from checking import WRONG_AXIS
from forked import Forked, forked

from sim.show.terminal.streams import Cleaned, Outlet

pytestmark = pytest.mark.skipif(not Path("/dev/full").exists(), reason="has no fork, or no device that is always full")

SHORT = "B500B0B500GXL1 B0B500B500GYL2 B500B0B500GXL3 B0B500B500GYL4 DD"
LOADS = ("card", "check.command", "compare", "explain", "run", "progress")
# Commands with an exit code for each verdict.
QUICK = [
    (["check", "good.3b"], 0),
    (["check", "bad.3b"], 1),
    (["check", "bad.3b", "--format", "json"], 1),
    (["check", "bad.3b", "--diff"], 1),
    (["explain"], 0),
    (["card", "replay", "good.log"], 0),
    (["check", "--help"], 0),
    (["--version"], 0),
]
LONG = [
    (["run", "good.3b"], 0),
    (["run", "fails.3b", "--json"], 1),
]
WAYS = [
    *(("closed", "closed", "closed"), ("null", "gone", "kept")),
    *(("null", "closed", "kept"), ("null", "gone", "gone"), ("null", "kept", "full")),
]
"""Kinds of stdin, stdout and stderr."""
SILENT = [(["check", "none.3b"], 2), (["explain", "3B999"], 2), (["frobnicate"], 2), ([], 2)]


@pytest.fixture(scope="module")
def drycut(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Forked]:
    folder = tmp_path_factory.mktemp("streams")
    for name, text in {"good": SHORT, "bad": WRONG_AXIS, "fails": SHORT.replace("GYL4", "GYL5")}.items():
        (folder / f"{name}.3b").write_text(text)
    with forked(folder, [*(f"sim.cli.{name}" for name in LOADS), "sim.show.terminal.run"]) as running:
        made = running.run("run", "good.3b", "--interpolator", "card", "--card-log", "good.log")
        assert made.code == 0, made.err
        yield running


def complaints(err: str) -> list[str]:
    """What stderr says, but for progress."""
    return [line for line in err.splitlines() if not line.endswith("%")]


@pytest.mark.alike(1)
@pytest.mark.parametrize(("command", "code"), QUICK + LONG + SILENT, ids=str)
def test_a_verdict_is_told_whether_anyone_listens_or_not(drycut: Forked, command: list[str], code: int) -> None:
    for stdin, out, err in WAYS if (command, code) in QUICK else WAYS[:2]:
        done = drycut.run(*command, stdin=stdin, out=out, err=err)
        assert done.code == code, (stdin, out, err, done)
        if code != 2:
            assert complaints(done.err) == [], (stdin, out, err)
        assert "Traceback" not in done.err
        assert "Exception" not in done.err


@pytest.mark.alike(1)
@pytest.mark.parametrize(("command", "code"), [*QUICK, LONG[0]], ids=str)
def test_output_that_cannot_be_written_is_bad_whatever_the_verdict(
    drycut: Forked, command: list[str], code: int
) -> None:
    done = drycut.run(*command, out="full")
    assert (done.code, complaints(done.err)) == (2, ["drycut: error: output: No space left on device"]), code
    assert drycut.run(*command, out="full", err="full").code == 2


def test_what_is_written_to_a_closed_stream_ends_in_no_file(drycut: Forked) -> None:
    assert drycut.run("check", "good.3b", "--output-file", "told.txt", out="closed", err="closed").code == 0
    assert drycut.run("check", "good.3b", "--format", "json=told.json", out="closed", err="closed").code == 0


def test_a_closed_stdin_that_is_to_be_checked_is_told(drycut: Forked) -> None:
    done = drycut.run("check", "-", stdin="closed")
    assert (done.code, done.out, len(done.err.splitlines())) == (2, "", 1)
    assert "stdin" in done.err
    assert os.devnull not in done.err


def test_nothing_is_said_of_a_stream_that_has_ended() -> None:
    stream = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    outlet = Outlet(stream, must_arrive=True)
    cleaned = Cleaned(outlet)
    cleaned.write("a line\n")
    stream.close()
    cleaned.flush()  # as Python 3.13 does of every stream that is no longer used
    outlet.flush()
