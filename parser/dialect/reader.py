"""A reader: what it is told beside a text, what it makes of it, and what it says of it, whatever the dialect.

What is told of a program besides its text, whatever the dialect: marks, family, unit and offset registers.

Findings at blocks: the place is that of the field which is wrong.
"""

import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import NamedTuple, Protocol

import numpy as np

from parser.dialect.decoding import Decoder
from parser.dialect.mender import Mender
from parser.documents import AssumptionEntry
from parser.findings.catalogue import Language, term
from parser.findings.codes import Check
from parser.findings.findings import Finding, Stands, Value
from parser.geometry.curves import Curves, Ints
from parser.text.source import Field, LineIndex, Span
from parser.toolpath import Toolpath


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


UNITS = ("um", "mm", "inch")
"""Units in which the numbers of a program may be told to stand (docs/iso.md §4)."""


_REGISTER = re.compile(r"([DH])0*(\d{1,4})", re.ASCII | re.IGNORECASE)


Registers = tuple[tuple[str, float], ...]
"""Values of offset registers, µm, by their names."""


class OwnDialect(NamedTuple):
    """A dialect of a shop's own.

    Attributes
    ----------
    name
        As people call it; none of a profile.
    base
        Name of the profile that it changes.
    changed
        The values that it has in place of those, JSON.
    """

    name: str
    base: str
    changed: str

    def __str__(self) -> str:
        return self.name


ChosenDialect = str | OwnDialect
"""The name of a profile, or a dialect of one's own; empty where the text is to tell it."""


class Choices(NamedTuple):
    """What is told of a program besides its text, by options, settings and machine files.

    Attributes
    ----------
    marks
        Further marks.
    dialect
        Its dialect, such as ``fanuc``; empty where the text is to tell it.
    unit
        Of its numbers: ``um``, ``mm`` or ``inch``; empty where text and dialect tell it.
    registers
        Values of offset registers, µm, by their names without leading zeros: ``("D0", 100.0)``. What the program says
        itself counts before them.
    """

    marks: Marks = STANDARD_MARKS
    dialect: ChosenDialect = ""
    unit: str = ""
    registers: Registers = ()


STANDARD_CHOICES = Choices()


def register_name(text: str) -> str:
    """Name of an offset register in capitals and without leading zeros, ``D1`` of ``d01``; empty where it is none."""
    match = _REGISTER.fullmatch(text.strip())
    return f"{match[1].upper()}{match[2]}" if match else ""


def merged(tables: Iterable[Registers]) -> Registers:
    """Registers of several tables, by their names; where two give one, the later counts."""
    return tuple(sorted(dict(pair for table in tables for pair in table).items()))


HeaderValue = str | float | tuple[float, ...] | None
"""What a header says of one thing: a text, a number or some; None or empty where it does not say it."""


NO_REMARKS: Ints = np.empty((0, 2), dtype=np.int64)


class Assumption(NamedTuple):
    """What a text leaves open, and what was taken; all of it for people.

    Attributes
    ----------
    what
        Term of the catalogue: ``assumed-dialect``, ``assumed-unit``, ``assumed-distance``, ``assumed-centres`` …
    taken
        What it was taken for, such as ``fast-wire``, ``0.001 mm``, ``G91``.
    why
        Term of the catalogue that says what speaks for it.
    """

    what: str
    taken: str
    why: str

    def entry(self, language: Language) -> AssumptionEntry:
        """It as documents have it; why it was made is told in a language."""
        return {"what": self.what.removeprefix("assumed-"), "taken": self.taken, "why": term(self.why, language)}


class BesideThePath(NamedTuple):
    """What a text asks for beside its path, and is not simulated.

    Attributes
    ----------
    reason
        Term of the catalogue that says what it is; empty where the path is all.
    words
        The words that ask for it, as people name them: ``G26``, ``U``.
    """

    reason: str = ""
    words: tuple[str, ...] = ()


PATH_IS_ALL = BesideThePath()


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
    """How a dialect writes what findings speak of.

    Attributes
    ----------
    clockwise, counter_clockwise
        Arcs.
    end, pause
        The end code, and a stop at which the operator goes on.
    rapid
        A rapid; empty where the machine jumps behind a pause alone.
    """

    clockwise: str
    counter_clockwise: str
    end: str
    pause: str
    rapid: str = ""

    @property
    def jump(self) -> str:
        """How a jump is written: as a rapid, or between two pauses."""
        return self.rapid or f"{self.pause} … {self.pause}"


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
    assumptions
        What the text leaves open and was taken, in the order in which it is told.
    codes
        Codes of this dialect for findings of the path and the machine that have other ones in 3B: ``3B301`` is
        ``ISO300``. Findings without one keep their code, which holds for every dialect.
    threadings
        How many jumps of the toolpath no block moves along: the wire is threaded elsewhere.
    not_simulated
        What the text asks for beside the path.
    """

    dialect: str
    counts: BlockCounts
    damages: tuple[Damage, ...]
    spelling: Spelling
    is_drawing: bool
    not_asked: Mapping[Check, str]
    offset_span: Span | None = None
    remarks: Ints = NO_REMARKS
    assumptions: tuple[Assumption, ...] = ()
    codes: Mapping[str, str] = MappingProxyType({})
    threadings: int = 0
    not_simulated: BesideThePath = PATH_IS_ALL


def in_codes(reading: Reading, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Findings of path and machine under the codes that the program's dialect has for them."""
    return tuple(found._replace(code=reading.codes.get(found.code, found.code)) for found in findings)


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
    decoder
        Shows how the words of a block are decoded; None where the dialect has no such thing to show.
    """

    lines: LineIndex
    reading: Reading
    header: Mapping[str, HeaderValue]
    toolpath: Toolpath
    findings: tuple[Finding, ...]
    mender: Mender | None = None
    decoder: Decoder | None = None


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

    def read(self, text: str, choices: Choices) -> ReadText:
        """What a text says. ProgramError (3B100) where it holds no block."""


def at_block(
    toolpath: Toolpath, lines: LineIndex, code: str, row: int, field: Field | None = None, /, **values: Value
) -> Finding:
    """Finding at a field of the block in a row (from 0) of the toolpath, or at the whole block.

    A field that is not written, or stands empty, is the whole block too.
    """
    return lines.finding(code, _span(toolpath, row, field), int(toolpath.source.block[row]), **values)


def without_stands(findings: Iterable[Finding], upper: Curves) -> tuple[Finding, ...]:
    """Findings without those on blocks that make no step, where their partner in another contour moves."""
    moves = upper.length_um > 0.0
    return tuple(each for each in findings if not (isinstance(each.fact, Stands) and moves[each.block - 1]))


def _span(toolpath: Toolpath, row: int, field: Field | None) -> Span:
    span = toolpath.source.field(row, field) if field is not None else None
    if span is not None and span[1] > span[0]:
        return span
    first, past = toolpath.source.span[row].tolist()
    return first, past
