"""Mends of a block that ends elsewhere than printed: one of its fields, written otherwise, would end it there."""

import numpy as np

from parser.dialect.mender import Mend
from parser.geometry.curves import Ints
from parser.threeb.block_checks import counts_fit
from parser.threeb.mend.joints import Rings, joint_points
from parser.threeb.mend.likelihood import familiar, obedience, sizes
from parser.threeb.mend.mends import FIELDS, SENSE, Mends, ease, field_text, mends, moves_of, word_table, words_of
from parser.threeb.print_checks import print_change
from parser.toolpath import Toolpath
from parser.words.moves import Moves

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
    points, least = alone + _beside(toolpath, row, now), _LEAST + written + int(_beside(toolpath, row, was)[0])
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


def _beside(toolpath: Toolpath, row: int, made: Moves) -> Ints:
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
