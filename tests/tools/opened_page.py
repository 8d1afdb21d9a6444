"""``drycut open`` in a process of its own, and requests to it as any program of the machine can make them."""

import http.client
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple
from urllib.parse import urlsplit

from places import ROOT

LONGEST_S = 30.0


class Answer(NamedTuple):
    """Status, headers with small names, and body of an answer."""

    status: int
    headers: dict[str, str]
    body: bytes


class OpenedPage:
    """The running server and its address."""

    def __init__(self, process: "subprocess.Popen[str]", address: str) -> None:
        self.process, self.address = process, address
        self.host, self.path = urlsplit(address).netloc, urlsplit(address).path

    def ask(self, path: str, body: bytes | str = b"", method: str = "POST", **headers: str) -> Answer:
        """The answer to a request; `path` is behind the token unless it begins with a slash, headers have _ for -."""
        connection = http.client.HTTPConnection(self.host, timeout=LONGEST_S)
        told = {name.replace("_", "-"): value for name, value in headers.items()}
        data = body.encode() if isinstance(body, str) else body
        try:
            connection.request(method, path if path.startswith("/") else self.path + path, data, told)
            answer = connection.getresponse()
            return Answer(answer.status, {k.lower(): v for k, v in answer.getheaders()}, answer.read())
        finally:
            connection.close()

    def ended(self) -> int:
        """Its exit code, once it has ended."""
        return self.process.wait(LONGEST_S)


class Recorder:
    """In place of a browser: what it was opened with."""

    def __init__(self, folder: Path) -> None:
        self._heard, program = folder / "heard", folder / "browser"
        program.write_text(f'#!/bin/sh\nprintf %s "$1" > {self._heard}.part; mv {self._heard}.part {self._heard}\n')
        program.chmod(0o755)
        self.program = str(program)

    def heard(self) -> str:
        """The one argument of its command line, once it came."""
        end_s = time.monotonic() + LONGEST_S
        while not self._heard.exists():
            assert time.monotonic() < end_s
            time.sleep(0.02)
        return self._heard.read_text()


@contextmanager
def opened_page(
    file: Path | None = None, *options: str, browser: str = "", state: Path | None = None
) -> Iterator[OpenedPage]:
    """The server of a file, which opens a browser where one is given; it is ended behind the block.

    What it is to remember stands in the folder `state`; nowhere without one.
    """
    shown = () if browser else ("--no-browser",)
    command = [sys.executable, "-m", "drycut", "open", *([str(file)] if file else []), *shown, *options]
    environment = {**os.environ, "BROWSER": browser, "XDG_STATE_HOME": str(state or os.devnull)}
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT, env=environment
    )
    assert process.stdout is not None
    try:
        yield OpenedPage(process, process.stdout.readline().strip())
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGTERM)
        try:
            process.wait(LONGEST_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        for stream in (process.stdout, process.stderr):
            if stream is not None:
                stream.close()
