"""Suspects: the one block that would close an open contour if one of its fields were written otherwise.

All that follows the mended block shifts with its end, so a mend closes the contour if it makes up for the gap. Of those
that do, the likeliest are named: the ones that turn an unlikely block into a likely one by the slightest change.
"""

from typing import NamedTuple

import numpy as np

from parser.dialect.mender import Suspect
from parser.geometry.curves import Floats, Ints
from parser.shape.closing import closure_tolerance_um
from parser.threeb.mend.joints import Ring, joint_points
from parser.threeb.mend.likelihood import alike, familiar, obedience, sizes
from parser.threeb.mend.mends import (
    FIELDS,
    QUADRANT,
    SENSE,
    TURN,
    Mends,
    ease,
    field_text,
    mends,
    moves_of,
    word_table,
    words_of,
)
from parser.toolpath import Toolpath
from parser.words.moves import Moves

MOST = 5
"""Suspects named at most; where more are as likely, naming some would accuse them by chance."""

_ROWS_AT_ONCE = 4096
_MOST_OFF_UM = 100.0  # however many arcs: errors of a CAM do not add up (docs/3b.md §1)
_OWN_START = 2  # points for ending at the first start, not at the end of a lead-in
_CLOSED_LOOP = 6  # points if a loop closes between lead-in and lead-out: then one of these two is at fault
_LEAST = 7  # points of a mend worth naming: one slip that makes the contour no less likely


class _Ranked(NamedTuple):
    """Mends with their rows in the toolpath, their points, and how far from closed they leave the contour."""

    row: Ints
    field: Ints
    word: Ints
    points: Ints
    off_um: Floats


def suspects(toolpath: Toolpath, first_row: int, past_row: int) -> tuple[Suspect, ...]:
    """The likeliest mends of the open contour of the rows from `first_row` up to but without `past_row`, best first.

    It may rightly end at its start, or at the end of a lead-in of one line. Empty where no mend closes it, where none
    makes it likelier than it stands, and where more than `MOST` are as likely.
    """
    rows = np.arange(first_row, past_row)
    tolerance = min(closure_tolerance_um(int(toolpath.is_arc[rows].sum())), _MOST_OFF_UM)
    all_sizes = np.sort(sizes(moves_of(word_table(toolpath, rows))))
    best = [
        _ranked(toolpath, ring, part, all_sizes, tolerance)
        for ring in _rings(toolpath, first_row, past_row, tolerance)
        for part in np.array_split(ring.rows, len(ring.rows) // _ROWS_AT_ONCE + 1)
    ]
    return _named(toolpath, _leading(best))


def _rings(toolpath: Toolpath, first: int, past: int, tolerance_um: float) -> list[Ring]:
    """Where the contour may close, and which rows may be at fault then.

    If the lead-out goes back along the lead-in, these two are cleared. If the loop between them closes, one of these
    two is likelier at fault than the other rows.
    """
    last = past - 1
    start, end = toolpath.start_um, toolpath.end_um
    gap = start[first] - end[last]
    own = Ring(np.arange(first, past), first, last, gap, _OWN_START)
    if past - first < 3:
        return [own]
    after_lead = Ring(np.arange(first + 1, past), first + 1, last, start[first + 1] - end[last])
    there_and_back = end[first] - start[first] + end[last] - start[last]
    loop = start[first + 1] - end[last - 1]
    if np.hypot(*loop) <= tolerance_um:
        return [Ring(np.array([first, last]), first, last, gap, _CLOSED_LOOP, is_led=True), own, after_lead]
    if np.hypot(*there_and_back) <= tolerance_um:
        return [Ring(np.arange(first + 1, last), first + 1, last - 1, loop)]
    return [own, after_lead]


def _ranked(toolpath: Toolpath, ring: Ring, rows: Ints, all_um: Floats, tolerance_um: float) -> _Ranked:
    """Mends of some rows of a ring, with their points: those of the block mended less those of the block written."""
    word = word_table(toolpath, rows)
    was = moves_of(word)
    made = mends(word, was.by_um, ring.gap_um, tolerance_um)
    now, row = moves_of(made.word), rows[made.row]
    before, after = word[made.row], made.word
    old = Moves(*(column[made.row] for column in was))
    points = (
        obedience(words_of(after), now)
        - obedience(words_of(before), old)
        + joint_points(toolpath, ring, row, now)
        - joint_points(toolpath, ring, row, old)
        + familiar(sizes(now), all_um, 1 + alike(sizes(now), sizes(old)))
        - familiar(sizes(old), all_um, 2)
        + ease(before, made)
        + ring.points
    )
    off = now.by_um - old.by_um - ring.gap_um
    return _Ranked(row, made.field, made.word, points, np.hypot(off[:, 0], off[:, 1]))


def _leading(found: list[_Ranked]) -> Mends:
    """The mends with the most points of all. Rows are the toolpath's.

    Of the values that a number may have, and of the quadrants of a line, the one that closes best stands for them.
    """
    best = max([_LEAST, *(int(ranked.points.max()) for ranked in found if len(ranked.points))])
    row, field, word, off = (
        np.concatenate([ranked[column][ranked.points >= best] for ranked in found]) for column in (0, 1, 2, 4)
    )
    said = np.where((field == SENSE) & (word[:, TURN] != 0), word[:, TURN] * 8 + word[:, QUADRANT], 0)
    order = np.lexsort([off, said, field, row])
    row, field, word, said = row[order], field[order], word[order], said[order]
    new = (np.diff(row, prepend=-1) != 0) | (np.diff(field, prepend=-1) != 0) | (np.diff(said, prepend=-99) != 0)
    return Mends(row[new], field[new], word[new])


def _named(toolpath: Toolpath, leading: Mends) -> tuple[Suspect, ...]:
    if len(leading.row) > MOST:
        return ()
    written = word_table(toolpath, leading.row)
    return tuple(
        Suspect(int(row), FIELDS[field], field_text(before, field), field_text(after, field))
        for row, field, before, after in zip(leading.row, leading.field.tolist(), written, leading.word, strict=True)
    )
