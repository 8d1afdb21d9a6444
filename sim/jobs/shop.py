"""The programs of a shop: where each comes from, each once, a scenario with the program that is its.

Where the program of a scenario comes from: its file, or its drawing where there is no file.

The programs of a shop: what names, folders and globs lead to, each once, a scenario with the program that is its.

A folder in OUT for each program: as the shop has them, under names that every system takes and that never meet.
"""

import glob
import hashlib
import os
import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

from parser.files import read_bytes
from parser.findings.errors import DrawingError, DrycutError, SettingsError
from parser.program import Program, load_program, suffixes
from parser.text.encoding import printable
from sim.base.progress import Progress, silent
from sim.check.files import FileFilter, find_files
from sim.setup.making import ToMake
from sim.setup.scenario import Scenario


class Source(NamedTuple):
    """Bytes of a program, and whether they were made of a drawing, so that no file holds them yet."""

    data: bytes
    is_made: bool


def source_of(scenario: Scenario, progress: Progress = silent) -> Source:
    """The bytes of a scenario's program.

    Raises FileUnreadableError where file or drawing cannot be read, DrawingError where no program can be made of the
    drawing, SettingsError where it cannot be written as it is asked for.
    """
    if scenario.to_make is None or scenario.program.exists():
        return Source(read_bytes(scenario.program), is_made=False)
    return Source(_made_bytes(scenario, scenario.to_make, progress), is_made=True)


def _made_bytes(scenario: Scenario, to_make: ToMake, progress: Progress) -> bytes:
    # Few programs are made, and what makes them takes long to load.
    from sim.make.cam.maker import NotMade  # noqa: PLC0415
    from sim.make.cam.of_scenario import program_of  # noqa: PLC0415
    from sim.show.refusals import why_refused  # noqa: PLC0415

    done = program_of(scenario, to_make, progress)
    if isinstance(done, NotMade):
        drawing = printable(str(scenario.drawing and scenario.drawing.file))
        raise DrawingError("no-program-of-drawing", drawing=drawing, why=why_refused(done.refusal))
    if done.upper_data is not None:
        raise SettingsError("two-drawings-in-one-file", file=printable(str(to_make.file)))
    return done.data


def program_read(scenario: Scenario, source: Source) -> Program:
    """The program of its bytes, read by the words for end and pause that it is asked to have. ProgramError if none."""
    return load_program(_in_usual_words(scenario, source.data), printable(scenario.program.name), scenario.choices)


def _in_usual_words(scenario: Scenario, data: bytes) -> bytes:
    """With ``DD`` and ``D``, where ``[program]`` names words of its own."""
    if scenario.to_make is None:
        return data
    writing = scenario.to_make.writing
    codes = writing.end_code, writing.pause_code
    end, pause = (None if code is None else code.encode(writing.encoding, "replace") for code in codes)
    if not (end or pause):
        return data
    from parser.write.threeb import with_usual_codes  # noqa: PLC0415 - what writes programs takes long to load

    return with_usual_codes(data, end, pause)


# Forbidden in names by Windows, with what is no character for people.
# https://learn.microsoft.com/windows/win32/fileio/naming-a-file
_UNSAFE: Final = re.compile(r'[<>:"/\\|?*\x00-\x1f\x7f-\x9f\ud800-\udfff]')
_DEVICES: Final = re.compile(r"(con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³])(\..*)?", re.IGNORECASE)
_HIDDEN: Final = ".drycut-"  # begins the names of our own hidden folders
MOST_CHARACTERS: Final = 80  # characters of one name; Windows takes 260 of a whole path


def folder_names(programs: Sequence[Path], names: Iterable[str], taken: frozenset[str]) -> list[str]:
    """The folder of each program in OUT, with ``/`` between its parts: its way from the folder that was named.

    Of several names it is the way from the folder that holds all of them. A part that some system cannot have, or that
    is `taken` by a file of ours, is mended and gets a mark, eight hex digits of what it was; so do folders that a
    system could not tell apart. So no two are the same, and the same names and programs give the same folders.
    """
    root = _root(names)
    ways = [_way(path, root) for path in programs]
    made = ["/".join(_safe(part, taken) for part in way) for way in ways]
    count = Counter(map(_told_apart, made))
    return [
        name if count[_told_apart(name)] == 1 else f"{name}~{_mark('/'.join(way))}"
        for name, way in zip(made, ways, strict=True)
    ]


def _root(names: Iterable[str]) -> str | None:
    """The folder that holds all that was named; None where Windows has it on several drives."""
    try:
        return os.path.commonpath([_folder(name) for name in names])
    except ValueError:
        return None


def _folder(name: str) -> str:
    path = Path(name)
    if not path.exists() and glob.has_magic(name):
        fixed = [part for part in path.parts if not glob.has_magic(part)]
        path = Path(*path.parts[: next(at for at, part in enumerate(path.parts) if part not in fixed)])
    return os.path.abspath(path if path.is_dir() else path.parent)  # noqa: PTH100 - links stay as they are named


def _way(path: Path, root: str | None) -> tuple[str, ...]:
    whole = Path(os.path.abspath(path))  # noqa: PTH100 - as above
    way = whole.parts if root is None else Path(os.path.relpath(whole, root)).parts
    return way or (whole.name,)


def _safe(part: str, taken: frozenset[str]) -> str:
    """A name that every system takes, the same where it is one already."""
    plain = unicodedata.normalize("NFC", part)
    clean = _UNSAFE.sub("_", plain).rstrip(". ")[:MOST_CHARACTERS]
    ours = clean.startswith(_HIDDEN) or clean.lower() in taken
    if clean == plain and not ours and not _DEVICES.fullmatch(clean):
        return clean
    visible = clean.lstrip(". ")
    return f"{'_' if _DEVICES.fullmatch(visible) else ''}{visible}~{_mark(part)}"


def _mark(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:8]


def _told_apart(name: str) -> str:
    """What of a name counts on systems that do not tell case apart."""
    return unicodedata.normalize("NFC", name).casefold()


SCENARIO: Final = "scenario.toml"


class ShopProgram(NamedTuple):
    """A program of a shop.

    Attributes
    ----------
    file
        Its file as it was named, with ``/`` between the parts; of a scenario that cannot be read, ``scenario.toml``.
    folder
        Its folder in OUT.
    scenario
        What it is run with; None where that cannot be read, for which `error` says why.
    """

    file: str
    folder: str
    scenario: Scenario | None
    error: str = ""


def find_programs(
    names: Sequence[str], scenario_of: Callable[[Path], Scenario], out: Path, taken: frozenset[str]
) -> list[ShopProgram]:
    """The programs that names lead to, in the order of the names, in folders in that of their paths.

    A folder with a ``scenario.toml`` is one scenario: its program is not run by itself too. Of a scenario that cannot
    be read nobody knows which program that is: none that stands beside it is run. Nothing is looked for in `out`.

    Parameters
    ----------
    names
        Files, folders and globs.
    scenario_of
        Scenario of a folder, and of a program alone; raises DrycutError.
    out
        Where the runs are written.
    taken
        Names, in small letters, that no folder in it may have.

    Raises FileUnreadableError for a name that leads to nothing, and what `scenario_of` raises for any program alone.
    """
    away = out.resolve()
    ends = (*suffixes(), f"/{SCENARIO}")
    file_filter = FileFilter(is_excluded=lambda path: path.resolve() == away, ends=ends)
    files = [Path(file) for file in find_files(names, file_filter).files]
    scenarios = {file: _scenario(file.parent, scenario_of) for file in files if file.name.lower() == SCENARIO}
    theirs = _Theirs(scenarios)
    apart = [file for file in files if file in scenarios or file not in theirs]
    ways = [file.parent if file in scenarios else file for file in apart]
    folders = folder_names(ways, names, taken)
    alone = _Alone(scenario_of)
    return [
        _found(file, scenarios[file] if file in scenarios else alone.of(file), folder)
        for file, folder in zip(apart, folders, strict=True)
    ]


def _scenario(folder: Path, scenario_of: Callable[[Path], Scenario]) -> Scenario | str:
    """The scenario of a folder, or why there is none."""
    try:
        return scenario_of(folder)
    except DrycutError as error:
        return error.message


class _Theirs:
    """The programs that belong to scenarios."""

    def __init__(self, scenarios: dict[Path, Scenario | str]) -> None:
        found = {file.parent: scenario for file, scenario in scenarios.items()}
        self._programs = {os.path.realpath(each.program) for each in found.values() if isinstance(each, Scenario)}
        self._unread = {os.path.realpath(folder) for folder, each in found.items() if isinstance(each, str)}

    def __contains__(self, file: Path) -> bool:
        """Whether a program is that of a scenario, or may be."""
        path = os.path.realpath(file)
        return path in self._programs or os.path.dirname(path) in self._unread  # noqa: PTH120 - text, as above


def _found(file: Path, scenario: Scenario | str, folder: str) -> ShopProgram:
    if isinstance(scenario, str):
        return ShopProgram(file.as_posix(), folder, None, scenario)
    return ShopProgram(scenario.program.as_posix(), folder, scenario)


class _Alone:
    """Scenarios of programs alone: read once, since all of them have the same machine, wire and work."""

    def __init__(self, scenario_of: Callable[[Path], Scenario]) -> None:
        self._scenario_of = scenario_of
        self._first: Scenario | None = None

    def of(self, file: Path) -> Scenario:
        """That of a file."""
        if self._first is None:
            self._first = self._scenario_of(file)
        return replace(self._first, title=printable(file.name), program=file)
