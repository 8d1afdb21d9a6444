"""The files that were opened last, by their paths, in a file of the user's: what an empty page offers again.

A file that was dropped on the page has no path that a server could know, so none of those is here. Each is read anew
when it is opened. No fault of the disk ends a command: what cannot be read counts as none, what cannot be written is
done without.
"""

import contextlib
import json
from pathlib import Path
from typing import Final

import platformdirs

from sim.base.files.stages import staged

_MOST: Final = 6
_LONGEST: Final = 100_000
"""Bytes of a list that is read: of so many paths none is longer."""


def _store() -> Path:
    return Path(platformdirs.user_state_dir("drycut", appauthor=False)) / "recent.json"


def recent() -> tuple[Path, ...]:
    """The files that are still there, the last one first."""
    try:
        with _store().open("rb") as stored:
            listed = json.loads(stored.read(_LONGEST))
        files = [Path(each) for each in listed if isinstance(each, str)] if isinstance(listed, list) else []
        return tuple(file for file in files if file.is_absolute() and file.is_file())[:_MOST]
    except (OSError, ValueError, RecursionError):
        return ()


def remember(file: Path) -> None:
    """Put a file first in the list."""
    path = file.absolute()
    files = [path, *(other for other in recent() if other != path)][:_MOST]
    with contextlib.suppress(OSError, ValueError):  # a name that is no text is not remembered
        data = json.dumps([str(each) for each in files], ensure_ascii=False).encode("utf-8")
        store = _store()
        with staged(store.parent, [store.name]) as stage:
            (stage / store.name).write_bytes(data)
