"""Mends: blocks with one field written otherwise, or solved for, so that they end at a wanted place.

Words stand here as an (n, 6) int64 table, one row a block, in the order of the columns of `StepWords`.

One number of a block solved for: the X, Y or count length J with which it ends at a wanted place.
"""

from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Floats, Ints
from parser.step_words.words import ArcEnds, Moves, arc_ends, label, moves, with_axes_named
from parser.text.source import Field
from parser.threeb.decode import decoded_words
from parser.threeb.mend.edits import counted_on
from parser.threeb.mend.likelihood import slip
from parser.toolpath import Toolpath
from parser.units import MAX_WORD_UM

X, Y, COUNT = range(3)
"""Numbers of a block that are solved for."""

_ROUNDS = 4  # of Newton's method; from the closed forms two suffice, four where they are ill-conditioned
_ADMITTED = 0.1  # of the radius: how far off a guess may end for Newton's method to start from it


class Solved(NamedTuple):
    """Numbers found, `value` (k,) in whole µm for the `field` (k,) of the blocks `row` (k,): several, one or none."""

    row: Ints
    field: Ints
    value: Ints


def solved_numbers(words: StepWords, want_um: Floats, tolerance_um: float) -> Solved:
    """Values of X, of Y and of J with which n blocks may end `want_um` (n, 2) from their starts."""
    is_line = words.turn == 0
    lines, arcs = np.flatnonzero(is_line), np.flatnonzero(~is_line)
    round_ = arcs[words.x_um[arcs] ** 2 + words.y_um[arcs] ** 2 > 1]
    found = [_whole(lines, COUNT, _line_count(words, want_um)[lines]), *_arc_counts(words, want_um, round_)]
    found += [_whole(lines, field, _line_extent(words, want_um, field)[lines]) for field in (X, Y)]
    arc, want = _of(words, arcs), want_um[arcs]
    guesses = [_whole(arcs, field, guess) for field in (X, Y) for guess in _arc_guesses(arc, want, field)]
    found.append(_polished(words, want_um, _joined(guesses), tolerance_um))
    # Guesses run together: one value of a block is looked at once.
    row, field, value = _joined(found)
    at, value = np.divmod(np.unique((field * len(is_line) + row) * (MAX_WORD_UM + 1) + value), MAX_WORD_UM + 1)
    field, row = np.divmod(at, max(len(is_line), 1))
    return Solved(row, field, value)


def _joined(found: list[Solved]) -> Solved:
    return Solved(*(np.concatenate(columns) for columns in zip(*found, strict=True)))


def _whole(row: Ints, field: int, value: Floats) -> Solved:
    """Values of a field rounded, those left out that no word can say."""
    fits = np.isfinite(value) & (value > -0.5) & (value <= MAX_WORD_UM)
    row = row[fits]
    return Solved(row, np.full(len(row), field), np.round(value[fits]).astype(np.int64))


def _of(words: StepWords, row: Ints) -> StepWords:
    return StepWords(*(getattr(words, name)[row] for name in StepWords.__slots__))


def _line_count(words: StepWords, want_um: Floats) -> Floats:
    """J of a line is its extent on the counted axis."""
    want = want_um * words.signs
    return np.where(words.count_axis == Axis.X, want[:, 0], want[:, 1])


def _line_extent(words: StepWords, want_um: Floats, field: int) -> Floats:
    """X or Y of a line, from the ratio X:Y of the wanted place and the other of the two."""
    other = words.y_um if field == Axis.X else words.x_um
    want = np.abs(want_um)
    with np.errstate(divide="ignore", invalid="ignore"):
        return want[:, field] * other / want[:, 1 - field]


def _arc_counts(words: StepWords, want_um: Floats, arcs: Ints) -> list[Solved]:
    """J to the wanted place within one turn, and J of the full turn."""
    arc = _of(words, arcs)
    start = (np.stack([arc.x_um, arc.y_um], axis=1) * arc.signs).astype(np.float64)
    full: Floats = 4.0 * np.hypot(arc.x_um, arc.y_um)
    count = np.mod(_phase(arc, start + want_um[arcs]) - _phase(arc, start), full)
    return [_whole(arcs, COUNT, count), _whole(arcs, COUNT, full)]


def _phase(arc: StepWords, place_um: Floats) -> Floats:
    """Length counted off since the farthest point on the counted axis, at places (n, 2) nearly on the circles."""
    radius: Floats = np.hypot(arc.x_um, arc.y_um)
    x, y = (place_um * (radius / np.maximum(np.hypot(place_um[:, 0], place_um[:, 1]), 1.0))[:, None]).T
    on_x = arc.count_axis == Axis.X
    cosine, sine = np.where(on_x, x, y), np.where(on_x, y, -x) * arc.turn
    phase: Floats = np.where(sine >= 0.0, radius - cosine, 3.0 * radius + cosine)
    return phase


def _arc_guesses(arc: StepWords, want_um: Floats, field: int) -> list[Floats]:
    """Four guesses of X or Y of each arc.

    Start and end lie on one circle: that settles the first guess, unless the number lies across the chord. Then J
    settles it: the second guess is for a full turn and for the greater arc over a chord, the third for arcs over a
    chord that J counts across. The fourth is 0, for an arc that starts on an axis.
    """
    extent = np.stack([arc.x_um, arc.y_um], axis=1).astype(np.float64)
    signs, count = arc.signs, arc.count_um
    other, along, across = extent[:, 1 - field], want_um[:, field], want_um[:, 1 - field]
    chord = (want_um**2).sum(axis=1) + 2.0 * other * signs[:, 1 - field] * across
    with np.errstate(divide="ignore", invalid="ignore"):
        level = np.where(np.abs(along) <= _ADMITTED * count, 1.0, np.nan)
        return [
            -chord / (2.0 * along) * signs[:, field],
            level * np.sqrt(((count + np.abs(across)) / 4.0) ** 2 - other**2),
            level * np.abs(count / 4.0 - other**2 / count),
            level * 0.0,
        ]


def _polished(words: StepWords, want_um: Floats, guess: Solved, tolerance_um: float) -> Solved:
    """Guesses made exact by Newton's method on both coordinates of the end, with the slope over 1 µm."""
    row, field, value = guess
    for turn in range(_ROUNDS):
        arc = _of(words, row)
        here = _ends(arc, field, value)
        miss = want_um[row] - here.end_um + here.start_um
        if turn == 0:
            near = np.hypot(miss[:, 0], miss[:, 1]) <= _ADMITTED * here.radius_um + tolerance_um
            row, field, value, miss = row[near], field[near], value[near], miss[near]
            arc, here = _of(arc, np.flatnonzero(near)), ArcEnds(*(column[near] for column in here))
        beyond = _ends(arc, field, value + 1)
        slope = (beyond.end_um - beyond.start_um) - (here.end_um - here.start_um)
        square = (slope**2).sum(axis=1)
        step = (miss * slope).sum(axis=1) / np.where(square > 0.0, square, np.inf)
        value = np.round(np.clip(value + step, 0.0, MAX_WORD_UM - 1.0)).astype(np.int64)
    return Solved(row, field, value)


def _ends(arc: StepWords, field: Ints, value: Ints) -> ArcEnds:
    """Arcs with another X or Y; a radius too small for a circle is taken as 2 µm."""
    start = np.stack([arc.x_um, arc.y_um], axis=1)
    at = np.arange(len(field))
    start[at, field] = value
    dots = np.flatnonzero((start**2).sum(axis=1) <= 1)
    start[dots, field[dots]] = 2
    return arc_ends(start * arc.signs, arc.count_um, arc.count_axis, arc.turn)


AXIS, QUADRANT, TURN = range(3, 6)
"""Columns of a table of words, behind X, Y and COUNT."""
SENSE = QUADRANT  # which with the turn is one field, Z
FIELDS = (Field.X, Field.Y, Field.COUNT, Field.AXIS, Field.SENSE)
"""Fields that may be written otherwise, by their numbers, X to SENSE."""

_COLUMNS = ("x_um", "y_um", "count_um", "count_axis", "quadrant", "turn")
_OTHER_FIELD = 7  # points of a changed axis, and of a changed quadrant or sense, like one changed digit
_TWO_CHANGED = 2  # points of a changed quadrant and sense, like two changed digits
_SENSES = np.array(list(product((0, 1, -1), (1, 2, 3, 4))))  # (turn, quadrant): what Z can say
PLACES = 10 ** np.arange(9)  # places of the digits of a word of up to nine


class Mends(NamedTuple):
    """Blocks written otherwise: `row` (k,) of the table they were made from, `field` (k,) by number, `word` (k, 6)."""

    row: Ints
    field: Ints
    word: Ints


def word_table(toolpath: Toolpath, rows: Ints) -> Ints:
    """(n, 6) words of the rows."""
    return np.stack([getattr(decoded_words(toolpath), name)[rows] for name in _COLUMNS], axis=1)


def moves_of(word: Ints) -> Moves:
    """What blocks with these words do."""
    return moves(words_of(word))


def mends(word: Ints, by_um: Floats, gap_um: Floats, tolerance_um: float) -> Mends:
    """Every way to write one field of one block otherwise so that the block ends elsewhere by the gap.

    Parameters
    ----------
    word, by_um
        (n, 6) words of n blocks and (n, 2) what they do.
    gap_um
        (2,) or (n, 2) by which each block should end elsewhere.
    tolerance_um
        Distance within which it does.
    """
    want = by_um + gap_um
    bare = _is_bare(word)
    numbers = _near(word, _numbers(word, want, tolerance_um, bare))
    return _that_end(joined([other_axes(word), other_senses(word), numbers]), want, tolerance_um)


def other_axes(word: Ints) -> Mends:
    """Each block counted on the other axis."""
    changed = word.copy()
    changed[:, AXIS] = 1 - word[:, AXIS]
    return Mends(np.arange(len(word)), np.full(len(word), AXIS), changed)


def other_senses(word: Ints) -> Mends:
    """Each block with each of the eleven other Z."""
    n, bare = len(_SENSES), _is_bare(word)
    row, changed = np.tile(np.arange(len(word)), n), np.tile(word, (n, 1))
    changed[:, [TURN, QUADRANT]] = np.repeat(_SENSES, len(word), axis=0)
    differs = (changed[:, [TURN, QUADRANT]] != word[row][:, [TURN, QUADRANT]]).any(axis=1)
    # A line that leaves X and Y out runs along the axis that its new digit names.
    changed[np.tile(bare, n), :COUNT] = 0
    words = with_axes_named(words_of(changed))
    changed[:, X], changed[:, Y] = words.x_um, words.y_um
    return Mends(row[differs], np.full(int(differs.sum()), SENSE), changed[differs])


def _is_bare(word: Ints) -> NDArray[np.bool_]:
    """Lines without X and Y, which decode to 1 along the axis that their digit names."""
    named = with_axes_named(words_of(word * np.array([0, 0, 1, 1, 1, 1])))
    bare: NDArray[np.bool_] = (word[:, TURN] == 0) & (word[:, X] == named.x_um) & (word[:, Y] == named.y_um)
    return bare


def _numbers(word: Ints, want_um: Floats, tolerance_um: float, bare: NDArray[np.bool_]) -> Mends:
    """Blocks with one number solved, as near as whole µm come."""
    solved = solved_numbers(words_of(word), want_um, tolerance_um)
    able = ~bare[solved.row] | (solved.field == COUNT)
    row, field = solved.row[able], solved.field[able]
    changed = word[row]
    changed[np.arange(len(row)), field] = solved.value[able]
    # Solving is good to a few µm: what it gives is looked at more closely below.
    return _that_end(Mends(row, field, changed), want_um, 4.0 * tolerance_um)


def _near(word: Ints, solved: Mends) -> Mends:
    """The solved numbers, and beside each the likelier ones near it: one slip away from what is written, or ruled.

    A closed contour still ends some µm off, and a flat line hardly feels its X: many numbers close it then, and only
    one of them was meant.
    """
    at = np.arange(len(solved.row))
    written, value = word[solved.row, solved.field], solved.word[at, solved.field]
    values = np.concatenate([value[None], _ruled(solved.word, solved.field)[None], *_slips(written, value)])
    row, field = (np.tile(column, len(values)) for column in (solved.row, solved.field))
    changed = np.tile(solved.word, (len(values), 1))
    changed[np.arange(len(row)), field] = values.ravel()
    number = values.ravel()
    differs = (number != word[row, field]) & (number >= (field == COUNT))
    return Mends(row[differs], field[differs], changed[differs])


def _ruled(word: Ints, field: Ints) -> Ints:
    """The number that the rest of a block asks for.

    J of an unreduced line is its longer side. J of an arc is the nearest count of whole quarters of its circle.
    """
    radius = np.maximum(np.hypot(word[:, X], word[:, Y]), 1.0)
    quarters = np.rint(np.rint(word[:, COUNT] / radius) * radius).astype(np.int64)
    count = np.where(word[:, TURN] == 0, np.maximum(word[:, X], word[:, Y]), quarters)
    written = word[np.arange(len(word)), field]
    return np.where(field == COUNT, count, np.where(word[:, AXIS] == field, word[:, COUNT], written))


def _slips(written: Ints, value: Ints) -> list[Ints]:
    """(9, k) numbers one slip from the written ones, for each kind of slip: a changed, a lost and a doubled digit.

    In each of the nine places stands the digit that brings the number nearest to `value`.
    """
    place = PLACES[:, None]
    high, low = written // (10 * place), written % place
    changed = high * 10 * place + low
    restored = written // place * 10 * place + low
    return [
        changed + _digit(value - changed, place) * place,
        restored + _digit(value - restored, place) * place,
        high * place + low,
    ]


def _digit(missing: Ints, place: Ints) -> Ints:
    digit: Ints = np.clip((missing + place // 2) // place, 0, 9)
    return digit


def _that_end(made: Mends, want_um: Floats, tolerance_um: float) -> Mends:
    """The mends whose blocks end where wanted."""
    off = moves_of(made.word).by_um - want_um[made.row]
    ends = np.hypot(off[:, 0], off[:, 1]) <= tolerance_um
    return Mends(*(column[ends] for column in made))


def joined(made: list[Mends]) -> Mends:
    """Mends one behind the other."""
    return Mends(*(np.concatenate(columns) for columns in zip(*made, strict=True)))


def words_of(word: Ints) -> StepWords:
    """The table as words; the radius and the curve mark of 4B do not move the path."""
    none = np.zeros(len(word), dtype=np.int64)
    x, y, count, axis, quadrant, turn = np.ascontiguousarray(word.T)
    return StepWords(x, y, count, axis, quadrant, turn, radius_um=none - 1, curve=none)


def ease(written: Ints, made: Mends) -> Ints:
    """(k,) points of how little mends change blocks (k, 6) as written."""
    points = np.full(len(made.row), _OTHER_FIELD)
    both = (made.field == SENSE) & (written[:, [QUADRANT, TURN]] != made.word[:, [QUADRANT, TURN]]).all(axis=1)
    points[both] = _TWO_CHANGED
    for field in (X, Y, COUNT):
        of = made.field == field
        points[of] = slip(written[of, field], made.word[of, field])
    return points


def field_text(word: Ints, field: int) -> str:
    """A field as 3B writes it."""
    if field == AXIS:
        return counted_on(Axis(int(word[AXIS]))).text
    return label(int(word[TURN]), int(word[QUADRANT])) if field == SENSE else str(word[field])
