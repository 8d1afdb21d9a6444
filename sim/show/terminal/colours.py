"""Colours on a terminal: which there are, and texts with them, told from escape sequences that a file holds."""

import os
import re
from collections.abc import Iterable, Mapping
from typing import Final, NamedTuple

from parser.findings.codes import Severity

COLOURS: Final[Mapping[str, str]] = {
    Severity.ERROR: "red",
    Severity.WARNING: "yellow",
    Severity.NOTE: "cyan",
    "pass": "green",
    "fail": "red",
    "incomplete": "yellow",
    "to-check": "yellow",
}
_CODES: Final = {"bold": "1", "dim": "2", "red": "31", "green": "32", "yellow": "33", "cyan": "36"}  # ECMA-48, SGR
# A mark that no file can hold: it is drawn when the process starts, and the printer takes it out of each line.
_MARK: Final = f"\x1b{os.urandom(8).hex()}"
_MARKED: Final = re.compile(rf"{_MARK}\[([\d;]*)m")


class Span(NamedTuple):
    """A part of a line, and the codes of its colours for a terminal, such as ``1;31``; empty for none."""

    text: str
    codes: str


def styled(text: str, style: str) -> str:
    """A text in a style, such as ``bold red``, for the printer alone to write. KeyError for a style that is none."""
    codes = ";".join(_CODES[part] for part in style.split())
    return f"{_MARK}[{codes}m{text}{_MARK}[m" if codes else text


def spans(line: str) -> list[Span]:
    """The parts of a line by their styles."""
    parts = _MARKED.split(line)
    return [Span(text, codes) for text, codes in zip(parts[::2], ["", *parts[1::2]], strict=True) if text]


def painted(parts: Iterable[tuple[str, str]], severity: Severity) -> str:
    """A line of a finding in colours, from its parts and what each of them is (sim.show.terminal.finding)."""
    styles = {"place": "bold", "severity": f"bold {COLOURS[severity]}"}
    return "".join(styled(text, styles.get(role, "")) for text, role in parts)
