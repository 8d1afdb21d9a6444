"""Places: where each block begins and ends, µm, from coordinates given as places and as ways (docs/iso.md §5)."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.given import Given
from parser.iso.modes import NO_MOTION, Modes

_DWELL, _SET_PLACE = 40, 920
_DIGITS = 6  # coordinates in µm to a millionth: 1.013 mm are 1013 µm and no rounding beside it


class Coordinates(NamedTuple):
    """Numbers of the blocks as they run, µm, NaN where a word is missing; each (e, 2).

    Attributes
    ----------
    end
        X Y as given: places or ways.
    center
        I J as given.
    radius
        (e,) R.
    """

    end: Floats
    center: Floats
    radius: Floats


class Places(NamedTuple):
    """Where blocks begin and end, on the table: µm, where the first G92 names the place of the start.

    Attributes
    ----------
    start_um, end_um
        (e, 2) of each block as it runs; the same where it does not move.
    shift_um
        (e, 2) what is added to coordinates as programmed: a G92 without a stop before it re-bases them.
    moves
        (e,) whether a block is told to move, be it by nothing.
    is_named
        (e,) whether a block names its place by G92: the wire is there, however it came.
    """

    start_um: Floats
    end_um: Floats
    shift_um: Floats
    moves: Bools
    is_named: Bools


def coordinates(given: Given, runs: Ints, mode: Modes) -> Coordinates:
    """The numbers of the blocks `runs` (e,) at their scale."""
    words = given.listing.words

    def um(letter: str) -> Floats:
        word = given.word(letter)[runs]
        scale = np.where(words.decimals[word] < 0, mode.integer_um, mode.point_um)
        return np.where(word >= 0, np.round(words.value[word] * scale, _DIGITS), np.nan)

    if not len(words.value):
        nothing = np.full((len(runs), 2), np.nan)
        return Coordinates(nothing, nothing, nothing[:, 0])
    return Coordinates(np.column_stack([um("X"), um("Y")]), np.column_stack([um("I"), um("J")]), um("R"))


def places(given: Given, runs: Ints, mode: Modes, numbers: Coordinates, is_threaded: Bools) -> Places:
    """Where the blocks `runs` (e,) begin and end.

    `is_threaded` (e,) says where the wire may stand elsewhere than the block before it ended: a G92 there names the
    place, any other one names only its coordinates.
    """
    names = given.g(_SET_PLACE)[runs]
    told = ~np.isnan(numbers.end).all(axis=1) | ((mode.motion >= 2) & ~np.isnan(numbers.center).all(axis=1))
    moves = told & ~names & ~given.g(_DWELL)[runs] & (mode.motion != NO_MOTION)
    moves &= ~given.listing.blocks.is_damaged[runs]
    is_bare = names & np.isnan(numbers.end).all(axis=1) & (given.word("Z")[runs] < 0)
    end = np.where(is_bare[:, None], 0.0, numbers.end)
    is_given = ~np.isnan(end)
    sets = is_given & (names | (moves & mode.is_absolute))[:, None]
    adds = is_given & (moves & ~mode.is_absolute)[:, None]
    past = _programmed(np.where(sets, end, np.nan), np.where(adds, end, 0.0))
    before = np.concatenate([np.zeros((1, 2)), past[:-1]])
    first = names & (np.cumsum(names | moves) == 1)
    before[first] = past[first]
    rebased = names & ~is_threaded & ~first
    shift = np.cumsum(np.where(rebased[:, None], before - past, 0.0), axis=0)
    end_um = past + shift
    start_um = np.concatenate([np.where(first[:1, None], end_um[:1], 0.0), end_um[:-1]])
    start_um = np.where(first[:, None], end_um, start_um)
    return Places(start_um, end_um, shift, moves, names & is_threaded & ~first)


def _programmed(placed: Floats, by: Floats) -> Floats:
    """Coordinates (e, 2) behind each block: the last one placed (NaN: none) and all ways since."""
    total = np.cumsum(by, axis=0)
    row = np.where(np.isnan(placed), -1, np.arange(len(placed))[:, None])
    last = np.maximum.accumulate(row, axis=0)
    base = np.where(last >= 0, np.take_along_axis(placed - total, np.maximum(last, 0), axis=0), 0.0)
    return base + total
