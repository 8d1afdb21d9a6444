"""What a mend changes in a file, as a unified diff: for people, and byte for byte for ``patch`` and ``git apply``."""

import os
import re
from collections.abc import Iterator, Sequence
from itertools import groupby, takewhile
from pathlib import Path, PurePath
from typing import AnyStr, Generic, NamedTuple

from parser.text.encoding import printable
from parser.text.lines import LINE_END

_CONTEXT = 3  # lines around a change that stay the same, as diff -u has them
_LINE = re.compile(rb"[^\n]*\n|[^\n]+")  # patch and git end a line at a line feed, whatever the file's encoding
_QUOTED = re.compile(rb'[\x00-\x1f"\\\x7f]')  # characters in names for which git writes escapes, in quotes


class _Change(NamedTuple):
    """Lines `first` up to but without `past` become lines `first` up to but without `new_past`, from 0."""

    first: int
    past: int
    new_past: int


class _Hunk(NamedTuple, Generic[AnyStr]):
    """Head of a hunk, and its lines with their signs."""

    head: str
    rows: list[tuple[str, AnyStr]]


def for_people(name: str, before: str, after: str) -> str:
    """Unified diff of two texts: line ends of any kind as newlines, other control characters as U+FFFD.

    Empty where they are the same.
    """
    lines: list[str] = []
    for head, rows in _hunks(_shown_lines(before), _shown_lines(after)):
        lines += (head, *(sign + line for sign, line in rows))
    heads = (f"--- {printable(name)}", f"+++ {printable(name)}") if lines else ()
    return "".join(f"{line}\n" for line in (*heads, *lines))


def for_tools(name: str, before: bytes, after: bytes) -> bytes:
    """Unified diff of two contents, of which ``patch -p0`` and ``git apply -p0`` make the second from the first.

    Empty where they are the same.
    """
    parts: list[bytes] = []
    for head, rows in _hunks(_LINE.findall(before), _LINE.findall(after)):
        parts.append(head.encode() + b"\n")
        parts += (sign.encode() + _ended(line) for sign, line in rows)
    heads = [b"--- " + _name(name) + b"\n", b"+++ " + _name(name) + b"\n"] if parts else []
    return b"".join(heads + parts)


def _shown_lines(text: str) -> list[str]:
    lines = [printable(line) for line in LINE_END.split(text)]
    return lines if lines[-1] else lines[:-1]


def _ended(line: bytes) -> bytes:
    return line if line.endswith(b"\n") else line + b"\n\\ No newline at end of file\n"


def _name(name: str) -> bytes:
    """Name of a file as both tools read it: from the folder of the run where it lies below, as they refuse others."""
    path = PurePath(name)
    if path.is_relative_to(Path.cwd()):
        path = path.relative_to(Path.cwd())
    raw = os.fsencode(path.as_posix())
    if _QUOTED.search(raw):
        return b'"' + _QUOTED.sub(lambda found: b"\\%03o" % ord(found[0]), raw) + b'"'
    return raw + b"\t" if b" " in raw else raw  # what follows a blank would be a date, but for the tab


def _hunks(before: Sequence[AnyStr], after: Sequence[AnyStr]) -> Iterator[_Hunk[AnyStr]]:
    for changes in _near(_changes(before, after)):
        first, past = max(changes[0].first - _CONTEXT, 0), min(changes[-1].past + _CONTEXT, len(before))
        new_past = changes[-1].new_past + past - changes[-1].past
        rows: list[tuple[str, AnyStr]] = []
        at = first
        for change in changes:
            rows += ((" ", line) for line in before[at : change.first])
            rows += (("-", line) for line in before[change.first : change.past])
            rows += (("+", line) for line in after[change.first : change.new_past])
            at = change.past
        rows += ((" ", line) for line in before[at:past])
        yield _Hunk(f"@@ -{_range(first, past)} +{_range(first, new_past)} @@", rows)


def _range(first: int, past: int) -> str:
    """Lines in the head of a hunk: the first from 1, and how many; where there are none, the line before."""
    return f"{first + (past > first)},{past - first}"


def _changes(before: Sequence[AnyStr], after: Sequence[AnyStr]) -> Iterator[_Change]:
    """Lines that differ, each held against the one in its place: linear, where a search for the shortest diff is not.

    That is enough: a mend changes words within their lines, and adds lines only behind all that it changes. Those have
    their place before the lines that both end with.
    """
    tail = sum(1 for _ in takewhile(lambda at: before[~at] == after[~at], range(min(len(before), len(after)))))
    old, new = len(before) - tail, len(after) - tail
    places = range(max(old, new))
    for differ, group in groupby(places, lambda at: at >= min(old, new) or before[at] != after[at]):
        if differ:
            first, *rest = group
            past = first + 1 + len(rest)
            yield _Change(first, min(past, old), min(past, new))


def _near(changes: Iterator[_Change]) -> Iterator[list[_Change]]:
    """Changes whose contexts touch, together."""
    near: list[_Change] = []
    for change in changes:
        if near and change.first - near[-1].past > 2 * _CONTEXT:
            yield near
            near = []
        near.append(change)
    if near:
        yield near
