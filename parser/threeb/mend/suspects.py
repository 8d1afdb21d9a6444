"""Suspects: the one block or word that, written otherwise, would end a contour or itself where it was to end.

Suspects: the one block that would close an open contour if one of its fields were written otherwise.

All that follows the mended block shifts with its end, so a mend closes the contour if it makes up for the gap. Of those
that do, the likeliest are named: the ones that turn an unlikely block into a likely one by the slightest change.

One slip of the pen: every word of a contour written otherwise that ends the contour where it was to end.

Nothing is solved here: all slips are tried, so that a word that was meant is among them, whatever else is odd.

Mends of a block that ends elsewhere than printed: one of its fields, written otherwise, would end it there.

Joints of a contour: how likely they are with a block written otherwise.
"""

from operator import itemgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.dialect.mender import Mend, Suspect
from parser.geometry.curves import Bools, Floats, Ints
from parser.shape.contours import CLOSED_WITHIN_UM, closure_tolerance_um
from parser.step_words.words import Moves
from parser.text.source import Field
from parser.threeb.block_checks import counts_fit
from parser.threeb.mend.likelihood import alike, familiar, joint, obedience, sizes
from parser.threeb.mend.mends import (
    COUNT,
    FIELDS,
    PLACES,
    QUADRANT,
    SENSE,
    TURN,
    Mends,
    X,
    Y,
    ease,
    field_text,
    joined,
    mends,
    moves_of,
    other_axes,
    other_senses,
    word_table,
    words_of,
)
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


MOST = 5
"""Suspects named at most; where more are as likely, naming some would accuse them by chance."""

_ROWS_AT_ONCE = 4096
_MOST_OFF_UM = 100.0  # however many arcs: errors of a CAM do not add up (docs/3b.md §1)
_OWN_START = 2  # points for ending at the first start, not at the end of a lead-in
_CLOSED_LOOP = 6  # points if a loop closes between lead-in and lead-out: then one of these two is at fault


class _Ring(NamedTuple):
    """A contour as it should close: from row `end` back to the start of row `begin`; `rows` (n,) may be at fault.

    `gap_um` (2,) is what a mend makes up for; `is_led` and `points` are those of `Rings` and of all mends of the ring.
    """

    rows: Ints
    begin: int
    end: int
    gap_um: Floats
    points: int = 0
    is_led: bool = False


class _RingRows(NamedTuple):
    """Rows (n,) that may be at fault, each with what its ring is: a row stands once for each ring."""

    row: Ints
    begin: Ints
    end: Ints
    gap_um: Floats
    points: Ints
    is_led: NDArray[np.bool_]

    def take(self, at: Ints) -> "_RingRows":
        """Those at the indices `at`, in which one may stand several times."""
        return _RingRows(self.row[at], self.begin[at], self.end[at], self.gap_um[at], self.points[at], self.is_led[at])


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
    ring_rows = _ring_rows(_rings(toolpath, first_row, past_row, tolerance))
    parts = np.array_split(np.arange(len(ring_rows.row)), len(ring_rows.row) // _ROWS_AT_ONCE + 1)
    best = [_ranked(toolpath, ring_rows.take(part), all_sizes, tolerance) for part in parts]
    return _named(toolpath, _leading(best))


def _rings(toolpath: Toolpath, first: int, past: int, tolerance_um: float) -> list[_Ring]:
    """Where the contour may close, and which rows may be at fault then.

    If the lead-out goes back along the lead-in, these two are cleared. If the loop between them closes, one of these
    two is likelier at fault than the other rows.
    """
    last = past - 1
    start, end = toolpath.start_um, toolpath.end_um
    gap = start[first] - end[last]
    own = _Ring(np.arange(first, past), first, last, gap, _OWN_START)
    if past - first < 3:
        return [own]
    after_lead = _Ring(np.arange(first + 1, past), first + 1, last, start[first + 1] - end[last])
    there_and_back = end[first] - start[first] + end[last] - start[last]
    loop = start[first + 1] - end[last - 1]
    if np.hypot(*loop) <= tolerance_um:
        return [_Ring(np.array([first, last]), first, last, gap, _CLOSED_LOOP, is_led=True), own, after_lead]
    if np.hypot(*there_and_back) <= tolerance_um:
        return [_Ring(np.arange(first + 1, last), first + 1, last - 1, loop)]
    return [own, after_lead]


def _ring_rows(rings: list[_Ring]) -> _RingRows:
    """The rows of all rings, one ring's behind the other's."""
    of = np.repeat(np.arange(len(rings)), [len(ring.rows) for ring in rings])
    ring_rows = _RingRows(
        row=np.arange(len(rings)),
        begin=np.array([ring.begin for ring in rings]),
        end=np.array([ring.end for ring in rings]),
        gap_um=np.array([ring.gap_um for ring in rings]),
        points=np.array([ring.points for ring in rings]),
        is_led=np.array([ring.is_led for ring in rings]),
    )
    return ring_rows.take(of)._replace(row=np.concatenate([ring.rows for ring in rings]))


def _ranked(toolpath: Toolpath, rows: _RingRows, all_um: Floats, tolerance_um: float) -> _Ranked:
    """Mends of some rows, with their points: those of the block mended less those of the block written."""
    word = word_table(toolpath, rows.row)
    was = moves_of(word)
    made = mends(word, was.by_um, rows.gap_um, tolerance_um)
    of = rows.take(made.row)
    before, after = word[made.row], made.word
    both = Moves(*(np.concatenate(pair) for pair in zip(moves_of(after), _moves_of(was, made.row), strict=True)))
    now, old = (Moves(*(column[half] for column in both)) for half in _halves(len(of.row)))
    rings = Rings(np.tile(of.begin, 2), np.tile(of.end, 2), np.tile(of.is_led, 2))
    points = obedience(words_of(np.concatenate([after, before])), both)
    points += joint_points(toolpath, rings, np.tile(of.row, 2), both)
    here, there = (points[half] for half in _halves(len(of.row)))
    ranked = (
        here
        - there
        + familiar(sizes(now), all_um, 1 + alike(sizes(now), sizes(old)))
        - familiar(sizes(old), all_um, 2)
        + ease(before, made)
        + of.points
    )
    off = now.by_um - old.by_um - of.gap_um
    return _Ranked(of.row, made.field, made.word, ranked, np.hypot(off[:, 0], off[:, 1]))


def _moves_of(moves: Moves, at: Ints) -> Moves:
    return Moves(*(column[at] for column in moves))


def _halves(n: int) -> tuple[slice, slice]:
    return slice(n), slice(n, 2 * n)


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


_STILL_UM = 1e-6
_SLIPPED_ROWS_AT_ONCE = 1_000  # some 300 slips each, 100 bytes a slip


def one_slips(toolpath: Toolpath, first_row: int, past_row: int, most: int) -> tuple[Suspect, ...]:
    """Slips with which the rows from `first_row` up to but without `past_row` end at their start, likeliest first.

    Where they end there already, slips that turn an arc round, and move no end. A block that was meant obeys the
    trade's rules no less than what is written. At most `most`.
    """
    gap: Floats = toolpath.start_um[first_row] - toolpath.end_um[past_row - 1]
    found: list[tuple[int, float, Suspect]] = []
    for low in range(first_row, past_row, _SLIPPED_ROWS_AT_ONCE):
        rows = np.arange(low, min(low + _SLIPPED_ROWS_AT_ONCE, past_row))
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
