"""Findings about single blocks, from their words alone."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from parser.controller_words.step_words import Axis, StepWords
from parser.dialect.at_block import at_block
from parser.findings.facts import CountedElsewhere, DoubtfulEnd, WrongLabel
from parser.findings.findings import Finding, Value
from parser.geometry.curves import Ints
from parser.step_words.labels import label
from parser.text.lines import LineIndex
from parser.text.source import Field
from parser.threeb.decode import decoded_words
from parser.threeb.reader import RADIUS_TOLERANCE_UM
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
        yield at_block(toolpath, lines, "3B205", row, Field.COUNT)


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
