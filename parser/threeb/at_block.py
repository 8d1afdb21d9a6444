"""Findings at blocks: the place is that of the field which is wrong."""

from parser.findings.findings import Finding, Value
from parser.text.lines import LineIndex
from parser.threeb.tokens import TokenKind, field_spans
from parser.toolpath import Toolpath


def at_block(
    toolpath: Toolpath, lines: LineIndex, code: str, row: int, field: TokenKind | None = None, /, **values: Value
) -> Finding:
    """Finding at a field of the block in a row (from 0) of the toolpath, or at the whole block."""
    first, past = toolpath.source.span[row].tolist()
    if field is not None:
        low, high = field_spans(lines.text, first, past).get(field, (first, past))
        first, past = (low, high) if high > low else (first, past)
    return lines.finding(code, (first, past), int(toolpath.source.block[row]), **values)
