"""One slip of the pen: every word of a contour written otherwise that ends the contour where it was to end.

Nothing is solved here: all slips are tried, so that a word that was meant is among them, whatever else is odd.
"""

from operator import itemgetter

import numpy as np

from parser.dialect.mender import Suspect
from parser.geometry.curves import Bools, Floats, Ints
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.text.source import Field
from parser.threeb.block_checks import counts_fit
from parser.threeb.mend.likelihood import obedience
from parser.threeb.mend.mends import (
    FIELDS,
    PLACES,
    TURN,
    Mends,
    ease,
    field_text,
    joined,
    moves_of,
    other_axes,
    other_senses,
    word_table,
    words_of,
)
from parser.threeb.mend.solved import COUNT, X, Y
from parser.toolpath import Toolpath

_STILL_UM = 1e-6
_ROWS_AT_ONCE = 1_000  # some 300 slips each, 100 bytes a slip


def one_slips(toolpath: Toolpath, first_row: int, past_row: int, most: int) -> tuple[Suspect, ...]:
    """Slips with which the rows from `first_row` up to but without `past_row` end at their start, likeliest first.

    Where they end there already, slips that turn an arc round, and move no end. A block that was meant obeys the
    trade's rules no less than what is written. At most `most`.
    """
    gap: Floats = toolpath.start_um[first_row] - toolpath.end_um[past_row - 1]
    found: list[tuple[int, float, Suspect]] = []
    for low in range(first_row, past_row, _ROWS_AT_ONCE):
        rows = np.arange(low, min(low + _ROWS_AT_ONCE, past_row))
        word = word_table(toolpath, rows)
        made = _that_end_well(gap, word)
        now = moves_of(made.word)
        points = obedience(words_of(made.word), now) + ease(word[made.row], made)
        off = np.hypot(*(now.by_um - moves_of(word).by_um[made.row] - gap).T)
        columns = zip(points.tolist(), off.tolist(), made.row.tolist(), made.field.tolist(), made.word, strict=True)
        for point, off_um, row, field, after in columns:
            was, other = field_text(word[row], field), field_text(after, field)
            found.append((-point, off_um, Suspect(int(rows[row]), FIELDS[field], was, other)))
    best: dict[tuple[int, Field, str], Suspect] = {}
    # Of numbers some µm apart the likeliest stands for all, and of those the one with which the contour ends nearest.
    for _, _, suspect in sorted(found, key=itemgetter(0, 1)):
        which = suspect.other if suspect.field in {Field.AXIS, Field.SENSE} else ""
        best.setdefault((suspect.row, suspect.field, which), suspect)
    return tuple(best.values())[:most]


def _that_end_well(gap: Floats, word: Ints) -> Mends:
    """Slips in rows with the words `word` (n, 6), by which a contour ends elsewhere by the gap (2,), or as it does."""
    was = moves_of(word)
    made = joined([other_axes(word), other_senses(word), *(_numbers(word, field) for field in (X, Y, COUNT))])
    words = words_of(made.word)
    made = _picked(made, ~words.is_endless & counts_fit(words))
    now = moves_of(made.word)
    shift = now.by_um - was.by_um[made.row]
    away = np.hypot(*shift.T)
    is_open = np.hypot(*gap) > CLOSED_WITHIN_UM
    turned = ~is_open & (away <= _STILL_UM) & (made.word[:, TURN] != word[made.row, TURN])
    ends = is_open & (away > CLOSED_WITHIN_UM) & (np.hypot(*(shift - gap).T) <= CLOSED_WITHIN_UM)
    obeys = obedience(words_of(made.word), now) >= obedience(words_of(word), was)[made.row]
    return _picked(made, (turned | ends) & obeys)


def _picked(made: Mends, wanted: Bools) -> Mends:
    return Mends(*(column[wanted] for column in made))


def _numbers(word: Ints, field: int) -> Mends:
    """Each block with each number that is one slip from the one in a field: a digit changed, put in, or left out."""
    value, place = word[:, field], PLACES[:, None, None]
    digit = np.arange(10)[None, :, None]
    high, low = value // (10 * place), value % place
    changed = np.where(value >= place, high * 10 * place + digit * place + low, -1)
    put_in = np.where(value * 10 >= place, value // place * 10 * place + digit * place + low, -1)
    left_out = np.where(value >= place, high * place + low, -1)
    values = np.concatenate([each.reshape(-1, len(value)) for each in (changed, put_in, left_out)])
    row, number = np.tile(np.arange(len(value)), len(values)), values.ravel()
    other = (number >= (field == COUNT)) & (number != value[row]) & (number < PLACES[-1])
    row, number = row[other], number[other]
    table = word[row]
    table[:, field] = number
    return Mends(row, np.full(len(row), field), table)
