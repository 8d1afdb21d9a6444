"""Decoded blocks on the terminal: each block's text, a line for each word, the buffer, and the way of the block."""

from collections.abc import Sequence

from controller.decode.blocks import Decoded
from parser.dialect.decoding import DecodeStep
from parser.findings.catalogue import Language
from parser.program import Program
from parser.text.encoding import printable
from parser.text.places import cells
from sim.show.decoded import buffer_text, order_text, value_text, way_texts, word_text
from sim.show.terminal.layout import paragraph
from sim.show.terminal.printer import say, styled
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of, wrapped
from sim.show.texts import Words
from sim.show.texts.phrases import catalogued

_INDENT = _GAP = "  "
_WIDEST = 24
"""Cells of a column: a longer text stands on a line of its own, and leaves the others their room."""


def print_decoded(program: Program, blocks: Sequence[Decoded], language: Language) -> None:
    """Print blocks of a program to stdout, after what was assumed to read it."""
    words = Words(language)
    assumptions = program.reading.assumptions
    for taken in assumptions:
        what, why = catalogued(taken.what), catalogued(taken.why)
        paragraph(words("decode.assumed", what=what, taken=taken.taken, why=why))
    for number, decoded in enumerate(blocks):
        if number or assumptions:
            say("")
        head = f"{words('decode.line', line=decoded.block.line)}: "
        for line in wrapped(printable(program.text[slice(*decoded.block.span)]), width_of(outlet()), head):
            say(styled(line, "bold"))
        _print_table([_step_row(step, language) for step in decoded.block.steps])
        named = [(getattr(name, language), getattr(text, language)) for name, text in way_texts(decoded)]
        _print_table([(words("decode.buffer"), buffer_text(decoded.block)), *named])


def _step_row(step: DecodeStep, language: Language) -> tuple[str, ...]:
    word, value = getattr(word_text(step), language), getattr(value_text(step), language)
    return f"{order_text(step.order)} {printable(word)}", step.field, value


def _print_table(rows: Sequence[tuple[str, ...]]) -> None:
    """Rows of texts under each other; the last text of a row may run on over several lines."""
    width = width_of(outlet())
    wide = [_room(column) for column in list(zip(*rows, strict=True))[:-1]]
    for *heads, text in rows:
        too_long = heads[0] if cells(heads[0]) > wide[0] else ""
        for line in wrapped(too_long, width, _INDENT, _INDENT * 2) if too_long else ():
            say(line)
        titles = ["" if too_long else heads[0], *heads[1:]]
        filled = (each + " " * (room - cells(each)) for each, room in zip(titles, wide, strict=True))
        for line in wrapped(text, width, _INDENT + "".join(each + _GAP for each in filled)):
            say(line)


def _room(column: Sequence[str]) -> int:
    """Cells of a column: of the widest text in it that is not too long for one."""
    return max((cells(each) for each in column if cells(each) <= _WIDEST), default=0)
