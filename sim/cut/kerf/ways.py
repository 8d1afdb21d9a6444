"""The wire's real way through each contour, as places so near each other that discs about them make a smooth kerf."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints, total_before
from parser.shape.contours import Contour
from sim.table.trace import Trace

_SCALLOP_UM = 0.02  # left standing between two discs one behind the other; steps are 1 µm
_STANDING_UM = 0.25  # places nearer to the one before add nothing: a wire that waits


class WireWay(NamedTuple):
    """The wire's way through one contour, m places.

    Attributes
    ----------
    place_um
        (m, 2) float64, the wire's centre.
    along_um
        (m,) float64, length of the way from its start.
    t_s
        (m,) float64.
    row
        (m,) int64, row of the toolpath that was running.
    """

    place_um: Floats
    along_um: Floats
    t_s: Floats
    row: Ints


def wire_ways(trace: Trace, contours: Sequence[Contour], offset_um: float) -> tuple[WireWay, ...]:
    """Ways through the contours, empty where the trace ends before one begins."""
    first = np.searchsorted(trace.row, [contour.first - 1 for contour in contours])
    past = np.searchsorted(trace.row, [contour.last for contour in contours])
    # The discharge begins where the wire stands after the jump.
    first = np.where(past > first, np.maximum(first - 1, 0), first)
    spacing = spacing_um(offset_um)
    return tuple(_wire_way(trace, slice(low, high), spacing) for low, high in zip(first, past, strict=True))


def spacing_um(offset_um: float) -> float:
    """Distance of discs of radius `offset_um` that leave scallops of 0.02 µm between them: d²/8r high."""
    return float(np.sqrt(8.0 * offset_um * _SCALLOP_UM))


def behind(way: WireWay, at: int) -> WireWay:
    """The rest of a way from one of its places on."""
    return WireWay(way.place_um[at:], way.along_um[at:], way.t_s[at:], way.row[at:])


def _wire_way(trace: Trace, samples: slice, spacing: float) -> WireWay:
    place, t_s, row = trace.wire_um[samples], trace.t_s[samples], trace.row[samples]
    if not len(row):
        return WireWay(place, t_s, t_s, row)
    number = np.maximum(np.ceil(_steps_um(place) / spacing), 1.0).astype(np.int64)
    before = np.repeat(np.arange(len(number)), number)
    share = (np.arange(len(before)) - np.repeat(np.cumsum(number) - number, number) + 1.0) / number[before]
    place = np.concatenate([place[:1], place[before] + share[:, None] * np.diff(place, axis=0)[before]])
    t_s = np.concatenate([t_s[:1], t_s[before] + share * np.diff(t_s)[before]])
    row = np.concatenate([row[1:2], row[before + 1]]) if len(before) else row
    along = total_before(_steps_um(place))
    moved = np.diff(np.floor(along / _STANDING_UM), prepend=-1.0) > 0.0
    return WireWay(place[moved], along[moved], t_s[moved], row[moved])


def _steps_um(place: Floats) -> Floats:
    by = np.diff(place, axis=0)
    return np.hypot(by[:, 0], by[:, 1])
