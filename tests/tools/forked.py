"""Commands in processes that share one start: each has standard streams of its own kinds, and an end of its own."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, NamedTuple

from places import ROOT

# What a process finds as it starts: its three files as asked for, and Python's streams on them, or None for a closed
# one. As every process of Python it flushes its streams at its end, and what fails then is told and makes its exit code
# 120 (Py_FinalizeEx); the rest of that end, which takes longer than the commands, is left out.
_SERVER = """
import gc, importlib, json, os, sys
sys.path.insert(0, sys.argv[1])
for name in sys.argv[2:]:
    importlib.import_module(name)
from sim.cli import main

gc.freeze()

def opened(kind, number, log):
    if kind == "gone":
        reader, writer = os.pipe()
        os.close(reader)
        return writer
    flags = os.O_RDONLY if number == 0 else os.O_WRONLY | os.O_APPEND | os.O_CREAT
    return os.open({"full": "/dev/full", "null": os.devnull}.get(kind, f"{log}.{number}"), flags)

for line in sys.stdin:
    arguments, kinds, log = json.loads(line)
    process = os.fork()
    if process == 0:
        break
    print(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), flush=True)
else:
    sys.exit()
for number, kind in enumerate(kinds):
    os.close(number)
for number, kind in enumerate(kinds):
    if kind != "closed":
        made = opened(kind, number, log)
        if made != number:
            os.dup2(made, number)
            os.close(made)
sys.stdin, sys.stdout, sys.stderr = (
    None if kind == "closed" else open(number, "w" if number else "r", encoding="utf-8", closefd=False)
    for number, kind in enumerate(kinds)
)
sys.__stdin__, sys.__stdout__, sys.__stderr__ = own = sys.stdin, sys.stdout, sys.stderr
sys.argv = ["drycut", *arguments]
try:
    main()
except SystemExit as end:
    code = end.code
for stream in (sys.stdout, sys.stderr, *own[1:]):
    try:
        stream and stream.flush()
    except Exception as error:
        os.write(2, f"Exception ignored in {stream}: {error}".encode())
        code = 120
os._exit(code)
"""


class Ended(NamedTuple):
    """How a command ended, and what it wrote where its streams were kept."""

    code: int
    out: str
    err: str


class Forked:
    """Runs commands with streams of these kinds: kept, null, closed, full, gone (a pipe without a reader)."""

    def __init__(self, server: "subprocess.Popen[str]", folder: Path) -> None:
        self._server = server
        self._log = folder / "stream"

    def run(self, *arguments: object, stdin: str = "null", out: str = "kept", err: str = "kept") -> Ended:
        """Run a command to its end."""
        logs = [Path(f"{self._log}.{number}") for number in (1, 2)]
        for log in logs:
            log.unlink(missing_ok=True)
        question = json.dumps([list(map(str, arguments)), [stdin, out, err], str(self._log)])
        asked, told = _pipes(self._server)
        asked.write(f"{question}\n")
        asked.flush()
        code = int(told.readline())
        return Ended(code, *(log.read_text("utf-8") if log.exists() else "" for log in logs))


def _pipes(server: "subprocess.Popen[str]") -> tuple[IO[str], IO[str]]:
    assert server.stdin
    assert server.stdout
    return server.stdin, server.stdout


@contextmanager
def forked(folder: Path, loads: Sequence[str]) -> Iterator[Forked]:
    """A process that has loaded these modules, and runs commands in copies of itself, in a folder."""
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "NO_COLOR": "1"}
    command = [sys.executable, "-c", _SERVER, str(ROOT), *loads]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, cwd=folder, env=environment) as server:
        yield Forked(server, folder)
        _pipes(server)[0].close()
