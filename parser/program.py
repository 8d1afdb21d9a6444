"""Entry to the parser: a file or a text in, a program with its toolpath and findings out."""

from dataclasses import dataclass
from pathlib import Path

from parser.block_checks import block_findings
from parser.decode import decode
from parser.encoding import decode_text, printable
from parser.errors import FileUnreadableError, ProgramError
from parser.findings import Finding
from parser.reader import RawBlocks, Records, read_records
from parser.toolpath import Toolpath


@dataclass(frozen=True, slots=True)
class Program:
    """A program as read.

    Attributes
    ----------
    name
        File name to show in messages.
    encoding
        Encoding of the file.
    text
        The whole text.
    toolpath
        Its exact geometry, up to the end code.
    findings
        What is wrong with the text and its single blocks, in file order.
    """

    name: str
    encoding: str
    text: str
    toolpath: Toolpath
    findings: tuple[Finding, ...]


def read_program(path: Path | str) -> Program:
    """Read a 3B file.

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
    text, encoding = decode_text(data)
    return parse_program(text, name=printable(path.name), encoding=encoding)


def parse_program(text: str, name: str = "program", encoding: str = "utf-8") -> Program:
    """Program of a text. Raises ProgramError (3B100) where it holds no block."""
    records = read_records(text)
    if not len(records.blocks.line):
        raise ProgramError(
            "no block found; expected `B X B Y B J G Z` such as `B 0 B 24900 B 24900 GY L2`; "
            "the machine would do nothing",
            code="3B100",
        )
    records, after_end = _up_to_end(records)
    toolpath = decode(records)
    findings = [*records.findings, *after_end, *_no_end(records), *block_findings(toolpath, records.lines)]
    return Program(name, encoding, text, toolpath, tuple(sorted(findings, key=lambda f: (f.line, f.column, f.code))))


def _up_to_end(records: Records) -> tuple[Records, list[Finding]]:
    """Records without what stands after the end code, and a finding where blocks do: the machine is off by then.

    ``D`` and ``DD`` before the first block are words of the header.
    """
    marks = tuple(mark for mark in records.marks if mark.after > 0 or mark.kind == "node")
    end = next((mark for mark in marks if mark.kind == "end"), None)
    if end is None:
        return records._replace(marks=marks), []
    at = end.line, records.lines.column(end.span[0])
    lost = len(records.blocks.line) - end.after
    kept = records._replace(
        blocks=RawBlocks._make(column[: end.after] for column in records.blocks),
        marks=marks[: marks.index(end) + 1],
        findings=tuple(finding for finding in records.findings if (finding.line, finding.column) < at),
    )
    if not lost:
        return kept, []
    line, column = int(records.blocks.line[end.after]), records.lines.column(int(records.blocks.span[end.after, 0]))
    return kept, [
        Finding(
            "3B103",
            f"{lost} block{'s' if lost > 1 else ''} after DD",
            "DD as the last mark",
            "the machine switches off at DD and never runs them",
            line,
            column,
        )
    ]


def _no_end(records: Records) -> list[Finding]:
    if any(mark.kind == "end" for mark in records.marks):
        return []
    return [
        Finding(
            "3B102",
            "no end code",
            "DD after the last block",
            "the machine does not switch off by itself",
            int(records.blocks.line[-1]),
        )
    ]
