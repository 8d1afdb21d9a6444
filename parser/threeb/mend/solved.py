"""One number of a block solved for: the X, Y or count length J with which it ends at a wanted place."""

from typing import NamedTuple

import numpy as np

from parser.controller_words.step_words import Axis, StepWords
from parser.geometry.curves import Floats, Ints
from parser.step_words.moves import ArcEnds, arc_ends
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
