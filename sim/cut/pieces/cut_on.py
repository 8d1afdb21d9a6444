"""How far the wire goes on in a piece once it is free."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from sim.cut.kerf.swept import Swept
from sim.cut.kerf.ways import last_beside

_SPARED = 0.1  # offsets: a wire that reaches less deep into a piece only takes off what an earlier cut left on it


class Rest(NamedTuple):
    """What the wire sweeps on a contour from one of the places of its way on, by its index."""

    swept: Swept
    first: int


def cut_on_um(piece_um: shapely.Polygon, rests: Iterable[Rest], offset_um: float) -> float:
    """How far the wire goes on in a piece, not counting where it runs along its own kerf again."""
    shapely.prepare(piece_um)
    inside = [(rest, _inside(piece_um, rest, offset_um)) for rest in rests]
    length = np.concatenate([_lengths_um(rest, at) for rest, at in inside])
    place = np.concatenate([rest.swept.way.place_um[at] for rest, at in inside])
    return float(length[~_again(place, np.cumsum(length), offset_um)].sum())


def _inside(piece_um: shapely.Polygon, rest: Rest, offset_um: float) -> Ints:
    """Indices of the places from which the wire cuts in a piece."""
    reach = (1.0 - _SPARED) * offset_um
    swept = rest.swept
    stretch = swept.stretches_near(piece_um.bounds)
    # Most stretches near a piece run beside it: then no place of them needs a look.
    chord = shapely.linestrings(swept.chord_um[stretch])
    runs_in = shapely.dwithin(piece_um, chord, reach + swept.off_um[stretch])  # type: ignore[call-overload]
    stretch = stretch[runs_in]
    near = swept.places_of(stretch)
    near = near[near >= rest.first]
    low_x, low_y, high_x, high_y = piece_um.bounds
    x, y = swept.way.place_um[near].T
    is_near = (x >= low_x - reach) & (x <= high_x + reach) & (y >= low_y - reach) & (y <= high_y + reach)
    near = near[is_near]
    inside: Ints = near[shapely.dwithin(piece_um, shapely.points(swept.way.place_um[near]), reach)]
    return inside


def _lengths_um(rest: Rest, at: Ints) -> Floats:
    """How far it is to each of some places of a rest from the one before."""
    along = rest.swept.way.along_um
    lengths: Floats = along[at] - along[np.maximum(at - 1, rest.first)]
    return lengths


def _again(place_um: Floats, along_um: Floats, offset_um: float) -> NDArray[np.bool_]:
    """Whether the way was at each of the places (m, 2) before: more than an offset earlier by its length (m,)."""
    if not len(along_um) or along_um[-1] - along_um[0] <= offset_um:
        return np.zeros(len(place_um), dtype=np.bool_)
    reach = _SPARED * offset_um
    earliest = len(place_um) - 1 - last_beside(place_um[::-1], place_um, reach, reach)  # seen backwards it is the last
    again: NDArray[np.bool_] = along_um - along_um[earliest] > offset_um
    return again
