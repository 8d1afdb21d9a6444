"""Entry to the parser: a file or a text in, a program with its toolpath and findings out, whichever its dialect."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from parser.dialect.decoding import Decoder
from parser.dialect.mender import Mender
from parser.dialect.reader import (
    STANDARD_CHOICES,
    Choices,
    HeaderValue,
    Marks,
    Reader,
    Reading,
    at_block,
    without_stands,
)
from parser.files import PROGRAMS, kind_of, read_bytes
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, Value
from parser.geometry.curves import Curves
from parser.iso.dialect import ISO
from parser.iso.profiles.profile import PROFILES
from parser.iso.profiles.profile import own_dialect as own_dialect  # noqa: PLC0414 - handed on
from parser.iso.profiles.profile import own_dialect_schema as own_dialect_schema  # noqa: PLC0414 - handed on
from parser.iso.profiles.profile import own_dialect_text as own_dialect_text  # noqa: PLC0414 - handed on
from parser.pmac.dialect import PMAC
from parser.text.encoding import decode_text, narrow, no_program, printable
from parser.text.source import LineIndex
from parser.threeb.dialect import THREE_B
from parser.toolpath import Toolpath

_REMARK = re.compile(r"//[^\r\n]*|;[^\r\n]*|\([^()\r\n]*\)")
_LOOKED_AT = 1 << 15  # characters: whatever a program is, it says so by then

READERS: tuple[Reader, ...] = (THREE_B, ISO, PMAC)
"""Readers in the order in which they are asked."""


@dataclass(frozen=True, slots=True, eq=False)
class Program:
    """A program as read.

    Attributes
    ----------
    name
        File name to show in messages.
    encoding
        Encoding of the file.
    text, lines
        The whole text, and the places in it.
    reading, header, toolpath, findings, mender, decoder
        What its reader made of it; see `parser.dialect.reader.ReadText`.
    choices
        What it was read with.
    """

    name: str
    encoding: str
    text: str
    lines: LineIndex
    reading: Reading
    header: Mapping[str, HeaderValue]
    toolpath: Toolpath
    findings: tuple[Finding, ...]
    mender: Mender | None
    decoder: Decoder | None = None
    choices: Choices = STANDARD_CHOICES

    def excerpt(self, line: int) -> str:
        """Text of a line, from 1, as written, without its end."""
        return self.text[slice(*self.lines.bounds(line))]


def read_program(path: Path | str, choices: Choices = STANDARD_CHOICES) -> Program:
    """Read a file.

    Raises FileUnreadableError where there is no readable file, ProgramError (3B100) where it is no text or holds no
    block.
    """
    path = Path(path)
    return load_program(read_bytes(path), name=printable(path.name), choices=choices)


def paired(program: Program, upper: Program) -> Program:
    """The program with the contour of another one as its upper one, block by block.

    ProgramError (3B705) where the blocks of the two cannot be run together: there are not as many, or one jumps where
    the other cuts.
    """
    low, high = program.toolpath, upper.toolpath
    n = min(len(low), len(high))
    differs = np.flatnonzero(low.is_jump[:n] != high.is_jump[:n])
    if len(low) != len(high) or len(differs):
        row = int(differs[0]) if len(differs) else n - 1
        values: dict[str, Value] = {"lower": len(low), "upper": len(high)}
        what = "pair-jumps" if len(differs) else "pair-counts"
        finding = at_block(low, program.lines, "3B705", max(row, 0), what=what, **values)
        raise ProgramError(finding, excerpt=program.excerpt(finding.line))
    found = without_stands(program.findings, high)
    return replace(program, toolpath=replace(low, upper=high.picked(slice(None))), findings=found)


def upper_program(program: Program) -> Program:
    """A program along the upper contour of one that has two: the same blocks, without words that count steps."""
    toolpath, upper = program.toolpath, program.toolpath.upper
    if upper is None:
        raise ValueError(f"{program.name} has one contour")
    columns = {name: getattr(upper, name) for name in Curves.__slots__}
    unprinted = np.full((len(toolpath), 2), np.nan)
    alone = replace(toolpath, **columns, printed_end_um=unprinted, words=None, told_center_um=None, upper=None)
    return replace(program, toolpath=alone)


def moving(program: Program) -> Program:
    """A program in which something moves, as whatever runs or shows a path needs it. ProgramError (ISO100) else."""
    if not len(program.toolpath):
        raise ProgramError(no_program("no-motion", language="ISO"))
    return program


def load_program(data: bytes, name: str, choices: Choices = STANDARD_CHOICES) -> Program:
    """Program of the bytes of a file.

    Raises ProgramError (3B100, ISO100, PMC100) where they are no text or hold no block; it says what they are where
    that is certain.
    """
    try:
        text, encoding = decode_text(data)
        return parse_program(text, name=name, encoding=encoding, choices=choices)
    except ProgramError as error:
        what = str(error.finding.values.get("what", ""))
        if what not in {"empty", "not-text", "no-block"}:
            raise
        kind = kind_of(data)
        known = kind not in {"", *PROGRAMS}  # blocks that all stand in remarks are a program without blocks
        raise ProgramError(none_there(kind if known else what, name, choices), others=error.others) from None


def parse_program(
    text: str, name: str = "program", encoding: str = "utf-8", choices: Choices = STANDARD_CHOICES
) -> Program:
    """Program of a text.

    Raises ProgramError (3B100, ISO100, PMC100) where it holds no block, or those of two languages.
    """
    reader = _reader(text, of_none=_meant(name, choices))
    return Program(name, encoding, text, **reader.read(text, choices)._asdict(), choices=choices)


def none_there(what: str, name: str, choices: Choices, detail: str = "") -> Finding:
    """Finding 3B100, ISO100 or PMC100, by the language that a file is meant for, its values as for `no_program`."""
    return no_program(what, detail, language=_meant(name, choices).name)


def _meant(name: str, choices: Choices) -> Reader:
    """The reader that tells what is wrong with a text that none knows: the dialects that can be chosen are of ISO."""
    if choices.dialect:
        return ISO
    return next((reader for reader in (ISO, PMAC) if name.lower().endswith(reader.suffixes)), READERS[0])


def _reader(text: str, *, of_none: Reader) -> Reader:
    """The reader that knows a text: what stands first in it decides, without remarks if possible.

    Raises ProgramError (ISO100) where two know it there: no machine runs both.
    """
    first = _REMARK.sub("", narrow(text[:_LOOKED_AT]))
    if PMAC.recognises(first):  # its buffers may hold G words
        return PMAC
    known = [reader for reader in READERS if reader.recognises(first)]
    if len({reader.name for reader in known}) > 1:
        raise ProgramError(no_program("two-languages", language="ISO"))
    return known[0] if known else next((reader for reader in READERS if reader.recognises(text)), of_none)


def suffixes() -> tuple[str, ...]:
    """Ends of names by which programs are known, of all readers in turn; files may be named otherwise."""
    return tuple(suffix for reader in READERS for suffix in reader.suffixes)


def usual_name(text: str) -> str:
    """Name of a file for a text that has none: its end is the usual one of the language that the text is written in."""
    try:
        reader = _reader(text, of_none=READERS[0])
    except ProgramError:
        reader = READERS[0]
    return f"program{reader.suffixes[0]}"


def own_marks() -> Marks:
    """Marks that the dialects of all readers have themselves, in capitals."""
    own = [reader.own_marks for reader in READERS]
    return Marks(
        end=tuple(word for marks in own for word in marks.end),
        pause=tuple(word for marks in own for word in marks.pause),
    )


def dialects() -> tuple[str, ...]:
    """Names of dialects that may be chosen for a program: the profiles of ISO."""
    return PROFILES


def block_words() -> tuple[str, ...]:
    """Words of letters that blocks are written with, of all readers, in capitals: none of them can be a mark."""
    return tuple(word for reader in READERS for word in reader.block_words)
