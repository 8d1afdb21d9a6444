"""Findings about single blocks, from their words and the end printed beside them."""

from collections.abc import Iterator

import numpy as np

from parser.decode import endless
from parser.findings import Finding
from parser.lines import LineIndex
from parser.toolpath import Axis, Ints, Toolpath
from parser.units import mm

PRINTED_END_TOLERANCE_UM = 2.0
"""Printed ends are rounded to 1 µm; one that is more than 2 µm off is a damaged block (docs/3b.md §4)."""


def block_findings(toolpath: Toolpath, lines: LineIndex) -> list[Finding]:
    """Blocks that never end, make no step, or end elsewhere than printed."""
    return [*_endless(toolpath, lines), *_uncounted(toolpath, lines), *_misprinted(toolpath, lines)]


def _at(  # noqa: PLR0913 - one for each field of a finding
    toolpath: Toolpath, lines: LineIndex, row: int, code: str, *, found: str, expected: str, machine: str
) -> Finding:
    column = lines.column(int(toolpath.source.span[row, 0]))
    return Finding(code, found, expected, machine, int(toolpath.source.line[row]), column, row + 1)


def _endless(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    words = toolpath.words
    for row in np.flatnonzero(endless(words)).tolist():
        if words.turn[row]:
            yield _at(
                toolpath,
                lines,
                row,
                "3B201",
                found=f"the arc starts ({words.x_um[row]}, {words.y_um[row]}) µm from its centre",
                expected="a radius of more than 1 µm",
                machine="the controller has no circle to follow",
            )
            continue
        axis = Axis(int(words.count_axis[row])).name
        yield _at(
            toolpath,
            lines,
            row,
            "3B202",
            found=f"the line counts on {axis} and does not move on it",
            expected=f"G{'Y' if axis == 'X' else 'X'}, the axis it moves on",
            machine="the count never ends and the table runs away",
        )


def _uncounted(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    for row in np.flatnonzero((toolpath.words.count_um == 0) & ~toolpath.is_jump).tolist():
        yield _at(
            toolpath,
            lines,
            row,
            "3B205",
            found="J is 0",
            expected="the count length of the block",
            machine="the block makes no step",
        )


def _misprinted(toolpath: Toolpath, lines: LineIndex) -> Iterator[Finding]:
    for row in _printed_off(toolpath).tolist():
        printed, end = mm(toolpath.printed_end_um[row]), mm(toolpath.end_um[row])
        yield _at(
            toolpath,
            lines,
            row,
            "3B207",
            found=f"the printed end is {printed[0]:.3f}, {printed[1]:.3f} mm",
            expected=f"{end[0]:.3f}, {end[1]:.3f} mm as the block decodes",
            machine="the table follows the block, and all later blocks are shifted",
        )


def _printed_off(toolpath: Toolpath) -> Ints:
    """Rows at which the printed end leaves the decoded end; later rows that keep the same shift are not named again."""
    rows = np.flatnonzero(~np.isnan(toolpath.printed_end_um[:, 0]))
    off = toolpath.printed_end_um[rows] - toolpath.end_um[rows]
    change = np.diff(off, axis=0, prepend=np.zeros((1, 2)))
    return rows[np.hypot(change[:, 0], change[:, 1]) > PRINTED_END_TOLERANCE_UM]
