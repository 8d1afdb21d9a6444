"""``drycut check --diff``: what ``patch`` and ``git apply`` make of it is what ``--fix`` writes, to the byte."""

import os
import random
import shutil
import subprocess
from itertools import product
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS
from command import run_inside

from sim.cli.check.mends import for_tools

ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "gb18030")
TOOLS = {"patch": ["patch", "-p0", "-s", "-i"], "git": ["git", "apply", "-p0"]}
NAMES = ["part.3b", "deep/a b.3b", "零件.4b", 'q"uote.3b', "back\\slash.3b", "tab\tname.3b", "-dash.3b", "a -> b.3b"]
FAULTS = (
    "//起点",
    "N1: B9900B0B9900GXL4//切入",
    *("//中间",) * 9,
    "N2: B9900B0B39600GXNR1",
    "",
    "N3: B9900B0B9900GXL3",
)

needs_tools = pytest.mark.skipif(
    not all(shutil.which(command) for command, *_ in TOOLS.values()), reason="there is no patch, or no git"
)


def applied(tool: str, patch: Path, cwd: Path) -> None:
    # Else git looks for a repository around the folder, and leaves files alone that it thinks elsewhere.
    environment = {**os.environ, "GIT_CEILING_DIRECTORIES": str(cwd.parent)}
    done = subprocess.run([*TOOLS[tool], str(patch)], cwd=cwd, env=environment, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.deeper
@needs_tools
def test_tools_make_of_the_diff_what_fix_writes(tmp_path: Path) -> None:
    folder = tmp_path / "shown"
    folder.mkdir()
    tails = {"\n": "", "\r\n": "\r\nDD", "\r": "\r//完\r\x1a\0\0"}
    for number, (encoding, end) in enumerate(product(ENCODINGS, tails)):
        tail = tails[end] if number % 2 else f"{end}DD{end}"
        (folder / f"{number:02}.3b").write_bytes((end.join(FAULTS) + tail).encode(encoding))
    for name in ("fixed", *TOOLS):
        shutil.copytree(folder, tmp_path / name)
    diff = run_inside("check", ".", "--diff", cwd=folder)
    assert (diff.returncode, diff.stderr) == (1, b"")
    assert diff.stdout.count(b"\n+++ ") == 12
    (tmp_path / "mend.patch").write_bytes(diff.stdout)
    run_inside("check", ".", "--fix", cwd=tmp_path / "fixed")
    for tool in TOOLS:
        applied(tool, tmp_path / "mend.patch", tmp_path / tool)
        for path in (tmp_path / tool).iterdir():
            assert path.read_bytes() == (tmp_path / "fixed" / path.name).read_bytes(), path.name


@needs_tools
@pytest.mark.parametrize("tool", TOOLS)
def test_tools_find_the_files_by_their_names(tmp_path: Path, tool: str) -> None:
    folder = tmp_path / "programs"
    for name in NAMES:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(WRONG_AXIS, "ascii")
    options = ("./part.3b", folder, "--diff", "--output-file", "../new/mend.patch")  # by full names, but for one
    done = run_inside("check", *options, cwd=folder)
    assert (done.returncode, done.stdout, done.stderr) == (1, b"", b"")
    applied(tool, tmp_path / "new" / "mend.patch", folder)
    assert {(folder / name).read_text("ascii") for name in NAMES} == {SOUND}


@needs_tools
@pytest.mark.parametrize("tool", TOOLS)
def test_any_two_contents_are_told_apart_as_the_tools_read_it(tmp_path: Path, tool: str) -> None:
    drawn = random.Random(17)
    pairs: list[tuple[bytes, bytes]] = []
    for _ in range(40):
        lines = [drawn.choice([b"a", b"b\r", b"\0", b"", b"B1"]) for _ in range(drawn.randrange(2, 40))]
        other = [line if drawn.random() < 0.8 else line + b"!" for line in lines]
        cut = drawn.randrange(len(lines))
        other[cut:cut] = [b"DD"] * drawn.randrange(-1, 2)
        pairs.append((b"\n".join(lines) + b"x", b"\n".join(other) + drawn.choice([b"\n", b"y"])))
    (tmp_path / "files").mkdir()
    with (tmp_path / "mend.patch").open("wb") as patch:
        for number, (before, after) in enumerate(pairs):
            (tmp_path / "files" / f"{number}").write_bytes(before)
            patch.write(for_tools(f"{number}", before, after))
    applied(tool, tmp_path / "mend.patch", tmp_path / "files")
    for number, (_, after) in enumerate(pairs):
        assert (tmp_path / "files" / f"{number}").read_bytes() == after


def test_nothing_is_written_and_the_exit_code_tells_whether_something_would_be(tmp_path: Path) -> None:
    for name, content in {"sound.3b": SOUND, "wrong.3b": WRONG_AXIS, "none.3b": "hello"}.items():
        (tmp_path / name).write_text(content, "ascii")
        os.utime(tmp_path / name, (1e9, 1e9))
    codes = {name: run_inside("check", name, "--diff", cwd=tmp_path) for name in ("sound.3b", "wrong.3b", "none.3b")}
    assert [done.returncode for done in codes.values()] == [0, 1, 2]
    assert codes["sound.3b"].stdout == codes["none.3b"].stdout == b""
    assert codes["wrong.3b"].stdout.startswith(
        b"--- wrong.3b\n+++ wrong.3b\n@@ -1,4 +1,4 @@\n B9900B0B9900GXL1\n-B9900"
    )
    assert b"none.3b: error[3B100]" in codes["none.3b"].stderr
    everything = run_inside("check", ".", "gone.3b", "--diff", cwd=tmp_path)
    assert (everything.returncode, everything.stdout) == (2, codes["wrong.3b"].stdout)
    assert b"gone.3b: cannot be read" in everything.stderr
    assert run_inside("check", "wrong.3b", "--diff", "--ignore", "3B204", cwd=tmp_path).returncode == 0
    assert {path.stat().st_mtime for path in tmp_path.iterdir()} == {1e9}


def test_what_is_left_to_a_person_is_told_beside_the_diff(tmp_path: Path) -> None:
    open_contour = "B10000B0B10000GXL1\nB0B10000B10000GYL2\nB10000B0B10000GXL1\nB0B10000B10000GYL4\n"
    (tmp_path / "open.3b").write_text(open_contour, "ascii")
    done = run_inside("check", "open.3b", "--diff", cwd=tmp_path)
    assert b"+DD" in done.stdout
    assert b"3B301 is left as it is; more than one mend is possible" in done.stderr


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (["--diff", "--fix"], "--fix and --diff cannot be done in one run"),
        (["--diff", "--format", "json"], "--format has no place beside it"),
        (["--diff", "-"], "--diff shows mends of files"),
        (["--diff", "-o", "part.3b"], "part.3b: is one of the programs"),
    ],
)
def test_options_that_contradict_diff_are_bad_use(tmp_path: Path, options: list[str], complaint: str) -> None:
    (tmp_path / "part.3b").write_text(WRONG_AXIS, "ascii")
    done = run_inside("check", "part.3b", *options, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    assert complaint in done.stderr.decode()
    assert (tmp_path / "part.3b").read_text("ascii") == WRONG_AXIS


def test_a_file_that_cannot_be_read_is_said_once(tmp_path: Path) -> None:
    done = run_inside("check", "none.3b", "--diff", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr == b"drycut: error: none.3b: cannot be read: No such file or directory\n"
