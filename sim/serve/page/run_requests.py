"""What the page asks of runs and drawings, and the files that they gave.

Requests of the page: the texts that one carries, and the answer to one that the page does not send.

Files as one zip, made while it is sent: however large they are, a piece of them is held at a time.
"""

import io
import json
from collections.abc import Awaitable, Callable, Iterable, Iterator
from pathlib import Path
from typing import Final, TypeAlias
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, Response, StreamingResponse

from sim.serve.page.drawings import LOOK_KEYS, MAKE_KEYS, Drawings
from sim.serve.page.life import Life
from sim.serve.page.programs import Programs
from sim.serve.page.runs import KEYS, MORE_KEYS, Runs

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
