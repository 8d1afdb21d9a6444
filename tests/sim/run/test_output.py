"""Files of a run: whole or not at all, the same bytes every time, and in memory that does not grow with the steps."""

import hashlib
import json
import os
import random
import subprocess
import sys
import zipfile
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from depth import cases
from places import ROOT
from runs import plain_scenario

from parser.findings.errors import FileUnreadableError, ProgramError
from parser.program import parse_program
from sim.base.files import staged
from sim.base.progress import silent
from sim.jobs.run_into import run_into
from sim.jobs.trace_file import read_trace

TEXT = "B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B9900GXL3 D B3000B0B3000GXL2 D B50B0B50GXL1 DD"
NAMES = ["cut.png", "replay.html", "report.html", "report.json"]


def digests(folder: Path) -> dict[str, str]:
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir())}


@pytest.mark.deeper
def test_trace_holds_every_step_from_the_start(tmp_path: Path) -> None:
    run = run_into(tmp_path / "out", parse_program(TEXT), plain_scenario(), silent, trace=True)
    trace = np.load(tmp_path / "out" / "trace.npz")
    n = len(run.stepped)
    assert {name: (trace[name].dtype.str, trace[name].shape) for name in trace if name.startswith("step")} == {
        "step_x_um": ("<i4", (n + 1,)),
        "step_y_um": ("<i4", (n + 1,)),
        "step_block": ("<i4", (n,)),
        "step_t_s": ("<f8", (n,)),
    }
    x, y = trace["step_x_um"], trace["step_y_um"]
    assert (x[0], y[0]) == (0, 0)
    assert [x[-1], y[-1]] == run.stepped.corner_um[-1].tolist()
    assert np.array_equal(np.abs(np.diff(x)) + np.abs(np.diff(y)), np.ones(n))
    assert np.array_equal(np.bincount(trace["step_block"], minlength=6)[1:], run.stepped.count)
    assert trace["step_t_s"][-1] == pytest.approx(run.plan.duration_s)
    assert trace["t_s"][0] == 0.0
    assert trace["t_s"].shape == trace["x_um"].shape == trace["y_um"].shape == trace["block"].shape


@pytest.mark.deeper
def test_two_runs_give_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        run_into(tmp_path / name, parse_program(TEXT), plain_scenario(), silent, trace=True)
    assert digests(tmp_path / "a") == digests(tmp_path / "b")
    assert sorted(digests(tmp_path / "a")) == [*NAMES, "trace.npz"]


def test_no_trace_of_an_earlier_run_stays(tmp_path: Path) -> None:
    run_into(tmp_path, parse_program(TEXT), plain_scenario(), silent, trace=True)
    assert "trace.npz" in (tmp_path / "report.html").read_text("utf-8")
    run_into(tmp_path, parse_program("B10B0B10GXL1"), plain_scenario(), silent)
    assert sorted(digests(tmp_path)) == NAMES
    assert "trace.npz" not in (tmp_path / "report.html").read_text("utf-8")


def test_a_trace_is_read_as_it_was_written(tmp_path: Path) -> None:
    run_into(tmp_path, parse_program(TEXT), plain_scenario(), silent, trace=True)
    arrays, trace = np.load(tmp_path / "trace.npz"), read_trace(tmp_path / "trace.npz")
    assert {field.name for field in fields(trace)} == set(arrays)
    for name in arrays:
        assert getattr(trace, name).dtype == arrays[name].dtype
        assert np.array_equal(getattr(trace, name), arrays[name])


@pytest.mark.parametrize("content", [None, b"", b"PK\x03\x04 half", b"hello", "a folder", "an array", "other arrays"])
def test_what_is_no_trace_is_told_as_such(tmp_path: Path, content: bytes | str | None) -> None:
    file = tmp_path / "trace.npz"
    if content == "a folder":
        file.mkdir()
    elif content == "an array":
        with file.open("wb") as out:
            np.save(out, np.arange(3))
    elif content == "other arrays":
        np.savez(file, x_um=np.arange(3.0))
    elif isinstance(content, bytes):
        file.write_bytes(content)
    with pytest.raises(FileUnreadableError, match=r"trace\.npz"):
        read_trace(file)


@pytest.mark.deeper
def test_a_damaged_trace_is_told_as_such_or_read_whole(tmp_path: Path) -> None:
    run_into(tmp_path, parse_program(TEXT), plain_scenario(), silent, trace=True)
    sound, file, rng = (tmp_path / "trace.npz").read_bytes(), tmp_path / "damaged.npz", random.Random(20261128)
    outcomes = {True: 0, False: 0}
    for _ in cases(100, 30_000):
        data = bytearray(sound)
        for _ in range(rng.randint(1, 6)):
            near_end = rng.random() < 0.5  # the directory of a zip stands at its end
            data[-1 - rng.randrange(900) if near_end else rng.randrange(len(data))] = rng.randrange(256)
        file.write_bytes(data[: rng.randrange(len(data))] if rng.random() < 0.2 else data)
        try:
            trace = read_trace(file)
        except FileUnreadableError as error:
            outcomes[False] += "damaged.npz" in str(error)
        else:
            outcomes[True] += len(trace.t_s) == len(trace.block)
    assert sum(outcomes.values()) == len(cases(100, 30_000))
    assert min(outcomes.values()) > 0


@pytest.mark.deeper
@pytest.mark.parametrize("name", ["t_s", "block", "step_t_s", "step_x_um"])
def test_a_trace_with_an_array_of_another_kind_is_none(tmp_path: Path, name: str) -> None:
    run_into(tmp_path, parse_program(TEXT), plain_scenario(), silent, trace=True)
    arrays = dict(np.load(tmp_path / "trace.npz"))
    for other in (arrays[name][1:], arrays[name].astype(np.float32), arrays[name][:, None], arrays[name][0]):
        np.savez(tmp_path / "other.npz", **{**arrays, name: other})
        with pytest.raises(FileUnreadableError, match=r"other\.npz"):
            read_trace(tmp_path / "other.npz")


@pytest.mark.deeper
def test_a_trace_with_a_member_that_is_no_array_is_none(tmp_path: Path) -> None:
    run_into(tmp_path, parse_program(TEXT), plain_scenario(), silent, trace=True)
    with zipfile.ZipFile(tmp_path / "trace.npz") as was, zipfile.ZipFile(tmp_path / "other.npz", "w") as other:
        for name in was.namelist():
            other.writestr(name, was.read(name) if name != "t_s.npy" else b"no array")
    with pytest.raises(FileUnreadableError, match=r"other\.npz"):
        read_trace(tmp_path / "other.npz")


def test_a_refused_run_writes_nothing(tmp_path: Path) -> None:
    with pytest.raises(ProgramError):
        run_into(tmp_path / "new" / "out", parse_program("B0B0B1000000000000GXL1"), plain_scenario(), silent)
    assert list(tmp_path.iterdir()) == []


def test_a_run_that_breaks_leaves_the_last_one_whole(tmp_path: Path) -> None:
    run_into(tmp_path / "out", parse_program(TEXT), plain_scenario(), silent)
    before = digests(tmp_path / "out")

    def broken(stage: str, done: int, total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_into(tmp_path / "out", parse_program("B10B0B10GXL1"), plain_scenario(), broken)
    assert digests(tmp_path / "out") == before
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_other_files_of_the_folder_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine", "utf-8")
    run_into(tmp_path, parse_program("B10B0B10GXL1"), plain_scenario(), silent)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*NAMES, "mine.txt"])


def test_a_file_in_the_folders_place_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("", "utf-8")
    with pytest.raises(FileUnreadableError, match="is a file"), staged(tmp_path / "out", NAMES):
        pass


@pytest.mark.deeper
def test_a_folder_in_a_files_place_is_refused_before_anything_changes(tmp_path: Path) -> None:
    run_into(tmp_path, parse_program(TEXT), plain_scenario(), silent)
    (tmp_path / "report.json").unlink()
    (tmp_path / "report.json").mkdir()
    before = (tmp_path / "cut.png").read_bytes()
    with pytest.raises(FileUnreadableError, match=r"report\.json: is a folder"):
        run_into(tmp_path, parse_program("B10B0B10GXL1"), plain_scenario(), silent)
    assert (tmp_path / "cut.png").read_bytes() == before
    assert sorted(path.name for path in tmp_path.iterdir()) == NAMES


def test_folders_made_for_a_run_that_breaks_go_again(tmp_path: Path) -> None:
    def broken(stage: str, done: int, total: int) -> None:
        raise OSError(28, "No space left on device")

    with pytest.raises(FileUnreadableError, match="cannot be written: No space left"):
        run_into(tmp_path / "a" / "b", parse_program(TEXT), plain_scenario(), broken)
    assert list(tmp_path.iterdir()) == []


def test_output_goes_through_a_link(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    run_into(tmp_path / "link", parse_program("B10B0B10GXL1"), plain_scenario(), silent)
    assert sorted(path.name for path in (tmp_path / "real").iterdir()) == NAMES


def test_written_files_can_be_read_by_others(tmp_path: Path) -> None:
    """A staging folder is private; what is moved out of it must not be."""
    run_into(tmp_path / "out", parse_program("B10B0B10GXL1"), plain_scenario(), silent)
    umask = os.umask(0)
    os.umask(umask)
    for path in (tmp_path / "out").iterdir():
        assert path.stat().st_mode & 0o777 == 0o666 & ~umask, path.name


def test_report_is_json_without_nan(tmp_path: Path) -> None:
    run_into(tmp_path, parse_program("B5B5B0GXL1 B10B0B10GXL1 DD"), plain_scenario(), silent)

    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    report = json.loads((tmp_path / "report.json").read_text("utf-8"), parse_constant=refuse)
    assert report["blocks"][0]["stepped"]["max_deviation_um"] is None
    assert [block["block"] for block in report["blocks"]] == [1, 2]


STREAM = """
import re, sys
from pathlib import Path
from runs import plain_scenario, silent
from parser.program import parse_program
from sim.jobs.run_into import run_into
text = "B100B100B10000GXNR1" * 65  # 18 turns each
peak_kib = lambda: int(re.search(r"VmHWM:\\s+(\\d+) kB", Path("/proc/self/status").read_text())[1])
before = peak_kib()
run = run_into(Path(sys.argv[1]), parse_program(text), plain_scenario(), silent, trace=True)
print(len(run.stepped), peak_kib() - before)
"""


# VmHWM, since ru_maxrss begins with what the process had that started this one: a worker that ran many tests.
@pytest.mark.deeper
@pytest.mark.skipif(sys.platform != "linux", reason="Linux tells the peak of a process in /proc")
def test_steps_stream_in_memory_that_hardly_grows_with_them(tmp_path: Path) -> None:
    path = os.pathsep.join([str(ROOT / "tests" / "tools"), str(ROOT)])
    done = subprocess.run(
        [sys.executable, "-c", STREAM, str(tmp_path / "out")],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": path},
    )
    steps, more_kib = map(int, done.stdout.split())
    assert steps > 1_250_000
    # It takes 300 MB whatever the program is, and 12 bytes a step; this leaves 44 bytes a step.
    assert more_kib < 364_000
