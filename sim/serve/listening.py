"""What servers of drycut have in common: a port that nobody else has, headers of every answer, requests cut off.

What ends a server is told by who runs it: signals are left alone until then.
"""

import contextlib
import signal
import socket
import sys
from collections.abc import Callable, Iterator, Sequence
from types import FrameType
from typing import Final

import uvicorn
from starlette.types import Message, Receive, Send

from parser.findings.errors import DrycutError, system_message

LOOPBACK: Final = "127.0.0.1"
HEADERS: Final = (
    (b"cache-control", b"no-store"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
)
"""Of every answer: a page of ours is in no frame, stays in no cache and says nothing of itself elsewhere."""


async def answer(send: Send, status: int, more: Sequence[tuple[bytes, bytes]] = ()) -> None:
    """Answer with a number alone."""
    await send({"type": "http.response.start", "status": status, "headers": [*HEADERS, *more]})
    await send({"type": "http.response.body", "body": b""})


def bounded(receive: Receive, most_bytes: int) -> Receive:
    """The same, cut off where more comes than was said."""
    came = 0

    async def cut_off() -> Message:
        nonlocal came
        message = await receive()
        came += len(message.get("body", b""))
        return {"type": "http.disconnect"} if came > most_bytes else message

    return cut_off


def with_headers(send: Send) -> Send:
    """The same, with the headers of every answer."""

    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", []), *HEADERS]}
        await send(message)

    return sent


class PortError(DrycutError, OSError):
    """A port that cannot be listened on; says why."""


class Server(uvicorn.Server):
    """A server that leaves signals to who runs it."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Capture none."""
        yield


@contextlib.contextmanager
def listening_on(port: int, host: str = LOOPBACK) -> Iterator[socket.socket]:
    """A socket that listens on a port of a host, any free one where that is 0. PortError where it cannot be had."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listening:
        try:
            _claim(listening)
            listening.bind((host, port))
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
def ended_by_signals(end_: Callable[[], None]) -> Iterator[None]:
    """Let Ctrl-C and a request to end be told, meanwhile."""

    def end(_: int, __: FrameType | None) -> None:
        end_()

    before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
