"""What an editor shows of a program: its path, its layout, and places as an editor counts them.

What an editor shows of the path: the geometry of the block under the pointer, and the figures as an outline.

The layout of a program: the words of its blocks in columns, or a blank between them; nothing else moves.

What is laid out is read again: where it says anything else than before, all of it stays as it was.

Places in a text as an editor counts them: lines from 0, and units of its encoding in a line.

A text as an editor has it open.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from lsprotocol.types import (
    DocumentSymbol,
    Hover,
    MarkupContent,
    MarkupKind,
    Position,
    PositionEncodingKind,
    Range,
    SymbolKind,
)

from controller.stepping.steps import interpolate
from parser.findings.catalogue import Language
from parser.findings.errors import ProgramError
from parser.findings.findings import Edit, edited
from parser.program import Program, load_program
from parser.shape.contours import Contour, find_contours
from parser.text.encoding import narrow, printable
from parser.text.source import LineIndex, Span
from parser.toolpath import Block, Point, Toolpath
from parser.units import mm_text
from sim.check.file_check import AsTyped, mended_text
from sim.show.texts import Words

_BEYOND_16: Final = "\uffff"


class Places:
    """Places in one text, whose lines end with LF, CRLF or CR as the protocol has them.

    Parameters
    ----------
    lines
        Of the text.
    encoding
        What units are: ``utf-8``, ``utf-16`` or ``utf-32``.
    """

    def __init__(self, lines: LineIndex, encoding: str) -> None:
        self._lines, self._encoding = lines, encoding

    def range_of(self, span: Span) -> Range:
        """The range of a span of characters."""
        return Range(self.position(span[0]), self.position(span[1]))

    def position(self, character: int) -> Position:
        """The position before a character of the text, or behind its last one."""
        line = self._lines.line(character)
        first, past = self._lines.bounds(line)
        return Position(line - 1, self._units(self._lines.text[first : min(character, past)]))

    def character(self, position: Position) -> int:
        """The character at a position; past the end of a line its end, past the last line the end of the text."""
        if position.line >= self.count:
            return len(self._lines.text)
        first, past = self._lines.bounds(position.line + 1)
        left = position.character
        for at in range(first, past):
            left -= self._units(self._lines.text[at])
            if left < 0:
                return at
        return past

    def line_range(self, line: int) -> Range:
        """All of a line, from 1, without its end."""
        return self.range_of(self._lines.bounds(line))

    @property
    def whole(self) -> Range:
        """All of the text."""
        return self.range_of((0, len(self._lines.text)))

    @property
    def count(self) -> int:
        """Lines, the one behind the last line end too."""
        return self._lines.line(len(self._lines.text))

    def _units(self, text: str) -> int:
        if self._encoding == PositionEncodingKind.Utf32:
            return len(text)
        if self._encoding == PositionEncodingKind.Utf8:
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text) + sum(letter > _BEYOND_16 for letter in text)


@dataclass(frozen=True, eq=False)
class Text:
    """A text as an editor has it: what was made of it, its places, and the language for people.

    `version` is the editor's number of this state of the text; None where it gives none, or its edits bear none.
    """

    uri: str
    version: int | None
    opened: AsTyped
    places: Places
    language: Language

    @cached_property
    def mends(self) -> tuple[Edit, ...]:
        """The edits of ``drycut check --fix``, worked out once; none where nothing is certain."""
        program = self.opened.program
        if program is None or not any(finding.edits for finding in self.opened.result.findings):
            return ()  # editors ask at every move of the caret
        return mended_text(program, self.opened.settings).edits


_BLOCK_3B: Final = re.compile(r"B(\d*)B(\d*)B(\d*)(?:B(\d*))?(G[XY]D{0,2})([LSN]R?[1-4])", re.IGNORECASE)
_REMARK_ISO: Final = re.compile(r"(\([^()\r\n]*\))")
_WORD_ISO: Final = re.compile(r"[A-Z]\s*[-+]?(?:\d+\.?\d*|\.\d+)", re.IGNORECASE)


def layout_of(program: Program) -> tuple[Edit, ...]:
    """What is to be changed; nothing where all stands so, or blocks would be read otherwise."""
    path, decoder = program.toolpath, program.decoder
    found = (block.span for block in decoder.blocks()) if decoder else map(tuple, path.source.span.tolist())
    spans = sorted(set(found))
    texts = [program.text[first:past] for first, past in spans]
    laid = _laid_3b(texts) if path.words is not None else [_laid_iso(text) for text in texts]
    edits = tuple(
        Edit(first, past, new) for (first, past), old, new in zip(spans, texts, laid, strict=True) if new != old
    )
    return edits if edits and _is_the_same(program, edits) else ()


def _laid_3b(texts: list[str]) -> list[str]:
    """Blocks with their numbers in columns as wide as the longest; what is no block by itself stays."""
    found = [_BLOCK_3B.fullmatch(re.sub(r"\s", "", narrow(text))) for text in texts]
    numbers = [number for match in found if match for number in match.groups()[:4] if number is not None]
    width = max(map(len, numbers), default=0)
    return [_in_columns(match, width) if match else text for match, text in zip(found, texts, strict=True)]


def _in_columns(block: re.Match[str], width: int) -> str:
    *numbers, axis, label = block.groups()
    columns = [f"B {number:>{width}}" for number in numbers if number is not None]
    return " ".join([*columns, axis.upper(), label.upper()])


def _laid_iso(text: str) -> str:
    """Words and remarks apart from each other by a blank, where there is nothing else."""
    laid: list[str] = []
    for at, piece in enumerate(_REMARK_ISO.split(text)):
        plain = narrow(piece)
        if at % 2:
            laid.append(piece)
        elif _WORD_ISO.sub("", plain).strip():
            return text
        else:
            laid += [re.sub(r"\s", "", word).upper() for word in _WORD_ISO.findall(plain)]
    return " ".join(laid) if laid else text


def _is_the_same(program: Program, edits: tuple[Edit, ...]) -> bool:
    """Whether the program says the same with the edits made, and nothing more is wrong with it."""
    try:
        other = load_program(edited(program.text, edits).encode("utf-8"), program.name, program.choices)
    except ProgramError:
        return False
    before, after = (Counter(finding.code for finding in each.findings) for each in (program, other))
    return not after - before and _are_alike(program.toolpath, other.toolpath)


def _are_alike(this: Toolpath, other: Toolpath) -> bool:
    columns = ("kind", "start_um", "end_um", "center_um", "sweep_rad", "printed_end_um")
    pairs = ((getattr(this, name), getattr(other, name)) for name in columns)
    if len(this) != len(other) or not all(np.array_equal(a, b, equal_nan=True) for a, b in pairs):
        return False
    if (this.words is None) != (other.words is None):
        return False
    names = ("x_um", "y_um", "count_um", "count_axis", "quadrant", "turn", "radius_um", "curve")
    words = this.words, other.words
    return words[0] is None or all(np.array_equal(getattr(words[0], name), getattr(words[1], name)) for name in names)


_MOST_BLOCKS: Final = 5_000
"""Blocks of a program whose outline names each of them; of a larger one it names the figures alone."""


def hover_of(text: Text, position: Position) -> Hover | None:
    """The block at a position: its number, kind, ends, length, and centre, radius and angles of an arc."""
    program = text.opened.program
    row = _row_at(program, text.places.character(position)) if program else None
    if program is None or row is None:
        return None
    first, past = program.toolpath.source.span[row].tolist()
    block, called = program.toolpath.block(row), program.toolpath.source.names.of_row(row)
    lines = "  \n".join(_block_lines(block, called, Words(text.language)))
    return Hover(MarkupContent(MarkupKind.Markdown, lines), text.places.range_of((first, past)))


def outline_of(text: Text) -> list[DocumentSymbol]:
    """Its figures in order, each with its blocks where they are few; none of a text that holds no program."""
    program = text.opened.program
    if program is None or text.opened.result.coverage.stepped == 0:
        return []
    contours = find_contours(program.toolpath, interpolate(program.toolpath).corner_um)
    words = Words(text.language)
    return [_figure(program, text.places, contour, number, words) for number, contour in enumerate(contours, start=1)]


def _row_at(program: Program, character: int) -> int | None:
    """The row whose block stands at a character, or else first in its line; None where none does."""
    span = program.toolpath.source.span
    at = np.flatnonzero((span[:, 0] <= character) & (character <= span[:, 1]))
    if not len(at):
        at = np.flatnonzero(program.toolpath.source.line == program.lines.line(character))
    return int(at[0]) if len(at) else None


def _block_lines(block: Block, called: str, words: Words) -> Iterator[str]:
    name = f"{called} ({block.number})" if called != str(block.number) else called
    yield words(f"editor.block-{block.kind.name.lower()}", name=f"**{name}**", length=mm_text(block.length_um))
    yield words("editor.ends", start=_place(block.start_um), end=_place(block.end_um))
    if block.center_um is None or block.sweep_rad is None:
        return
    yield words(
        "editor.arc",
        radius=mm_text(block.radius_um or 0.0),
        center=_place(block.center_um),
        sweep=f"{np.degrees(block.sweep_rad):+.3f}",
    )


def _figure(program: Program, places: Places, contour: Contour, number: int, words: Words) -> DocumentSymbol:
    path, rows = program.toolpath, slice(contour.first - 1, contour.last)
    first, past = int(path.source.span[rows, 0].min()), int(path.source.span[rows, 1].max())
    length = mm_text(float(path.length_um[rows].sum()))
    kind = "open" if contour.is_open else "closed" if contour.encloses else "parting"
    name = words("editor.figure", number=number, first=_name(program, contour.first), last=_name(program, contour.last))
    blocks = range(contour.first - 1, contour.last) if len(path) <= _MOST_BLOCKS else ()
    whole = places.range_of((first, past))
    return DocumentSymbol(
        name,
        SymbolKind.Class,
        whole,
        places.range_of(tuple(path.source.span[contour.first - 1].tolist())),
        detail=words(f"editor.figure-{kind}", length=length),
        children=[_block_symbol(program, places, row) for row in blocks],
    )


def _block_symbol(program: Program, places: Places, row: int) -> DocumentSymbol:
    path = program.toolpath
    first, past = path.source.span[row].tolist()
    at = places.range_of((first, past))
    text = printable(path.source.block_text(row).strip())
    return DocumentSymbol(_name(program, row + 1), SymbolKind.Field, at, at, detail=text)


def _name(program: Program, block: int) -> str:
    return program.toolpath.source.names.at(block)


def _place(place: Point) -> str:
    return f"{mm_text(place.x)}, {mm_text(place.y)}"
