"""Stages: hidden folders in which files are made, beside where they are to stand; what dead runs left is cleared.

Output files of a run: made aside and put in their folder as one set, or not at all.

A file of the user's with new content: whole or not at all, and with all else as it was.
"""

import errno
import os
import re
import secrets
import shutil
import stat
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from parser.findings.errors import FileUnreadableError, Message, system_message
from parser.locks import drop_lock, take_lock
from sim.base.files.swap import finish, swap

MOST_WAIT_S = 30.0
"""A swap takes milliseconds; who holds a folder for longer has been stopped."""
_PAUSE_S = 0.002


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Wait until no other run changes files of a folder, and keep others waiting as long as the context lasts.

    Where the file system knows no locks, nobody waits. FileUnreadableError where another run holds the folder for
    longer than `MOST_WAIT_S`.
    """
    lock = _waited_for(folder)
    try:
        yield
    finally:
        drop_lock(lock)


def _waited_for(folder: Path) -> int | None:
    end_s = time.monotonic() + MOST_WAIT_S
    while True:
        try:
            return take_lock(folder)
        except BlockingIOError:
            if time.monotonic() > end_s:
                raise FileUnreadableError("folder-locked", folder=folder, seconds=MOST_WAIT_S) from None
        except OSError:
            return None
        time.sleep(_PAUSE_S)


_NAME = re.compile(r"\.drycut-[0-9a-f]{16}")


@contextmanager
def stage_in(folder: Path) -> Iterator[Path]:
    """A new and empty stage in a folder, locked as long as its run lives.

    At the end it is closed (`close`). It lies in the folder itself, so that files move within one file system, and may
    be read by who may read that one: while a swap is under way its files are shown. FileUnreadableError where it cannot
    be made.
    """
    stage = folder / f".drycut-{secrets.token_hex(8)}"
    lock = None
    try:
        with alone_in(folder):  # else a run that clears up could meet it before it is locked
            _make(stage)
            with suppress(OSError):  # a file system without locks
                lock = take_lock(stage)
        yield stage
    finally:
        drop_lock(lock)
        close(stage, folder)


def _make(stage: Path) -> None:
    try:
        stage.mkdir()
    except OSError as error:
        raise FileUnreadableError("cannot-be-written", file=stage.parent, why=system_message(error)) from None


@contextmanager
def scratch() -> Iterator[Path]:
    """A folder for files that a run needs itself until it ends, among the temporary ones of the system.

    Other users may not look into it. FileUnreadableError where it cannot be made.
    """
    temporary = Path(tempfile.gettempdir())
    clear_once(temporary)
    with stage_in(temporary) as stage:
        stage.chmod(0o700)
        yield stage


def close(stage: Path, folder: Path) -> None:
    """Finish a swap from a stage, and remove the stage; nothing where it is gone already.

    Raises FileUnreadableError where files of the folder are still in the stage and cannot be put back.
    """
    if not os.path.lexists(stage):
        return
    try:
        finish(stage, folder)
    except OSError as error:
        raise FileUnreadableError(
            "files-left-in-stage", folder=folder, stage=stage.name, why=system_message(error)
        ) from None
    shutil.rmtree(stage, ignore_errors=True)


def clear(folder: Path) -> None:
    """Close the stages of dead runs of this user in a folder, in which nothing else may happen (`alone_in`).

    Where the file system knows no locks, nobody can tell that a run is dead: its stage stays.
    """
    try:
        names = os.listdir(folder)  # noqa: PTH208 - names alone, of what may be many files
    except PermissionError:  # one may write into a folder that one may not list
        return
    for name in filter(_NAME.fullmatch, names):
        stage = folder / name
        with suppress(FileNotFoundError):  # its own run has just removed it
            if _is_of_another(stage):
                continue
            try:
                lock = take_lock(stage)
            except OSError:
                continue
            drop_lock(lock)
            close(stage, folder)


@cache
def clear_once(folder: Path) -> None:
    """`clear`, the first time that this process asks for it: many files of one folder are mended one by one."""
    with alone_in(folder):
        clear(folder)


def _is_of_another(stage: Path) -> bool:
    """Whether a stage is another user's, who is the one to clear it: what it asks for is not done in our name."""
    return hasattr(os, "geteuid") and stage.lstat().st_uid != os.geteuid()


@contextmanager
def staged(target: Path, names: Sequence[str]) -> Iterator[Path]:
    """Empty folder whose files `names` are put in `target` at the end of a block that raised nothing.

    They come as one set: at every moment, and after a kill at any moment, the names in `target` show the files that
    were there before, or the new ones, never some of each (docs/report.md says how, and what Windows lacks). What the
    block did not make is not there afterwards either: no file of an earlier run stands beside those of this. Where the
    block raises, or one of the names cannot be replaced, all is as it was, and folders made for it are gone. What runs
    that were killed have left in `target` is cleared away. FileUnreadableError where the target is no folder or cannot
    be written.
    """
    try:
        made = _make_folders(target)
        with _removed_on_error(made), stage_in(target) as stage:
            with alone_in(target):
                clear(target)
            _refuse_other_than_files(target, names)
            yield stage
            with alone_in(target):
                clear(target)
                _refuse_other_than_files(target, names)
                try:
                    swap(stage, target, names)
                finally:
                    close(stage, target)
    except FileUnreadableError:
        raise
    except OSError as error:
        raise FileUnreadableError("cannot-be-written", file=_named(error, target), why=system_message(error)) from None


def _named(error: OSError, target: Path) -> Path:
    """The file of the target folder that an error is about, or that folder."""
    named = (Path(name) for name in (error.filename, error.filename2) if isinstance(name, str | Path))
    return next((path for path in named if path.parent == target), target)


def _refuse_other_than_files(target: Path, names: Sequence[str]) -> None:
    """FileUnreadableError where a folder, a device or a pipe has the name of a file that is to be written."""
    for path in (target / name for name in names):
        try:
            mode = path.stat().st_mode
        except OSError:  # nothing is there, or a link that leads nowhere
            continue
        if not stat.S_ISREG(mode):
            kind = Message("a-folder" if stat.S_ISDIR(mode) else "no-plain-file")
            raise FileUnreadableError("is-no-file-to-replace", path=path, kind=kind)


def _make_folders(target: Path) -> list[Path]:
    """Make a folder with its parents; those that were missing, innermost first."""
    if target.exists() and not target.is_dir():
        raise FileUnreadableError("is-a-file-not-a-folder", path=target)
    missing = [folder for folder in (target, *target.parents) if not folder.exists()]
    with _removed_on_error(missing):
        target.mkdir(parents=True, exist_ok=True)
    return missing


@contextmanager
def _removed_on_error(folders: list[Path]) -> Iterator[None]:
    try:
        yield
    except BaseException:
        for folder in folders:
            with suppress(OSError):
                folder.rmdir()
        raise


def replace_file(path: Path, before: bytes, after: bytes) -> None:
    """Put `after` in place of a file's content, whole or not at all, a power cut included; a link is followed.

    Owner, group, mode and, on Linux, extended attributes with access lists stay. Raises FileUnreadableError, and
    changes nothing, where they cannot, where the file is no longer as it was read (`before`), where it has a second
    name (a hard link), which would keep that content, where it is read-only, and where it or its folder cannot be
    written.
    """
    target = path.resolve()
    try:
        clear_once(target.parent)
        was = target.stat()
        _refuse(path, target, was)
        with stage_in(target.parent) as stage:
            made = stage / "mended"
            with os.fdopen(os.open(made, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
                file.write(after)
                file.flush()
                os.fsync(file.fileno())  # else a power cut may leave an empty file under the name of a program
            _keep_owner(path, made, was)
            _keep_attributes(path, made, target)
            made.chmod(stat.S_IMODE(was.st_mode))
            if target.read_bytes() != before:
                raise FileUnreadableError("has-changed-since-read", path=path)
            made.replace(target)
    except FileUnreadableError:
        raise
    except OSError as error:
        raise FileUnreadableError("cannot-be-written", file=path, why=system_message(error)) from None


def _refuse(path: Path, target: Path, was: os.stat_result) -> None:
    """FileUnreadableError where a file may not be replaced."""
    if was.st_nlink > 1:
        raise FileUnreadableError("has-hard-links", path=path, names=was.st_nlink)
    # Root may write all files; one that nobody may write is still not meant to change.
    if not was.st_mode & 0o222 or not _may(target, os.W_OK):
        raise FileUnreadableError("is-read-only", path=path)
    if not _may(target.parent, os.W_OK | os.X_OK):
        raise FileUnreadableError("folder-takes-no-file", path=path)


def _may(path: Path, what: int) -> bool:
    return os.access(path, what, effective_ids=os.access in os.supports_effective_ids)


def _keep_owner(path: Path, made: Path, was: os.stat_result) -> None:
    """Give a file the owner and the group of another; FileUnreadableError where the system forbids it."""
    if sys.platform == "win32":
        return
    own = made.stat()
    try:
        if (own.st_uid, own.st_gid) != (was.st_uid, was.st_gid):
            os.chown(made, was.st_uid, was.st_gid)
    except OSError:
        raise FileUnreadableError("belongs-to-another-user", path=path) from None


def _keep_attributes(path: Path, made: Path, target: Path) -> None:
    """Give a file the extended attributes of another, among them its access list, and no more.

    FileUnreadableError where the system forbids it. Only Linux lets Python at them.
    """
    if sys.platform != "linux":
        return
    wanted, own = _attributes(target), _attributes(made)
    try:
        for name in own.keys() - wanted.keys():
            os.removexattr(made, name)
        for name, value in wanted.items():
            if own.get(name) != value:
                os.setxattr(made, name, value)
    except OSError as error:
        raise FileUnreadableError(
            "attributes-cannot-be-kept", path=path, names=", ".join(sorted(wanted)), why=system_message(error)
        ) from None


if sys.platform == "linux":

    def _attributes(path: Path) -> dict[str, bytes]:
        """Extended attributes by name; none where the file system has none."""
        try:
            return {name: os.getxattr(path, name) for name in os.listxattr(path)}
        except OSError as error:
            if error.errno == errno.ENOTSUP:
                return {}
            raise
