"""Mends of a block that ends elsewhere than printed: one of its fields, written otherwise, would end it there.

Joints of a contour: how likely they are with a block written otherwise.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.dialect.mender import Mend
from parser.geometry.curves import Floats, Ints
from parser.step_words.words import Moves
from parser.threeb.block_checks import counts_fit
from parser.threeb.mend.likelihood import familiar, joint, obedience, sizes
from parser.threeb.mend.mends import FIELDS, SENSE, Mends, ease, field_text, mends, moves_of, word_table, words_of
from parser.threeb.print_checks import print_change
from parser.toolpath import Toolpath


class Rings(NamedTuple):
    """Contours as they should close: (k,) or one of all: from row `end` back to the start of row `begin`.

    `is_led` tells that one closes where a lead-out ends on a lead-in, which is no joint.
    """

    begin: Ints | int
    end: Ints | int
    is_led: NDArray[np.bool_] | bool


def joint_points(toolpath: Toolpath, rings: Rings, row: Ints, made: Moves) -> Ints:
    """(k,) points of the joints of rings that the rows touch, if they moved so, and of the one that closes each."""
    k = len(row)
    begin, end = np.broadcast_to(rings.begin, k), np.broadcast_to(rings.end, k)
    at_begin, at_end = row == begin, row == end
    before, after = np.where(at_begin, end, row - 1), np.where(at_end, begin, row + 1)
    was = moves_of(word_table(toolpath, np.concatenate([before, after, end, begin])))
    arriving, leaving = _directions(was, 1.0), _directions(was, 0.0)
    own_leaving, own_arriving = _directions(made, 0.0), _directions(made, 1.0)
    slack = 1.0 / np.maximum(was.length_um, 1.0)
    own = 1.0 / np.maximum(made.length_um, 1.0)
    entering = joint(arriving[:k], own_leaving, slack[:k] + own)
    exiting = joint(own_arriving, leaving[k : 2 * k], slack[k : 2 * k] + own)
    closing = joint(arriving[2 * k : 3 * k], leaving[3 * k :], slack[2 * k : 3 * k] + slack[3 * k :])
    led = np.where(at_begin, 0, entering) + np.where(at_end, 0, exiting)
    return np.where(rings.is_led, led, entering + exiting + np.where(at_begin | at_end, 0, closing))


def _directions(made: Moves, fraction: float) -> Floats:
    """(n, 2) directions at a fraction of each block's length; (0, 0) where it has none."""
    angle = made.start_angle_rad + fraction * made.sweep_rad
    tangent = np.stack([-np.sin(angle), np.cos(angle)], axis=1) * np.sign(made.sweep_rad)[:, None]
    chord = made.by_um / np.where(made.length_um > 0.0, made.length_um, 1.0)[:, None]
    return np.where(np.isnan(made.radius_um)[:, None], chord, tangent)


_PRINTED_UM = 1.5  # a printed end is rounded to 1 µm, and so is J
_LEAST = 7  # points more than the block as written: one slip that makes it no less likely
_AS_LIKELY = 6  # points; one broken rule, or a number changed in more than a digit, is less likely


def printed_mends(toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
    """The likeliest mends of the block in a row that ends elsewhere than printed, best first.

    Of the values that a number may have, the best one stands for it.
    """
    gap = print_change(toolpath, row)
    word = word_table(toolpath, np.array([row]))
    was = moves_of(word)
    by = was.by_um
    made = mends(word, by, gap, _PRINTED_UM)
    words = words_of(made.word)
    sound = ~words.is_endless & counts_fit(words)  # what only moves the fault on is no mend
    made = Mends(*(column[sound] for column in made))
    if not len(made.row):
        return ()
    now = moves_of(made.word)
    alone, written = (
        obedience(words_of(made.word), now) + ease(word[made.row], made),
        int(obedience(words_of(word), was)[0]),
    )
    points, least = (
        alone + _points_beside(toolpath, row, now),
        _LEAST + written + int(_points_beside(toolpath, row, was)[0]),
    )
    if points.max() < least:  # what is written fits its neighbours by chance: the printed end speaks against it
        points, least = alone, _LEAST + written
    off = np.hypot(*(now.by_um - by - gap).T)
    order = np.lexsort([off, -points])
    best: dict[int | str, Mend] = {}
    for at in order[points[order] >= max(least, points.max() - _AS_LIKELY)].tolist():
        field = int(made.field[at])
        text = field_text(made.word[at], field)
        best.setdefault(text if field == SENSE else field, Mend(FIELDS[field], text))
    return tuple(best.values())


def _points_beside(toolpath: Toolpath, row: int, made: Moves) -> Ints:
    """(k,) points of the joints with the blocks beside a row, if it moved so, and of sizes that its contour has too."""
    jump = toolpath.is_jump
    if jump[row]:
        return np.zeros(len(made.length_um), dtype=np.int64)
    jumps = np.flatnonzero(jump)
    at = int(np.searchsorted(jumps, row))
    begin = int(jumps[at - 1]) + 1 if at else 0
    past = int(jumps[at]) if at < len(jumps) else len(toolpath)
    others = np.delete(np.arange(begin, past), row - begin)
    ring = Rings(begin, past - 1, is_led=True)
    known = np.sort(sizes(moves_of(word_table(toolpath, others))))
    return joint_points(toolpath, ring, np.full(len(made.length_um), row), made) + familiar(sizes(made), known, 1)
