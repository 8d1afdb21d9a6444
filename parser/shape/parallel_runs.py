"""Which stretches of a path run beside one another, and how far aside: passes over one edge do."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from parser.geometry.along import headings_along, headings_at, places_at
from parser.geometry.curves import Curves, Floats, Ints, extents, total_before
from parser.geometry.distance import feet
from parser.geometry.near import Near, near_places
from parser.toolpath import Toolpath

BESIDE_UM = 400.0
"""Passes of one cut lie this near each other: an offset is a wire's radius and a gap, and one leaves some of another's
(docs/3b.md §5)."""
_SAME_WAY = 0.9  # cosine of the angle between two ways that run beside each other
_UNLIKE_UM, _UNLIKE_SHARE = 10.0, 0.3  # a trim takes about as much all along
_FEW_PAIRS = 10_000
_SAMPLES = 16  # of a stretch, at equal lengths
_MOST_LOOKED_AT = 1 << 20  # places beside rows, in one go


class Stretches(NamedTuple):
    """Stretches (k,) of the path, by their first and last rows, both included."""

    first: Ints
    last: Ints

    def take(self, at: Ints) -> "Stretches":
        """Those at the indices `at`."""
        return Stretches(self.first[at], self.last[at])


class Samples(NamedTuple):
    """Places (m, 2) µm on the path with the direction (m, 2) of travel there, and which stretch (m,) each is of."""

    of: Ints
    place_um: Floats
    way: Floats


class Neighbours(NamedTuple):
    """Rows (k,) that run beside places.

    Attributes
    ----------
    at, row
        Which place, and the row beside it.
    aside_um
        How far the row runs to the left of the place, looking along the path there; negative to the right.
    sense
        +1 where it runs the same way, −1 where it runs the other.
    """

    at: Ints
    row: Ints
    aside_um: Floats
    sense: Ints


class RunBeside(NamedTuple):
    """How k pairs of stretches run beside each other.

    Attributes
    ----------
    share
        Share of the second one's samples that have the first one beside them, about as far aside as most have it.
    sense
        Mean sense of these, +1 where all run the same way, −1 where all run the other way; 0 without any.
    aside_um
        Median of how far the first one runs to the left of the second; 0 without any.
    """

    share: Floats
    sense: Floats
    aside_um: Floats


def sampled(toolpath: Toolpath, stretches: Stretches, samples: int = _SAMPLES) -> Samples:
    """Places at the middles of `samples` equal parts of each stretch."""
    before = total_before(toolpath.length_um)
    low, high = before[stretches.first], before[stretches.last + 1]
    share = (np.arange(samples) + 0.5) / samples
    run = (low[:, None] + (high - low)[:, None] * share).reshape(-1)
    of = np.repeat(np.arange(len(low)), samples)
    row = np.clip(np.searchsorted(before, run, side="right") - 1, stretches.first[of], stretches.last[of])
    since = np.clip(run - before[row], 0.0, toolpath.length_um[row])
    return Samples(of, places_at(toolpath, row, since), headings_along(toolpath, row, since))


def neighbours(toolpath: Toolpath, rows: Ints, place_um: Floats, way: Floats) -> Neighbours:
    """Those of the `rows` (r,) that run beside places (m, 2) µm on the path, passed in the directions (m, 2)."""
    near = _near(toolpath.picked(rows), place_um)
    return _running_beside(toolpath, rows[near.row], near.other, place_um, way)


def _running_beside(toolpath: Toolpath, row: Ints, at: Ints, place_um: Floats, way: Floats) -> Neighbours:
    """Those of the pairs (p,) of a row and a place, by its number, that run beside each other."""
    foot = feet(toolpath, row, place_um[at]).place_um
    heading = headings_at(toolpath, row, foot)
    out, along = foot - place_um[at], way[at]
    aside = along[:, 0] * out[:, 1] - along[:, 1] * out[:, 0]
    ahead = (along * out).sum(axis=1)
    cosine = (along * heading).sum(axis=1)
    # A foot at the end of a row lies aside, not ahead, where the row runs beside the place.
    is_near = (
        (np.abs(cosine) >= _SAME_WAY) & (np.abs(aside) <= BESIDE_UM) & (np.abs(ahead) <= 0.5 * np.abs(aside) + 5.0)
    )
    which = np.flatnonzero(is_near)
    return Neighbours(at[which], row[which], aside[which], np.sign(cosine[which]).astype(np.int64))


def _near(curves: Curves, place_um: Floats) -> Near:
    """Pairs of places and rows that may run beside each other; of few all, which is faster than to look."""
    if len(curves) * len(place_um) > _FEW_PAIRS:
        return near_places(curves, place_um, BESIDE_UM)
    row, place = np.arange(len(curves)), np.arange(len(place_um))
    return Near(np.repeat(place, len(row)), np.tile(row, len(place)))


def run_beside(toolpath: Toolpath, stretches: Stretches, this: Ints, other: Ints) -> RunBeside:
    """How the stretches `one` (k,) run beside the stretches `other` (k,), by their numbers.

    Each pair is looked at by itself: where a thousand passes lie on one another, all rows lie near all places.
    """
    nothing = np.zeros(len(this))
    if not len(this):
        return RunBeside(nothing, nothing, nothing)
    boxes = extents(toolpath)
    rows = stretches.last[this] - stretches.first[this] + 1
    part = np.cumsum(rows) // (_MOST_LOOKED_AT // _SAMPLES)
    bounds = np.append(np.flatnonzero(np.diff(part, prepend=-1)), len(this))
    parts = [
        _some_beside(toolpath, boxes, stretches, this[low:past], other[low:past])
        for low, past in pairwise(bounds.tolist())
    ]
    share, sense, aside = (np.concatenate(column) for column in zip(*parts, strict=True))
    return RunBeside(share, sense, aside)


def _some_beside(
    toolpath: Toolpath, boxes: tuple[Floats, Floats], stretches: Stretches, this: Ints, other: Ints
) -> RunBeside:
    """How some stretches run beside others, `boxes` being the lowest and highest places (n, 2) of the rows."""
    places = sampled(toolpath, stretches.take(other))
    number = stretches.last[this] - stretches.first[this] + 1
    pair = np.repeat(np.arange(len(this)), number)
    row = np.arange(len(pair)) + (stretches.first[this] - np.cumsum(number) + number)[pair]
    at = pair[:, None] * _SAMPLES + np.arange(_SAMPLES)
    near = np.ones(at.shape, dtype=np.bool_)
    for axis, (low, high) in enumerate(zip(boxes[0].T, boxes[1].T, strict=True)):
        place = places.place_um[:, axis][at]
        near &= (place >= (low[row] - BESIDE_UM)[:, None]) & (place <= (high[row] + BESIDE_UM)[:, None])
    of, sample = np.nonzero(near)
    return _by_pair(_running_beside(toolpath, row[of], at[of, sample], places.place_um, places.way), len(this))


def _by_pair(beside_neighbours: Neighbours, pairs: int) -> RunBeside:
    """Rows beside places summed up by pairs of stretches, each with so many places one after the other."""
    # Of the rows of one stretch the nearest one counts at a place.
    nearest = np.lexsort((np.abs(beside_neighbours.aside_um), beside_neighbours.at))
    once = nearest[np.diff(beside_neighbours.at[nearest], prepend=-1) != 0]
    pair, aside, sense = (
        beside_neighbours.at[once] // _SAMPLES,
        beside_neighbours.aside_um[once],
        beside_neighbours.sense[once],
    )
    count = np.bincount(pair, minlength=pairs)
    usual = _medians(pair, aside, count)
    like = np.abs(aside - usual[pair]) <= _UNLIKE_UM + _UNLIKE_SHARE * np.abs(usual[pair])
    share = np.bincount(pair, like, pairs) / _SAMPLES
    return RunBeside(share, np.bincount(pair, sense, pairs) / np.maximum(count, 1), usual)


def _medians(group: Ints, value: Floats, count: Ints) -> Floats:
    """Medians of the values of each group, of the two in the middle the lower one; 0 of an empty group."""
    value = value[np.lexsort((value, group))]
    middle = np.cumsum(count) - count + (count - 1) // 2
    return np.where(count > 0, np.append(value, 0.0)[np.minimum(middle, len(value))], 0.0)
