"""Programs in C against the card's library: it is made once for all tests, where there is a compiler."""

import os
import subprocess
import time
from pathlib import Path
from typing import NamedTuple

import pytest
from places import ROOT

from sim.clients.library import Compiler, CompilerError, build, found_compiler

CLIENTS = ROOT / "tests" / "clients"
WARNINGS = ("-Wall", "-Wextra", "-Werror", "-Wno-unused-function")
LONGEST_S = 120.0


class Ran(NamedTuple):
    """How a program ended: its exit code, what it printed, the lines of the card's log."""

    code: int
    out: str
    err: str
    log: list[str]


class Made:
    """The library in a folder, and programs made against it."""

    def __init__(self, folder: Path, compiler: Compiler) -> None:
        self.folder, self.compiler = folder, compiler

    def compile(self, source: Path, client: Path, *options: str) -> subprocess.CompletedProcess[str]:
        libraries = ("-L", str(self.folder), "-lges", "-ldrycut_sleep", "-lpthread", "-lm")
        headers = ("-I", str(self.folder / "include"), "-I", str(CLIENTS))
        return subprocess.run(
            [*self.compiler.call, *WARNINGS, *options, str(source), "-o", str(client), *headers, *libraries],
            capture_output=True,
            text=True,
            check=False,
        )

    def client(self, name: str) -> Path:
        """The program of a file of tests/clients, made once."""
        client = self.folder / "clients" / name
        if not client.exists():
            client.parent.mkdir(exist_ok=True)
            aside = client.with_name(f"{name}.{os.getpid()}")
            done = self.compile(CLIENTS / f"{name}.c", aside)
            assert (done.returncode, done.stderr) == (0, "")
            aside.replace(client)
        return client

    def run(self, client: Path, folder: Path, *arguments: str, card: str = "", **asked: str) -> Ran:
        """Run a program with nothing but the folder of the library, and what is asked, in its environment."""
        log = folder / f"{client.name}.log"
        environment = {"LD_LIBRARY_PATH": str(self.folder), "DRYCUT_CARD_LOG": str(log), **asked}
        if card:
            (folder / "card.toml").write_text(card, "utf-8")
            environment["DRYCUT_CARD"] = str(folder / "card.toml")
        done = subprocess.run(
            [str(client), *arguments],
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=LONGEST_S,
            check=False,
        )
        return Ran(
            done.returncode, done.stdout, done.stderr, log.read_text("utf-8").splitlines() if log.exists() else []
        )


@pytest.fixture(scope="session")
def library(tmp_path_factory: pytest.TempPathFactory) -> Made:
    """The library, made by the first worker that asks for it; the others wait for it."""
    try:
        compiler = found_compiler()
    except CompilerError as error:
        pytest.skip(f"the card's library was not tested: {error}")
    root = tmp_path_factory.getbasetemp()
    folder = (root.parent if os.environ.get("PYTEST_XDIST_WORKER") else root) / "libges"
    try:
        folder.mkdir()
    except FileExistsError:
        while not (folder / "made").exists():
            time.sleep(0.05)
    else:
        build(folder, compiler)
        (folder / "made").touch()
    return Made(folder, compiler)
