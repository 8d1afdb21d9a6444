"""Which files a check is to look at."""

import glob
import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from parser.findings.errors import FileUnreadableError, Message
from parser.program import suffixes

STORED: Final = "drycut-check.json"
"""File of results (`sim.check.stored`), which is no program wherever it stands."""


def _none(_: Path) -> bool:
    return False


class FileFilter(NamedTuple):
    """Which files of folders count.

    Attributes
    ----------
    is_excluded
        Files and folders that are left out.
    is_included
        Files that count though their names do not end as those of programs do.
    ends
        A file counts whose ``/NAME`` ends in one of these, in any case; those of all dialects where it is empty.
    """

    is_excluded: Callable[[Path], bool] = _none
    is_included: Callable[[Path], bool] = _none
    ends: tuple[str, ...] = ()

    def has(self, path: Path) -> bool:
        """Whether a file counts by its name."""
        return f"/{path.name}".lower().endswith(self.ends or suffixes()) or self.is_included(path)


class Found(NamedTuple):
    """Files that names lead to, and the names of files in their folders that do not count."""

    files: list[str]
    passed_over: list[str]


def find_files(names: Sequence[str], file_filter: FileFilter = FileFilter()) -> Found:  # noqa: B008 - frozen
    """Files of the names: files themselves, all programs in folders and below, and what globs match.

    Files and folders that are excluded are left out, unless they are named themselves. Each file stands there once, as
    it was first spelled. A folder or a link that cannot be read is among them, so that reading it tells. Hidden files
    and folders that are excluded are not passed over: nobody takes them for programs. Raises FileUnreadableError for a
    name that leads to no file.
    """
    found: dict[str, str] = {}
    passed_over: dict[str, None] = {}
    for name in names:
        looked = _Looked(file_filter)
        files = list(looked.files(name))
        if not files:
            raise FileUnreadableError(
                Message("all-programs-excluded", name=name)
                if looked.left_out
                else Message("no-program-there", name=name, suffixes=" or ".join(suffixes()))
            )
        for file in files:
            found.setdefault(file if file == "-" else os.path.realpath(file), file)
        passed_over.update(dict.fromkeys(looked.passed_over))
    return Found(list(found.values()), [name for name in sorted(passed_over) if os.path.realpath(name) not in found])


class _Looked:
    """Looks through what one name leads to.

    `left_out` tells whether something in it is excluded; `passed_over` are files that do not count by their names.
    """

    def __init__(self, file_filter: FileFilter) -> None:
        self._filter = file_filter
        self.left_out = False
        self.passed_over: list[str] = []

    def files(self, name: str) -> Iterator[str]:
        """Files of the name."""
        path = Path(name)
        if name == "-" or path.is_file():
            yield name
        elif path.is_dir():
            yield from sorted(self._below(path))
        elif glob.has_magic(name):
            for match in sorted(glob.glob(name, recursive=True)):  # noqa: PTH207 - Path.glob refuses absolute patterns
                if all(self._keeps(part) for part in _matched(name, match)):
                    yield from self.files(match)
        else:
            yield name  # whatever keeps it from being read is said when it is read

    def _below(self, folder: Path) -> Iterator[str]:
        """Programs in a folder and below, by their names.

        With broken links that are named like one, and folders that cannot be listed.
        """
        shut: list[str] = []
        for here, folders, names in os.walk(folder, onerror=lambda error: shut.append(str(error.filename))):
            folders[:] = [name for name in folders if self._keeps(Path(here) / name)]
            for file in (Path(here) / name for name in names):
                if self._filter.has(file):
                    if (file.is_file() or (file.is_symlink() and not file.exists())) and self._keeps(file):
                        yield str(file)
                elif not any(part.startswith(".") for part in file.relative_to(folder).parts):
                    self._pass_over(file)
        yield from shut

    def _pass_over(self, file: Path) -> None:
        if not self._filter.is_excluded(file):
            self.passed_over.append(str(file))

    def _keeps(self, path: Path) -> bool:
        if self._filter.is_excluded(path):
            self.left_out = True
            return False
        return True


def _matched(pattern: str, match: str) -> list[Path]:
    """What a glob has matched: the path, and those folders in it that the glob does not name."""
    named = next(at for at, part in enumerate(Path(pattern).parts) if glob.has_magic(part))
    parts = Path(match).parts
    return [Path(*parts[:length]) for length in range(named + 1, len(parts) + 1)]
