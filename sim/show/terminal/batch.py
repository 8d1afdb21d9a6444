"""The summary of a shop on the terminal."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

from parser.findings.catalogue import Language
from sim.show.index_page.page import counts_shown, outcome_of
from sim.show.terminal.colours import COLOURS, styled
from sim.show.terminal.printer import say
from sim.show.terminal.wrap import wrapped
from sim.show.texts import Words

_MOST: Final = 20
_COUNTED: Final = ("pass", "to_check", "fail", "refused", "fault", "from_cache")


def print_batch(index: Mapping[str, Any], output: Path, language: Language) -> None:
    """Print what came of a shop: the programs that did not pass, counts, and where the index is."""
    tell = Words(language)
    bad = [program for program in index["programs"] if outcome_of(program) != "pass"]
    for program in bad[:_MOST]:
        outcome = outcome_of(program)
        verdict = tell(f"batch.verdict-{outcome}")
        told_text = tell("batch.bad", file=program["file"], verdict=verdict, why=_why(program))
        for line in wrapped(told_text, indent="    "):
            say(styled(line, COLOURS.get(outcome, COLOURS["fail"])))
    if len(bad) > _MOST:
        say(tell("batch.more", n=f"{len(bad) - _MOST:,}"))
    counts = counts_shown(index["counts"])
    told_text = tell("phrases.comma").join(
        tell(f"batch.count-{name}", n=f"{counts[name]:,}") for name in _COUNTED if counts[name]
    )
    say(tell("batch.one" if counts["programs"] == 1 else "batch.some", n=f"{counts['programs']:,}", counts=told_text))
    say(tell("batch.written", output=output))


def _why(program: Mapping[str, Any]) -> str:
    """Why a program does not pass, or is to be checked: the message, or its errors or warnings by code."""
    return program["message"] or ", ".join(_codes(program, "warning" if program["to_check"] else "error"))


def _codes(program: Mapping[str, Any], severity: str) -> Iterator[str]:
    for found in program["findings"]:
        if found["severity"] == severity:
            yield found["code"] if found["count"] == 1 else f"{found['code']} ×{found['count']:,}"
