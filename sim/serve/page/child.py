"""A process of drycut's own: it is told one thing, tells others a line each, and can be ended at any moment."""

import asyncio
import contextlib
import json
import sys
from collections.abc import AsyncIterator
from typing import Any, Final

_LONGEST_LINE: Final = 1 << 20


class Child:
    """The process of a module, from `begun`."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self._process = process

    async def tells(self, asked: object) -> AsyncIterator[Any]:
        """What it tells once it was told what is asked, until it ends; all of it is JSON.

        Nothing of the page reaches a command line: it goes through a pipe.
        """
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None  # noqa: S101 - asked for
        assert stdout is not None  # noqa: S101 - asked for
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):
            stdin.write(f"{json.dumps(asked)}\n".encode())
            await stdin.drain()
        stdin.close()
        async for line in stdout:
            if line.endswith(b"\n"):  # else it was ended in the middle of it
                yield json.loads(line)
        await self._process.wait()

    def end(self) -> None:
        """End it at once."""
        with contextlib.suppress(ProcessLookupError):
            self._process.kill()


async def begun(module: str) -> Child:
    """A new process of a module of drycut; nothing is imported from the folder that drycut was started in."""
    pipe = asyncio.subprocess.PIPE
    command = (sys.executable, "-P", "-m", module)
    nowhere = asyncio.subprocess.DEVNULL
    return Child(
        await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe, stderr=nowhere, limit=_LONGEST_LINE)
    )
