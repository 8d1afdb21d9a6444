"""The summary of a shop on the terminal."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

from sim.show.terminal.colours import COLOURS, styled
from sim.show.terminal.printer import say
from sim.show.terminal.wrap import wrapped

_MOST: Final = 20
_SAID: Final = {
    "pass": "pass",
    "fail": "fail",
    "refused": "cannot be run",
    "fault": "faults of drycut",
    "from_cache": "from the last run",
}


def print_batch(index: Mapping[str, Any], output: Path) -> None:
    """Print what came of a shop: the programs that did not pass, counts, and where the index is."""
    bad = [program for program in index["programs"] if program["verdict"] != "pass"]
    for program in bad[:_MOST]:
        for line in wrapped(f"{program['file']}: {program['verdict']}: {_why(program)}", indent="    "):
            say(styled(line, COLOURS["fail"]))
    if len(bad) > _MOST:
        say(f"… and {len(bad) - _MOST:,} more, in index.html")
    counts = index["counts"]
    told = ", ".join(f"{counts[name]:,} {word}" for name, word in _SAID.items() if counts[name])
    say(f"{counts['programs']:,} program{'s' * (counts['programs'] != 1)}: {told}")
    say(f"written: {output}/ index.html, index.json, and a folder for each program that ran")


def _why(program: Mapping[str, Any]) -> str:
    """Why a program does not pass: the message, or its errors by code."""
    return program["message"] or ", ".join(_errors(program))


def _errors(program: Mapping[str, Any]) -> Iterator[str]:
    for found in program["findings"]:
        if found["severity"] == "error":
            yield found["code"] if found["count"] == 1 else f"{found['code']} ×{found['count']:,}"
