"""The one door by which drycut reads what users give it: files and the standard input, up to a limit."""

import os
import stat
import sys
from pathlib import Path
from typing import BinaryIO

from parser.findings.errors import FileUnreadableError, SettingsError
from parser.findings.messages import system_message

MOST_MB = 64
"""Size of a file that is read, MB of 10^6 bytes: 3B of two million blocks, DXF of some hundred thousand entities."""
LIMIT_NAME = "DRYCUT_MAX_FILE_MB"
"""Environment variable that sets another limit, in MB."""

_BYTES_PER_MB = 1_000_000
_HIGHEST_MB = 1_000_000
_CHUNK = 1 << 20  # a file may grow while it is read, and files of /proc tell no size
# A pipe must not be waited for. Not every system knows all of these.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)
_KINDS = {
    stat.S_IFDIR: "is-a-folder",
    stat.S_IFIFO: "is-a-pipe",
    stat.S_IFSOCK: "is-a-socket",
    stat.S_IFCHR: "is-a-device",
    stat.S_IFBLK: "is-a-device",
}


def read_bytes(path: Path) -> bytes:
    """Bytes of a regular file of no more than the limit.

    Raises FileUnreadableError for any other file, without reading it, and where it cannot be opened.
    """
    try:
        _refuse_other_than_file(path, path.stat())  # before it is opened: that alone makes some devices do something
        with os.fdopen(os.open(path, _FLAGS), "rb") as file:
            found = os.fstat(file.fileno())
            _refuse_other_than_file(path, found)
            return _up_to_limit(path, file, found.st_size)
    except FileUnreadableError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise FileUnreadableError("cannot-be-read", file=path, why=system_message(error)) from None


def read_text(path: Path) -> str:
    """Text of a file in UTF-8, line ends as they are. As `read_bytes`; UnicodeDecodeError where it is no such text."""
    return read_bytes(path).decode("utf-8")


def read_stdin() -> bytes:
    """All of the standard input. FileUnreadableError where it is closed, or longer than the limit."""
    if sys.stdin is None:
        raise FileUnreadableError("stdin-closed")
    return _up_to_limit("<stdin>", sys.stdin.buffer, 0)


def limit_mb() -> float:
    """Limit on the size of a file, MB. SettingsError where the environment gives one that is none."""
    setting = os.environ.get(LIMIT_NAME, "")
    if not setting:
        return MOST_MB
    try:
        limit = float(setting)
    except ValueError:
        limit = 0.0
    if not 0.0 < limit <= _HIGHEST_MB:
        raise SettingsError("size-limit-no-number", name=LIMIT_NAME, most_mb=_HIGHEST_MB, found=setting)
    return limit


def _refuse_other_than_file(path: Path, found: os.stat_result) -> None:
    if not stat.S_ISREG(found.st_mode):
        raise _refused(path, _KINDS.get(stat.S_IFMT(found.st_mode), "is-a-device"))


def _up_to_limit(name: Path | str, file: BinaryIO, told_size: int) -> bytes:
    limit = int(limit_mb() * _BYTES_PER_MB)
    parts, left = [], limit + 1
    while told_size <= limit and left and (part := file.read(min(left, _CHUNK))):
        parts.append(part)
        left -= len(part)
    if told_size > limit or not left:
        raise _refused(name, "file-too-large", f"{LIMIT_NAME}={limit_mb():g}")
    return b"".join(parts)


def _refused(name: Path | str, what: str, detail: str = "") -> FileUnreadableError:
    return FileUnreadableError("cannot-be-read-since", file=name, what=what, detail=detail)
