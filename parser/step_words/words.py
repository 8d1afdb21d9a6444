"""Lines and arcs to words, by the rules of the trade (docs/3b.md §1), and words to the moves that they make.

Labels of blocks, Z: letters for a line or the sense of an arc, and the digit of the quadrant (docs/3b.md §1).

Words that tell lines and arcs, by the trade's rules for quadrant, count length and count axis (docs/3b.md §1).

Words to moves: what each block does from where it starts, exactly, the count length J deciding where it ends.

Arcs from 3B words: count length and counted axis give the end in closed form, any number of quadrants and turns.

The counted coordinate of a point that runs round a circle of radius R is a triangle wave of period 4R in the length
counted off. Adding J to its phase and folding back gives the end; no walk from quadrant to quadrant.
"""

from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Bools, Floats, Ints

SENSES: Final = {0: "L", 1: "NR", -1: "SR"}
"""Letters by the turn: a line, an arc counter-clockwise, an arc clockwise."""


def label(turn: int, quadrant: int) -> str:
    """``L1`` to ``L4``, ``NR1`` to ``NR4``, ``SR1`` to ``SR4``."""
    return f"{SENSES[turn]}{quadrant}"


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


class ArcEnds(NamedTuple):
    """Arcs in their own centre's frame: (n,) and (n, 2) float64, µm and rad."""

    start_um: Floats
    end_um: Floats
    radius_um: Floats
    start_angle_rad: Floats
    sweep_rad: Floats


def arc_ends(start_um: Ints, count_um: Ints, count_axis: Ints, turn: Ints) -> ArcEnds:
    """Exact ends of n arcs.

    Parameters
    ----------
    start_um
        (n, 2) int64, start relative to the centre, signed, not (0, 0).
    count_um, count_axis, turn
        (n,) count length J, counted axis G (0 X, 1 Y), +1 counter-clockwise or −1 clockwise.

    Notes
    -----
    The radius is ``sqrt(X² + Y²)``, never rounded: with it the arc of the Qt paper ends where the paper prints it.
    """
    x, y = start_um[:, 0].astype(np.float64), start_um[:, 1].astype(np.float64)
    radius = np.sqrt((start_um.astype(np.int64) ** 2).sum(axis=1).astype(np.float64))
    on_x = count_axis == Axis.X
    # Turned and mirrored so that every arc runs counter-clockwise and counts along its cosine.
    mirror = turn.astype(np.float64)
    cosine, sine = np.where(on_x, x, y), np.where(on_x, y, -x) * mirror
    phase = _phase(cosine, sine, radius)
    turns, rest = np.divmod(phase + count_um, 4.0 * radius)
    rest = np.clip(rest, 0.0, 4.0 * radius)
    end_cosine, end_sine = _fold(rest, radius)
    sweep = _angle(end_cosine, end_sine) + 2.0 * np.pi * turns - _angle(cosine, sine)
    end_sine = end_sine * mirror
    end = np.stack([np.where(on_x, end_cosine, -end_sine), np.where(on_x, end_sine, end_cosine)], axis=1)
    return ArcEnds(np.stack([x, y], axis=1), end, radius, np.arctan2(y, x), sweep * mirror)


def _phase(cosine: Floats, sine: Floats, radius: Floats) -> Floats:
    """Length counted off since angle 0. ``R − x`` is taken as ``y² / (R + x)`` where the difference would cancel."""
    near = np.where(cosine > 0.0, sine**2 / (radius + np.abs(cosine)), radius - cosine)
    return np.where(sine >= 0.0, near, 4.0 * radius - near)


def _fold(rest: Floats, radius: Floats) -> tuple[Floats, Floats]:
    """Cosine and sine coordinate at a phase in [0, 4R]."""
    upper = rest <= 2.0 * radius
    cosine = np.where(upper, radius - rest, rest - 3.0 * radius)
    square = np.where(upper, rest * (2.0 * radius - rest), (4.0 * radius - rest) * (rest - 2.0 * radius))
    return cosine, np.where(upper, 1.0, -1.0) * np.sqrt(np.maximum(square, 0.0))


def _angle(cosine: Floats, sine: Floats) -> Floats:
    """Angle in [0, 2π)."""
    angle = np.arctan2(sine, cosine)
    return np.where(angle < 0.0, angle + 2.0 * np.pi, angle)


# (X, Y) of a line that leaves both out and so runs along the axis its digit names (`BBB40000GXL1`).
_AXIS_OF_LABEL = np.array([[0, 0], [1, 0], [0, 1], [1, 0], [0, 1]], dtype=np.int64)


class Moves(NamedTuple):
    """What each block does relative to its own start; (n,) or (n, 2) float64, µm and rad, NaN where a line has none."""

    by_um: Floats
    center_um: Floats
    radius_um: Floats
    start_angle_rad: Floats
    sweep_rad: Floats
    length_um: Floats


def moves(words: StepWords) -> Moves:
    """What each block does relative to its own start."""
    is_arc = (words.turn != 0) & ~words.is_endless
    n = len(is_arc)
    signs = words.signs
    by = np.where(words.is_endless[:, None], 0.0, _line_by(words) * signs)
    center = np.full((n, 2), np.nan)
    radius, angle, sweep = np.full(n, np.nan), np.full(n, np.nan), np.zeros(n)
    start = (np.stack([words.x_um, words.y_um], axis=1) * signs)[is_arc]
    arcs = arc_ends(start, words.count_um[is_arc], words.count_axis[is_arc], words.turn[is_arc])
    by[is_arc] = arcs.end_um - arcs.start_um
    center[is_arc] = -arcs.start_um
    radius[is_arc], angle[is_arc], sweep[is_arc] = arcs.radius_um, arcs.start_angle_rad, arcs.sweep_rad
    length = np.hypot(by[:, 0], by[:, 1])
    length[is_arc] = arcs.radius_um * np.abs(arcs.sweep_rad)
    return Moves(by, center, radius, angle, sweep, length)


def _line_by(words: StepWords) -> Floats:
    """(n, 2) absolute displacement of every row read as a line: J along the counted axis, the ratio X:Y across it."""
    on_x = words.count_axis == Axis.X
    counted = np.where(on_x, words.x_um, words.y_um)
    other = np.where(on_x, words.y_um, words.x_um)
    finite = counted > 0
    along = np.where(finite, words.count_um, 0).astype(np.float64)
    across = words.count_um * other / np.where(finite, counted, 1) * finite
    return np.stack([np.where(on_x, along, across), np.where(on_x, across, along)], axis=1)


def with_axes_named(words: StepWords) -> StepWords:
    """Words as the controller reads them: a line without X and Y gets the axis its digit names."""
    bare = (words.turn == 0) & (words.x_um == 0) & (words.y_um == 0)
    named = _AXIS_OF_LABEL[words.quadrant]
    return replace(words, x_um=np.where(bare, named[:, 0], words.x_um), y_um=np.where(bare, named[:, 1], words.y_um))
