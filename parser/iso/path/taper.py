"""How the wire leans: by G51 and G52 with an angle, by U and V, or along a second contour (docs/taper.md).

Words of angles: the profile has their letter; in a block of G51 or G52 both A and T are one. An angle without a point
that is no angle of a wire stands in thousandths of a degree, as in EDM_NC (decode.cpp).

U and V say how far the wire is moved in the upper plane against the programmed one, in the mode of X and Y.
"""

from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from parser.controller_words import Taper
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints, curves_between
from parser.iso.path.flow import GivenColumns
from parser.iso.path.places import Modes, carried, exact
from parser.iso.path.registers import Run

_OFF, _LEFT, _RIGHT = 500, 510, 520
_LETTERS = "AT"
_MOST_DEG: Final = 90.0
_THOUSANDTH: Final = 1e-3
_STILL_UM = 1e-3


class ProgrammedLean(NamedTuple):
    """How the wire leans along the rows of a path.

    Attributes
    ----------
    taper
        By angles; None where the program gives none.
    upper
        Along a contour of its own; None where the program has none.
    is_known
        Whether that is all, so that the wire is known in each plane.
    """

    taper: Taper | None
    upper: Curves | None
    is_known: bool


def lean_of(given: GivenColumns, run: Run) -> ProgrammedLean:
    """How the wire leans by the words of its blocks; upright where nothing says more."""
    taper, has_angles = _taper(given, run)
    upper, is_line = _upper(given, run)
    compensates = run.offsets is not None and bool(np.nan_to_num(run.offsets.by_um, nan=1.0).any())
    is_known = has_angles and is_line and not (upper is not None and (taper is not None or compensates))
    return ProgrammedLean(taper, upper, is_known) if is_known else ProgrammedLean(None, None, is_known=False)


def _taper(given: GivenColumns, run: Run) -> tuple[Taper | None, bool]:
    """Side and angle of each row, None where none leans; and whether each that leans has an angle."""
    runs, at = run.flow.block, run.rows.at
    mode = carried(given.group("taper")[runs], _OFF)
    side = ((mode == _LEFT).astype(np.int64) - (mode == _RIGHT))[at]
    degrees = _angles_deg(given, runs)[at]
    leans = (side != 0) & (degrees != 0.0)
    if not leans.any():
        return None, True
    if not (np.abs(degrees[leans]) < _MOST_DEG).all():
        return None, False
    side = np.where(leans, side * np.sign(np.nan_to_num(degrees, nan=1.0)), 0).astype(np.int64)
    return Taper(side, np.radians(np.where(leans, np.abs(degrees), 0.0))), True


def _angles_deg(given: GivenColumns, runs: Ints) -> Floats:
    """(e,) angle in force, degrees; NaN before the first."""
    words, profile = given.listing.words, given.profile
    leans = np.isin(given.group("taper"), (_LEFT, _RIGHT))
    chosen = np.full(len(leans), -1, dtype=np.int64)
    for letter in _LETTERS:
        word = given.word(letter)
        counts = (word >= 0) & (leans | (letter == profile.angle))
        chosen[counts] = word[counts]
    value = np.where(chosen >= 0, words.value[chosen], np.nan) if len(words.value) else np.full(len(leans), np.nan)
    is_whole = words.decimals[chosen] < 0 if len(words.value) else leans
    scale = np.where(is_whole, profile.angle_integer_deg, profile.angle_point_deg)
    scale = np.where(is_whole & (np.abs(value * scale) >= _MOST_DEG), _THOUSANDTH, scale)
    degrees = (value * scale)[runs]
    last = np.maximum.accumulate(np.where(np.isnan(degrees), -1, np.arange(len(degrees))))
    return np.where(last >= 0, degrees[last], np.nan)


def _upper(given: GivenColumns, run: Run) -> tuple[Curves | None, bool]:
    """The contour of the plane of U and V, None where they are 0, or nothing moves.

    And whether they change on lines alone.
    """
    aside = _aside_um(given, run.flow.block, run.mode)
    if not aside.any() or not len(run.rows.at):
        return None, True
    at, path = run.rows.at, run.rows.curves
    end = aside[at]
    start = np.concatenate([end[:1] * 0.0, end[:-1]])
    changes = np.hypot(*(end - start).T) > _STILL_UM
    upper = curves_between(path.start_um + start, path.end_um + end, path.center_um + end, path.sweep_rad)
    return with_jumps(upper, path.kind == CurveKind.JUMP), not (changes & path.is_arc).any()


def _aside_um(given: GivenColumns, runs: Ints, mode: Modes) -> Floats:
    """(e, 2) U and V behind each running block."""
    words = given.listing.words
    aside = np.zeros((len(runs), 2))
    for axis, letter in enumerate("UV"):
        word = given.word(letter)[runs]
        if not (word >= 0).any():
            continue
        scale = np.where(words.decimals[word] < 0, mode.integer_um, mode.point_um)
        value = np.where(word >= 0, words.value[word] * scale, 0.0)
        total = np.cumsum(np.where(mode.is_absolute, 0.0, value))
        placed = (word >= 0) & mode.is_absolute
        last = np.maximum.accumulate(np.where(placed, np.arange(len(runs)), -1))
        base = np.where(last >= 0, (value - total)[last], 0.0)
        aside[:, axis] = exact(base + total)
    return aside


def with_jumps(curves: Curves, is_jump: Bools) -> Curves:
    """The curves, some of them as jumps."""
    return replace(curves, kind=np.where(is_jump, CurveKind.JUMP, curves.kind))


def same_rows(lower: Curves, upper: Curves) -> bool:
    """Whether two contours can be run block by block together: as many rows, and jumps where the other has them."""
    return len(lower) == len(upper) and bool(((lower.kind == CurveKind.JUMP) == (upper.kind == CurveKind.JUMP)).all())
