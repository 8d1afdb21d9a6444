"""The requests of the page, answered."""

import asyncio
import json
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any, Final, TypeAlias

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, Response, StreamingResponse
from starlette.routing import Route

from parser.findings.errors import FileUnreadableError, ProgramError
from parser.text.encoding import printable
from sim.open.answers import ReadFile, answer, file_of, read_file
from sim.open.drawings import LOOK_KEYS, MAKE_KEYS, Drawings, is_drawing
from sim.open.life import Life
from sim.open.lines import changed_lines
from sim.open.programs import Programs
from sim.open.row import row_or_why
from sim.open.runs import KEYS, MORE_KEYS, Runs
from sim.open.zipped import zipped
from sim.show.open_page.page import open_page

_Work: TypeAlias = Callable[[Request], Awaitable[Response]]
_BAD: Final = 400
_MISSING: Final = 404
_NOTHING: Final = 204
_OF_FILES: Final = (
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; "
    "form-action 'none'; base-uri 'none'; frame-ancestors 'self'"
)
"""Pages of a run hold all that they show: they may ask nobody, this server neither; the page itself may frame them."""
_KINDS: Final = {
    ".html": "text/html; charset=utf-8",
    ".json": "application/json",
    ".png": "image/png",
    ".apng": "image/apng",
    ".gif": "image/gif",
    ".webp": "image/webp",
    ".mp4": "video/mp4",
}


def app_of(programs: Programs, drawings: Drawings, life: Life, runs: Runs) -> Starlette:
    """The application behind the guard."""
    files, texts = _Files(programs, drawings, life), _Checks(programs)
    running, drawn = _Running(life, runs, programs, drawings), _Drawn(drawings, runs)
    works: list[_Work] = [files.first, files.read, files.save, files.alive, files.close]
    works += [files.program, files.rows, files.again, files.row, drawn.look, drawn.draft, drawn.drafted]
    works += [texts.check, texts.version, texts.lines, running.run, running.more, running.progress, running.cancel]
    return Starlette(
        routes=[
            Route("/", files.page, methods=["GET"]),
            Route("/run/{number:int}/{name}", running.made, methods=["GET"]),
            Route("/zip/{number:int}", running.zip, methods=["GET"]),
            *(Route(f"/{_name_of(work)}", _guarded(work), methods=["POST"]) for work in works),
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
        return JSONResponse(
            {**read, "why": {language: printable(why) for language, why in opened.why._asdict().items()}}
            if opened.why
            else read
        )

    async def program(self, request: Request) -> Response:
        """The program of a number, as its file is now."""
        number = (await _told(request, "number"))["number"]
        try:
            data = await run_in_threadpool(self._programs.read, number)
        except FileUnreadableError:
            return Response(status_code=_MISSING)
        file = self._programs.file(number)
        return JSONResponse(_read(file.name if file else "", data, number))

    async def rows(self, request: Request) -> Response:
        """What is known of the programs of the folder, behind those that the page knows."""
        self._life.seen()
        told = await _told(request, "known", "list")
        if not all(number.isdecimal() for number in told.values()):
            raise _BadRequestError
        return JSONResponse(await self._programs.rows(int(told["known"][:9]), int(told["list"][:9])))

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
        told = await _told(request, "text", "encoding", "newline")
        data = file_of(ReadFile(told["text"], told["encoding"], told["newline"]))
        return Response(data, media_type="application/octet-stream")

    async def alive(self, _: Request) -> Response:
        """The page is still open."""
        self._life.seen()
        return Response(status_code=_NOTHING)

    async def close(self, _: Request) -> Response:
        """The server is to end."""
        self._life.end()
        return Response(status_code=_NOTHING)


class _Drawn:
    """Drawings: laid beneath a program, and made into one."""

    def __init__(self, drawings: Drawings, runs: Runs) -> None:
        self._drawings, self._runs = drawings, runs

    async def look(self, request: Request) -> Response:
        """The curves of a drawing as they lie beneath a text, and what there is to say of it."""
        told = await _told(request, "drawing", *LOOK_KEYS)
        file = self._drawings.file(told["drawing"])
        if file is None:
            return Response(status_code=_MISSING)
        return Response(await self._drawings.look(file, told), media_type="application/json")

    async def draft(self, request: Request) -> Response:
        """Make a program of a drawing."""
        told = await _told(request, "drawing", *MAKE_KEYS)
        file = self._drawings.file(told["drawing"])
        if file is None:
            return Response(status_code=_MISSING)
        files = {"drawing_file": str(file), "result_file": str(self._drawings.result(told["drawing"]))}
        await self._runs.draft({**told, **files})
        return JSONResponse(self._runs.state)

    async def drafted(self, request: Request) -> Response:
        """The program that was made of a drawing last."""
        number = (await _told(request, "drawing"))["drawing"]
        result = self._drawings.result(number) if self._drawings.file(number) else None
        if result is None or not result.is_file():
            return Response(status_code=_MISSING)
        return FileResponse(result, media_type="application/json")


class _Running:
    """The run of the page."""

    def __init__(self, life: Life, runs: Runs, programs: Programs, drawings: Drawings) -> None:
        self._life, self._runs, self._programs, self._drawings = life, runs, programs, drawings

    async def run(self, request: Request) -> Response:
        """Run a text."""
        told = await _told(request, "name", "text", "number", "drawing", *KEYS)
        files = {
            "drawing_file": str(self._drawings.file(told["drawing"]) or ""),
            "near_file": str(self._programs.file(told["number"]) or ""),
        }
        await self._runs.start(told["name"], told["text"].encode("utf-8", "replace"), {**told, **files})
        return JSONResponse(self._runs.state)

    async def more(self, request: Request) -> Response:
        """Make a film or pictures of the run."""
        await self._runs.make(await _told(request, *MORE_KEYS))
        return JSONResponse(self._runs.state)

    async def progress(self, _: Request) -> Response:
        """How far it is."""
        self._life.seen()
        return JSONResponse(self._runs.state)

    async def cancel(self, _: Request) -> Response:
        """End it."""
        await self._runs.cancel()
        return JSONResponse(self._runs.state)

    async def made(self, request: Request) -> Response:
        """A file that it made."""
        path = self._runs.file(request.path_params["number"], request.path_params["name"])
        if path is None:
            return Response(status_code=_MISSING)
        kind = _KINDS.get(path.suffix, "application/octet-stream")
        return FileResponse(path, media_type=kind, headers={"content-security-policy": _OF_FILES})

    async def zip(self, request: Request) -> Response:
        """All files of a run."""
        number = request.path_params["number"]
        files = [self._runs.file(number, name) for name in self._runs.files(number)]
        if not files:
            return Response(status_code=_MISSING)
        return StreamingResponse(zipped(filter(None, files)), media_type="application/zip")


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
        told = await _told(request, "before", "after")
        return await self._lines.answered(changed_lines, told["before"], told["after"])

    async def _asked(self, request: Request) -> tuple[str, Path | None, str]:
        told = await _told(request, "name", "text", "number")
        return told["name"], self._programs.file(told["number"]), told["text"]


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
                return Response(status_code=_NOTHING)
            return JSONResponse(await run_in_threadpool(work, *asked))


class _BadRequestError(Exception):
    """A request that the page does not send."""


async def _told(request: Request, *names: str) -> dict[str, str]:
    """The texts of a request by their names."""
    try:
        told = json.loads(await request.body())
    except (ValueError, RecursionError) as error:
        raise _BadRequestError from error
    if not isinstance(told, dict) or not all(isinstance(told.get(name), str) for name in names):
        raise _BadRequestError
    return {name: told[name] for name in names}


def _name_of(work: _Work) -> str:
    """Of a request: that of the method that answers it."""
    return str(getattr(work, "__name__", ""))


def _guarded(work: _Work) -> _Work:
    async def answered(request: Request) -> Response:
        try:
            return await work(request)
        except (_BadRequestError, ClientDisconnect):
            return Response(status_code=_BAD)

    return answered


def _read(name: str, data: bytes, number: str = "") -> dict[str, Any]:
    """A file as the page has it; no text where it is none; its number, where it is one of the programs."""
    try:
        read = read_file(data) if data else ReadFile("", "utf-8", "\n")
    except ProgramError:
        return {"name": printable(name), "text": None, "encoding": "", "newline": "\n", "number": number}
    return {"name": printable(name), **read._asdict(), "number": number}
