"""Words that tell lines and arcs, by the trade's rules for quadrant, count length and count axis (docs/3b.md §1)."""

import numpy as np

from parser.controller_words.step_words import Axis, StepWords
from parser.geometry.curves import Bools, Floats, Ints

MOST_SWEEP_RAD = 1.8 * np.pi
"""Beyond it the ends of an arc are so near each other that a centre equally far from both may lie anywhere."""
MOST_SHIFT = 0.5
"""Of the radius; the centre of an arc of a few µm alone would move farther, and it is told as a line."""


def words_of_lines(by_um: Floats) -> StepWords:
    """Words of lines by (n, 2), rounded to whole µm; quadrant 1 and J = 0 where both round to 0."""
    by = np.rint(by_um).astype(np.int64)
    quadrant = _quadrant(by[:, 0], by[:, 1])
    x, y = np.abs(by[:, 0]), np.abs(by[:, 1])
    # At 45° GY in quadrants 1 and 3, GX in 2 and 4: the axis that is stepped last.
    on_x = (x > y) | ((x == y) & (quadrant % 2 == 0))
    axis = np.where(on_x, np.int64(Axis.X), np.int64(Axis.Y))
    return _words(by, np.maximum(x, y), axis, quadrant, np.zeros_like(x))


def words_of_arcs(start_um: Floats, end_um: Floats, sweep_rad: Floats) -> StepWords:
    """Words of n arcs; of a line where whole µm leave no arc.

    The controller's radius is the distance of the start from the centre, so that a start that is off its circle would
    make the end as far off, and so on from arc to arc. The centre is therefore moved along the chord until it is as
    far from the start as from the end. Then the start from the centre is rounded to whole µm, and J ends the arc
    abreast of its end.

    Parameters
    ----------
    start_um, end_um
        (n, 2) where the arc begins, near its circle, and where it is to end, relative to the centre.
    sweep_rad
        (n,) signed, positive counter-clockwise.
    """
    by = end_um - start_um
    shift = _to_bisector(start_um, end_um, sweep_rad)
    is_astray = np.hypot(shift[:, 0], shift[:, 1]) > MOST_SHIFT * np.hypot(start_um[:, 0], start_um[:, 1])
    return chosen(is_astray, words_of_lines(by), words_of_told_arcs(np.rint(start_um - shift), by, sweep_rad))


def words_of_told_arcs(start_um: Floats, by_um: Floats, sweep_rad: Floats) -> StepWords:
    """Words of n arcs whose starts from the centre are told in whole µm and stay; of a line where that is no arc.

    Parameters
    ----------
    start_um
        (n, 2) where the arc begins, relative to the centre.
    by_um
        (n, 2) how far it is to go; J ends it abreast of there.
    sweep_rad
        (n,) signed, positive counter-clockwise.
    """
    end = start_um + by_um
    turn, radius = np.sign(sweep_rad), np.hypot(start_um[:, 0], start_um[:, 1])
    low = np.arctan2(start_um[:, 1], start_um[:, 0])
    turned = turn * (np.arctan2(end[:, 1], end[:, 0]) - low)
    turned += 2.0 * np.pi * np.rint((np.abs(sweep_rad) - turned) / (2.0 * np.pi))
    on_y = np.abs(end[:, 0]) > np.abs(end[:, 1])
    count = np.rint(_counted(radius, low, turn * turned, np.where(on_y, end[:, 1], end[:, 0]), on_y)).astype(np.int64)
    place = start_um.astype(np.int64)
    x, y = place.T
    quadrant = np.where(turn > 0.0, _quadrant(x, y), 5 - _quadrant(x, -y))
    axis = np.where(on_y, np.int64(Axis.Y), np.int64(Axis.X))
    arcs = _words(place, count, axis, quadrant, turn.astype(np.int64))
    return chosen((x * x + y * y > 1) & (turned > 0.0) & (count > 0), arcs, words_of_lines(by_um))


def _to_bisector(start_um: Floats, end_um: Floats, sweep_rad: Floats) -> Floats:
    """Ways (n, 2) along the chords from centres to where start and end are equally far; none for near circles."""
    by = end_um - start_um
    square = (by * by).sum(axis=1)
    share = (0.5 * (start_um + end_um) * by).sum(axis=1) / np.where(square > 0.0, square, np.inf)
    return np.where(np.abs(sweep_rad) < MOST_SWEEP_RAD, share, 0.0)[:, None] * by


def _counted(radius: Floats, low: Floats, turned: Floats, end: Floats, on_y: Bools) -> Floats:
    """Count lengths (n,) from angles on, turned by others, up to where a place `end` on the counted axis lies."""
    # On X an arc counts |d cos|, on Y |d sin|, which is the same a quarter turn on.
    low = low - np.where(on_y, 0.5 * np.pi, 0.0)
    high = low + turned
    turn = np.sign(turned)
    count = radius * turn * (counted_way(high) - counted_way(low))
    # Its start and its end are not quite equally far from the centre; what counts is to be abreast of the end.
    return count - turn * np.sign(np.sin(high)) * (end - radius * np.cos(high))


def counted_way(angle_rad: Floats) -> Floats:
    """Way of a cosine from 0 to angles (n,): 2 for every half turn, and the rest of the last one."""
    halves = np.floor(angle_rad / np.pi)
    return 2.0 * halves + 1.0 - np.cos(angle_rad - halves * np.pi)


def chosen(is_one: Bools, this: StepWords, other: StepWords) -> StepWords:
    """Words of `one` where `is_one` (n,), of `other` elsewhere."""
    return StepWords(*(np.where(is_one, getattr(this, name), getattr(other, name)) for name in StepWords.__slots__))


def _quadrant(x: Ints, y: Ints) -> Ints:
    """Quadrants of directions (n,); on an axis the one entered counter-clockwise: +X 1, +Y 2, −X 3, −Y 4."""
    inside = [(x > 0) & (y >= 0), (x <= 0) & (y > 0), (x < 0) & (y <= 0), y < 0]
    return np.select(inside, [1, 2, 3, 4], 1).astype(np.int64)


def _words(place: Ints, count: Ints, axis: Ints, quadrant: Ints, turn: Ints) -> StepWords:
    """Words from X and Y (n, 2), signed, without the radius and the curve mark of 4B."""
    x, y = np.abs(place).T
    return StepWords(x, y, count, axis, quadrant, turn, np.full_like(count, -1), np.zeros_like(count))
