"""A reader: what it makes of the text of a program, and what it says of it, whatever the dialect."""

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np

from parser.dialect.mender import Mender
from parser.findings.codes import Check
from parser.findings.findings import Finding
from parser.geometry.curves import Ints
from parser.text.lines import LineIndex
from parser.text.source import Span
from parser.toolpath import Toolpath

HeaderValue = str | float | tuple[float, ...] | None
"""What a header says of one thing: a text, a number or some; None or empty where it does not say it."""


NO_REMARKS: Ints = np.empty((0, 2), dtype=np.int64)


class Marks(NamedTuple):
    """Words between blocks that a machine knows besides those of the dialect.

    Attributes
    ----------
    end, pause
        Marks that end the program and that pause it; letters alone.
    """

    end: tuple[str, ...] = ()
    pause: tuple[str, ...] = ()


STANDARD_MARKS = Marks()


class Damage(NamedTuple):
    """A piece of text that could not be read: its place, and how many whole blocks stand before it."""

    span: Span
    after: int


class BlockCounts(NamedTuple):
    """Blocks of a text.

    Attributes
    ----------
    found
        That stand in it, damaged ones and those after the end code included.
    whole
        That could be read, also those after the end code.
    run
        Of these, blocks before the end code.
    """

    found: int
    whole: int
    run: int


class Spelling(NamedTuple):
    """How a dialect writes what findings speak of: arcs clockwise and counter-clockwise, and the end code."""

    clockwise: str
    counter_clockwise: str
    end: str


class Reading(NamedTuple):
    """How a text was read.

    Attributes
    ----------
    dialect
        Its name for people, such as ``3B``, ``4B`` or ``3B+4B``.
    counts
        How many blocks there are.
    damages
        What could not be read before the end code, in order.
    spelling
        Of the dialect.
    is_drawing
        Whether the path is known to be the drawing's contour, which the controller offsets.
    not_asked
        Checks for which this text gives no cause, each with the term of the catalogue that says why.
    offset_span
        Where the header gives an offset; None where it gives none.
    remarks
        (m, 2) int64, first character and one past the last of each remark, in order, with what begins and ends it.
    """

    dialect: str
    counts: BlockCounts
    damages: tuple[Damage, ...]
    spelling: Spelling
    is_drawing: bool
    not_asked: Mapping[Check, str]
    offset_span: Span | None = None
    remarks: Ints = NO_REMARKS


class ReadText(NamedTuple):
    """All that a reader makes of a text.

    Attributes
    ----------
    lines
        Places in the text.
    reading, header
        How it was read, and what its header says, by the keys that the report gives them; lengths in µm.
    toolpath
        Exact geometry, up to the end code.
    findings
        What is wrong with the text and its single blocks, in file order.
    mender
        What the dialect knows of writing blocks otherwise; None where it knows nothing of it.
    """

    lines: LineIndex
    reading: Reading
    header: Mapping[str, HeaderValue]
    toolpath: Toolpath
    findings: tuple[Finding, ...]
    mender: Mender | None = None


class Reader(Protocol):
    """Reads the programs of one family of dialects."""

    @property
    def name(self) -> str:
        """Of the family, for people."""

    @property
    def suffixes(self) -> tuple[str, ...]:
        """Ends of names of its files, in small letters, with the dot; the first is the usual one."""

    @property
    def own_marks(self) -> Marks:
        """Marks of the family itself, in capitals."""

    @property
    def block_words(self) -> tuple[str, ...]:
        """Words of letters that its blocks are written with, in capitals: none of them can be a further mark."""

    def recognises(self, text: str) -> bool:
        """Whether a text holds a block of the family, or what was meant for one."""

    def read(self, text: str, marks: Marks) -> ReadText:
        """What a text says. ProgramError (3B100) where it holds no block."""
