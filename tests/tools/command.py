"""The command line for tests, in a process of its own, or in that of the tests where start-up is not what matters."""

import contextlib
import io
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from unittest import mock

from places import ROOT

from sim.cli import main
from sim.cli.spoken.commands import speak_as_asked

HANGUP = getattr(signal, "SIGHUP", signal.SIGTERM)
"""What a closed terminal sends; Windows has no such signal."""
_PROGRESS = re.compile(rb"drycut(?:: (?!error: )|\xef\xbc\x9a).*\d ?%.*")
_PLAIN = {"PYTHONPATH": str(ROOT), "PYTHONUTF8": "1", "COLUMNS": "100", "LC_ALL": "C.UTF-8", "NO_COLOR": "1"}


def run_command(
    *arguments: object, stdin: bytes = b"", cwd: Path | None = None, **environment: str
) -> subprocess.CompletedProcess[bytes]:
    """``drycut`` with arguments; it reads no locale but the one given, and knows no terminal."""
    return subprocess.run(
        [sys.executable, "-m", "drycut", *map(str, arguments)],
        input=stdin,
        capture_output=True,
        cwd=cwd,
        env={**os.environ, **_PLAIN, **environment},
        timeout=120,
        check=False,
    )


def without_progress(stderr: bytes) -> bytes:
    """What a command said beside its progress, which it tells where the machine is slow."""
    return b"".join(line for line in stderr.splitlines(keepends=True) if not _PROGRESS.fullmatch(line.rstrip()))


def run_inside(
    *arguments: object, cwd: Path | None = None, encoding: str = "utf-8", **environment: str
) -> subprocess.CompletedProcess[bytes]:
    """What `run_command` gives, a second sooner: no interpreter starts, and nothing is read from stdin."""
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding) for _ in range(2))
    command = ["drycut", *map(str, arguments)]
    handlers = {number: signal.getsignal(number) for number in (signal.SIGTERM, HANGUP)}
    with (
        mock.patch.object(sys, "argv", command),
        mock.patch.dict(os.environ, {**_PLAIN, **environment}),
        contextlib.chdir(cwd or Path.cwd()),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        code = _exit_code()
    speak_as_asked(())  # the language of a process ends with it
    for number, handler in handlers.items():
        signal.signal(number, handler)
    written = []
    for stream in (out, err):
        stream.flush()
        written.append(stream.buffer.getvalue())
    return subprocess.CompletedProcess(command, code, *written)


def _exit_code() -> object:
    try:
        main()
    except SystemExit as end:
        return end.code
    return 0
