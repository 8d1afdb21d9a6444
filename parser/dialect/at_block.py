"""Findings at blocks: the place is that of the field which is wrong."""

from parser.findings.findings import Finding, Value
from parser.text.lines import LineIndex
from parser.text.source import Field, Span
from parser.toolpath import Toolpath


def at_block(
    toolpath: Toolpath, lines: LineIndex, code: str, row: int, field: Field | None = None, /, **values: Value
) -> Finding:
    """Finding at a field of the block in a row (from 0) of the toolpath, or at the whole block.

    A field that is not written, or stands empty, is the whole block too.
    """
    return lines.finding(code, _span(toolpath, row, field), int(toolpath.source.block[row]), **values)


def _span(toolpath: Toolpath, row: int, field: Field | None) -> Span:
    span = toolpath.source.field(row, field) if field is not None else None
    if span is not None and span[1] > span[0]:
        return span
    first, past = toolpath.source.span[row].tolist()
    return first, past
