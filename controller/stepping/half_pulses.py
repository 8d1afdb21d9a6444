"""Where a path comes so near to half a pulse on an axis that rounding could change the whole pulse.

On each axis a line is ``p(s) = start + T s`` and an arc ``p(s) = c + A sin(κs − ψ)`` with ``A = sqrt(T² + N²) / κ``,
``c = start + N / κ`` and ``ψ = atan2(N, T)``: the terms of a `Path` put together. Between its extremes an arc
is as monotone as a line, so each half pulse is met once, over the span in which p is within a doubt of it.
"""

from typing import NamedTuple

import numpy as np

from controller.motion.path import Path
from parser.geometry.curves import Floats, Ints

_STANDS = 1e-200
"""Put for a slope or an amplitude of 0: an axis that stands near half a pulse is in doubt all along."""


class Parts(NamedTuple):
    """m parts of rows of a path: (m,) rows, lengths from the rows' starts, and the doubt of places there, µm."""

    row: Ints
    from_um: Floats
    to_um: Floats
    doubt_um: Floats

    def picked(self, which: Ints) -> "Parts":
        """The parts of these indices."""
        return Parts._make(column[which] for column in self)


class Doubts(NamedTuple):
    """(m,) rows, and the lengths (m,) µm from their starts between which an axis is in doubt."""

    row: Ints
    first_um: Floats
    last_um: Floats


def doubts(path: Path, parts: Parts) -> Doubts:
    """Spans of all axes in which places may round either way, in no order."""
    bent = path.curvature[parts.row] > 0.0
    lines = _of_lines(path, parts.picked(np.flatnonzero(~bent)))
    arcs = _of_arcs(path, parts.picked(np.flatnonzero(bent)))
    return Doubts._make(np.concatenate(pair) for pair in zip(lines, arcs, strict=True))


def _of_lines(path: Path, parts: Parts) -> Doubts:
    parts, axis = _each_axis(parts, path.start_um.shape[1])
    start, slope = path.start_um[parts.row, axis], path.tangent[parts.row, axis]
    of, low, high = _levels(start + slope * parts.from_um, start + slope * parts.to_um, parts)
    slope = np.where(slope == 0.0, _STANDS, slope)
    return _spans(parts, of, (low - start[of]) / slope[of], (high - start[of]) / slope[of])


def _of_arcs(path: Path, parts: Parts) -> Doubts:
    parts, axis = _each_axis(parts, path.start_um.shape[1])
    tangent, normal = path.tangent[parts.row, axis], path.normal[parts.row, axis]
    bend = path.curvature[parts.row]
    center = path.start_um[parts.row, axis] + normal / bend
    size, phase = np.hypot(tangent, normal) / bend, np.arctan2(normal, tangent)
    of, half_turn = _half_turns(bend * parts.from_um - phase, bend * parts.to_um - phase)
    parts = _within(parts.picked(of), (half_turn * np.pi + phase[of]) / bend[of], np.pi / 2.0 / bend[of])
    center, size, phase, bend = center[of], size[of], phase[of], bend[of]
    first, last = (center + size * np.sin(bend * s - phase) for s in (parts.from_um, parts.to_um))
    of, low, high = _levels(first, last, parts)
    rising = 1.0 - 2.0 * (half_turn[of] % 2)
    size = np.maximum(size, _STANDS)[of]
    middle = half_turn[of] * np.pi + phase[of]
    angles = (middle + rising * np.arcsin(np.clip((level - center[of]) / size, -1.0, 1.0)) for level in (low, high))
    first, last = (angle / bend[of] for angle in angles)
    return _spans(parts, of, first, last)


def _each_axis(parts: Parts, axes: int) -> tuple[Parts, Ints]:
    """The parts once for each axis, and the axis of each."""
    m = len(parts.row)
    return parts.picked(np.repeat(np.arange(m), axes)), np.tile(np.arange(axes), m)


def _half_turns(first: Floats, last: Floats) -> tuple[Ints, Ints]:
    """Half turns between extremes of a sine that angles from `first` to `last` touch: number of the part, half turn."""
    low = np.floor(first / np.pi + 0.5).astype(np.int64)
    count = np.floor(last / np.pi + 0.5).astype(np.int64) - low + 1
    of = np.repeat(np.arange(len(first)), count)
    return of, low[of] + _counted(count)


def _within(parts: Parts, middle: Floats, reach: Floats) -> Parts:
    """The parts cut to what lies within a reach of the middle."""
    first = np.maximum(parts.from_um, middle - reach)
    return parts._replace(from_um=first, to_um=np.maximum(np.minimum(parts.to_um, middle + reach), first))


def _levels(first: Floats, last: Floats, parts: Parts) -> tuple[Ints, Floats, Floats]:
    """Half pulses that monotone parts from place `first` to `last` come near: number of the part, level ∓ doubt."""
    doubt = parts.doubt_um
    low = np.ceil(np.minimum(first, last) - doubt - 0.5)
    count = np.maximum(np.floor(np.maximum(first, last) + doubt - 0.5) - low + 1.0, 0.0).astype(np.int64)
    of = np.repeat(np.arange(len(first)), count)
    level = low[of] + _counted(count) + 0.5
    return of, level - doubt[of], level + doubt[of]


def _spans(parts: Parts, of: Ints, one_um: Floats, other_um: Floats) -> Doubts:
    """Spans between two lengths, in either order, as far as the parts go."""
    low, high = parts.from_um[of], parts.to_um[of]
    first, last = np.minimum(one_um, other_um), np.maximum(one_um, other_um)
    return Doubts(parts.row[of], np.clip(first, low, high), np.clip(last, low, high))


def _counted(count: Ints) -> Ints:
    """0, 1, … to each count, strung together."""
    return np.arange(int(count.sum())) - np.repeat(np.cumsum(count) - count, count)
