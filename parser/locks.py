"""Locks on folders, which the system ends with the process that holds them, however that ends."""

import os
import sys
from pathlib import Path

if sys.platform == "win32":
    import msvcrt

    def _locked(folder: Path) -> int:
        """Windows opens no folder: a file in it stands for it, which goes when it is closed."""
        try:
            file = os.open(folder / ".drycut-lock", os.O_RDWR | os.O_CREAT | os.O_TEMPORARY)
        except PermissionError as error:  # another process is just closing it
            raise BlockingIOError(*error.args) from None
        try:
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        except OSError as error:
            os.close(file)
            raise BlockingIOError(*error.args) from None
        return file

else:
    import fcntl

    def _locked(folder: Path) -> int:
        file = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(file)
            raise
        return file


def take_lock(folder: Path) -> int:
    """Lock a folder; what `drop_lock` takes.

    BlockingIOError where another process has locked it, or this one has; another OSError where the folder is not there,
    or its file system knows no locks.
    """
    return _locked(folder)


def drop_lock(lock: int | None) -> None:
    """Unlock what `take_lock` locked; nothing where there is no lock."""
    if lock is not None:
        os.close(lock)
