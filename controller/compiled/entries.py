"""Machine code of loops on disk: an entry each, sealed by its digest.

The package may bring entries of its own (`READY`), made where it was built; all others stay in a folder of the user's.
An entry that is cut off, damaged or of another system counts as none; one that cannot be written is done without. So no
fault of the disk ends a command.
"""

import contextlib
import hashlib
import json
import os
import platform
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import platformdirs

from controller.compiled.machine_code import MachineCode, Shape
from parser.locks import drop_lock, take_lock

READY: Final = Path(__file__).with_name("ready")
"""The folder of the package's own entries, in packages that have some."""
_SEAL: Final = hashlib.sha256().digest_size
_LETTERS: Final = 16
"""Of the digest in the name of an entry."""
_MOST_WAIT_S: Final = 60.0
"""The longest loop takes some 10 s to compile; who holds the folder for longer has been stopped."""
_PAUSE_S: Final = 0.02
_LATEST: Final = 4
"""Entries of a loop that stay: of as many releases, or systems that share a home."""


def folder() -> Path:
    """The folder of the user's entries: ``NUMBA_CACHE_DIR`` of the environment, or one in the user's cache folder."""
    own = os.environ.get("NUMBA_CACHE_DIR")
    return Path(own) if own else Path(platformdirs.user_cache_dir("drycut", appauthor=False)) / "loops"


def file_of(name: str, digest: str) -> str:
    """Name of the file of a loop's entry: code is of a system and an architecture."""
    own = hashlib.sha256(f"{digest} {sys.platform} {platform.machine()}".encode()).hexdigest()[:_LETTERS]
    return f"{name}-{own}.loop"


def stored(name: str, digest: str) -> MachineCode | None:
    """The machine code of a loop, by its name and the digest of its sources; None where there is none that is whole."""
    for entry in _entries(file_of(name, digest)):
        seal, rest = entry[:_SEAL], entry[_SEAL:]
        if hashlib.sha256(rest).digest() == seal:
            head, object_code = rest.split(b"\n", 1)
            symbol, takes, gives = json.loads(head)
            return MachineCode(symbol, tuple(map(_shape, takes)), _shape(gives), object_code)
    return None


def _entries(file: str) -> Iterator[bytes]:
    for entries_in in (READY, folder()):
        with contextlib.suppress(OSError):
            yield (entries_in / file).read_bytes()


def store(name: str, digest: str, code: MachineCode) -> None:
    """Keep the machine code of a loop, where that can be done."""
    head = json.dumps([code.symbol, code.takes, code.gives]).encode()
    rest = head + b"\n" + code.object_code
    with contextlib.suppress(OSError):
        path = folder() / file_of(name, digest)
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, hashlib.sha256(rest).digest() + rest)
        _clear(path.parent, name)


@contextlib.contextmanager
def alone() -> Iterator[None]:
    """Wait until no other process compiles, `_MOST_WAIT_S` at most: of many that start first at once one compiles.

    Nobody waits where the folder cannot be locked.
    """
    lock = _waited_for(folder())
    try:
        yield
    finally:
        drop_lock(lock)


def _waited_for(entries_in: Path) -> int | None:
    end_s = time.monotonic() + _MOST_WAIT_S
    with contextlib.suppress(OSError):
        entries_in.mkdir(parents=True, exist_ok=True)
    while time.monotonic() < end_s:
        try:
            return take_lock(entries_in)
        except BlockingIOError:
            time.sleep(_PAUSE_S)
        except OSError:
            break
    return None


def _clear(entries_in: Path, name: str) -> None:
    """Remove the entries of a loop but for the latest: each change of its sources adds one."""
    entries = sorted(entries_in.glob(f"{name}-{'?' * _LETTERS}.loop"), key=lambda entry: entry.stat().st_mtime)
    for entry in entries[:-_LATEST]:
        entry.unlink(missing_ok=True)


def write_whole(path: Path, entry: bytes) -> None:
    """Write an entry whole: another process may read or write it meanwhile. OSError where that cannot be done."""
    number, draft = tempfile.mkstemp(dir=path.parent, suffix=path.suffix)
    try:
        with os.fdopen(number, "wb") as file:
            file.write(entry)
        Path(draft).replace(path)
    except OSError:
        with contextlib.suppress(OSError):
            Path(draft).unlink()
        raise


def _shape(listed: Any) -> Shape:
    kind, name, dimensions, fields = listed
    return Shape(kind, name, dimensions, tuple(map(_shape, fields)))
