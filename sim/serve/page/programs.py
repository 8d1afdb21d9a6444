"""The programs that the page may open, by number, and as rows of a list; and what an empty page offers.

A program as a list of them shows it: its verdict, what is found, how large it is, and its path, small.

The programs that the page may open, by number: the one of the start, or those that were found in a folder.

No request names a path: a number stands for the file that was found under it, and none is given twice.

What a page that holds nothing offers to begin with: a sound program, one with a fault, and a drawing.
"""

import asyncio
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple, cast

from parser.files import read_bytes
from parser.findings.catalogue import LANGUAGES, Bilingual, texts
from parser.findings.errors import DrycutError, FileUnreadableError, ProgramError
from parser.findings.findings import Finding, counted
from parser.text.encoding import printable
from sim.check.file_check import as_typed
from sim.check.files import find_files
from sim.jobs.examples import example
from sim.serve.page.answers import printable_entry, read_file, size_of
from sim.serve.page.child import Child, begun
from sim.serve.page.model import RowEntry, RowsEntry
from sim.show.index_page.page import thumbnail, title_of
from sim.show.texts.phrases import same


def row_of(name: str, file: Path | None, data: bytes) -> RowEntry:
    """The row of a file's bytes, whatever they hold; `file` is where they stand, None where nobody knows.

    Lengths are µm. ``verdict`` is pass, to-check, incomplete, fail, or refused where there is no program.
    """
    try:
        read = read_file(data)
    except ProgramError as error:
        return _row(name, "refused", (error.finding,), _message(error.finding))
    program, result = (found := as_typed(name, file, read.text)).program, found.result
    if result.unreadable:
        return _row(name, "refused", result.findings, _message(result.findings[0]))
    size = size_of(result)
    row = _row(name, result.outcome, result.findings)
    if program is None or not len(program.toolpath) or size is None:
        return row
    return {**row, "picture": thumbnail(program.toolpath), "cut_um": size["cut_um"], "box_um": size["box_um"]}


def row_or_why(name: str, file: Path | None, data: bytes) -> RowEntry:
    """As `row_of`; where drycut itself fails at it, the row says so."""
    try:
        return row_of(name, file, data)
    except DrycutError as error:
        return refused(name, error.in_both())
    except Exception:
        return _row(name, "fault", message=same(traceback.format_exc().strip().splitlines()[-1]))


def refused(name: str, why: Bilingual) -> RowEntry:
    """The row of a file that cannot be read."""
    return _row(name, "refused", message=why)


def _message(finding: Finding) -> Bilingual:
    return Bilingual(*(texts(finding, language).message for language in LANGUAGES))


def _row(name: str, verdict: str, findings: Sequence[Finding] = (), message: Bilingual | None = None) -> RowEntry:
    counts = counted(findings)
    name_text = printable(name)
    return {
        "file": name_text,
        "title": name_text,
        "verdict": verdict,
        "message": None if message is None else printable_entry(message),
        "findings": [{"code": of.code, "severity": str(of.severity), "count": of.n} for of in counts],
        "titles": {of.code: title_of(of.code).entry() for of in counts},
        "picture": "",
        "cut_um": None,
        "box_um": None,
    }


MOST: Final = 10_000
"""Programs of a folder that are shown."""
_AT_ONCE: Final = 500
"""Rows of an answer."""


class Opened(NamedTuple):
    """What is open at the start: a program with its file, a folder, or nothing; `why` says why that is so.

    Where nothing is open, `recent` files are offered.
    """

    file: Path | None = None
    data: bytes = b""
    folder: Path | None = None
    why: Bilingual | None = None
    recent: tuple[Path, ...] = ()

    @property
    def name(self) -> str:
        """Of its file."""
        return self.file.name if self.file else ""


class Programs:
    """The programs that the page may open, and what the check says of those of a folder.

    FileUnreadableError for a folder without a program.

    Attributes
    ----------
    opened
        What is open at the start.
    """

    def __init__(self, opened: Opened) -> None:
        self.opened = opened
        self._folder = opened.folder
        self._files: list[Path] = [opened.file] if opened.file else list(opened.recent)
        self._first = self._left_out = 0
        self._rows: list[RowEntry] = []
        self._turn = asyncio.Lock()  # two tabs may ask at the same moment
        self._child: Child | None = None
        self._following: asyncio.Task[None] | None = None
        if opened.folder is not None:
            self._take(opened.folder)

    def file(self, number: str) -> Path | None:
        """The file of a number; None where there is none."""
        is_one = number.isascii() and number.isdigit() and int(number[:9]) < len(self._files)
        return self._files[int(number[:9])] if is_one else None

    def read(self, number: str) -> bytes:
        """The bytes of the program of a number, as its file has them now. FileUnreadableError where it has none."""
        file = self.file(number)
        if file is None or not self._is_inside(file):
            raise FileUnreadableError("no-such-program", number=number[:9])
        return read_bytes(file)

    async def again(self) -> None:
        """Look through the folder again, and check what is there; nothing where none is open."""
        async with self._turn:
            if self._folder is not None:
                await self._end()
                await asyncio.to_thread(self._look, self._folder)

    async def rows(self, known: int, list_: int) -> RowsEntry:
        """How far the check of the folder is, and the rows behind those that are `known` of a list.

        The check begins when it is first asked for. ``list`` is another one once the folder was looked through again:
        then nothing of it is known. ``left_out`` are files beyond `MOST`, and links that lead out of the folder.
        """
        async with self._turn:
            found = self._files[self._first :] if self._folder is not None else []
            if found and self._following is None:
                self._child = await begun("sim.serve.page.lister")
                self._following = asyncio.create_task(self._follow(self._child, self._named(found)))
        first = known if list_ == self._first else 0
        return {
            "folder": printable(self._folder.resolve().name) if self._folder is not None else "",
            "list": self._first,
            "total": len(found),
            "left_out": self._left_out,
            "is_over": self._following is None or self._following.done(),
            "rows": self._rows[first : first + _AT_ONCE],
        }

    async def end(self) -> None:
        """End the check."""
        async with self._turn:
            await self._end()

    async def _end(self) -> None:
        child, following = self._child, self._following
        self._child = self._following = None
        if child is not None and following is not None:
            child.end()
            await following

    def _look(self, folder: Path) -> None:
        try:
            self._take(folder)
        except FileUnreadableError:  # all of them are gone
            self._first, self._left_out, self._rows = len(self._files), 0, []

    def _take(self, folder: Path) -> None:
        """Find the programs of the folder, which get the next numbers."""
        found = [Path(file) for file in find_files([str(folder)]).files]
        inside = [file for file in found if self._is_inside(file)][:MOST]
        self._first, self._left_out, self._rows = len(self._files), len(found) - len(inside), []
        self._files += inside

    def _is_inside(self, file: Path) -> bool:
        """Whether it stands in the folder indeed: a link may lead anywhere."""
        return self._folder is None or file.resolve().is_relative_to(self._folder.resolve())

    def _named(self, files: Sequence[Path]) -> list[tuple[str, str]]:
        assert self._folder is not None  # noqa: S101 - asked where there is one
        return [(printable(file.relative_to(self._folder).as_posix()), str(file)) for file in files]

    async def _follow(self, child: Child, named_files: list[tuple[str, str]]) -> None:
        rows = self._rows
        async for row in child.tells(named_files):
            rows.append(cast(RowEntry, {**row, "number": str(self._first + len(rows))}))


_SOUND: Final = "keyhole"
_DRAWN: Final = "plate"


class Start(NamedTuple):
    """A file to begin with: its name, and its bytes."""

    name: str
    data: bytes


def start(name: str) -> Start:
    """What to begin with: ``sound``, ``broken`` or ``drawing``. KeyError for another name."""
    return _STARTS[name]()


def _sound() -> Start:
    program = example(_SOUND).program
    return Start(f"{_SOUND}{program.suffix}", read_bytes(program))


def _broken() -> Start:
    """The same program with one letter wrong, which is certainly mended."""
    file = Path(__file__).with_name("broken").with_suffix(example(_SOUND).program.suffix)
    return Start(file.name, read_bytes(file))


def _drawing() -> Start:
    drawing = example(_DRAWN).drawing
    assert drawing is not None  # noqa: S101 - the example has one
    return Start(f"{_DRAWN}.dxf", read_bytes(drawing.file))


_STARTS: Final = {"sound": _sound, "broken": _broken, "drawing": _drawing}
STARTS: Final = tuple(_STARTS)
"""Their names, in the order in which they are offered."""
