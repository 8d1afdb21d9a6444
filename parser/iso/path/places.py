"""Places: where each block begins and ends, µm, from coordinates given as places and as ways (docs/iso.md §5).

Modes: what words of a group, once given, hold in force until another one of the group.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.path.flow import GivenColumns

NO_MOTION = -1
_ABSOLUTE, _ABSOLUTE_CENTERS = 900, 901
_UM_PER_INCH = 25_400.0
_INCH, _MM = (200, 700), (210, 710)
_LEFT, _RIGHT = (410, 1410, 1510), (420, 1420, 1520)
"""G41 and G42; G141, G142 and G151, G152 do the same to two contours, each in its own plane."""


class Modes(NamedTuple):
    """What is in force in each block as it runs, words of the block itself included; each column has shape (e,).

    Attributes
    ----------
    motion
        int64: 0 G00 … 3 G03; −1 before the first one.
    is_absolute, has_absolute_centers
        bool: X Y are places, I J are places.
    integer_um, point_um
        float64: what a coordinate of 1 means without a point, and with one.
    side
        int64: +1 G41, −1 G42, 0 G40; words of two planes likewise.
    """

    motion: Ints
    is_absolute: Bools
    has_absolute_centers: Bools
    integer_um: Floats
    point_um: Floats
    side: Ints


def modes(given: GivenColumns, runs: Ints) -> Modes:
    """The modes in force in the blocks `runs` (e,), in the order in which they run."""
    profile = given.profile
    motion = carried(given.group("motion")[runs], NO_MOTION)
    centers = carried(given.group("centres")[runs], _ABSOLUTE_CENTERS if profile.centers == "absolute" else 0)
    distance = carried(given.group("distance")[runs], _ABSOLUTE if profile.distance == "absolute" else 0)
    side, of_planes = (carried(given.group(name)[runs], 0) for name in ("compensation", "two-planes"))
    side = np.where(np.isin(of_planes, (*_LEFT, *_RIGHT)), of_planes, side)
    integer_um, point_um = _scales(given, carried(given.group("unit")[runs], 0))
    return Modes(
        motion=np.where(motion >= 0, motion // 10, NO_MOTION),
        is_absolute=distance == _ABSOLUTE,
        has_absolute_centers=centers == _ABSOLUTE_CENTERS,
        integer_um=integer_um,
        point_um=point_um,
        side=np.isin(side, _LEFT).astype(np.int64) - np.isin(side, _RIGHT),
    )


def carried(given: Ints, at_start: int) -> Ints:
    """Values (e,) that hold until the next one that is not negative; `at_start` before the first."""
    last = np.maximum.accumulate(np.where(given >= 0, np.arange(len(given)), -1))
    return np.where(last >= 0, given[last], at_start)


def _scales(given: GivenColumns, unit: Ints) -> tuple[Floats, Floats]:
    """Coordinates follow the profile until a unit word says the other system than the profile's."""
    profile = given.profile
    is_inch_profile = profile.point_um == _UM_PER_INCH
    integer = np.full(len(unit), profile.integer_um)
    point = np.full(len(unit), profile.point_um)
    if is_inch_profile:
        metric = np.isin(unit, _MM)
        return np.where(metric, 1.0, integer), np.where(metric, 1000.0, point)
    inch = np.isin(unit, _INCH)
    return np.where(inch, 1e-4 * _UM_PER_INCH, integer), np.where(inch, _UM_PER_INCH, point)


DWELL, SET_PLACE = 40, 920
"""G04, whose X is a time, and G92, tenfold."""

_DIGITS = 6


class Coordinates(NamedTuple):
    """Numbers of e blocks as they run, µm, NaN where a word is missing.

    Attributes
    ----------
    end, center
        (e, 2) X Y and I J, places or ways.
    radius
        (e,) R.
    moves
        (e,) whether a block is told to move, be it by nothing.
    names
        (e,) whether a block names its place by G92.
    lacks_motion
        (e,) whether a block has numbers to move by, and no motion word was there before it ran.
    """

    end: Floats
    center: Floats
    radius: Floats
    moves: Bools
    names: Bools
    lacks_motion: Bools


class Places(NamedTuple):
    """Where e blocks begin and end, on the table: µm, where the first G92 names the place of the start.

    Attributes
    ----------
    start_um, end_um
        (e, 2) of each block as it runs; the same where it does not move.
    shift_um
        (e, 2) what is added to coordinates as programmed.
    is_threaded
        (e,) G92 behind a stop: the wire was threaded anew at the place that it names.
    is_rebased
        (e,) G92 elsewhere that names another place than the wire is at: from here on coordinates are others.
    """

    start_um: Floats
    end_um: Floats
    shift_um: Floats
    is_threaded: Bools
    is_rebased: Bools


def coordinates(given: GivenColumns, runs: Ints, mode: Modes) -> Coordinates:
    """The numbers of the blocks `runs` (e,) at their scale. A bare G92 names X0 Y0."""
    words = given.listing.words

    def um(letter: str) -> Floats:
        word = given.word(letter)[runs]
        scale = np.where(words.decimals[word] < 0, mode.integer_um, mode.point_um)
        return np.where(word >= 0, exact(words.value[word] * scale), np.nan)

    if not len(words.value):
        nothing = np.full((len(runs), 2), np.nan)
        return Coordinates(nothing, nothing, nothing[:, 0], *np.zeros((3, len(runs)), dtype=np.bool_))
    end, center = np.column_stack([um("X"), um("Y")]), np.column_stack([um("I"), um("J")])
    names = given.g(SET_PLACE)[runs]
    is_told = _any(end) | ((mode.motion >= 2) & _any(center))
    to_move = is_told & ~names & ~given.g(DWELL)[runs] & ~given.listing.blocks.is_damaged[runs]
    has_motion = mode.motion != NO_MOTION
    end[names & bare_place(given)[runs]] = 0.0
    lacks_motion = to_move & ~has_motion & (given.group("path")[runs] < 0)  # those take numbers of their own
    return Coordinates(end, center, um("R"), to_move & has_motion, names, lacks_motion)


def bare_place(given: GivenColumns) -> Bools:
    """(b,) blocks with G92 and no coordinate."""
    return given.g(SET_PLACE) & (given.word("X") < 0) & (given.word("Y") < 0) & (given.word("Z") < 0)


def places(numbers: Coordinates, is_absolute: Bools, stops: Bools) -> Places:
    """Where blocks begin and end; `stops` (e,) are those behind which the wire may be threaded elsewhere."""
    names, moves = numbers.names, numbers.moves
    placed = np.where((names | (moves & is_absolute))[:, None], numbers.end, np.nan)
    by = np.where((moves & ~is_absolute)[:, None], np.nan_to_num(numbers.end), 0.0)
    past = exact(_programmed(placed, by))
    first = names & (np.cumsum(names | moves) == 1)
    before = np.concatenate([np.zeros((1, 2)), past[:-1]])
    before[first] = past[first]
    is_threaded = names & ~first & _behind_stop(stops, moves)
    is_rebased = names & ~is_threaded & ((before[:, 0] != past[:, 0]) | (before[:, 1] != past[:, 1]))
    shift = exact(np.cumsum(np.where(is_rebased[:, None], before - past, 0.0), axis=0))
    start_um = exact(before + np.concatenate([np.zeros((1, 2)), shift[:-1]]))
    return Places(start_um, exact(past + shift), shift, is_threaded, is_rebased)


def lost(numbers: Coordinates, is_absolute: Bools, is_damaged: Bools) -> Bools:
    """(e,) whether a block that is told places begins or ends where nobody knows.

    Behind a block whose motion is not known the wire is at no known place until blocks name X and Y again.
    """
    row = np.arange(len(is_damaged))[:, None]
    names = (numbers.names | (numbers.moves & is_absolute))[:, None] & ~np.isnan(numbers.end)
    damaged = np.maximum.accumulate(np.where(is_damaged[:, None], row, -1))
    named = np.maximum.accumulate(np.where(names, row, -1))
    is_unknown: Bools = damaged[:, 0] > named.min(axis=1)
    before: Bools = np.concatenate([np.zeros(1, dtype=np.bool_), is_unknown[:-1]])
    either: Bools = before | is_unknown
    return either


def exact(um: Floats) -> Floats:
    """Lengths to a millionth of a µm, as sums of written numbers are: 1.013 mm are 1013 µm, and no bit beside it."""
    return np.round(um, _DIGITS)


def _programmed(placed: Floats, by: Floats) -> Floats:
    """Coordinates (e, 2) behind each block: the last one placed (NaN: none) and all ways since."""
    total = np.cumsum(by, axis=0)
    row = np.where(np.isnan(placed), -1, np.arange(len(placed))[:, None])
    last = np.maximum.accumulate(row, axis=0)
    base = np.take_along_axis(placed - total, np.maximum(last, 0), axis=0)
    return np.where(last >= 0, base, 0.0) + total


def _behind_stop(stops: Bools, moves: Bools) -> Bools:
    """(e,) whether a stop stands before a block and no motion between."""
    last_stop, last_move = _last(stops), _last(moves)
    return np.concatenate([[False], last_stop[:-1] >= np.maximum(last_move[:-1], 0)])


def _last(of: Bools) -> Ints:
    """(e,) the last block so far that is one of them; −1 before the first."""
    return np.maximum.accumulate(np.where(of, np.arange(len(of)), -1))


def _any(pairs: Floats) -> Bools:
    return ~np.isnan(pairs[:, 0]) | ~np.isnan(pairs[:, 1])
