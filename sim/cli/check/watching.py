"""``--watch``: a check again whenever a file that the arguments lead to has changed."""

import glob
import os
import time
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple, NoReturn

import click

from parser.findings.catalogue import Language
from parser.findings.errors import DrycutError
from sim.check.files import FileFilter
from sim.check.settings.read import NAMES
from sim.cli.spoken import complaint
from sim.show.terminal.printer import clear, say
from sim.show.texts import Words

_LEAST_REST_S = 0.3
_MOST_REST_S = 3.0
_RESTS_A_LOOK = 100.0
"""A look at all files may take a hundredth of the time: 5,000 files take some 20 ms, and so a rest of 2 s."""


class _FileState(NamedTuple):
    """What tells that a file was written, or another put in its place: time, size, and number of the file."""

    modified_ns: int
    size: int
    number: int


def watch(
    names: Sequence[str], file_filter: Callable[[], FileFilter], check: Callable[[], object], language: Language
) -> NoReturn:
    """Check, and again after each change of what the names lead to, until KeyboardInterrupt.

    `file_filter` says which files of folders count, as settings stand then. What keeps the first check from being done
    is raised; later it is told, as a later change may mend it.
    """
    counts = file_filter()
    seen = _look(names, counts)
    clear()
    check()
    while True:
        say(Words(language)("findings.watching"), err=True)
        seen = _settled_change(names, counts, seen)
        clear()
        try:
            counts = file_filter()
            check()
        except DrycutError as error:
            say(Words(language)("commands.error", message=error), err=True)
        except click.ClickException as error:
            say(Words(language)("commands.error", message=complaint(error)), err=True)


def rest_s(look_s: float) -> float:
    """Rest between two looks, s, by how long a look takes, s."""
    return min(max(_LEAST_REST_S, _RESTS_A_LOOK * look_s), _MOST_REST_S)


def _settled_change(
    names: Sequence[str], file_filter: FileFilter, before: dict[str, _FileState]
) -> dict[str, _FileState]:
    """What is seen as soon as it is not as before, and the same at two looks: a file half written changes again."""
    last, look_s = before, 0.0
    while True:
        time.sleep(rest_s(look_s))
        began_s = time.monotonic()
        now = _look(names, file_filter)
        look_s = time.monotonic() - began_s
        if now == last != before:
            return now
        last = now


def _look(names: Sequence[str], file_filter: FileFilter) -> dict[str, _FileState]:
    """The files that the names lead to, and settings that may count for them; none that cannot be looked at."""
    seen: dict[str, _FileState] = {}
    programs = {path for name in names for path in _paths(name, file_filter)}
    folders = {os.path.dirname(path) for path in programs}  # noqa: PTH120 - as below
    for path in (*programs, *{file for folder in folders for file in _settings_above(folder)}):
        try:
            found = os.stat(path)  # noqa: PTH116 - no Path for each of thousands of files, several times a second
        except OSError:
            continue
        seen[path] = _FileState(found.st_mtime_ns, found.st_size, found.st_ino)
    return seen


@cache
def _settings_above(folder: str) -> tuple[str, ...]:
    """Settings files, there or not, in a folder and all above it; that is more than the search for settings reads."""
    here = Path(folder).resolve()
    return tuple(str(above / name) for above in (here, *here.parents) for name in NAMES)


def _paths(name: str, file_filter: FileFilter) -> Iterator[str]:
    """What `sim.check.files.find_files` would find, without telling files apart that have several names."""
    path = Path(name)
    if path.is_dir():
        for here, _, files in os.walk(name):
            yield from (f"{here}/{file}" for file in files if _counts(file_filter, Path(here, file)))
    elif glob.has_magic(name) and not path.is_file():
        for match in glob.glob(name, recursive=True):  # noqa: PTH207 - Path.glob refuses absolute patterns
            yield from _paths(match, file_filter)
    else:
        yield name


def _counts(file_filter: FileFilter, file: Path) -> bool:
    """Whether a file of a folder counts; by its suffix alone where settings that are wrong just now do not say."""
    try:
        return file_filter.has(file)
    except DrycutError:
        return False
