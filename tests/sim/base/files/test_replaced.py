"""A program that is mended keeps all but its content, or stays as it is, and is never half of one."""

import os
import stat
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from command import run_inside
from swaps import before_each_call

from parser.findings.errors import FileUnreadableError
from sim.base.files import replace_file

NOBODY = 65534
WRONG = "B9900B0B9900GXL4\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n"
posix = pytest.mark.skipif(os.name == "nt", reason="Windows has neither such owners nor such modes")
linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux lets Python at them")
root = pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root gives files away")


@pytest.fixture
def part() -> Iterator[Path]:
    """A program in a folder that all users come to."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        path = Path(folder) / "part.3b"
        path.write_bytes(b"old")
        yield path


@contextmanager
def as_nobody() -> Iterator[None]:
    os.setegid(NOBODY)
    os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(0)
        os.setegid(0)


def refused(path: Path, why: str) -> None:
    """A file that cannot be mended is as it was, alone in its folder, and people are told why."""
    before = path.stat()
    with pytest.raises(FileUnreadableError, match=rf"part\.3b: cannot be written: .*{why}"):
        replace_file(path, b"old", b"new")
    after = path.stat()
    assert path.read_bytes() == b"old"
    assert (after.st_ino, after.st_mode, after.st_uid, after.st_mtime_ns) == (
        before.st_ino,
        before.st_mode,
        before.st_uid,
        before.st_mtime_ns,
    )
    assert not list(path.parent.glob(".drycut*"))


@posix
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o644, 0o666, 0o755, 0o2755])
def test_the_mode_stays(part: Path, mode: int) -> None:
    part.chmod(mode)
    replace_file(part, b"old", b"new")
    assert (part.read_bytes(), stat.S_IMODE(part.stat().st_mode)) == (b"new", mode)


@root
def test_the_owner_stays_where_the_system_allows_it(part: Path) -> None:
    os.chown(part, 12345, 23456)
    part.chmod(0o2640)
    replace_file(part, b"old", b"new")
    kept = part.stat()
    assert (kept.st_uid, kept.st_gid, stat.S_IMODE(kept.st_mode), part.read_bytes()) == (12345, 23456, 0o2640, b"new")


@root
@pytest.mark.parametrize(("owner", "group"), [(12345, NOBODY), (NOBODY, 12345)])
def test_a_file_whose_owner_would_change_is_left(part: Path, owner: int, group: int) -> None:
    os.chown(part, owner, group)
    part.chmod(0o666)
    part.parent.chmod(0o777)
    with as_nobody():
        refused(part, "it belongs to another user or group, and would then be yours")


@root
def test_a_file_that_one_may_not_write_is_left(part: Path) -> None:
    part.parent.chmod(0o777)
    with as_nobody():
        refused(part, "it is read-only")


@root
def test_a_file_in_a_folder_that_one_may_not_write_is_left(part: Path) -> None:
    os.chown(part, NOBODY, NOBODY)
    with as_nobody():
        refused(part, "nothing may be added to its folder")


def test_a_read_only_file_is_left_even_by_root(part: Path) -> None:
    part.chmod(0o444)
    refused(part, "it is read-only")
    part.chmod(0o644)


def test_a_file_with_a_second_name_is_left(part: Path) -> None:
    (part.parent / "second.3b").hardlink_to(part)
    refused(part, r"it has 2 names \(hard links\)")
    assert (part.parent / "second.3b").samefile(part)


@posix
def test_a_link_is_followed_and_stays(part: Path) -> None:
    link = part.parent / "link.3b"
    link.symlink_to("part.3b")
    replace_file(link, b"old", b"new")
    assert (link.is_symlink(), part.is_symlink(), part.read_bytes()) == (True, False, b"new")


@linux
def test_attributes_stay_and_none_come(part: Path) -> None:
    try:
        os.setxattr(part, "user.machine", b"dk7740")
    except OSError:
        pytest.skip("this file system has no attributes")
    replace_file(part, b"old", b"new")
    assert {name: os.getxattr(part, name) for name in os.listxattr(part)} == {"user.machine": b"dk7740"}


ACL = bytes.fromhex("02000000 01000600ffffffff 0200040039300000 04000400ffffffff 10000600ffffffff 20000400ffffffff")
"""An access list: owner rw, user 12345 r, group r, mask rw, others r."""


@linux
@pytest.mark.parametrize("of_folder", [False, True], ids=["of the file", "that its folder gives to new files"])
def test_the_access_list_stays(part: Path, of_folder: bool) -> None:
    try:
        os.setxattr(part.parent if of_folder else part, f"system.posix_acl_{'default' if of_folder else 'access'}", ACL)
    except OSError:
        pytest.skip("this file system has no access lists")
    before = part.stat().st_mode
    replace_file(part, b"old", b"new")
    kept = {name: os.getxattr(part, name) for name in os.listxattr(part)}
    assert kept == ({} if of_folder else {"system.posix_acl_access": ACL})
    assert part.stat().st_mode == before


@linux
def test_a_file_whose_attributes_cannot_stay_is_left(part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def lacking(*_: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "listxattr", lambda path: ["security.own"] if path == part else [])
    monkeypatch.setattr(os, "getxattr", lambda path, name: b"secret")
    monkeypatch.setattr(os, "setxattr", lacking)
    refused(part, r"its attributes \(security\.own\) cannot be kept: Operation not permitted")


def test_a_file_that_was_saved_anew_since_it_was_read_is_left(part: Path) -> None:
    with pytest.raises(FileUnreadableError, match="it has changed since it was read"):
        replace_file(part, b"as it was read", b"new")
    assert [(path.name, path.read_bytes()) for path in part.parent.iterdir()] == [("part.3b", b"old")]


def test_whatever_step_fails_the_file_is_whole(part: Path) -> None:
    failed = 0
    for number in range(1, 30):

        def told(step: int, call: str, at: int = number) -> None:
            if step == at:
                raise OSError(28, "No space left on device")

        part.write_bytes(b"old")
        try:
            with before_each_call(told):
                replace_file(part, b"old", b"new")
        except FileUnreadableError:
            failed += 1
            assert [(path.name, path.read_bytes()) for path in part.parent.iterdir()] == [("part.3b", b"old")]
    assert failed == 2


@posix
def test_a_mend_tells_why_it_leaves_a_file_and_goes_on(part: Path) -> None:
    other = part.parent / "also.3b"
    for path in (part, other):
        path.write_text(WRONG)
    part.chmod(0o444)
    done = run_inside("check", part.parent, "--fix")
    assert done.returncode == 2
    assert f"{part}: cannot be written: it is read-only" in done.stderr.decode()
    assert (part.read_text(), other.read_text()) == (WRONG, WRONG.replace("L4", "L1"))
