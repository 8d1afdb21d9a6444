"""The run of the page: one at a time, in a process of its own, with its files in a folder that goes with the server."""

import asyncio
import contextlib
import json
import re
import sys
from pathlib import Path
from typing import Any, Final

from parser.text.encoding import printable

FILES: Final = ("replay.html", "report.html", "cut.png", "report.json")
KEYS: Final = ("machine", "thickness_mm", "wire_mm", "offset_mm", "side")
"""What the page may say of a run, as texts; empty ones leave what is usual."""
_SAFE: Final = re.compile(r"[^\w.-]")
_LONGEST_NAME: Final = 60
_IDLE: Final[dict[str, Any]] = {"state": "idle"}
_LONGEST_LINE: Final = 1 << 20


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
        self._process: asyncio.subprocess.Process | None = None
        self._following: asyncio.Task[None] | None = None
        self._state = _IDLE

    @property
    def state(self) -> dict[str, Any]:
        """How far it is: ``state`` is idle, running, done, wrong or cancelled; more of it by its kind."""
        return self._state

    async def start(self, name: str, text: bytes, asked: dict[str, str]) -> None:
        """Run a text of a name, in place of the run before."""
        await self.cancel()
        self._number += 1
        folder = self._folder / str(self._number)
        file = folder / "program" / _file_name(name)
        file.parent.mkdir(parents=True)
        file.write_bytes(text)
        self._state = {"state": "running", "run": self._number}
        # Nothing of the page reaches a command line: it goes through a pipe.
        self._process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", "sim.open.runner"),
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.DEVNULL,
            limit=_LONGEST_LINE,
        )
        told = {**{key: asked[key] for key in KEYS}, "file": str(file), "folder": str(folder / "out")}
        self._following = asyncio.create_task(self._follow(self._process, self._number, json.dumps(told)))

    async def cancel(self) -> None:
        """End the run that is on, if one is."""
        process, following = self._process, self._following
        self._process = self._following = None
        if process is None or following is None:
            return
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        await following
        if self._state["state"] == "running":
            self._state = {"state": "cancelled"}

    def file(self, number: int, name: str) -> Path | None:
        """A file of a finished run; None where there is none of this name."""
        path = self._folder / str(number) / "out" / name
        return path if name in FILES and path.is_file() else None

    async def _follow(self, process: asyncio.subprocess.Process, number: int, asked: str) -> None:
        assert process.stdin is not None  # noqa: S101 - asked for
        assert process.stdout is not None  # noqa: S101 - asked for
        last: dict[str, Any] = {}
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):
            process.stdin.write(f"{asked}\n".encode())
            await process.stdin.drain()
        process.stdin.close()
        async for line in process.stdout:
            last = json.loads(line)
            if "stage" in last:
                self._state = {"state": "running", "run": number, **last}
        await process.wait()
        if "done" in last:
            self._state = {"state": "done", "run": number, **last["done"]}
        elif "wrong" in last:
            self._state = {"state": "wrong", "run": number, "why": printable(last["wrong"])}
        elif process is self._process:
            self._state = {"state": "wrong", "run": number, "why": ""}


def _file_name(name: str) -> str:
    """A name for a file that nothing in it makes a way to another one, nor an option."""
    safe = _SAFE.sub("_", Path(name).name)[-_LONGEST_NAME:].lstrip(".-")
    return safe or "program"
