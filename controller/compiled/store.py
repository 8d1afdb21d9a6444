"""Where machine code stays on disk: an entry each, sealed by its digest.

An entry that is cut off, damaged or of another machine counts as none; one that cannot be written is done without. So
no fault of the disk ends a command.
"""

import contextlib
import hashlib
import json
import os
import tempfile
from pathlib import Path
from typing import Any, Final

import platformdirs

from controller.compiled.machine_code import MachineCode, Shape, machine

_SEAL: Final = hashlib.sha256().digest_size
_LETTERS: Final = 16
"""Of the digest in the name of an entry."""
_LATEST: Final = 4
"""Entries of a loop that stay: of as many releases, or machines that share a home."""


def folder() -> Path:
    """The folder of the entries: that of the environment's ``NUMBA_CACHE_DIR``, or in the user's cache folder."""
    own = os.environ.get("NUMBA_CACHE_DIR")
    return Path(own) if own else Path(platformdirs.user_cache_dir("drycut", appauthor=False)) / "loops"


def stored(name: str, digest: str) -> MachineCode | None:
    """The machine code of a loop, by its name and the digest of its sources; None where there is none that is whole."""
    try:
        entry = _path(name, digest).read_bytes()
    except OSError:
        return None
    seal, rest = entry[:_SEAL], entry[_SEAL:]
    if hashlib.sha256(rest).digest() != seal:
        return None
    head, object_code = rest.split(b"\n", 1)
    symbol, takes, gives = json.loads(head)
    return MachineCode(symbol, tuple(map(_shape, takes)), _shape(gives), object_code)


def store(name: str, digest: str, code: MachineCode) -> None:
    """Keep the machine code of a loop, where that can be done."""
    head = json.dumps([code.symbol, code.takes, code.gives]).encode()
    rest = head + b"\n" + code.object_code
    with contextlib.suppress(OSError):
        path = _path(name, digest)
        path.parent.mkdir(parents=True, exist_ok=True)
        _write(path, hashlib.sha256(rest).digest() + rest)
        _clear(path.parent, name)


def _clear(entries_in: Path, name: str) -> None:
    """Remove the entries of a loop but for the latest: each change of its sources adds one."""
    entries = sorted(entries_in.glob(f"{name}-{'?' * _LETTERS}.loop"), key=lambda entry: entry.stat().st_mtime)
    for entry in entries[:-_LATEST]:
        entry.unlink(missing_ok=True)


def _write(path: Path, entry: bytes) -> None:
    """Write an entry whole: another process may read or write it meanwhile. OSError where that cannot be done."""
    number, draft = tempfile.mkstemp(dir=path.parent)
    try:
        with os.fdopen(number, "wb") as file:
            file.write(entry)
        Path(draft).replace(path)
    except OSError:
        with contextlib.suppress(OSError):
            Path(draft).unlink()
        raise


def _path(name: str, digest: str) -> Path:
    own = hashlib.sha256(f"{digest} {machine()}".encode()).hexdigest()[:_LETTERS]
    return folder() / f"{name}-{own}.loop"


def _shape(listed: Any) -> Shape:
    kind, name, dimensions, fields = listed
    return Shape(kind, name, dimensions, tuple(map(_shape, fields)))
