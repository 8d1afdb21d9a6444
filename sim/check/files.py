"""Which files a check is to look at."""

import glob
import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from parser.findings.errors import FileUnreadableError
from parser.findings.messages import Message
from parser.program import suffixes


def find_files(
    names: Sequence[str], is_excluded: Callable[[Path], bool], ends: tuple[str, ...] | None = None
) -> list[str]:
    """Files of the names: files themselves, all programs in folders and below, and what globs match.

    In folders the files whose ``/NAME`` ends in one of `ends` count, in any case; where None, those of all dialects.
    Files and folders that `is_excluded` are left out, unless they are named themselves. Each file stands there once, as
    it was first spelled. A folder or a link that cannot be read is among them, so that reading it tells. Raises
    FileUnreadableError for a name that leads to no file.
    """
    found: dict[str, str] = {}
    for name in names:
        looked = _Looked(is_excluded, ends or suffixes())
        files = list(looked.files(name))
        if not files:
            raise FileUnreadableError(
                Message("all-programs-excluded", name=name)
                if looked.left_out
                else Message("no-program-there", name=name, suffixes=" or ".join(suffixes()))
            )
        for file in files:
            found.setdefault(file if file == "-" else os.path.realpath(file), file)
    return list(found.values())


class _Looked:
    """Looks through what one name leads to; `left_out` tells whether something in it is excluded."""

    def __init__(self, is_excluded: Callable[[Path], bool], ends: tuple[str, ...]) -> None:
        self._is_excluded = is_excluded
        self._ends = ends
        self.left_out = False

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
        """Programs in a folder and below, by the ends of their names in any case.

        With broken links that are named like one, and folders that cannot be listed.
        """
        shut: list[str] = []
        for here, folders, names in os.walk(folder, onerror=lambda error: shut.append(str(error.filename))):
            folders[:] = [name for name in folders if self._keeps(Path(here) / name)]
            for file in (Path(here) / name for name in names if f"/{name}".lower().endswith(self._ends)):
                if (file.is_file() or (file.is_symlink() and not file.exists())) and self._keeps(file):
                    yield str(file)
        yield from shut

    def _keeps(self, path: Path) -> bool:
        if self._is_excluded(path):
            self.left_out = True
            return False
        return True


def _matched(pattern: str, match: str) -> list[Path]:
    """What a glob has matched: the path, and those folders in it that the glob does not name."""
    named = next(at for at, part in enumerate(Path(pattern).parts) if glob.has_magic(part))
    parts = Path(match).parts
    return [Path(*parts[:length]) for length in range(named + 1, len(parts) + 1)]
