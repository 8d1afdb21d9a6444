"""A command run inside the process of the fuzzer, and the promises of every command."""

import contextlib
import re
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any
from unittest import mock

from command import run_inside
from places import ROOT

from fuzzing.promises import of_document, unclean

_CODES = (None, 0, 1, 2)
"""Of good ends, findings and refusals; 3 would be a fault of drycut itself."""


def ran(arguments: Sequence[str], folder: Path, **environment: str) -> "CompletedProcess[bytes]":
    """The command with its output, in a folder."""
    with mock.patch.object(tempfile, "tempdir", str(folder)):  # where the traceback of a fault goes
        return run_inside(*arguments, cwd=folder, **environment)


def broken_by(done: "CompletedProcess[bytes]", folder: Path, form: str = "text") -> Iterator[str]:
    """Promises that a command broke in a folder; `form` is its format, "file" where it goes there, or "diff".

    A diff is to be applied: its lines are those of the program, whatever they hold.
    """
    out, err = (stream.decode("utf-8", "surrogateescape") for stream in (done.stdout, done.stderr))
    if done.returncode not in _CODES:
        yield f"exit code {done.returncode}: {fault(folder) or err[-400:]}"
    if "Traceback (most recent call last)" in err + out:
        yield f"a traceback: {err[-400:]!r}"
    if done.returncode == 2 and not err and not out and form != "file":
        yield "a refusal without a word"
    for name, text in (("stdout", "" if form == "diff" else out), ("stderr", err)):
        yield from (f"{name} {what}" for what in unclean(text))
    if done.returncode in (None, 0, 1) and form not in ("file", "diff"):
        yield from (f"{form} {what}" for what in of_document(form, out) if form != "text" or out)


def fault(folder: Path) -> str:
    """What went wrong inside drycut, as the file of a fault tells it: the error, and the innermost of its places."""
    for file in folder.glob("drycut-fault-*.txt"):
        told = file.read_text(encoding="utf-8").splitlines()
        places = re.findall(r'File "(.*?)", line (\d+)', "\n".join(told))
        own = [f"{Path(path).relative_to(ROOT)}:{line}" for path, line in places if Path(path).is_relative_to(ROOT)]
        return f"{told[-1]} at {', '.join(own[-3:])}"
    return ""


def answer_of(done: "CompletedProcess[bytes]", folder: Path) -> str:
    """What must be the same when the command is run again in another folder."""
    answer: tuple[Any, ...] = done.returncode, done.stdout, done.stderr
    return repr(answer).replace(str(folder), "HERE")


def leftovers(folder: Path) -> Iterator[str]:
    """Unfinished files that a command left behind."""
    with contextlib.suppress(OSError):
        for path in folder.rglob(".drycut*"):
            yield f"leaves {path.name[:8]} behind"
