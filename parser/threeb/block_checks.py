"""Findings about single blocks, from their words alone, and about what stands between them."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from parser.controller_words import Axis, StepWords
from parser.dialect.reader import Marks, at_block
from parser.findings.findings import (
    CountedElsewhere,
    DoubtfulEnd,
    Finding,
    NoEnd,
    Stands,
    Value,
    WithoutOffset,
    WrongLabel,
)
from parser.geometry.curves import Ints
from parser.shape.contours import ends_closed
from parser.shape.passes import Passes, find_passes
from parser.step_words.words import label
from parser.text.source import Field, LineIndex
from parser.threeb.decode import decoded_words, is_open_way, placed_marks
from parser.threeb.reader import RADIUS_TOLERANCE_UM, Mark, Records
from parser.threeb.tokens import FOREIGN_ENDS, LIKE_A_BLOCK
from parser.toolpath import Toolpath

FULL_TURN_UM = 4.0
"""J of a full circle is 4R within about this; more is more than one turn (docs/3b.md §1)."""
_COUNT_TOLERANCE_UM = 1  # a CAM may round X or Y and J apart
_SMALL_UM = 100  # X:Y of a slope that was reduced are small numbers
_SLOPE_UM = 1000  # X:Y of a slope by hand, such as 577:1000, are no longer than this
_SLOPE_TIMES = 10  # where X:Y of a line is a slope and no length, J is at least so many times as long
_WAYS = ("+X", "+Y", "−X", "−Y")


def block_findings(toolpath: Toolpath, lines: LineIndex) -> list[Finding]:
    """Blocks that never end or make no step, and words that do not fit each other or the rules of the trade."""
    checks = (_endless, _uncounted, _neighbour_labels, _line_counts, _turns, _radii)
    return [finding for check in checks for finding in check(toolpath, lines)]


def ruled_label(words: StepWords) -> Ints:
    """Quadrant (n,) that the trade writes on blocks along or from an axis (docs/3b.md §1); elsewhere the one written.

    Lines and counter-clockwise arcs: +X 1, +Y 2, −X 3, −Y 4; clockwise arcs: +Y 1, −X 2, −Y 3, +X 4.
    """
    sign = words.signs
    along_x, along_y = (words.y_um == 0) & (words.x_um > 0), (words.x_um == 0) & (words.y_um > 0)
    way = np.where(along_x, np.where(sign[:, 0] > 0, 0, 2), np.where(sign[:, 1] > 0, 1, 3))
    ruled = np.where(words.turn < 0, (way - 1) % 4 + 1, way + 1)
    return np.where(along_x | along_y, ruled, words.quadrant)


def counts_fit(words: StepWords) -> NDArray[np.bool_]:
    """(n,) False on lines whose J fits none of the ways in which a line is written.

    J is the length on the counted axis, or a multiple of it where X and Y are reduced. Where X:Y is a slope in lowest
    terms and small against J, a J written by hand need not be a multiple.
    """
    counted = _counted(words)
    near = np.abs(words.count_um - counted) <= _COUNT_TOLERANCE_UM
    longer = np.maximum(words.x_um, words.y_um)
    is_slope = (np.gcd(words.x_um, words.y_um) == 1) & (longer <= _SLOPE_UM)
    is_slope &= _SLOPE_TIMES * longer <= words.count_um
    fits: NDArray[np.bool_] = (words.turn != 0) | near | is_slope | (words.count_um % np.maximum(counted, 1) == 0)
    return fits


def _counted(words: StepWords) -> Ints:
    return np.where(words.count_axis == Axis.X, words.x_um, words.y_um)


def _endless(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    words = decoded_words(toolpath)
    for row in np.flatnonzero(words.is_endless).tolist():
        if words.turn[row]:
            yield at_block(toolpath, lines, "3B201", row, x=int(words.x_um[row]), y=int(words.y_um[row]))
            continue
        axis = Axis(int(words.count_axis[row])).name
        other = "Y" if axis == "X" else "X"
        yield at_block(toolpath, lines, "3B202", row, Field.AXIS, axis=axis, other=other)


def _uncounted(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    for row in np.flatnonzero((decoded_words(toolpath).count_um == 0) & ~toolpath.is_jump).tolist():
        yield at_block(toolpath, lines, "3B205", row, Field.COUNT).with_fact(Stands())


def _neighbour_labels(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    words = decoded_words(toolpath)
    ruled = ruled_label(words)
    for row in np.flatnonzero(ruled != words.quadrant).tolist():
        turn, quadrant = int(words.turn[row]), int(ruled[row])
        way = (quadrant - 1 + (turn < 0)) % 4
        values = {"written": label(turn, int(words.quadrant[row])), "ruled": label(turn, quadrant), "way": _WAYS[way]}
        values["others"] = ""
        found = at_block(toolpath, lines, "3B203", row, Field.SENSE, **values)
        yield found.with_fact(WrongLabel(values["ruled"]))


def _line_counts(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    """Counts of lines that do not fit (3B208), or are a multiple though X and Y are not reduced (3B209)."""
    words = decoded_words(toolpath)
    counted = _counted(words)
    off = ~counts_fit(words)
    times, rest = np.divmod(words.count_um, np.maximum(counted, 1))
    unreduced = (words.turn == 0) & (np.gcd(words.x_um, words.y_um) > 1) & (counted >= _SMALL_UM)
    for row in np.flatnonzero(off | (unreduced & (times > 1) & (rest == 0))).tolist():
        count, extent = int(words.count_um[row]), int(counted[row])
        values: dict[str, Value] = {"count": count, "extent": extent, "axis": Axis(int(words.count_axis[row])).name}
        if off[row]:
            goes = "too-far" if count > extent else "too-short"
            by = abs(count - extent)
            values |= {"goes": goes, "by": by}
            found = at_block(toolpath, lines, "3B208", row, Field.COUNT, **values)
            yield found.with_fact(CountedElsewhere())
        else:
            values["times"] = int(times[row])
            yield at_block(toolpath, lines, "3B209", row, Field.COUNT, **values)


def _turns(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    full, counts = 4.0 * toolpath.radius_um, decoded_words(toolpath).count_um
    for row in np.flatnonzero(counts > full + FULL_TURN_UM).tolist():
        count = int(counts[row])
        values = {"count": count, "full": round(float(full[row])), "turns": round(count / float(full[row]), 1)}
        yield at_block(toolpath, lines, "3B210", row, Field.COUNT, **values).with_fact(DoubtfulEnd())


def _radii(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    """Radii of 4B arcs that differ from the radius that their X and Y give."""
    written = decoded_words(toolpath).radius_um
    off = (written > 0) & toolpath.is_arc & (np.abs(written - toolpath.radius_um) > RADIUS_TOLERANCE_UM)
    for row in np.flatnonzero(off).tolist():
        decoded = float(toolpath.radius_um[row])
        yield at_block(toolpath, lines, "3B212", row, Field.RADIUS, radius=int(written[row]), decoded=decoded)


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
    for row, name in enumerate(toolpath.source.label):
        if not name:
            continue
        if name in seen:
            first = int(toolpath.source.line[seen[name]])
            yield at_block(toolpath, records.lines, "3B107", row, label=name, line=first)
        seen.setdefault(name, row)


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
