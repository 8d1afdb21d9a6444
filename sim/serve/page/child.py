"""Processes of the page: one of drycut's own that can be ended at any moment, and how long the server itself lives.

A process of drycut's own: it is told one thing, tells others a line each, and can be ended at any moment.

How the process of a job speaks to the server: it is asked by a line of JSON on stdin, and tells lines of JSON on
stdout. The server holds its end of stdin as long as it lives: where that closes, the process ends too.

How long the server lives: until it is told to end, or no page has been open for a while.
"""

import asyncio
import contextlib
import json
import os
import sys
import threading
import time
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from pathlib import Path
from queue import SimpleQueue
from typing import Any, Final

from parser.findings.errors import DrycutError
from sim.base.progress import Progress
from sim.show.terminal.printer import write

PageRequest = dict[str, str]
"""What is asked of a job: texts by their names, of which the page says some."""
Job = Callable[[PageRequest], Mapping[str, Any]]
"""Does what it is asked for; what it returns is told last."""
_STDIN: Final = 0
_AHEAD: Final = "--ahead"
"""Argument of a process that was begun before there is a job."""
_STEPS: Final = 100
"""Of a stage, that are told."""


def do(jobs: Mapping[str, Job], warm_up: Callable[[], None] | None = None) -> None:
    """Do the job that is asked for; the last line says what came of it.

    A process that was begun ahead of its job warms up first.
    """
    if warm_up is not None and _AHEAD in sys.argv:
        warm_up()
    query = read_request()
    try:
        _tell(done=jobs[query["job"]](query))
    except DrycutError as error:
        _tell(wrong=error.in_both()._asdict())


def do_each(jobs: Mapping[str, Job]) -> None:
    """Do one of the jobs for each line that asks for it, one behind the other, until the server ends."""
    requests: SimpleQueue[PageRequest] = SimpleQueue()
    threading.Thread(target=_queue_requests, args=(requests,), daemon=True).start()
    while True:
        query = requests.get()
        try:
            _tell(done=jobs[query["job"]](query))
        except DrycutError as error:
            _tell(wrong=error.in_both()._asdict())


def _queue_requests(requests: "SimpleQueue[PageRequest]") -> None:
    for line in sys.stdin.buffer:
        requests.put(json.loads(line))
    os._exit(0)


def written(request: PageRequest, found: object) -> dict[str, Any]:
    """Nothing to tell: what was found, which may be large, goes as JSON into the file that was asked for."""
    Path(request["result_file"]).write_text(json.dumps(found), encoding="utf-8")
    return {}


def read_request() -> Any:
    """What this process is asked for. From then on it ends when the server does, however that ends."""
    line = sys.stdin.buffer.readline()
    if not line:  # the server ended before it had a job
        sys.exit(1)
    threading.Thread(target=_end_with_server, daemon=True).start()
    return json.loads(line)


def _end_with_server() -> None:
    while os.read(_STDIN, 1):  # by its number: a lock of Python's own stream would be held when this process ends
        pass
    os._exit(1)


def telling(stages: Sequence[str]) -> Progress:
    """Tells of the progress through these stages, by the hundredth of each."""
    last = ("", -1)

    def progress(stage: str, done: int, total: int) -> None:
        nonlocal last
        now = stage, _STEPS * done // total if total else _STEPS
        if now != last:
            last = now
            at = stages.index(stage) if stage in stages else len(stages) - 1
            _tell(stage=stage, at=at, of=len(stages), share=now[1] / _STEPS)

    return progress


def _tell(**values: Any) -> None:
    write(f"{json.dumps(values)}\n", "json")


_LONGEST_LINE: Final = 1 << 20


class Child:
    """The process of a module, from `begun`."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self._process = process

    async def tells(self, query: object) -> AsyncIterator[Any]:
        """What it tells once it was told what is asked, until it ends; all of it is JSON.

        Nothing of the page reaches a command line: it goes through a pipe, which stays open until then.
        """
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None  # noqa: S101 - asked for
        assert stdout is not None  # noqa: S101 - asked for
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):
            stdin.write(f"{json.dumps(query)}\n".encode())
            await stdin.drain()
        async for line in stdout:
            if line.endswith(b"\n"):  # else it was ended in the middle of it
                yield json.loads(line)
        await self._process.wait()
        stdin.close()

    async def answer(self, query: object) -> dict[str, Any]:
        """What it tells of one of the many things that it is asked (`do_each`); nothing where it ended."""
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None  # noqa: S101 - asked for
        assert stdout is not None  # noqa: S101 - asked for
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):
            stdin.write(f"{json.dumps(query)}\n".encode())
            await stdin.drain()
        line = await stdout.readline()
        return dict(json.loads(line)) if line.endswith(b"\n") else {}

    @property
    def is_alive(self) -> bool:
        """Whether it has not ended yet."""
        return self._process.returncode is None

    def end(self) -> None:
        """End it at once."""
        with contextlib.suppress(ProcessLookupError):
            self._process.kill()

    async def close(self) -> None:
        """End one that waits for what it is asked."""
        self.end()
        stdin = self._process.stdin
        assert stdin is not None  # noqa: S101 - asked for
        stdin.close()
        await self._process.wait()


async def begun(module: str, *, ahead: bool = False) -> Child:
    """A new process of a module of drycut; nothing is imported from the folder that drycut was started in.

    One that is begun `ahead` of its job has loaded and tried all that the job needs by the time it is told of it.
    """
    pipe = asyncio.subprocess.PIPE
    command = (sys.executable, "-P", "-m", module, *([_AHEAD] if ahead else []))
    nowhere = asyncio.subprocess.DEVNULL
    return Child(
        await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe, stderr=nowhere, limit=_LONGEST_LINE)
    )


FIRST_S: Final = 300.0
"""A browser may take its time to start, or the address be copied to it by hand."""
AWAY_S: Final = 60.0
"""Browsers wake hidden pages once a minute at least, and these say so each time: a closed one is silent."""


class Life:
    """Whether the page is still there; `now` tells the time, s."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._until = now() + FIRST_S
        self._is_ended = False

    def note_page(self) -> None:
        """The page was heard of."""
        self._until = self._now() + 2.0 * AWAY_S

    def end(self) -> None:
        """It is to end now."""
        self._is_ended = True

    @property
    def is_over(self) -> bool:
        """Whether it is to end."""
        return self._is_ended or self._now() > self._until
