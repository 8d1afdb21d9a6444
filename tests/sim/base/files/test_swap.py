"""A set of files is swapped whole: for who reads it between any two steps, and where any step fails."""

import errno
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from unittest import mock

import pytest
from swaps import NAMES, NEW, OLD, before_each_call, found, left, memory_folder, without_links, write

from parser.findings.errors import FileUnreadableError
from sim.base.files import staged

LINKED, MOVED = "by links", "by moves"
needs_links = pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")


@pytest.fixture(params=[pytest.param(LINKED, marks=needs_links), MOVED])
def way(request: pytest.FixtureRequest) -> Iterator[str]:
    """Both ways of a swap; moves are those of a file system without links."""
    with without_links() if request.param == MOVED else nullcontext():
        yield request.param


@pytest.fixture
def in_memory() -> Iterator[Path]:
    """A folder for many swaps, where the system has a file system in memory."""
    with memory_folder() as folder:
        yield folder


def whole(folder: Path, way: str) -> bool:
    """Whether a reader finds one set alone; by moves some of its files may be missing for the moment."""
    texts = found(folder)
    if way == LINKED:
        return texts in (OLD, NEW)
    return texts.items() <= OLD.items() or texts.items() <= NEW.items()


def test_a_reader_finds_one_set_between_any_two_steps(tmp_path: Path, way: str) -> None:
    write(tmp_path, OLD)
    seen = []

    def told(number: int, call: str) -> None:
        assert whole(tmp_path, way), (number, call, found(tmp_path))
        seen.append(found(tmp_path))

    with before_each_call(told):
        write(tmp_path, NEW)
    assert (seen[0], found(tmp_path), left(tmp_path)) == (OLD, NEW, [])
    assert len(seen) > 20


def refused_from(first: int, last: int) -> AbstractContextManager[None]:
    """A system that refuses the calls with these numbers, as Windows does for a file that is open."""

    def told(number: int, call: str) -> None:
        if first <= number <= last:
            raise PermissionError(errno.EACCES, "The process cannot access the file")

    return before_each_call(told)


@pytest.mark.parametrize("times", [1, 1_000_000])
def test_whatever_step_fails_the_set_is_the_earlier_one_or_the_new_one(in_memory: Path, way: str, times: int) -> None:
    failed = 0
    for number in range(1, 100):
        folder = in_memory / str(number)
        write(folder, OLD)
        try:
            with refused_from(number, number + times - 1):
                write(folder, NEW)
        except FileUnreadableError:
            failed += 1
            assert whole(folder, way), (number, found(folder))
        else:
            assert found(folder) == NEW, number
        assert times > 1 or left(folder) == [], number
        try:
            with staged(folder, NAMES):
                raise KeyboardInterrupt
        except KeyboardInterrupt:
            assert found(folder) in (OLD, NEW), number
        assert left(folder) == [], number
        if number > failed + 20:
            break
    assert 10 < failed < 60


@needs_links
def test_a_file_that_cannot_be_replaced_keeps_the_others_as_they_were(tmp_path: Path) -> None:
    write(tmp_path, OLD)
    real = os.replace

    def busy(source: Path, target: Path) -> None:
        if target == tmp_path / "c.png":
            raise OSError(errno.EBUSY, "Device or resource busy", str(source), None, str(target))
        real(source, target)

    with mock.patch("os.replace", busy), pytest.raises(FileUnreadableError, match=r"c\.png: cannot be .*busy"):
        write(tmp_path, NEW)
    assert (found(tmp_path), left(tmp_path)) == (OLD, [])


@pytest.mark.skipif(
    sys.platform != "linux" or os.geteuid() != 0 or not shutil.which("chattr"),
    reason="chattr is of Linux, and for root",
)
def test_an_immutable_file_keeps_the_others_as_they_were(tmp_path: Path) -> None:
    write(tmp_path, OLD)
    chattr = str(shutil.which("chattr"))
    if subprocess.run([chattr, "+i", tmp_path / "b.json"], capture_output=True, check=False).returncode:
        pytest.skip("this file system has no immutable files")
    try:
        with pytest.raises(FileUnreadableError, match=r"b\.json: cannot be written: Operation not permitted"):
            write(tmp_path, NEW)
        assert (found(tmp_path), left(tmp_path)) == (OLD, [])
    finally:
        subprocess.run([chattr, "-i", tmp_path / "b.json"], check=True)


def test_a_folder_that_takes_a_files_name_during_the_run_is_refused(tmp_path: Path, way: str) -> None:
    write(tmp_path, OLD)
    swap = staged(tmp_path, NAMES)
    (swap.__enter__() / "a.html").write_text("new a")
    (tmp_path / "e.html").mkdir()
    with pytest.raises(FileUnreadableError, match=r"e\.html: is a folder"):
        swap.__exit__(None, None, None)
    (tmp_path / "e.html").rmdir()
    assert (found(tmp_path), left(tmp_path)) == (OLD, [])


@needs_links
def test_a_link_in_a_files_place_is_replaced_and_comes_back_where_a_step_fails(tmp_path: Path) -> None:
    folder, other = tmp_path / "out", tmp_path / "other.html"
    write(folder, OLD)
    other.write_text("mine")
    (folder / "a.html").unlink()
    (folder / "a.html").symlink_to("../other.html")
    with refused_from(7, 7), pytest.raises(FileUnreadableError):
        write(folder, NEW)
    assert found(folder) == OLD | {"a.html": "mine"}
    write(folder, NEW)
    assert (found(folder), left(folder), other.read_text()) == (NEW, [], "mine")


def test_earlier_files_come_back_as_they_were_where_a_step_fails(tmp_path: Path, way: str) -> None:
    write(tmp_path, OLD)
    before = {name: (tmp_path / name).stat() for name in OLD}
    with refused_from(16, 16), pytest.raises(FileUnreadableError):
        write(tmp_path, NEW)
    for name, was in before.items():
        now = (tmp_path / name).stat()
        assert (now.st_ino, now.st_mode, now.st_nlink, now.st_mtime_ns) == (
            was.st_ino,
            was.st_mode,
            1,
            was.st_mtime_ns,
        )


def test_one_file_is_replaced_by_one_rename(tmp_path: Path) -> None:
    calls = []
    with before_each_call(lambda number, call: calls.append(call)), staged(tmp_path, ["film.mp4"]) as stage:
        (stage / "film.mp4").write_text("film")
    assert [call for call in calls if call not in {"mkdir", "rmdir"}] == ["replace"]


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such modes")
def test_who_may_read_the_folder_may_read_its_files_during_a_swap(tmp_path: Path) -> None:
    """The names lead through the hidden folder then."""
    (tmp_path / "plain").mkdir()
    with staged(tmp_path, NAMES) as stage:
        assert stage.stat().st_mode == (tmp_path / "plain").stat().st_mode
