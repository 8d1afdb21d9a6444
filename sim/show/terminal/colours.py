"""Colours of severities and verdicts on a terminal, by the names that both rich and click know."""

from collections.abc import Mapping
from typing import Final

from parser.findings.codes import Severity

COLOURS: Final[Mapping[str, str]] = {
    Severity.ERROR: "red",
    Severity.WARNING: "yellow",
    Severity.NOTE: "cyan",
    "pass": "green",
    "fail": "red",
    "incomplete": "yellow",
}
