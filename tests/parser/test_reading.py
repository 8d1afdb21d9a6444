"""The one door for files: only regular ones, only up to a limit, and nothing else of drycut reads any."""

import ast
import os
import re
import socket
import stat
import sys
from pathlib import Path

import pytest
from command import run_command, run_inside

from parser import files
from parser.files import (
    LIMIT_NAME,
    MOST_MB,
    limit_mb,
    read_bytes,
    read_text,
)
from parser.findings.errors import DrycutError, FileUnreadableError, SettingsError

ROOT = Path(__file__).parents[2]
SHIPPED = {
    *("parser/findings/catalogue.py", "sim/show/texts/texts.py", "sim/setup/key_words.py", "sim/setup/key_tables.py"),
    *("sim/show/html/environment.py", "sim/show/findings/catalogue_document.py", "sim/show/terminal/markdown.py"),
    *("parser/iso/profiles/profile.py", "parser/write/iso.py", "parser/drawing/dxf/document.py"),
    *("controller/compiled/loops.py", "sim/base/workers/maker.py"),  # our own modules
    "sim/check/own_checks.py",  # which distributions offer checks
    *("sim/serve/page/shortcut.py", "sim/show/draw/letters.py"),  # its icon, and how wide the letters of the font are
    *("controller/card/abi/table.py", "sim/clients/library.py"),  # C that libraries are made of
}
"""Modules that read files which drycut brings along, or its own documents."""
OWN = {
    *("sim/base/files/swap.py", "sim/base/files/stages.py", "sim/base/files/steps.py", "sim/run/recording.py"),
    *("sim/jobs/batch.py", "sim/jobs/batch.py", "sim/jobs/trace_file.py"),
    *("controller/compiled/entries.py", "sim/show/html/bytecode.py"),  # machine code and bytecode, sealed
    "sim/serve/page/recent.py",  # a list of our own
    "sim/show/terminal/streams.py",  # reopens closed streams on nothing
    *("sim/cli/lsp.py", "sim/serve/page/child.py"),  # hand a protocol, or a process of ours, its streams
    *(
        "sim/serve/page/drawings.py",
        "sim/serve/page/runs.py",
    ),  # what a process of ours found, and the files of a run
}
"""Modules that read what drycut wrote, or look whether a file is still what the door read."""
SQUARE = b"B9B0B9GXL1\nB0B9B9GYL2\nB9B0B9GXL3\nB0B9B9GYL4\nDD\n"
_MAY_READ = re.compile(r"read_text|read_bytes|open\(|stdin|np\.load|fromfile")
posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")


@pytest.mark.parametrize("limit", [None, "2", "0.5"])
def test_a_file_is_read_up_to_the_limit_and_not_a_byte_further(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: str | None
) -> None:
    if limit is not None:
        monkeypatch.setenv(LIMIT_NAME, limit)
    most = int(limit_mb() * 1e6)
    assert most == (MOST_MB * 1_000_000 if limit is None else float(limit) * 1e6)
    part = tmp_path / "part.3b"
    with part.open("wb") as file:
        file.truncate(most)  # sparse
    assert len(read_bytes(part)) == most
    with part.open("ab") as file:
        file.write(b"B")
    with pytest.raises(FileUnreadableError, match=rf"larger than the largest file .*\({LIMIT_NAME}=") as caught:
        read_bytes(part)
    assert caught.value.what == "file-too-large"


@pytest.mark.parametrize("told", ["0", "-1", "much", "nan", "inf", "1e9"])
def test_a_limit_that_is_none_is_refused(monkeypatch: pytest.MonkeyPatch, told: str) -> None:
    monkeypatch.setenv(LIMIT_NAME, told)
    with pytest.raises(SettingsError, match=LIMIT_NAME):
        limit_mb()


@posix
def test_what_is_no_regular_file_is_refused_without_being_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(os.path.relpath(tmp_path / "socket"))
        kinds = {"/dev/zero": "is-a-device", tmp_path: "is-a-folder", tmp_path / "pipe": "is-a-pipe"}
        for path, what in {**kinds, tmp_path / "socket": "is-a-socket"}.items():
            with pytest.raises(FileUnreadableError) as caught:
                read_bytes(Path(path))
            assert caught.value.what == what


@posix
def test_a_pipe_that_takes_the_place_of_a_file_is_not_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    os.mkfifo(tmp_path / "pipe")
    plain = os.stat_result((stat.S_IFREG, *[0] * 9))
    monkeypatch.setattr(Path, "stat", lambda self: plain)
    with pytest.raises(FileUnreadableError, match="pipe"):
        read_bytes(tmp_path / "pipe")


def test_a_file_that_grows_while_it_is_read_stays_below_the_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(LIMIT_NAME, "1")
    part = tmp_path / "part.3b"
    part.write_bytes(b" " * 2_000_000)
    empty = os.stat_result((stat.S_IFREG, *[0] * 9))  # as files of /proc are
    monkeypatch.setattr(files.os, "fstat", lambda descriptor: empty)
    with pytest.raises(FileUnreadableError, match="larger"):
        read_bytes(part)


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="Linux alone has these")
def test_a_file_of_proc_that_tells_no_size_is_read_whole() -> None:
    assert "[stack]" in read_text(Path("/proc/self/maps"))


@pytest.mark.parametrize("name", ["nowhere.3b", "a\0b.3b", "x" * 5000])
def test_what_cannot_be_opened_is_one_line_for_people(tmp_path: Path, name: str) -> None:
    with pytest.raises(DrycutError, match=r"cannot be read|no such file"):
        read_bytes(tmp_path / name)


@posix
def test_every_command_refuses_what_is_no_file(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_bytes(SQUARE)
    (tmp_path / "scenario").mkdir()
    device, part, toml = "/dev/null", tmp_path / "part.3b", tmp_path / "machine.toml"
    for link in (toml, tmp_path / "scenario" / "scenario.toml"):
        link.symlink_to(device)
    for command in (
        ("check", device),
        ("check", part, "--machine", toml),
        ("run", device),
        ("run", tmp_path / "scenario"),
        ("draw", device, "-o", tmp_path / "a.png"),
        ("replay", device, "-o", tmp_path / "a.gif"),
        ("compare", part, device),
        ("ballbar", "--machine", toml),
        ("card", "replay", device),
    ):
        done = run_inside(*command)
        assert done.returncode == 2, command
        assert b"this is a device, not a file" in done.stdout + done.stderr, command


def test_the_standard_input_ends_at_the_limit() -> None:
    done = run_command("check", "-", stdin=SQUARE * 10_000, **{LIMIT_NAME: "0.1"})
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"<stdin>: cannot be read: this is larger than the largest file" in done.stderr
    assert b"(DRYCUT_MAX_FILE_MB=0.1)" in done.stderr


def test_nothing_else_reads_files() -> None:
    found = set()
    for package in ("parser", "controller", "sim"):
        for file in (ROOT / package).rglob("*.py"):
            text = file.read_text("utf-8")
            if _MAY_READ.search(text) and any(_reads(node) for node in ast.walk(ast.parse(text))):
                found.add(file.relative_to(ROOT).as_posix())
    assert found == {*SHIPPED, *OWN, "parser/files.py"}


def _reads(node: ast.AST) -> bool:
    """Whether a node reads a file, or the standard input. The door itself is called by its name alone."""
    if isinstance(node, ast.Attribute):
        return node.attr in {"read_text", "read_bytes", "stdin", "load", "fromfile"} and (
            node.attr != "load" or ast.unparse(node) == "np.load"
        )
    if not isinstance(node, ast.Call) or not ast.unparse(node.func).endswith("open"):
        return False
    return ast.unparse(node.func) == "open" or any(
        isinstance(mode, ast.Constant) and str(mode.value).startswith("r") for mode in node.args
    )
