"""Mends of a block that ends elsewhere than printed: one of its fields, written otherwise, would end it there."""

import numpy as np

from parser.dialect.mender import Mend
from parser.threeb.block_checks import counts_fit
from parser.threeb.mend.likelihood import obedience
from parser.threeb.mend.mends import FIELDS, Mends, ease, field_text, mends, moves_of, word_table, words_of
from parser.threeb.print_checks import print_change
from parser.toolpath import Toolpath

_PRINTED_UM = 1.5  # a printed end is rounded to 1 µm, and so is J
_AS_LIKELY = 6  # points; one broken rule, or a number changed in more than a digit, is less likely


def printed_mends(toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
    """The likeliest mends of the block in a row that ends elsewhere than printed, at most one a field."""
    gap = print_change(toolpath, row)
    word = word_table(toolpath, np.array([row]))
    by = moves_of(word).by_um
    made = mends(word, by, gap, _PRINTED_UM)
    words = words_of(made.word)
    sound = ~words.is_endless & counts_fit(words)  # what only moves the fault on is no mend
    made = Mends(*(column[sound] for column in made))
    if not len(made.row):
        return ()
    now = moves_of(made.word)
    points = obedience(words_of(made.word), now) + ease(word[made.row], made)
    off = np.hypot(*(now.by_um - by - gap).T)
    order = np.lexsort([off, -points])
    best: dict[int, Mend] = {}
    for at in order[points[order] >= points.max() - _AS_LIKELY].tolist():
        field = int(made.field[at])
        best.setdefault(field, Mend(FIELDS[field], field_text(made.word[at], field)))
    return tuple(best[field] for field in sorted(best))
