"""The run of the page, what is asked of it and of drawings, and the files that they gave.

The run of the page: one at a time, in a process of its own, with its files in a folder that goes with the server.

What more is made of a finished run, a film, pictures or fault drills, is made in such a process too, and stands beside
its files.

What the page asks of runs and drawings, and the files that they gave.

Requests of the page: the texts that one carries, and the answer to one that the page does not send.

Files as one zip, made while it is sent: however large they are, a piece of them is held at a time.
"""

import asyncio
import contextlib
import io
import json
import os
import shutil
from collections.abc import Awaitable, Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, Final, TypeAlias
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, Response, StreamingResponse

from parser.text.encoding import printable
from sim.serve.page.child import Child, Life, begun
from sim.serve.page.drawings import LOOK_KEYS, MAKE_KEYS, PLAN_KEYS, Drawings, safe_name
from sim.serve.page.machines import machine_files
from sim.serve.page.programs import Programs
from sim.setup.settable import FIELDS, TAPER_FIELDS

KEYS: Final = ("machine", "technology", *FIELDS, "offset_mm", "side", *TAPER_FIELDS)
"""What the page may say of a run, as texts; empty ones leave what is usual."""
MORE_KEYS: Final = ("job", "form", "seconds", "set", "language")
"""What it may say of a film, of pictures, or of fault drills."""
_IDLE: Final[dict[str, Any]] = {"state": "idle"}
_MORE: Final = ("film", "pictures", "drills")
_RUNNER: Final = "sim.serve.page.runner"


class Runs:
    """The run of the page, and its files.

    Parameters
    ----------
    folder
        Of its files; who gave it clears it away.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._number = 0
        self._child: Child | None = None
        self._following: asyncio.Task[None] | None = None
        self._state = _IDLE
        self._turn = asyncio.Lock()  # two tabs may ask at the same moment
        self._asked: dict[str, str] = {}
        self._ran: dict[str, Any] = {}
        self._is_warm = self._is_over = False
        self._spare: Child | None = None

    @property
    def state(self) -> dict[str, Any]:
        """How far it is: ``state`` is idle, running, done, wrong or cancelled; more of it by its kind.

        Once the run has ended well it has its number, ``verdict``, ``machine`` and ``files``, whatever comes behind it.
        """
        if not self._ran:
            return self._state
        files = [{"name": name, "bytes": size} for name, size in self.files(self._ran["run"]).items()]
        return {**self._state, **self._ran, "files": files}

    async def start(self, name: str, text: bytes, query: dict[str, str]) -> None:
        """Run a text of a name, in place of the run before; ``drawing_file`` is what it is held against.

        Settings near ``near_file`` say how it is read; each is empty where there is none.
        """
        async with self._turn:
            await self._start(name, text, query)

    async def make(self, query: dict[str, str]) -> None:
        """Make a film, pictures or fault drills of the finished run; nothing where there is none."""
        async with self._turn:
            if self._ran and query["job"] in _MORE:
                await self._end()
                await self._begin({**self._asked, **{key: query[key] for key in MORE_KEYS}})

    async def draft(self, query: dict[str, str]) -> None:
        """Make a program of ``drawing_file``, which is told in ``result_file``."""
        async with self._turn:
            await self._end()
            await self._begin({**query, "machine_files": str(machine_files(self._folder)), "job": "program"})

    async def warm(self) -> None:
        """Have a process ready for the next job from now on: it begins to compute at once."""
        async with self._turn:
            self._is_warm = not self._is_over
            await self._spared()

    async def end(self) -> None:
        """End the run that is on, and the process that waits for the next one."""
        async with self._turn:
            self._is_warm, self._is_over = False, True
            await self._end()
            spare, self._spare = self._spare, None
            if spare is not None:
                await spare.close()

    async def _spared(self) -> None:
        if self._is_warm and self._spare is None:
            self._spare = await begun(_RUNNER, ahead=True)

    async def cancel(self) -> None:
        """End the run that is on, if one is."""
        async with self._turn:
            await self._end()

    async def _start(self, name: str, text: bytes, query: dict[str, str]) -> None:
        await self._end()
        self._number += 1
        self._ran = {}
        # Who still looks at the run before this one may; the one before that goes.
        shutil.rmtree(self._folder / str(self._number - 2), ignore_errors=True)
        folder = self._folder / str(self._number)
        file = folder / "program" / safe_name(name)
        file.parent.mkdir(parents=True)
        file.write_bytes(text)
        self._asked = {
            **{key: query[key] for key in (*KEYS, "drawing_file", "near_file")},
            "machine_files": str(machine_files(self._folder)),
            "file": str(file),
            "folder": str(self._made_in(self._number)),
        }
        await self._begin({**self._asked, "job": "run"})

    async def _end(self) -> None:
        child, following = self._child, self._following
        self._child = self._following = None
        if child is None or following is None:
            return
        child.end()
        await following
        if self._state["state"] == "running":
            self._state = {**self._state, "state": "cancelled"}

    def file(self, number: int, name: str) -> Path | None:
        """A file of a run; None where none of this name stands in its folder."""
        return self._made_in(number) / name if name in self.files(number) else None

    def files(self, number: int) -> dict[str, int]:
        """How many bytes each file of a run has, by their names: what stands in its folder, no folder and no link."""
        made: dict[str, int] = {}
        with contextlib.suppress(FileNotFoundError), os.scandir(self._made_in(number)) as entries:
            for entry in sorted(entries, key=lambda entry: entry.name):
                with contextlib.suppress(FileNotFoundError):  # a film is just being put in place of the last one
                    if entry.is_file(follow_symlinks=False):
                        made[entry.name] = entry.stat(follow_symlinks=False).st_size
        return made

    def _made_in(self, number: int) -> Path:
        return self._folder / str(number) / "out"

    async def _begin(self, query: dict[str, str]) -> None:
        self._state = {"state": "running", "job": query["job"], "run": self._number}
        self._child = await self._worker(query["job"])
        self._following = asyncio.create_task(self._follow(self._child, query))

    async def _worker(self, job: str) -> Child:
        """A process for a job: the one that waits for it, where there is one."""
        if job == "program":
            return await begun("sim.serve.page.drafter")
        spare, self._spare = self._spare, None
        return spare if spare is not None and spare.is_alive else await begun(_RUNNER)

    async def _follow(self, child: Child, query: dict[str, str]) -> None:
        last: dict[str, Any] = {}
        begin = self._state
        async for last in child.tells(query):
            if "stage" in last:
                self._state = {**begin, **last}
        if "done" in last:
            self._ran = {"run": begin["run"], **last["done"]} if query["job"] == "run" else self._ran
            self._state = {**begin, "state": "done"}
        elif "wrong" in last:
            self._state = {**begin, "state": "wrong", "why": _by_names(last["wrong"], query)}
        elif child is self._child:
            self._state = {**begin, "state": "wrong", "why": None}
        await self._spared()  # now: before, it would have taken time from the job


def _by_names(why: dict[str, str], query: dict[str, str]) -> dict[str, str]:
    """A message in both languages, in which files of the page stand by their names alone."""
    folders = {str(Path(query[key]).parent) for key in ("file", "drawing_file") if query.get(key)}
    for folder in folders:
        why = {language: text.replace(f"{folder}{os.sep}", "") for language, text in why.items()}
    return {language: printable(text) for language, text in why.items()}


_PIECE: Final = 1 << 18


def zipped(files: Iterable[Path]) -> Iterator[bytes]:
    """The bytes of a zip of files, each under its own name; without their times, so that the same give the same.

    OSError where one cannot be read.
    """
    made = _Sink()
    with ZipFile(made, "w") as archive:
        for file in files:
            entered = ZipInfo(file.name)
            entered.compress_type = ZIP_DEFLATED
            with file.open("rb") as data, archive.open(entered, "w", force_zip64=True) as entry:
                while piece := data.read(_PIECE):
                    entry.write(piece)
                    yield made.drained()
    yield made.drained()


class _Sink(io.RawIOBase):
    """Takes what is written, once, and cannot go back."""

    def __init__(self) -> None:
        self._held = bytearray()

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        piece = bytes(memoryview(data))  # type: ignore[arg-type]  # whatever has bytes
        self._held += piece
        return len(piece)

    def drained(self) -> bytes:
        """What came since the last time."""
        held_bytes, self._held = bytes(self._held), bytearray()
        return held_bytes


Work: TypeAlias = Callable[[Request], Awaitable[Response]]
"""What answers a request."""
BAD: Final = 400
MISSING: Final = 404
NOTHING: Final = 204


class BadRequestError(Exception):
    """A request that the page does not send."""


async def told(request: Request, *names: str) -> dict[str, str]:
    """The texts of a request by their names. BadRequestError where one is missing."""
    try:
        texts = json.loads(await request.body())
    except (ValueError, RecursionError) as error:
        raise BadRequestError from error
    if not isinstance(texts, dict) or not all(isinstance(texts.get(name), str) for name in names):
        raise BadRequestError
    return {name: _whole(texts[name]) for name in names}


def _whole(text: str) -> str:
    """A text with U+FFFD in place of each half of a surrogate pair, which no encoding has; all places stay."""
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def name_of(work: Work) -> str:
    """Of a request: that of the method that answers it."""
    return str(getattr(work, "__name__", ""))


def guarded(work: Work) -> Work:
    """The same, with an answer to requests that the page does not send."""

    async def answered(request: Request) -> Response:
        try:
            return await work(request)
        except (BadRequestError, ClientDisconnect):
            return Response(status_code=BAD)

    return answered


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


class Drawn:
    """Drawings: laid beneath a program, and made into one."""

    def __init__(self, drawings: Drawings, runs: Runs) -> None:
        self._drawings, self._runs = drawings, runs

    async def look(self, request: Request) -> Response:
        """The curves of a drawing as they lie beneath a text, and what there is to say of it."""
        query = await told(request, "drawing", *LOOK_KEYS)
        file = self._drawings.file(query["drawing"])
        if file is None:
            return Response(status_code=MISSING)
        return Response(await self._drawings.look(file, query), media_type="application/json")

    async def plan(self, request: Request) -> Response:
        """What would be cut of a drawing, as it lies beneath a text."""
        query = await told(request, "drawing", *PLAN_KEYS)
        file = self._drawings.file(query["drawing"])
        if file is None:
            return Response(status_code=MISSING)
        return Response(await self._drawings.plan(file, query), media_type="application/json")

    async def draft(self, request: Request) -> Response:
        """Make a program of a drawing."""
        query = await told(request, "drawing", *MAKE_KEYS)
        file = self._drawings.file(query["drawing"])
        if file is None:
            return Response(status_code=MISSING)
        files = {"drawing_file": str(file), "result_file": str(self._drawings.result(query["drawing"]))}
        await self._runs.draft({**query, **files})
        return JSONResponse(self._runs.state)

    async def drafted(self, request: Request) -> Response:
        """The program that was made of a drawing last."""
        number = (await told(request, "drawing"))["drawing"]
        result = self._drawings.result(number) if self._drawings.file(number) else None
        if result is None or not result.is_file():
            return Response(status_code=MISSING)
        return FileResponse(result, media_type="application/json")


class Running:
    """The run of the page."""

    def __init__(self, life: Life, runs: Runs, programs: Programs, drawings: Drawings) -> None:
        self._life, self._runs, self._programs, self._drawings = life, runs, programs, drawings

    async def run(self, request: Request) -> Response:
        """Run a text."""
        query = await told(request, "name", "text", "number", "drawing", *KEYS)
        files = {
            "drawing_file": str(self._drawings.file(query["drawing"]) or ""),
            "near_file": str(self._programs.file(query["number"]) or ""),
        }
        await self._runs.start(query["name"], query["text"].encode("utf-8", "replace"), {**query, **files})
        return JSONResponse(self._runs.state)

    async def more(self, request: Request) -> Response:
        """Make a film or pictures of the run."""
        await self._runs.make(await told(request, *MORE_KEYS))
        return JSONResponse(self._runs.state)

    async def progress(self, _: Request) -> Response:
        """How far it is."""
        self._life.note_page()
        return JSONResponse(self._runs.state)

    async def cancel(self, _: Request) -> Response:
        """End it."""
        await self._runs.cancel()
        return JSONResponse(self._runs.state)

    async def made(self, request: Request) -> Response:
        """A file that it made."""
        path = self._runs.file(request.path_params["number"], request.path_params["name"])
        if path is None:
            return Response(status_code=MISSING)
        kind = _KINDS.get(path.suffix, "application/octet-stream")
        return FileResponse(path, media_type=kind, headers={"content-security-policy": _OF_FILES})

    async def zip(self, request: Request) -> Response:
        """All files of a run."""
        number = request.path_params["number"]
        files = [self._runs.file(number, name) for name in self._runs.files(number)]
        if not files:
            return Response(status_code=MISSING)
        return StreamingResponse(zipped(filter(None, files)), media_type="application/zip")
