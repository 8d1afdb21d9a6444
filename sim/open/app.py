"""The requests of the page, answered."""

import asyncio
import json
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any, Final, NamedTuple

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.routing import Route

from parser.findings.errors import ProgramError
from parser.text.encoding import printable
from sim.open.answers import ReadFile, answer, file_of, read_file
from sim.open.life import Life
from sim.show.open_page.page import open_page

_BAD: Final = 400
_SUPERSEDED: Final = 204


class Opened(NamedTuple):
    """The program that is open at the start: its file and bytes; no file where the page begins empty."""

    file: Path | None = None
    data: bytes = b""

    @property
    def name(self) -> str:
        """Of its file."""
        return self.file.name if self.file else ""


def app_of(opened: Opened, life: Life) -> Starlette:
    """The application behind the guard."""
    checks = _Checks(opened.file)

    async def page(_: Request) -> Response:
        life.seen()
        text, policy = open_page()
        return HTMLResponse(text, headers={"content-security-policy": policy})

    async def first(_: Request) -> Response:
        return JSONResponse(_read(opened.name, opened.data))

    async def read(request: Request) -> Response:
        name = request.query_params.get("name", "")
        return JSONResponse(_read(name, await request.body()))

    async def save(request: Request) -> Response:
        told = await _told(request, "text", "encoding", "newline")
        data = file_of(ReadFile(told["text"], told["encoding"], told["newline"]))
        return Response(data, media_type="application/octet-stream")

    async def alive(_: Request) -> Response:
        life.seen()
        return Response(status_code=204)

    async def close(_: Request) -> Response:
        life.end()
        return Response(status_code=204)

    routes = {"first": first, "read": read, "check": checks.check, "save": save, "alive": alive, "close": close}
    return Starlette(
        routes=[
            Route("/", page, methods=["GET"]),
            *(Route(f"/{name}", _guarded(work), methods=["POST"]) for name, work in routes.items()),
        ]
    )


class _Checks:
    """Checks one text at a time; of those that wait for their turn only the last one is looked at."""

    def __init__(self, first: Path | None) -> None:
        self._first = first
        self._turn = asyncio.Lock()
        self._last = 0

    async def check(self, request: Request) -> Response:
        """What is found in a text; `is_first` says that it is of the file that was open at the start."""
        told = await _told(request, "name", "text", "is_first")
        file = self._first if told["is_first"] == "yes" else None
        self._last += 1
        number = self._last
        async with self._turn:
            if number != self._last:
                return Response(status_code=_SUPERSEDED)
            return JSONResponse(await run_in_threadpool(answer, told["name"] or "program", file, told["text"]))


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


def _guarded(work: Callable[[Request], Awaitable[Response]]) -> Callable[[Request], Awaitable[Response]]:
    async def answered(request: Request) -> Response:
        try:
            return await work(request)
        except (_BadRequestError, ClientDisconnect):
            return Response(status_code=_BAD)

    return answered


def _read(name: str, data: bytes) -> dict[str, Any]:
    """A file as the page has it; no text where it is none."""
    try:
        read = read_file(data) if data else ReadFile("", "utf-8", "\n")
    except ProgramError:
        return {"name": printable(name), "text": None, "encoding": "", "newline": "\n"}
    return {"name": printable(name), **read._asdict()}
