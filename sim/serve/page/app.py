"""The requests of the page, answered.

Which lines of a text are others than in an earlier one.
"""

import asyncio
import os
import re
from collections.abc import Callable, Sequence
from difflib import SequenceMatcher
from itertools import takewhile
from pathlib import Path
from typing import Any, Final, NamedTuple

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.routing import Route

from parser.findings.catalogue import Bilingual
from parser.findings.errors import FileUnreadableError, ProgramError, SettingsError
from parser.text.encoding import printable
from sim.serve.page.answers import ReadFile, answer, file_of, file_text, printable_entry, read_file
from sim.serve.page.child import Life
from sim.serve.page.drawings import Drawings, is_drawing
from sim.serve.page.form import Chosen, chosen
from sim.serve.page.machines import Machines, is_machine, is_technology, machine_of, technology_of
from sim.serve.page.model import AnswerEntry, ChangeEntry, ChangesEntry, FileTextEntry, MachineFileEntry
from sim.serve.page.programs import STARTS, Programs, row_or_why, start
from sim.serve.page.runs import (
    MISSING,
    NOTHING,
    BadRequestError,
    Drawn,
    Running,
    Runs,
    Work,
    guarded,
    name_of,
    told,
)
from sim.show.open_page.page import open_page
from sim.show.texts.phrases import machine_name, technology_name

_AFTER_FIRST_S: Final = 1.0
"""From the first page on: its first check is to be answered before a process for runs takes time from it."""
_MOST_COMPARED: Final = 2000
"""Lines between the first and the last change that are told apart; of more all count as changed."""
_MOST_PLACES: Final = 100
_MOST_LINES: Final = 40
"""Of one place, that are told."""


def changed_lines(before: str, after: str) -> ChangesEntry:
    """The places where the lines of two texts differ, from the top; ``more`` are those beyond the first hundred.

    A place has ``line``, from 1, where it stands in the text after, what stood there and what stands there, and how
    many ``lines`` each of the two has: of long ones the first forty are told.
    """
    was, now = before.split("\n"), after.split("\n")
    places = [_place(was[a:b], now[c:d], c) for a, b, c, d in _changes(was, now)]
    return {"places": places[:_MOST_PLACES], "more": max(len(places) - _MOST_PLACES, 0)}


def _changes(was: Sequence[str], now: Sequence[str]) -> list[tuple[int, int, int, int]]:
    """First and past row before, first and past row after, of each change."""
    head = _same(was, now)
    tail = _same(was[head:][::-1], now[head:][::-1])
    inner, other = was[head : len(was) - tail], now[head : len(now) - tail]
    if max(len(inner), len(other)) > _MOST_COMPARED:  # the library takes a time that grows with their square
        return [(head, len(was) - tail, head, len(now) - tail)]
    found = SequenceMatcher(None, inner, other).get_opcodes()
    return [(head + a, head + b, head + c, head + d) for kind, a, b, c, d in found if kind != "equal"]


def _same(this: Sequence[str], other: Sequence[str]) -> int:
    """How many lines are the same at the begin."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(this, other, strict=False)))


def _place(was: Sequence[str], now: Sequence[str], row: int) -> ChangeEntry:
    return {
        "line": row + 1,
        "before": "\n".join(was[:_MOST_LINES]),
        "after": "\n".join(now[:_MOST_LINES]),
        "lines": [len(was), len(now)],
    }


class Stores(NamedTuple):
    """Where what comes to the page stands."""

    drawings: Drawings
    machines: Machines


def app_of(programs: Programs, stores: Stores, life: Life, runs: Runs) -> Starlette:
    """The application behind the guard; ``state.ahead`` does at the start what the page will ask for."""
    drawings = stores.drawings
    files, texts = _Files(programs, stores, life, runs), _Checks(programs, stores.machines.folder)
    running, drawn = Running(life, runs, programs, drawings), Drawn(drawings, runs)
    works: list[Work] = [files.first, files.read, files.save, files.alive, files.close]
    works += [files.program, files.example, files.rows, files.again, files.row]
    works += [drawn.look, drawn.plan, drawn.draft, drawn.drafted]
    works += [texts.check, texts.version, texts.lines, running.run, running.more, running.progress, running.cancel]
    app = Starlette(
        routes=[
            Route("/", files.page, methods=["GET"]),
            Route("/run/{number:int}/{name}", running.made, methods=["GET"]),
            Route("/zip/{number:int}", running.zip, methods=["GET"]),
            *(Route(f"/{name_of(work)}", guarded(work), methods=["POST"]) for work in works),
        ]
    )
    app.state.ahead = files.ahead if is_drawing(programs.opened.name, programs.opened.data) else texts.ahead
    return app


class _Files:
    """The page itself, and programs as they come to it and go from it."""

    def __init__(self, programs: Programs, stores: Stores, life: Life, runs: Runs) -> None:
        self._programs, self._stores, self._life, self._runs = programs, stores, life, runs
        self._warming: asyncio.Task[None] | None = None

    async def page(self, _: Request) -> Response:
        """The page."""
        self._life.note_page()
        text, policy = open_page(STARTS)
        return HTMLResponse(text, headers={"content-security-policy": policy})

    async def first(self, _: Request) -> Response:
        """The program or drawing that is open at the start; a run can begin at once some moments later."""
        self._warming = self._warming or asyncio.create_task(self._warm())
        opened = self._programs.opened
        read = self._answer(opened.name, opened.data, "0" if opened.file else "")
        if opened.why is not None:
            read["why"] = printable_entry(opened.why)
        if opened.recent:
            read["recent"] = [
                {"name": printable(file.name), "folder": printable(str(file.parent)), "number": str(number)}
                for number, file in enumerate(opened.recent)
            ]
        return JSONResponse(read)

    async def ahead(self) -> None:
        """Have the process ready that looks at the drawing which is open at the start."""
        await self._stores.drawings.warm()

    async def _warm(self) -> None:
        await asyncio.sleep(_AFTER_FIRST_S)
        await self._stores.drawings.warm()
        await self._runs.warm()

    async def program(self, request: Request) -> Response:
        """The program of a number, as its file is now."""
        number = (await told(request, "number"))["number"]
        try:
            data = await run_in_threadpool(self._programs.read, number)
        except FileUnreadableError:
            return Response(status_code=MISSING)
        file = self._programs.file(number)
        return JSONResponse(self._answer(file.name if file else "", data, number))

    async def example(self, request: Request) -> Response:
        """A file to begin with."""
        name = (await told(request, "example"))["example"]
        if name not in STARTS:
            return Response(status_code=MISSING)
        return JSONResponse(self._answer(*await run_in_threadpool(start, name)))

    async def rows(self, request: Request) -> Response:
        """What is known of the programs of the folder, behind those that the page knows."""
        self._life.note_page()
        query = await told(request, "known", "list")
        if not all(number.isdecimal() for number in query.values()):
            raise BadRequestError
        return JSONResponse(await self._programs.rows(int(query["known"][:9]), int(query["list"][:9])))

    async def again(self, _: Request) -> Response:
        """Look through the folder again."""
        await self._programs.again()
        return JSONResponse(await self._programs.rows(0, 0))

    async def row(self, request: Request) -> Response:
        """What a list shows of a file that came to the page."""
        name, data = request.query_params.get("name", ""), await request.body()
        return JSONResponse(await run_in_threadpool(row_or_why, name, None, data))

    async def read(self, request: Request) -> Response:
        """The text of a file that came to the page, or the number that it has as a drawing."""
        return JSONResponse(self._answer(request.query_params.get("name", ""), await request.body()))

    def _answer(self, name: str, data: bytes, number: str = "") -> FileTextEntry:
        if is_drawing(name, data):
            return {**_read(name, b""), "drawing": self._stores.drawings.keep(name, data)}
        return self._machine(name, data) if is_machine(name) else _read(name, data, number)

    def _machine(self, name: str, data: bytes) -> FileTextEntry:
        machines = self._stores.machines
        try:
            own = machines.keep(data)
        except SettingsError as error:
            texts = (text.replace(str(machines.folder) + os.sep, "") for text in error.in_both())
            named = Bilingual(*(re.sub(r"(own|technology)-\d+\.toml", lambda _: name, text, count=1) for text in texts))
            return {**_read(name, b""), "why": printable_entry(named)}
        if is_technology(own):
            return {**_read(name, b""), "technologies": _technologies(own, machines.folder)}
        title = machine_name(machine_of(own, machines.folder))
        return {**_read(name, b""), "machine": {"name": own, "title": printable_entry(title)}}

    async def save(self, request: Request) -> Response:
        """The bytes of a text."""
        query = await told(request, "text", "opened", "encoding", "newline")
        data = file_of(ReadFile(query["opened"], query["encoding"], query["newline"]), query["text"])
        return Response(data, media_type="application/octet-stream")

    async def alive(self, _: Request) -> Response:
        """The page is still open."""
        self._life.note_page()
        return Response(status_code=NOTHING)

    async def close(self, _: Request) -> Response:
        """The server is to end."""
        self._life.end()
        return Response(status_code=NOTHING)


class _Text(NamedTuple):
    """A text that is to be checked: its name, where it stands, and what a run of it has."""

    name: str
    file: Path | None
    text: str
    for_run: Chosen


def _technologies(own: str, folder: Path) -> list[MachineFileEntry]:
    """A technology file as a form offers it: once for each material that it knows."""
    technology = technology_of(own, folder)
    named = technology_name(technology)
    return [
        {
            "name": f"{own}/{material}",
            "title": printable_entry(Bilingual(*(f"{text}: {material}" for text in (named.en, named.zh)))),
        }
        for material in technology.materials
    ]


class _Checks:
    """What is found in texts, and how they differ."""

    def __init__(self, programs: Programs, machine_files: Path) -> None:
        self._programs, self._machine_files = programs, machine_files
        self._checks, self._lines = _Last(), _Last()
        self._ahead: tuple[_Text, asyncio.Task[AnswerEntry]] | None = None

    async def ahead(self) -> None:
        """Check what is open at the start, before the page asks for it: a browser takes longer to start.

        Where nothing is open, that loads what the first check needs.
        """
        opened = self._programs.opened
        text = _read(opened.name, opened.data)["text"] or ""
        first = _Text(
            printable(opened.name),
            self._programs.file("0") if text else None,
            text,
            chosen("", "", self._machine_files),
        )
        checked = asyncio.create_task(run_in_threadpool(answer, *first))
        self._ahead = first, checked
        await asyncio.wait([checked])
        if checked.exception() is not None:  # the page's own check meets it again, and is answered as any other
            self._ahead = None

    async def check(self, request: Request) -> Response:
        """What is found in a text; ``number`` is that of its program, empty where it came to the page."""
        text, ahead = await self._text(request), self._ahead
        self._ahead = None
        if ahead is not None and ahead[0] == text:
            return JSONResponse(await ahead[1])
        return await self._checks.answered(answer, *text)

    async def version(self, request: Request) -> Response:
        """What is found in a text that waits for its turn, however many others are asked for."""
        return JSONResponse(await run_in_threadpool(answer, *await self._text(request)))

    async def lines(self, request: Request) -> Response:
        """Which lines of a text are others than before."""
        query = await told(request, "before", "after")
        return await self._lines.answered(changed_lines, query["before"], query["after"])

    async def _text(self, request: Request) -> _Text:
        query = await told(request, "name", "text", "number", "machine", "thickness_mm")
        for_run = chosen(query["machine"], query["thickness_mm"], self._machine_files)
        return _Text(query["name"], self._programs.file(query["number"]), query["text"], for_run)


class _Last:
    """Does one work at a time; of those that wait for their turn only the last one."""

    def __init__(self) -> None:
        self._turn = asyncio.Lock()
        self._last = 0

    async def answered(self, work: Callable[..., Any], *values: object) -> Response:
        """What comes of it; nothing where a later one was values for meanwhile."""
        self._last += 1
        number = self._last
        async with self._turn:
            if number != self._last:
                return Response(status_code=NOTHING)
            return JSONResponse(await run_in_threadpool(work, *values))


def _read(name: str, data: bytes, number: str = "") -> FileTextEntry:
    """A file as the page has it; no text where it is none; its number, where it is one of the programs."""
    try:
        read = read_file(data) if data else ReadFile("", "utf-8", "\n")
    except ProgramError:
        return {"name": printable(name), "text": None, "encoding": "", "newline": "\n", "number": number}
    return file_text(name, read, number)
