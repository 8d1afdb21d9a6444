"""Which files a check is to look at."""

import glob
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from parser.findings.errors import FileUnreadableError
from parser.program import suffixes


def find_files(names: Sequence[str]) -> list[str]:
    """Files of the names: files themselves, all programs in folders and below, and what globs match.

    Each once, as it was first spelled. A folder or a link that cannot be read is among them, so that reading it tells.
    Raises FileUnreadableError for a name that leads to no file.
    """
    found: dict[str, str] = {}
    for name in names:
        files = list(_files(name))
        if not files:
            raise FileUnreadableError(f"{name}: no program there; expected files that end in {' or '.join(suffixes())}")
        for file in files:
            found.setdefault(file if file == "-" else os.path.realpath(file), file)
    return list(found.values())


def _files(name: str) -> Iterator[str]:
    path = Path(name)
    if name == "-" or path.is_file():
        yield name
    elif path.is_dir():
        yield from sorted(_below(path))
    elif glob.has_magic(name):
        for match in sorted(glob.glob(name, recursive=True)):  # noqa: PTH207 - Path.glob refuses absolute patterns
            yield from _files(match)
    else:
        yield name  # whatever keeps it from being read is said when it is read


def _below(folder: Path) -> Iterator[str]:
    """Programs in a folder and below, by the ends of their names in any case.

    With broken links that are named like one, and folders that cannot be listed.
    """
    shut: list[str] = []
    ends = suffixes()
    for here, _, names in os.walk(folder, onerror=lambda error: shut.append(str(error.filename))):
        for file in (Path(here) / name for name in names if name.lower().endswith(ends)):
            if file.is_file() or (file.is_symlink() and not file.exists()):
                yield str(file)
    yield from shut
