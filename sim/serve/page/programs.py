"""The programs that the page may open, by number: the one of the start, or those that were found in a folder.

No request names a path: a number stands for the file that was found under it, and none is given twice.
"""

import asyncio
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from parser.files import read_bytes
from parser.findings.catalogue import Bilingual
from parser.findings.errors import FileUnreadableError
from parser.text.encoding import printable
from sim.check.files import find_files
from sim.serve.page.child import Child, begun

MOST: Final = 10_000
"""Programs of a folder that are shown."""
_AT_ONCE: Final = 500
"""Rows of an answer."""


class Opened(NamedTuple):
    """What is open at the start: a program with its file, a folder, or nothing; `why` says why that is so."""

    file: Path | None = None
    data: bytes = b""
    folder: Path | None = None
    why: Bilingual | None = None

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
        self._files: list[Path] = [opened.file] if opened.file else []
        self._first = self._left_out = 0
        self._rows: list[dict[str, Any]] = []
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

    async def rows(self, known: int, list_: int) -> dict[str, Any]:
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
            rows.append({**row, "number": str(self._first + len(rows))})
