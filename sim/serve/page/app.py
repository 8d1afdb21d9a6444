"""The requests of the page, answered."""

import asyncio
from collections.abc import Callable
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.routing import Route

from parser.findings.errors import FileUnreadableError, ProgramError
from parser.text.encoding import printable
from sim.serve.page.answers import ReadFile, answer, file_of, read_file
from sim.serve.page.drawings import Drawings, is_drawing
from sim.serve.page.life import Life
from sim.serve.page.lines import changed_lines
from sim.serve.page.programs import Programs
from sim.serve.page.request import MISSING, NOTHING, BadRequestError, Work, guarded, name_of, told
from sim.serve.page.row import row_or_why
from sim.serve.page.run_requests import Drawn, Running
from sim.serve.page.runs import Runs
from sim.show.open_page.page import open_page


def app_of(programs: Programs, drawings: Drawings, life: Life, runs: Runs) -> Starlette:
    """The application behind the guard."""
    files, texts = _Files(programs, drawings, life), _Checks(programs)
    running, drawn = Running(life, runs, programs, drawings), Drawn(drawings, runs)
    works: list[Work] = [files.first, files.read, files.save, files.alive, files.close]
    works += [files.program, files.rows, files.again, files.row, drawn.look, drawn.draft, drawn.drafted]
    works += [texts.check, texts.version, texts.lines, running.run, running.more, running.progress, running.cancel]
    return Starlette(
        routes=[
            Route("/", files.page, methods=["GET"]),
            Route("/run/{number:int}/{name}", running.made, methods=["GET"]),
            Route("/zip/{number:int}", running.zip, methods=["GET"]),
            *(Route(f"/{name_of(work)}", guarded(work), methods=["POST"]) for work in works),
        ]
    )


class _Files:
    """The page itself, and programs as they come to it and go from it."""

    def __init__(self, programs: Programs, drawings: Drawings, life: Life) -> None:
        self._programs, self._drawings, self._life = programs, drawings, life

    async def page(self, _: Request) -> Response:
        """The page."""
        self._life.seen()
        text, policy = open_page()
        return HTMLResponse(text, headers={"content-security-policy": policy})

    async def first(self, _: Request) -> Response:
        """The program or drawing that is open at the start."""
        opened = self._programs.opened
        read = self._taken(opened.name, opened.data, "0" if opened.file else "")
        if opened.why is None:
            return JSONResponse(read)
        why = {language: printable(text) for language, text in opened.why._asdict().items()}
        return JSONResponse({**read, "why": why})

    async def program(self, request: Request) -> Response:
        """The program of a number, as its file is now."""
        number = (await told(request, "number"))["number"]
        try:
            data = await run_in_threadpool(self._programs.read, number)
        except FileUnreadableError:
            return Response(status_code=MISSING)
        file = self._programs.file(number)
        return JSONResponse(_read(file.name if file else "", data, number))

    async def rows(self, request: Request) -> Response:
        """What is known of the programs of the folder, behind those that the page knows."""
        self._life.seen()
        asked = await told(request, "known", "list")
        if not all(number.isdecimal() for number in asked.values()):
            raise BadRequestError
        return JSONResponse(await self._programs.rows(int(asked["known"][:9]), int(asked["list"][:9])))

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
        return JSONResponse(self._taken(request.query_params.get("name", ""), await request.body()))

    def _taken(self, name: str, data: bytes, number: str = "") -> dict[str, Any]:
        if is_drawing(name, data):
            return {**_read(name, b""), "drawing": self._drawings.keep(name, data)}
        return _read(name, data, number)

    async def save(self, request: Request) -> Response:
        """The bytes of a text."""
        asked = await told(request, "text", "opened", "encoding", "newline")
        data = file_of(ReadFile(asked["opened"], asked["encoding"], asked["newline"]), asked["text"])
        return Response(data, media_type="application/octet-stream")

    async def alive(self, _: Request) -> Response:
        """The page is still open."""
        self._life.seen()
        return Response(status_code=NOTHING)

    async def close(self, _: Request) -> Response:
        """The server is to end."""
        self._life.end()
        return Response(status_code=NOTHING)


class _Checks:
    """What is found in texts, and how they differ."""

    def __init__(self, programs: Programs) -> None:
        self._programs = programs
        self._checks, self._lines = _Last(), _Last()

    async def check(self, request: Request) -> Response:
        """What is found in a text; ``number`` is that of its program, empty where it came to the page."""
        return await self._checks.answered(answer, *await self._asked(request))

    async def version(self, request: Request) -> Response:
        """What is found in a text that waits for its turn, however many others are asked for."""
        return JSONResponse(await run_in_threadpool(answer, *await self._asked(request)))

    async def lines(self, request: Request) -> Response:
        """Which lines of a text are others than before."""
        asked = await told(request, "before", "after")
        return await self._lines.answered(changed_lines, asked["before"], asked["after"])

    async def _asked(self, request: Request) -> tuple[str, Path | None, str]:
        asked = await told(request, "name", "text", "number")
        return asked["name"], self._programs.file(asked["number"]), asked["text"]


class _Last:
    """Does one work at a time; of those that wait for their turn only the last one."""

    def __init__(self) -> None:
        self._turn = asyncio.Lock()
        self._last = 0

    async def answered(self, work: Callable[..., Any], *asked: object) -> Response:
        """What comes of it; nothing where a later one was asked for meanwhile."""
        self._last += 1
        number = self._last
        async with self._turn:
            if number != self._last:
                return Response(status_code=NOTHING)
            return JSONResponse(await run_in_threadpool(work, *asked))


def _read(name: str, data: bytes, number: str = "") -> dict[str, Any]:
    """A file as the page has it; no text where it is none; its number, where it is one of the programs."""
    try:
        read = read_file(data) if data else ReadFile("", "utf-8", "\n")
    except ProgramError:
        return {"name": printable(name), "text": None, "encoding": "", "newline": "\n", "number": number}
    return {"name": printable(name), **read._asdict(), "number": number}
