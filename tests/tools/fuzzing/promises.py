"""Promises of all that is printed: no control characters, documents that their readers read, findings with a place."""

import json
import re
from collections.abc import Iterator
from xml.etree import ElementTree as ET

from parser.findings.catalogue import LANGUAGES, texts
from parser.findings.codes import CODES
from parser.findings.findings import Finding
from parser.text.source import LineIndex

# C0 but for tab and newline, DEL and C1; lone surrogates; marks that turn the direction of text (Unicode, UAX #9).
_UNCLEAN = re.compile(
    r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069]"
)


def unclean(text: str) -> Iterator[str]:
    """What a text for people holds that a terminal would obey."""
    for found in sorted({f"U+{ord(char):04X}" for char in _UNCLEAN.findall(text)}):
        yield f"prints {found}"


def of_document(name: str, text: str) -> Iterator[str]:
    """What is wrong with the form of an output in a format."""
    try:
        if name in ("json", "sarif", "gitlab"):
            json.loads(text, parse_constant=_no_json)
        elif name == "junit":
            ET.fromstring(text)  # noqa: S314 - our own
        elif not text:
            yield "is empty"
    except (ValueError, ET.ParseError) as error:
        yield f"is not well-formed: {error}"


def _no_json(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")


def of_texts(finding: Finding) -> Iterator[str]:
    """A finding has a known code, and a line of text in every language."""
    if finding.code not in CODES:
        yield f"{finding.code} is no code"
        return
    for language in LANGUAGES:
        message = texts(finding, language).message
        if not message or "\n" in message:
            yield f"{finding.code} has no line of text in {language}"


def of_place(finding: Finding, lines: LineIndex | None) -> Iterator[str]:
    """A finding has a place in a text, its line and column are those of it; `lines` is None where there is no text."""
    first, past = finding.span
    if not finding.line:
        if finding.span != (0, 0):
            yield f"{finding.code} has a span and no line"
    elif lines is None or not 0 <= first <= past <= len(lines.text):
        yield f"{finding.code} points beyond the text at {finding.span}"
    elif (finding.line, finding.column) != (lines.line(first), lines.column(first)):
        yield f"{finding.code} at {finding.span} names {finding.line}:{finding.column}"
