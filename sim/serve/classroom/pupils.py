"""Who may ask for the lesson: browsers in the network that have the code of the class, and nobody else.

A page elsewhere cannot read answers or hand in: Host and Origin are held against the own addresses. The code has six
digits: who tries many gets no answer for a while.
"""

import asyncio
import hmac
import secrets
import time
from collections import deque
from typing import Final

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response
from starlette.routing import Route
from starlette.types import ASGIApp, Receive, Scope, Send

from sim.serve.classroom.hand_ins import HandIns
from sim.serve.listening import answer, bounded, with_headers
from sim.show.class_page import entry_page
from sim.teach.handins import MOST_BYTES, HandInError

COOKIE: Final = "drycut"
_MOST_TRIES: Final = 10
"""Of one address in a minute; of all together ten times as many."""
_MINUTE_S: Final = 60.0
_CODE_BYTES: Final = 1000


def new_code() -> str:
    """Six digits that nobody guesses."""
    return f"{secrets.randbelow(1_000_000):06}"


class Doors:
    """Lets through what comes for one of the own addresses, from no page elsewhere, and not too long."""

    def __init__(self, app: ASGIApp, hosts: frozenset[str]) -> None:
        self._app, self._hosts = app, hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request."""
        if scope["type"] != "http":
            return
        refused = self._refused(scope)
        if refused:
            await answer(send, refused)
            return
        await self._app(scope, bounded(receive, MOST_BYTES), with_headers(send))

    def _refused(self, scope: Scope) -> int:
        """Status of a refusal; 0 where there is none."""
        headers = {name.lower(): value for name, value in scope["headers"]}
        host = headers.get(b"host", b"").decode("latin-1")
        if host not in self._hosts:
            return 421
        if headers.get(b"origin", f"http://{host}".encode()).decode("latin-1") != f"http://{host}":
            return 403
        is_own = headers.get(b"sec-fetch-site", b"same-origin") in {b"same-origin", b"none"}
        if not is_own and scope["method"] != "GET":
            return 403
        length = headers.get(b"content-length", b"0")
        return 413 if not length.isdigit() or int(length) > MOST_BYTES else 0


class Tries:
    """How often codes were tried in the last minute, by address."""

    def __init__(self) -> None:
        self._tries: deque[tuple[float, str]] = deque()

    def is_too_many(self, address: str) -> bool:
        """Note a try; whether it is one too many."""
        now = time.monotonic()
        while self._tries and self._tries[0][0] < now - _MINUTE_S:
            self._tries.popleft()
        own = sum(1 for _, each in self._tries if each == address)
        if own >= _MOST_TRIES or len(self._tries) >= 10 * _MOST_TRIES:
            return True
        self._tries.append((now, address))
        return False


def pupils_app(hand_ins: HandIns, lesson: str, code: str) -> Starlette:
    """What pupils see: the page where the code is entered, and behind it the lesson."""
    room = _Room(hand_ins, lesson, code)
    return Starlette(
        routes=[
            Route("/", room.page, methods=["GET"]),
            Route("/enter", room.enter, methods=["POST"]),
            Route("/hand-in", room.hand_in, methods=["POST"]),
        ]
    )


class _Room:
    def __init__(self, hand_ins: HandIns, lesson: str, code: str) -> None:
        self._hand_ins, self._lesson, self._code = hand_ins, lesson, code
        title = hand_ins.ready.lesson.title
        self._entry, self._wrong = entry_page(title), entry_page(title, "wrong-code")
        self._too_many = entry_page(title, "too-many")
        self._token, self._tries, self._one = secrets.token_urlsafe(24), Tries(), asyncio.Lock()

    def _is_in(self, request: Request) -> bool:
        return hmac.compare_digest(request.cookies.get(COOKIE, "").encode(), self._token.encode())

    async def page(self, request: Request) -> Response:
        """The lesson, or where its code is entered."""
        return HTMLResponse(self._lesson if self._is_in(request) else self._entry)

    async def enter(self, request: Request) -> Response:
        """Try a code; whoever has it is led to the lesson."""
        if self._tries.is_too_many(request.client.host if request.client else ""):
            return HTMLResponse(self._too_many, status_code=429)
        body = await request.body()
        tried = body[:_CODE_BYTES].decode("latin-1").rpartition("=")[2].strip()
        if not hmac.compare_digest(tried.encode(), self._code.encode()):
            return HTMLResponse(self._wrong, status_code=403)
        response = RedirectResponse("/", status_code=303)
        response.set_cookie(COOKIE, self._token, httponly=True, samesite="strict")
        return response

    async def hand_in(self, request: Request) -> Response:
        """Take a hand-in; answers with the points that it earns."""
        if not self._is_in(request):
            return Response(status_code=403)
        data = await request.body()
        return await taken(self._hand_ins, data, self._one)


async def taken(hand_ins: HandIns, data: bytes, one_at_a_time: asyncio.Lock) -> Response:
    """A hand-in that was sent, marked and written; answers with the points that it earns."""
    async with one_at_a_time:
        try:
            found = await run_in_threadpool(hand_ins.take, data)
        except HandInError as error:
            return JSONResponse({"why": error.why}, status_code=400)
    if found is None:
        return Response(status_code=507)
    return JSONResponse({"points": found[1]})
