"""The drawings that came to the page, by number, and what is found in them: their files go with the server.

Names of files that come from a page.
"""

import asyncio
import json
import re
from pathlib import Path
from typing import Final

from parser.files import PLOTS, kind_of
from parser.text.encoding import printable
from sim.serve.page.child import Child, begun
from sim.serve.page.machines import machine_files
from sim.setup.settable import FIELDS, TAPER_FIELDS

_UNSAFE: Final = re.compile(r"[^\w.-]")
_LONGEST: Final = 60


def safe_name(name: str) -> str:
    """A name for a file that nothing in it makes a way to another one, nor an option."""
    return _UNSAFE.sub("_", Path(name).name)[-_LONGEST:].lstrip(".-") or "program"


READ_KEYS: Final = ("join_mm", "unit")
"""How the page has a drawing read."""
LOOK_KEYS: Final = ("name", "text", "machine", "technology", *FIELDS, "offset_mm", "side", *TAPER_FIELDS, *READ_KEYS)
"""What the page says where a drawing is to be laid beneath its program."""
MAKE_KEYS: Final = (
    "language",
    "machine",
    "technology",
    *FIELDS,
    *TAPER_FIELDS,
    "offset_mm",
    "tab_mm",
    "slug_tab_mm",
    "led_um",
    "rough_first",
    "no_core",
    "common_edges",
    "picks",
    "starts",
    "entries",
    "order",
    "wire_side",
    "direction",
    *READ_KEYS,
)
"""What it says where a program is to be made; empty texts leave what is usual."""
PLAN_KEYS: Final = (*MAKE_KEYS, "placement")
"""What it says where it shows a plan: how the drawing lies beneath its program, too."""
_MOST: Final = 20
"""Drawings that are kept, the last ones."""
_LONGEST_S: Final = 60.0
"""Of a look, and of a plan."""
_MARK: Final = rb"(?:\xef\xbb\xbf)?"
_BEGINS: Final = re.compile(_MARK + rb"(?:AutoCAD Binary DXF|\s*(?:999[^\n]*\n[^\n]*\n\s*)*0\s*\n\s*SECTION)")


def is_drawing(name: str, data: bytes) -> bool:
    """Whether a file is meant as a drawing: its name says so, or its first lines."""
    is_dxf = name.lower().endswith(".dxf") or _BEGINS.match(data[:4096].replace(b"\r", b"\n")) is not None
    return is_dxf or kind_of(data) in PLOTS


class Drawings:
    """The drawings, looks at them, and plans of them.

    Parameters
    ----------
    folder
        Of their files; who gave it clears it away.
    """

    def __init__(self, folder: Path) -> None:
        self._folder, self._machines = folder / "drawings", machine_files(folder)
        self._files: list[Path] = []
        self._planner: Child | None = None
        self._busy_with: Path | None = None
        self._turn = asyncio.Lock()

    def keep(self, name: str, data: bytes) -> str:
        """The number of a drawing that came."""
        number = len(self._files)
        file = self._folder / str(number) / Path(safe_name(name)).with_suffix(".dxf").name
        file.parent.mkdir(parents=True)
        file.write_bytes(data)
        self._files.append(file)
        if number >= _MOST:
            self._files[number - _MOST].unlink(missing_ok=True)
        return str(number)

    def file(self, number: str) -> Path | None:
        """The file of a number; None where there is none."""
        is_one = number.isascii() and number.isdigit() and int(number[:9]) < len(self._files)
        file = self._files[int(number[:9])] if is_one else None
        return file if file is not None and file.is_file() else None

    def result(self, number: str) -> Path:
        """Where the program that is made of the drawing of a number is told."""
        return self._folder / number / "made.json"

    async def look(self, file: Path, query: dict[str, str]) -> bytes:
        """What is found in a drawing, in JSON: ``why`` alone where it is none, or took too long."""
        return await self._answer("look", file, query)

    async def plan(self, file: Path, query: dict[str, str]) -> bytes:
        """What would be cut of a drawing, in JSON: ``why`` alone where nothing can be, or it took too long."""
        return await self._answer("plan", file, query)

    async def warm(self) -> None:
        """Have the process ready that looks and plans."""
        async with self._turn:
            await self._process()

    async def _answer(self, job: str, file: Path, query: dict[str, str]) -> bytes:
        """What comes of a job; what is under way for another drawing is ended, since nobody looks at that one now."""
        result = file.with_name(f"{job}.json")
        task = {**query, "job": job, "drawing_file": str(file), "machine_files": str(self._machines)}
        if self._turn.locked() and self._planner is not None and self._busy_with not in {None, file}:
            self._planner.end()
        async with self._turn:
            planner, self._busy_with = await self._process(), file
            try:
                last = await asyncio.wait_for(planner.answer({**task, "result_file": str(result)}), _LONGEST_S)
            except TimeoutError:
                last = {}
            self._busy_with = None
            if not last:
                await self._end_planner()
            return result.read_bytes() if "done" in last else _why(last.get("wrong"))

    async def _process(self) -> Child:
        if self._planner is None or not self._planner.is_alive:
            self._planner = await begun("sim.serve.page.planner")
        return self._planner

    async def end(self) -> None:
        """End the process that looks and plans."""
        async with self._turn:
            await self._end_planner()

    async def _end_planner(self) -> None:
        planner, self._planner = self._planner, None
        if planner is not None:
            await planner.close()


def _why(said: dict[str, str] | None) -> bytes:
    """Why there is no look, in both languages; None where nothing was told."""
    return json.dumps({"why": said and {language: printable(text) for language, text in said.items()}}).encode()
