"""A program without faults, as those who damage it look at it: its blocks, its lines, the words of its blocks."""

from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Ints
from parser.program import Program
from parser.text.source import Field, Span


class Slip(NamedTuple):
    """A damaged text; the fault stands, or shows, in one of its `lines`, from 1."""

    text: str
    lines: frozenset[int]


class Sound:
    """A program that is to be damaged.

    Parameters
    ----------
    program
        With at least one block.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self.path = program.toolpath
        self.text = program.text

    @cached_property
    def rows(self) -> list[int]:
        """Rows of the path, one for each block that stands in the text; routines that run twice stand there once."""
        spans = self.path.source.span
        _, first = np.unique(spans[:, 0], return_index=True)
        return [row for row in sorted(first.tolist()) if spans[row, 0] < spans[row, 1]]

    @cached_property
    def alone(self) -> list[int]:
        """Those of the rows whose block has its line for itself."""
        lines = self._lines[self.rows]
        known, counts = np.unique(lines, return_counts=True)
        return [row for row in self.rows if counts[np.searchsorted(known, self._lines[row])] == 1]

    @cached_property
    def neighbours(self) -> list[tuple[int, int]]:
        """Rows of two cuts in lines that follow one another."""
        cuts = [row for row in self.alone if not self.path.is_jump[row]]
        pairs = pairwise(cuts)
        return [(this, other) for this, other in pairs if self.line(other) == self.line(this) + 1]

    @property
    def _lines(self) -> Ints:
        return self.path.source.line

    def line(self, row: int) -> int:
        """The line in which the block of a row stands, from 1."""
        return int(self._lines[row])

    def stops(self, kind: str) -> list[int]:
        """Lines of pauses, or of the end, that hold no block."""
        of_blocks = set(self._lines.tolist())
        return [stop.line for stop in self.path.stops if stop.kind == kind and stop.line not in of_blocks]

    def field(self, row: int, field: Field) -> tuple[Span, str] | None:
        """Where a field of a block stands in the text, and what stands there; None where the block has none."""
        span = self.path.source.field(row, field)
        return span and (span, self.text[slice(*span)])

    def line_span(self, line: int) -> Span:
        """A line with its end, which the last line may lack."""
        first, past = self.program.lines.bounds(line)
        ends = self.text[past : past + 2]
        return first, past + (2 if ends == "\r\n" else len(ends[:1]))

    def line_text(self, line: int) -> str:
        """A line as written, without its end."""
        return self.program.excerpt(line)

    @cached_property
    def line_end(self) -> str:
        """How the first line ends."""
        past = self.program.lines.bounds(1)[1]
        return self.text[past : self.line_span(1)[1]] or "\n"

    def with_text(self, span: Span, text: str) -> str:
        """The whole text with another one in place of a span."""
        return f"{self.text[: span[0]]}{text}{self.text[span[1] :]}"
