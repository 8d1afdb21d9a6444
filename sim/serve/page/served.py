"""The server: on the loopback, until its life is over or a signal ends it.

Who may ask: the page that was given the address, in a browser of this machine, and nobody else.

The server listens on the loopback alone. Pages of other origins can send requests there all the same, and names of
other hosts can be made to lead there (DNS rebinding): so Host, Origin and what the browser says of the sender are held
against the own address, and the path begins with a token that no other page knows.
"""

import asyncio
import hmac
import secrets
import socket
from collections.abc import Awaitable, Callable, Coroutine, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

import uvicorn
from starlette.types import ASGIApp, Receive, Scope, Send

from sim.base.files import scratch
from sim.serve.listening import LOOPBACK, Server, answer, bounded, ended_by_signals, listening_on, with_headers
from sim.serve.page.app import Stores, app_of
from sim.serve.page.child import Life
from sim.serve.page.drawings import Drawings
from sim.serve.page.machines import Machines
from sim.serve.page.programs import Programs
from sim.serve.page.runs import Runs

MOST_BYTES: Final = 64_000_000
"""Of what a page may send: a program of a million blocks."""


class Address(NamedTuple):
    """Where the page is: host with port, and the token that its path begins with."""

    host: str
    token: str

    @property
    def origin(self) -> str:
        """Of the page."""
        return f"http://{self.host}"

    @property
    def url(self) -> str:
        """Of the page."""
        return f"{self.origin}/{self.token}/"


class Guard:
    """Lets through what comes from the page, with its path behind the token; all else gets no answer but a number."""

    def __init__(self, app: ASGIApp, address: Address) -> None:
        self._app, self._address = app, address

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request."""
        if scope["type"] != "http":
            return
        refused = self._refused(scope)
        if refused:
            await answer(send, refused)
            return
        if scope["path"] == f"/{self._address.token}":  # the address without its last slash, as people copy it
            await answer(send, 308, [(b"location", f"{self._address.url}".encode())])
            return
        begins = len(self._address.token) + 1
        inner = {**scope, "path": scope["path"][begins:], "raw_path": scope["raw_path"][begins:]}
        await self._app(inner, bounded(receive, MOST_BYTES), with_headers(send))

    def _refused(self, scope: Scope) -> int:
        """Status of a refusal; 0 where there is none."""
        headers = {name.lower(): value for name, value in scope["headers"]}
        if headers.get(b"host", b"").decode("latin-1") != self._address.host:
            return 421
        if headers.get(b"origin", self._address.origin.encode()).decode("latin-1") != self._address.origin:
            return 403
        token, _, inner = scope["path"].lstrip("/").partition("/")
        is_own = headers.get(b"sec-fetch-site", b"same-origin") in {b"same-origin", b"none"}
        if not is_own and (inner or not _goes_to_a_page(scope, headers)):
            return 403
        if not hmac.compare_digest(token.encode("utf-8", "replace"), self._address.token.encode()):
            return 404
        length = headers.get(b"content-length", b"0")
        return 413 if not length.isdigit() or int(length) > MOST_BYTES else 0


def _goes_to_a_page(scope: Scope, headers: dict[bytes, bytes]) -> bool:
    """Whether a tab of the browser goes to the address, as from the file that leads there: no page can read it then."""
    return bool(
        scope["method"] == "GET"
        and headers.get(b"sec-fetch-mode") == b"navigate"
        and headers.get(b"sec-fetch-dest") == b"document"
    )


_LOOK_S: Final = 0.2
_WAY: Final = "drycut.html"
_WAY_PAGE: Final = """\
<!DOCTYPE html>
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={url}">
<title>drycut</title>
<a href="{url}">drycut</a>
"""


def serve(programs: Programs, port: int, ready: Callable[[str, Path], None]) -> None:
    """Serve the page of programs until it is over; `ready` is told the address once it can be opened, and a way there.

    The way is a page that leads to the address, in a file that only its owner reads: any user of the machine sees what
    stands in a command line, such as that of a browser. Port 0 is any free one. PortError where the port cannot be had.
    """
    life = Life()
    with ended_by_signals(life.end), listening_on(port) as listening, scratch() as folder:
        address = Address(f"{LOOPBACK}:{listening.getsockname()[1]}", secrets.token_urlsafe(24))
        runs, drawings = Runs(folder), Drawings(folder)
        app = app_of(programs, Stores(drawings, Machines(folder)), life, runs)
        config = uvicorn.Config(
            Guard(app, address),
            lifespan="off",
            log_level="critical",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=2,
        )
        server = Server(config)
        way = way_to(address, folder)
        ends = [runs.end, drawings.end, programs.end]
        opening = _Opening(lambda: ready(address.url, way), app.state.ahead)
        asyncio.run(_run(server, listening, life, opening, ends))


def way_to(address: Address, folder: Path) -> Path:
    """A page that leads to an address, written into a folder that others may not look into."""
    file = folder / _WAY
    file.touch(0o600)
    file.write_text(_WAY_PAGE.format(url=address.url), "utf-8")
    return file


class _Opening(NamedTuple):
    """What is done once requests are answered: who waits for it is told, and work of the first page is done ahead."""

    ready: Callable[[], None]
    ahead: Callable[[], Coroutine[Any, Any, None]]


async def _run(
    server: uvicorn.Server,
    listening: socket.socket,
    life: Life,
    opening: "_Opening",
    ends: Sequence[Callable[[], Awaitable[None]]],
) -> None:
    """Serve until the life is over; `opening` is done once requests are answered, `ends` end what was begun."""
    serving = asyncio.create_task(server.serve(sockets=[listening]))
    while not server.started and not serving.done():
        await asyncio.sleep(0.01)
    opening.ready()
    ahead = asyncio.create_task(opening.ahead())
    while not life.is_over and not serving.done():
        await asyncio.sleep(_LOOK_S)
    await ahead
    for end in ends:
        await end()
    server.should_exit = True
    await serving
