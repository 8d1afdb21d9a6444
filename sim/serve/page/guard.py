"""Who may ask: the page that was given the address, in a browser of this machine, and nobody else.

The server listens on the loopback alone. Pages of other origins can send requests there all the same, and names of
other hosts can be made to lead there (DNS rebinding): so Host, Origin and what the browser says of the sender are held
against the own address, and the path begins with a token that no other page knows.
"""

import hmac
from collections.abc import Sequence
from typing import Final, NamedTuple

from starlette.types import ASGIApp, Message, Receive, Scope, Send

MOST_BYTES: Final = 64_000_000
"""Of what a page may send: a program of a million blocks."""
_HEADERS: Final = (
    (b"cache-control", b"no-store"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
)


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
            await _answer(send, refused)
            return
        if scope["path"] == f"/{self._address.token}":  # the address without its last slash, as people copy it
            await _answer(send, 308, [(b"location", f"{self._address.url}".encode())])
            return
        begins = len(self._address.token) + 1
        inner = {**scope, "path": scope["path"][begins:], "raw_path": scope["raw_path"][begins:]}
        await self._app(inner, _bounded(receive), _with_headers(send))

    def _refused(self, scope: Scope) -> int:
        """Status of a refusal; 0 where there is none."""
        headers = {name.lower(): value for name, value in scope["headers"]}
        if headers.get(b"host", b"").decode("latin-1") != self._address.host:
            return 421
        if headers.get(b"origin", self._address.origin.encode()).decode("latin-1") != self._address.origin:
            return 403
        if headers.get(b"sec-fetch-site", b"same-origin") not in {b"same-origin", b"none"}:
            return 403
        token = scope["path"].lstrip("/").partition("/")[0]
        if not hmac.compare_digest(token.encode("utf-8", "replace"), self._address.token.encode()):
            return 404
        length = headers.get(b"content-length", b"0")
        return 413 if not length.isdigit() or int(length) > MOST_BYTES else 0


async def _answer(send: Send, status: int, more: Sequence[tuple[bytes, bytes]] = ()) -> None:
    await send({"type": "http.response.start", "status": status, "headers": [*_HEADERS, *more]})
    await send({"type": "http.response.body", "body": b""})


def _bounded(receive: Receive) -> Receive:
    """The same, cut off where more comes than was said."""
    came = 0

    async def bounded() -> Message:
        nonlocal came
        message = await receive()
        came += len(message.get("body", b""))
        return {"type": "http.disconnect"} if came > MOST_BYTES else message

    return bounded


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", []), *_HEADERS]}
        await send(message)

    return sent
