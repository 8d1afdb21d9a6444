"""Places in a text as an editor counts them: lines from 0, and units of its encoding in a line.

A text as an editor has it open.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

from lsprotocol.types import Position, PositionEncodingKind, Range

from parser.findings.catalogue import Language
from parser.findings.findings import Edit
from parser.text.lines import LineIndex
from parser.text.source import Span
from sim.check.file_check import AsTyped
from sim.check.mended import mended_text

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
