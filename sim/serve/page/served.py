"""The server: on the loopback, until its life is over or a signal ends it."""

import asyncio
import contextlib
import secrets
import signal
import socket
import sys
from collections.abc import Awaitable, Callable, Iterator, Sequence
from types import FrameType
from typing import Final

import uvicorn

from parser.findings.errors import DrycutError
from parser.findings.messages import system_message
from sim.base.files import scratch
from sim.serve.page.app import app_of
from sim.serve.page.drawings import Drawings
from sim.serve.page.guard import Address, Guard
from sim.serve.page.life import Life
from sim.serve.page.programs import Programs
from sim.serve.page.runs import Runs

_HOST: Final = "127.0.0.1"
_LOOK_S: Final = 0.2


class PortError(DrycutError, OSError):
    """A port that cannot be listened on; says why."""


class _Server(uvicorn.Server):
    """A server that leaves signals to who runs it."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        yield


def serve(programs: Programs, port: int, ready: Callable[[str], None]) -> None:
    """Serve the page of programs until it is over; `ready` is told the address once it can be opened.

    Port 0 is any free one. PortError where the port cannot be had.
    """
    life = Life()
    with _ended_by_signals(life), _listening(port) as listening, scratch() as folder:
        address = Address(f"{_HOST}:{listening.getsockname()[1]}", secrets.token_urlsafe(24))
        runs = Runs(folder)
        config = uvicorn.Config(
            Guard(app_of(programs, Drawings(folder), life, runs), address),
            lifespan="off",
            log_level="critical",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=2,
        )
        server = _Server(config)
        asyncio.run(_run(server, listening, life, lambda: ready(address.url), [runs.cancel, programs.end]))


async def _run(
    server: uvicorn.Server,
    listening: socket.socket,
    life: Life,
    ready: Callable[[], None],
    ends: Sequence[Callable[[], Awaitable[None]]],
) -> None:
    """Serve until the life is over; `ends` end what the server has begun."""
    serving = asyncio.create_task(server.serve(sockets=[listening]))
    while not server.started and not serving.done():
        await asyncio.sleep(0.01)
    ready()
    while not life.is_over and not serving.done():
        await asyncio.sleep(_LOOK_S)
    for end in ends:
        await end()
    server.should_exit = True
    await serving


@contextlib.contextmanager
def _listening(port: int) -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listening:
        try:
            _claim(listening)
            listening.bind((_HOST, port))
            listening.listen()  # from here on nobody else can have the port
        except OSError as error:
            raise PortError("port-taken", port=port, why=system_message(error)) from None
        yield listening


def _claim(listening: socket.socket) -> None:
    """Let the port be had while old connections to it are still dying, and let nobody share it.

    On Windows they do not hinder, and the option that helps elsewhere would let others take a port that is in use.
    https://learn.microsoft.com/windows/win32/winsock/using-so-reuseaddr-and-so-exclusiveaddruse
    """
    if sys.platform == "win32":
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_EXCLUSIVEADDRUSE, 1)
    else:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)


@contextlib.contextmanager
def _ended_by_signals(life: Life) -> Iterator[None]:
    def end(_: int, __: FrameType | None) -> None:
        life.end()

    before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
