"""The summary of a shop on the terminal."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

from parser.findings.catalogue import Language
from sim.show.terminal.colours import COLOURS, styled
from sim.show.terminal.printer import say
from sim.show.terminal.wrap import wrapped
from sim.show.texts import Words

_MOST: Final = 20
_COUNTED: Final = ("pass", "fail", "refused", "fault", "from_cache")


def print_batch(index: Mapping[str, Any], output: Path, language: Language) -> None:
    """Print what came of a shop: the programs that did not pass, counts, and where the index is."""
    tell = Words(language)
    bad = [program for program in index["programs"] if program["verdict"] != "pass"]
    for program in bad[:_MOST]:
        verdict = tell(f"batch.verdict-{program['verdict']}")
        told_text = tell("batch.bad", file=program["file"], verdict=verdict, why=_why(program))
        for line in wrapped(told_text, indent="    "):
            say(styled(line, COLOURS["fail"]))
    if len(bad) > _MOST:
        say(tell("batch.more", n=f"{len(bad) - _MOST:,}"))
    counts = index["counts"]
    told_text = tell("phrases.comma").join(
        tell(f"batch.count-{name}", n=f"{counts[name]:,}") for name in _COUNTED if counts[name]
    )
    say(tell("batch.one" if counts["programs"] == 1 else "batch.some", n=f"{counts['programs']:,}", counts=told_text))
    say(tell("batch.written", output=output))


def _why(program: Mapping[str, Any]) -> str:
    """Why a program does not pass: the message, or its errors by code."""
    return program["message"] or ", ".join(_errors(program))


def _errors(program: Mapping[str, Any]) -> Iterator[str]:
    for found in program["findings"]:
        if found["severity"] == "error":
            yield found["code"] if found["count"] == 1 else f"{found['code']} ×{found['count']:,}"
