"""How likely a block is in a sound contour, by the trade's rules and by how it joins its neighbours.

Points are logarithms of odds, rounded to whole numbers. A block loses points by what few sound blocks do, and gains
points by what sound blocks do far more often than chance would have it. The points were set on broken contours
(tests/tools/suspects_rates.py).
"""

import numpy as np
from numpy.typing import NDArray

from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Floats, Ints
from parser.step_words.words import Moves
from parser.threeb.block_checks import ruled_label

Flags = NDArray[np.bool_]

_RULE_BROKEN = -7
_UNREDUCED = 2
_AXIS_PARALLEL = 5
_KNOWN_SIZE = 4
_SMOOTH, _SQUARE, _CUSP = 7, 6, -4
_EXACT = 2  # beside those for smooth or square
_JOINT_RAD, _EXACT_RAD = np.radians(0.2), np.radians(0.01)
_PARALLEL_UM = 3  # the small side that an axis-parallel line has after an arc whose end is not whole µm (docs/3b.md §1)
_GONE_UM = 10.0  # shorter than any block of a drawing
_TIE_UM = 2.0  # at 45° either count axis will do
_SAME_SIZE_UM = 1.5


def obedience(words: StepWords, made: Moves) -> Ints:
    """(n,) points of blocks by themselves: rules of labels, count axes and count lengths, and lines along an axis."""
    extent = np.stack([words.x_um, words.y_um], axis=1)
    is_arc = ~np.isnan(made.radius_um)
    broken = (
        (ruled_label(words) != words.quadrant).astype(np.int64)
        + _wrong_axis(words, made, is_arc)
        + np.where(is_arc, words.count_um > 4.0 * made.radius_um + 4.0, _uneven(words))
        + (is_arc & _line_like(words))
        + (made.length_um < _GONE_UM)
    )
    longer, shorter = extent.max(axis=1), extent.min(axis=1)
    parallel = ~is_arc & (shorter <= _PARALLEL_UM) & (longer > 10 * shorter)
    unreduced = ~is_arc & (words.count_um == longer)
    points: Ints = _RULE_BROKEN * broken + _AXIS_PARALLEL * parallel + _UNREDUCED * unreduced
    return points


def _wrong_axis(words: StepWords, made: Moves, is_arc: Flags) -> Flags:
    """Blocks counted on the axis that the rule does not name (docs/3b.md §1)."""
    reach = np.abs(made.by_um - np.where(is_arc[:, None], made.center_um, 0.0))
    extent = np.stack([words.x_um, words.y_um], axis=1).astype(np.float64)
    nearer_x = np.where(is_arc, reach[:, 0] - reach[:, 1], extent[:, 1] - extent[:, 0])
    tie = np.where(is_arc, np.abs(nearer_x) <= _TIE_UM, nearer_x == 0.0)
    tied_to_x = np.isin(words.quadrant, (2, 4))
    ruled_y = np.where(~is_arc & tie, ~tied_to_x, nearer_x > 0.0)
    wrong: Flags = (ruled_y != (words.count_axis == Axis.Y)) & ~(is_arc & tie)
    return wrong


def _line_like(words: StepWords) -> Flags:
    """Blocks whose J is the longer of X and Y, with neither 0: a line is written so, an arc has it by chance alone."""
    shorter, longer = np.minimum(words.x_um, words.y_um), np.maximum(words.x_um, words.y_um)
    alike: Flags = (shorter > 0) & (words.count_um == longer)
    return alike


def _uneven(words: StepWords) -> Flags:
    """Lines whose J is no multiple of their longer side; that of sound lines is, with X and Y reduced or not."""
    uneven: Flags = words.count_um % np.maximum(np.maximum(words.x_um, words.y_um), 1) != 0
    return uneven


def joint(arriving: Floats, leaving: Floats, slack_rad: Floats) -> Ints:
    """(n,) points of joints of directions (n, 2): smooth, square, a cusp, or any other angle.

    `slack_rad` (n,) is what whole µm leave open of the angle.
    """
    along = (arriving * leaving).sum(axis=1)
    across = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    angle, within = np.abs(np.arctan2(across, along)), _JOINT_RAD + slack_rad
    off_square = np.abs(angle - np.pi / 2.0)
    points: Ints = _SMOOTH * (angle <= within) + _SQUARE * (off_square <= within) + _CUSP * (angle >= np.pi - within)
    points += _EXACT * (np.minimum(angle, off_square) <= _EXACT_RAD + slack_rad)
    points[(along == 0.0) & (across == 0.0)] = 0  # a block of length 0 has no direction
    return points


def sizes(made: Moves) -> Floats:
    """(n,) radii of arcs, and lengths of lines with a minus sign, so that no line has the size of an arc."""
    return np.where(np.isnan(made.radius_um), -made.length_um, made.radius_um)


def alike(one_um: Floats, other_um: Floats) -> Flags:
    """(n,) whether sizes are the same but for rounding."""
    same: Flags = np.abs(one_um - other_um) <= _SAME_SIZE_UM
    return same


def familiar(size_um: Floats, all_um: Floats, least: Ints | int) -> Ints:
    """(n,) points of sizes that at least so many of the sorted `all_um` share: parts are full of equal sides, radii."""
    first = np.searchsorted(all_um, size_um - _SAME_SIZE_UM)
    past = np.searchsorted(all_um, size_um + _SAME_SIZE_UM, side="right")
    return _KNOWN_SIZE * (past - first >= least)


def slip(written: Ints, other: Ints) -> Ints:
    """(n,) points of what happened to a number: one digit changed, lost or doubled, two changed, or more."""
    places = 10 ** np.arange(10)[:, None]
    changed = ((written // places % 10) != (other // places % 10)).sum(axis=0)
    same_length = _digits(written) == _digits(other)
    long, short = np.maximum(written, other), np.minimum(written, other)
    one_less = (long // (10 * places) * places + long % places == short).any(axis=0)
    lost = one_less & (_digits(long) == _digits(short) + 1)
    single = lost | (same_length & (changed == 1))
    return np.where(single, 7, np.where(same_length & (changed == 2), 2, 0))


def _digits(number: Ints) -> Ints:
    digits: Ints = (number[None] >= 10 ** np.arange(10)[:, None]).sum(axis=0)
    return np.maximum(digits, 1)
