"""Text to listing: words by their letters, remarks, tape marks, assignments, and what is none of them."""

import re

import numpy as np

from parser.iso.listing import Assignment, Blocks, Listing, Unread, Words
from parser.text.encoding import narrow
from parser.text.lines import LineIndex

_REMARK = re.compile(r"\([^()\r\n]*\)?|;[^\r\n]*")
_ASSIGNED = re.compile(r"([A-Z])[ \t]*(\d+)[ \t]*=([^\r\n;]*)", re.IGNORECASE)
_WORD = re.compile(r"([A-Za-z])[ \t]*([-+]?[ \t]*(?:\d+\.?\d*|\.\d+))")
_LINE = re.compile(r"[^\r\n]+")


def read_listing(text: str) -> Listing:
    """The words of a text."""
    folded = narrow(text)
    lines = LineIndex(folded)
    remarks = [match.span() for match in _REMARK.finditer(folded)]
    bare = _REMARK.sub(lambda match: " " * len(match[0]), folded)
    rows: list[tuple[int, float, int, int, int, int]] = []
    blocks: list[tuple[int, int, int, bool, bool]] = []
    starts = [0]
    assignments: list[Assignment] = []
    unread: list[Unread] = []
    for line in _LINE.finditer(bare):
        if not line[0].strip() or line[0].strip().startswith("%"):
            continue
        number = len(blocks)
        assigned = _ASSIGNED.fullmatch(line[0].strip())
        if assigned:
            terms = tuple(_term(part) for part in assigned[3].split("+") if part.strip())
            name = f"{assigned[1].upper()}{int(assigned[2])}"
            assignments.append(Assignment(number, name, terms, line.span()))
        else:
            for word in _WORD.finditer(bare, *line.span()):
                figure = re.sub(r"\s", "", word[2])
                decimals = len(figure) - figure.index(".") - 1 if "." in figure else -1
                rows.append((ord(word[1].upper()), float(figure), decimals, *word.span(), number))
            rest = _WORD.sub(lambda match: " " * len(match[0]), line[0])
            unread += [
                Unread((line.start() + piece.start(), line.start() + piece.end()), number)
                for piece in re.finditer(r"[^\s/]+", rest)
            ]
        first = line.start() + len(line[0]) - len(line[0].lstrip())
        past = line.start() + len(line[0].rstrip())
        damaged = bool(unread and unread[-1].block == number)
        blocks.append((lines.line(line.start()), first, past, line[0].strip().startswith("/"), damaged))
        starts.append(len(rows))
    letter, value, decimals_, word_first, word_past, block = (
        np.array(column, dtype=np.float64 if at == 1 else np.int64)
        for at, column in enumerate(zip(*rows, strict=True) if rows else [[]] * 6)
    )
    columns = [np.array(column) for column in zip(*blocks, strict=True)] if blocks else [np.zeros(0, np.int64)] * 5
    return Listing(
        text,
        lines,
        Words(letter, value, decimals_, word_first, word_past, block),
        Blocks(*columns[:3], columns[3].astype(bool), columns[4].astype(bool), np.array(starts)),
        tuple(assignments),
        (),
        np.array(remarks, dtype=np.int64).reshape(-1, 2),
        tuple(unread),
        len(folded),
        (),
    )


def _term(part: str) -> tuple[float, int] | str:
    part = part.strip().upper()
    if part[:1].isalpha():
        return f"{part[0]}{int(part[1:])}"
    return float(part), len(part) - part.index(".") - 1 if "." in part else -1
