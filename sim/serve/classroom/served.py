"""The server of a class: on the loopback for the teacher, and for pupils in the network only where that is asked for.

The teacher's page shows marks as they come in, and how pupils come to the lesson.
"""

import asyncio
import contextlib
import secrets
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Final, NamedTuple

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.routing import Route

from sim.base.files import scratch
from sim.make.lessons import ReadyLesson
from sim.serve.classroom.hand_ins import HandIns
from sim.serve.classroom.pupils import Doors, new_code, pupils_app, taken
from sim.serve.listening import LOOPBACK, Server, ended_by_signals, listening_on
from sim.serve.page.served import Address, Guard, way_to
from sim.show.class_page import class_page, pupil_page
from sim.show.class_page.page import RoomDoor
from sim.show.lesson_page import lesson_page

_ANY: Final = "0.0.0.0"  # noqa: S104 - where the network is asked for
_NOWHERE: Final = "192.0.2.1"
"""An address that is no one's (RFC 5737): on the way there stands the own one. Nothing is sent."""
_LOOK_S: Final = 0.2


class Opened(NamedTuple):
    """What a teacher is told: where the own page is, a file that leads there, and how pupils come to the lesson."""

    teacher: str
    way: Path
    pupils: tuple[str, ...]
    code: str


class Life:
    """Until somebody ends it."""

    is_over = False

    def end(self) -> None:
        """End it."""
        self.is_over = True


def serve_class(
    ready: ReadyLesson, folder: Path, port: int, *, network: bool, on_open: Callable[[Opened], None]
) -> None:
    """Serve a lesson until a signal ends it; hand-ins are written into a folder.

    PortError where the port cannot be had. In a network, pupils come by the port, and the teacher's page has another.
    """
    life, hand_ins = Life(), HandIns(ready, folder)
    with contextlib.ExitStack() as stack:
        stack.enter_context(ended_by_signals(life.end))
        own = stack.enter_context(listening_on(0 if network else port))
        scratch_folder = stack.enter_context(scratch())
        address = Address(f"{LOOPBACK}:{own.getsockname()[1]}", secrets.token_urlsafe(24))
        door = RoomDoor((), "")
        servers = []
        if network:
            shared = stack.enter_context(listening_on(port, _ANY))
            hosts = hosts_of(shared)
            others = [host for host in hosts if not host.startswith(LOOPBACK)] or hosts
            door = RoomDoor(tuple(f"http://{host}/" for host in others), new_code())
            app = pupils_app(hand_ins, lesson_page(ready, hands_in=True), door.code)
            guard = Doors(app, frozenset(hosts))
            servers.append((Server(_config(guard)), shared))
        teacher = Guard(_teacher_app(ready, hand_ins, door), address)
        servers.append((Server(_config(teacher)), own))
        opened = Opened(address.url, way_to(address, scratch_folder), door.addresses, door.code)
        asyncio.run(_run(servers, life, lambda: on_open(opened)))


def _config(app: Doors | Guard) -> uvicorn.Config:
    return uvicorn.Config(
        app,
        lifespan="off",
        log_level="critical",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=2,
        limit_concurrency=500,
    )


def hosts_of(listening: socket.socket) -> list[str]:
    """Host and port by which others reach a port of this machine: the address of its way out, and the loopback."""
    port = listening.getsockname()[1]
    found = []
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as way:
        way.connect((_NOWHERE, 9))
        found.append(way.getsockname()[0])
    with contextlib.suppress(OSError):
        found += socket.gethostbyname_ex(socket.gethostname())[2]
    return [f"{host}:{port}" for host in dict.fromkeys([*found, LOOPBACK])]


def _teacher_app(ready: ReadyLesson, hand_ins: HandIns, door: RoomDoor) -> Starlette:
    teacher = _Teacher(ready, hand_ins, door)
    return Starlette(
        routes=[
            Route("/", teacher.marks, methods=["GET"]),
            Route("/number", teacher.number, methods=["GET"]),
            Route("/lesson", teacher.lesson, methods=["GET"]),
            Route("/hand-in", teacher.hand_in, methods=["POST"]),
            Route("/pupil-{number:int}.html", teacher.pupil, methods=["GET"]),
        ]
    )


class _Teacher:
    def __init__(self, ready: ReadyLesson, hand_ins: HandIns, door: RoomDoor) -> None:
        self._ready, self._hand_ins, self._door = ready, hand_ins, door
        self._one = asyncio.Lock()

    async def marks(self, _: Request) -> Response:
        """Marks so far, and how pupils come to the lesson."""
        return HTMLResponse(await run_in_threadpool(self._page))

    def _page(self) -> str:
        result = self._hand_ins.result()
        files = tuple(f"pupil-{number}.html" for number in range(1, len(result.marks) + 1))
        return class_page(result, files, self._door)

    async def number(self, _: Request) -> Response:
        """How many hand-ins came so far: the page looks whether there are more."""
        return JSONResponse(self._hand_ins.number)

    async def lesson(self, _: Request) -> Response:
        """The lesson itself, to try it."""
        return HTMLResponse(lesson_page(self._ready, hands_in=True))

    async def hand_in(self, request: Request) -> Response:
        """Take a hand-in of this machine."""
        return await taken(self._hand_ins, await request.body(), self._one)

    async def pupil(self, request: Request) -> Response:
        """The page of a pupil."""
        result = await run_in_threadpool(self._hand_ins.result)
        at = int(request.path_params["number"]) - 1
        if not 0 <= at < len(result.marks):
            return Response(status_code=404)
        return HTMLResponse(pupil_page(result, at, "./"))


async def _run(servers: list[tuple[Server, socket.socket]], life: Life, ready: Callable[[], None]) -> None:
    serving = [asyncio.create_task(server.serve(sockets=[listening])) for server, listening in servers]
    while not all(server.started for server, _ in servers) and not any(task.done() for task in serving):
        await asyncio.sleep(0.01)
    ready()
    while not life.is_over and not any(task.done() for task in serving):
        await asyncio.sleep(_LOOK_S)
    for server, _ in servers:
        server.should_exit = True
    await asyncio.gather(*serving)
