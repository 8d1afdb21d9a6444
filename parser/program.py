"""Entry to the parser: a file or a text in, a program with its toolpath and findings out."""

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from parser.findings.errors import FileUnreadableError, ProgramError
from parser.findings.facts import TooLarge, telling
from parser.findings.findings import Finding, file_order
from parser.text.encoding import decode_text, no_program, printable
from parser.text.lines import LineIndex
from parser.threeb.block_checks import block_findings
from parser.threeb.columns import RawBlocks
from parser.threeb.damage import Damage
from parser.threeb.decode import decode
from parser.threeb.grammar import STANDARD_MARKS, Marks
from parser.threeb.header import Header
from parser.threeb.order_checks import damaged_after, dialect, lost_blocks, order_findings
from parser.threeb.print_checks import print_findings
from parser.threeb.reader import Records, read_records
from parser.toolpath import Toolpath


class Reading(NamedTuple):
    """How a text was read.

    Attributes
    ----------
    dialect
        ``3B``, ``4B`` or ``3B+4B``. 4B is read as the trade recalls it (docs/3b.md §6).
    found
        Blocks that stand in the text, damaged ones and those after the end code included.
    blocks
        Whole blocks, also those after the end code.
    run
        Of these, blocks before the end code.
    damages
        What could not be read before the end code, in order.
    """

    dialect: str
    found: int
    blocks: int
    run: int
    damages: tuple[Damage, ...]


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
    header
        What its header says.
    reading
        Dialect, and what could be read.
    toolpath
        Its exact geometry, up to the end code.
    findings
        What is wrong with the text and its single blocks, in file order.
    """

    name: str
    encoding: str
    text: str
    lines: LineIndex
    header: Header
    reading: Reading
    toolpath: Toolpath
    findings: tuple[Finding, ...]

    def excerpt(self, line: int) -> str:
        """Text of a line, from 1, as written, without its end."""
        return self.text[slice(*self.lines.bounds(line))]


def read_program(path: Path | str) -> Program:
    """Read a 3B or 4B file.

    Raises FileUnreadableError where there is no readable file, ProgramError (3B100) where it is no text or holds no
    block.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except IsADirectoryError:
        raise FileUnreadableError(f"{path}: is a folder; a 3B file was expected") from None
    except OSError as error:
        raise FileUnreadableError(f"{path}: cannot be read: {error.strerror or error}") from None
    return load_program(data, name=printable(path.name))


def load_program(data: bytes, name: str, marks: Marks = STANDARD_MARKS) -> Program:
    """Program of the bytes of a file. Raises ProgramError (3B100) where they are no text or hold no block."""
    text, encoding = decode_text(data)
    return parse_program(text, name=name, encoding=encoding, marks=marks)


def parse_program(text: str, name: str = "program", encoding: str = "utf-8", marks: Marks = STANDARD_MARKS) -> Program:
    """Program of a text. Raises ProgramError (3B100) where it holds no block."""
    records = read_records(text, marks)
    if not len(records.blocks.line):
        raise ProgramError(no_program("no-block"), others=records.findings)
    blocks = len(records.blocks.line)
    records, after_end, behind = _up_to_end(records)
    found = blocks + behind + sum(damage.is_block for damage in records.damages)
    reading = Reading(dialect(records), found, blocks, len(records.blocks.line), records.damages)
    toolpath = decode(records)
    damaged = np.array([damage.span[0] for damage in records.damages], dtype=np.int64)
    findings = [*records.findings, *after_end, *order_findings(records, toolpath, marks)]
    if not any(telling(findings, TooLarge)):
        findings += block_findings(toolpath, records.lines)
        findings += print_findings(toolpath, records.header, records.lines, damaged)
    ordered = tuple(sorted(findings, key=file_order))
    return Program(name, encoding, text, records.lines, records.header, reading, toolpath, ordered)


def _up_to_end(records: Records) -> tuple[Records, list[Finding], int]:
    """Records without what stands after the end code, finding 3B103 where blocks do, and how many of these are damaged.

    Marks before the first block are words of the header.
    """
    marks = tuple(mark for mark in records.marks if mark.after > 0 or mark.kind == "node")
    end = next((mark for mark in marks if mark.kind == "end"), None)
    if end is None:
        return records._replace(marks=marks), [], 0
    first = end.span[0]
    kept = records._replace(
        blocks=RawBlocks._make(column[: end.after] for column in records.blocks),
        marks=marks[: marks.index(end) + 1],
        damages=tuple(damage for damage in records.damages if damage.span[0] < first),
        findings=tuple(finding for finding in records.findings if finding.span[0] < first),
    )
    return kept, lost_blocks(records, end), len(damaged_after(records, end))
