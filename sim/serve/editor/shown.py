"""What an editor shows of the path: the geometry of the block under the pointer, and the figures as an outline."""

from collections.abc import Iterator
from typing import Final

import numpy as np
from lsprotocol.types import DocumentSymbol, Hover, MarkupContent, MarkupKind, Position, SymbolKind

from controller.stepping.words import interpolate
from parser.program import Program
from parser.shape.contours import Contour, find_contours
from parser.text.encoding import printable
from parser.toolpath import Block, Point
from parser.units import mm_text
from sim.serve.editor.opened import Text
from sim.serve.editor.places import Places
from sim.show.words import Words

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
