"""Findings about what stands between the blocks: marks, labels, dialects."""

from collections.abc import Iterator

import numpy as np

from parser.dialect.at_block import at_block
from parser.dialect.choices import Marks
from parser.findings.facts import NoEnd, WithoutOffset
from parser.findings.findings import Finding
from parser.shape.closing import ends_closed
from parser.shape.passes import Passes, find_passes
from parser.threeb.figures import is_open_way, placed_marks
from parser.threeb.reader import Mark, Records
from parser.threeb.tokens import FOREIGN_ENDS, LIKE_A_BLOCK
from parser.toolpath import Toolpath

_SAME_PLACE_UM = 2.0  # printed places are rounded to 1 µm


def order_findings(records: Records, toolpath: Toolpath, marks: Marks) -> list[Finding]:
    """Findings about marks, labels and dialect of a program that was cut off at its end code."""
    return [
        *_no_end(records),
        *_foreign_ends(records, marks),
        *_repeated_labels(records, toolpath),
        *_dialect(records),
        *_idle_pauses(records, toolpath),
        *_unpaused_nodes(records, toolpath),
        *_long_ways(records, toolpath),
    ]


def lost_blocks(records: Records, end: Mark) -> list[Finding]:
    """Finding 3B103 where blocks, whole or damaged, stand after the end code: the machine is off by then."""
    whole = len(records.blocks.line) - end.after
    damaged = damaged_after(records, end)
    if not whole and not damaged:
        return []
    first = min([*damaged[:1], *([_span(records, end.after)] if whole else [])])
    return [records.lines.finding("3B103", first, blocks=whole + len(damaged), mark=end.word)]


def damaged_after(records: Records, end: Mark) -> list[tuple[int, int]]:
    """Spans of damaged blocks after the end code, in lines that were meant for blocks: other text may stand there."""
    lines = records.lines
    behind = [damage.span for damage in records.damages if damage.is_block and damage.span[0] > end.span[0]]
    meant = {lines.line(like.start()) for like in LIKE_A_BLOCK.finditer(lines.text, end.span[1])} if behind else ()
    return [span for span in behind if lines.line(span[0]) in meant]


def dialect(records: Records) -> str:
    """``3B``, ``4B``, or ``3B+4B`` where blocks of both stand in one program."""
    four = int((records.blocks.radius_um >= 0).sum())
    if not four:
        return "3B"
    return "4B" if four == len(records.blocks.line) else "3B+4B"


def _span(records: Records, block: int) -> tuple[int, int]:
    first, past = records.blocks.span[block].tolist()
    return first, past


def _no_end(records: Records) -> list[Finding]:
    if any(mark.kind == "end" for mark in records.marks):
        return []
    return [records.lines.finding("3B102", _span(records, -1)).with_fact(NoEnd())]


def _foreign_ends(records: Records, marks: Marks) -> Iterator[Finding]:
    for mark in records.marks:
        if mark.kind == "end" and mark.word in FOREIGN_ENDS and mark.word not in marks.end:
            yield records.lines.finding("3B105", mark.span, mark=mark.word)


def _repeated_labels(records: Records, toolpath: Toolpath) -> Iterator[Finding]:
    seen: dict[str, int] = {}
    for row, label in enumerate(toolpath.source.label):
        if not label:
            continue
        if label in seen:
            first = int(toolpath.source.line[seen[label]])
            yield at_block(toolpath, records.lines, "3B107", row, label=label, line=first)
        seen.setdefault(label, row)


def _dialect(records: Records) -> Iterator[Finding]:
    four = records.blocks.radius_um >= 0
    n = int(four.sum())
    if not n:
        return
    found = records.lines.finding("3B110", _span(records, int(np.argmax(four))), blocks=n, path="path-without-offset")
    yield found.with_fact(WithoutOffset())
    if n < len(four):
        rarer = four if 2 * n <= len(four) else ~four
        row = int(np.argmax(rarer))
        yield records.lines.finding("3B109", _span(records, row), row + 1, three=len(four) - n, four=n)


def _idle_pauses(records: Records, toolpath: Toolpath) -> Iterator[Finding]:
    """Pauses behind a pause with nothing between, and pauses after a closed figure that goes on without a jump.

    A closed figure may go on with a trim of its edge, or its tab. One that is cut once more as it was has lost a jump.
    """
    placed, jump = placed_marks(records.marks), toolpath.is_jump
    idle: list[tuple[Mark, int, bool]] = []
    begin = 0  # first row of the figure being cut
    for before, (row, mark) in zip([None, *placed], placed, strict=False):
        if mark.kind != "pause":
            continue
        repeated = before is not None and before[0] == row and before[1].kind == "pause"
        cuts_on = 0 < row < len(toolpath) and not jump[row - 1] and not jump[row]
        if repeated or (cuts_on and ends_closed(toolpath, begin, row)):
            idle.append((mark, row, repeated))
        begin = row
    passes = None if all(repeated for _, _, repeated in idle) else find_passes(toolpath)
    trimmed = (
        {pass_.edge for pass_ in passes.passes if abs(pass_.shift_um) > _SAME_PLACE_UM or pass_.is_tab}
        if passes
        else set()
    )
    for mark, row, repeated in idle:
        if repeated or passes is None or not _before_trim(passes, trimmed, row):
            yield records.lines.finding("3B308", mark.span, row)  # in the block that it follows


def _before_trim(passes: Passes, trimmed: set[int], row: int) -> bool:
    """Whether a pause before a row stands between two passes over one edge, one that is trimmed or has a tab."""
    around = passes.around(row)
    return around is not None and around[0].edge == around[1].edge and around[0].edge in trimmed


def _unpaused_nodes(records: Records, toolpath: Toolpath) -> Iterator[Finding]:
    """Start nodes that lie elsewhere than the wire stands, with no pause between the last cut and them."""
    paused, jump = -1, toolpath.is_jump  # rows before the last pause
    for row, mark in placed_marks(records.marks):
        if mark.kind != "node":
            paused = row
        elif 0 < row != paused and not jump[row - 1] and toolpath.length_um[row] > _SAME_PLACE_UM:
            yield records.lines.finding("3B309", mark.span, row + 1, length=float(toolpath.length_um[row]))


def _long_ways(records: Records, toolpath: Toolpath) -> Iterator[Finding]:
    """Lines between two pauses that are cut and close no figure: they may be the way to the next one."""
    placed = placed_marks(records.marks)
    pauses = [row for row, mark in placed if mark.kind == "pause"]
    nodes = {row for row, mark in placed if mark.kind == "node"}
    jump = toolpath.is_jump
    for at, until, after in zip(pauses, pauses[1:], [*pauses[2:], len(toolpath)], strict=False):
        is_way = until - at > 1 and jump[at] and not (jump[at + 1 : until] | toolpath.is_arc[at + 1 : until]).any()
        if is_way and at not in nodes and until < len(toolpath) and is_open_way(toolpath, at, until, after):
            length = float(toolpath.length_um[at + 1 : until].sum())
            yield at_block(toolpath, records.lines, "3B320", at + 1, lines=until - at - 1, last=until, length=length)
