"""Sets of files that are swapped while somebody watches, fails or kills, and what a reader finds of them."""

import errno
import functools
import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from unittest import mock

from sim.base.files import staged

NAMES = ("a.html", "b.json", "c.png", "d.npz", "e.html")
OLD = {"a.html": "old a", "b.json": "old b", "c.png": "old c", "d.npz": "old d"}
NEW = {"a.html": "new a", "b.json": "new b", "c.png": "new c", "e.html": "new e"}
"""Has no d, and an e that there was not."""
CALLS = ("link", "mkdir", "rename", "replace", "rmdir", "symlink", "unlink")
"""What the system is asked to change names with; between two of these calls nothing changes."""


@contextmanager
def memory_folder() -> Iterator[Path]:
    """A folder in memory, where the system has one: swaps take a tenth of the time there."""
    memory = Path("/dev/shm")  # noqa: S108 - the folders in it have names of their own
    with tempfile.TemporaryDirectory(dir=memory if memory.is_dir() else None) as folder:
        yield Path(folder)


def write(folder: Path, files: dict[str, str]) -> None:
    """Write a set as a run does."""
    with staged(folder, NAMES) as stage:
        for name, text in files.items():
            (stage / name).write_text(text)


def found(folder: Path) -> dict[str, str]:
    """What a reader finds by the names, who opens each."""
    texts = {}
    for name in NAMES:
        try:
            texts[name] = (folder / name).read_text()
        except FileNotFoundError:
            continue
    return texts


def left(folder: Path) -> list[str]:
    """What is in a folder beside plain files."""
    return sorted(path.name for path in folder.iterdir() if path.is_symlink() or not path.is_file())


@contextmanager
def before_each_call(told: Callable[[int, str], None]) -> Iterator[None]:
    """Have `told` called with the number, from 1, and the name of each call that changes names, before it is made."""
    count = 0

    def watched(name: str, real: Callable[..., object], *args: object, **options: object) -> object:
        nonlocal count
        count += 1
        told(count, name)
        return real(*args, **options)

    with mock.patch.multiple(os, **{name: functools.partial(watched, name, getattr(os, name)) for name in CALLS}):
        yield


def without_links() -> AbstractContextManager[object]:
    """A file system that has no symbolic links."""
    return mock.patch("os.symlink", side_effect=PermissionError(errno.EPERM, "Operation not permitted"))
