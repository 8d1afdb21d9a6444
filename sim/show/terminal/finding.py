"""A finding in lines of text, as a good compiler writes it: place and title, the source line, what is to be said of it.

The first line has place, severity, code and title, however long the name of the file is: editors and grep look for them
in one line. All others fit the width.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Final, Literal, NamedTuple

from parser.findings.catalogue import Language, texts
from parser.findings.findings import Finding
from parser.text.encoding import printable
from parser.text.places import caret_lines, cells, place
from sim.show.terminal.wrap import WIDTH, wrapped
from sim.show.texts import Words

LABELS: Final = ("found", "expected", "machine", "hint")
"""What is said of a finding: names of its texts, and of their words."""


class Part(NamedTuple):
    """Part of a line, and what it is; those of a `severity` have its colour."""

    text: str
    role: Literal["place", "severity", "label", "plain"] = "plain"


Line = tuple[Part, ...]


def message(finding: Finding, language: Language) -> str:
    """What a finding says in one line, with its block before it."""
    return with_block(finding, texts(finding, language).message, language)


def with_block(finding: Finding, text: str, language: Language) -> str:
    """A text of a finding with its block before it, where it has one."""
    return Words(language)("findings.block", block=finding.block_name, message=text) if finding.block else text


def hint(finding: Finding, language: Language) -> str:
    """``hint: write GY``: how to mend it; empty where its page has no hint."""
    text = texts(finding, language).hint
    return f"{_label('hint', language)}{text}" if text else ""


def finding_lines(
    name: str, finding: Finding, excerpt: str | None, language: Language, width: int = WIDTH
) -> Iterator[Line]:
    """The lines of a finding in a file of this name, in `width` cells; `excerpt` is its source line or None."""
    of = texts(finding, language)
    severity = Words(language)(f"findings.{finding.severity}")
    where = place(printable(name), finding.line, finding.column)
    yield Part(where, "place"), Part(": "), Part(f"{severity}[{finding.code}]", "severity"), Part(f": {of.title}")
    gutter = "  " + " " * len(str(finding.line))
    if excerpt is not None:
        yield from _source(finding, excerpt, gutter, width)
    said = {**of._asdict(), "found": with_block(finding, of.found, language)}
    for label in LABELS:
        if said[label]:
            yield from _labelled(label, printable(said[label]), gutter, language, width)


def _source(finding: Finding, excerpt: str, gutter: str, width: int) -> Iterator[Line]:
    # The line's number before it keeps a build server from taking the line of a program for a command to itself.
    room = width - len(gutter) - len(" | ")
    first, past = finding.span
    excerpt_line, carets = caret_lines(excerpt, max(finding.column, 1), past - first, room)
    yield (Part(f"  {finding.line} | {excerpt_line}".rstrip()),)
    if finding.column:
        yield Part(f"{gutter} | "), Part(carets, "severity")


def _labelled(label: str, text: str, gutter: str, language: Language, width: int) -> Iterator[Line]:
    head = f"{gutter} = {_heads(language)[label]}"
    first, *others = wrapped(text, width, head)
    yield Part(head, "label"), Part(first.removeprefix(head))
    for line in others:
        yield (Part(line),)


@cache
def _heads(language: Language) -> Mapping[str, str]:
    """The labels with their colons, all of the same width."""
    heads = {name: _label(name, language) for name in LABELS}
    longest = max(map(cells, heads.values()))
    return {name: head + " " * (longest - cells(head)) for name, head in heads.items()}


def _label(name: str, language: Language) -> str:
    say = Words(language)
    return f"{say(f'findings.{name}')}{say('findings.colon')}"
