"""Stages: hidden folders in which files are made, beside where they are to stand; what dead runs left is cleared."""

import os
import re
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from parser.findings.errors import FileUnreadableError
from parser.findings.messages import system_message
from sim.base.files.locks import alone_in, drop_lock, take_lock
from sim.base.files.swap import finish

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
