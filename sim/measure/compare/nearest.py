"""Which of many curves lies nearest to a place: shapely's STRtree over chords, then the curves themselves."""

from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.along import places
from parser.geometry.boxes import chunks
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.distance import distance_to_curves
from sim.measure.compare.effort import Effort

_SAGITTA_UM = 2.0  # of the chords that stand for arcs in the tree: few of them, and few that come into question
_MOST_CHORDS = 500_000  # beyond, arcs have longer ones
_AT_ONCE = 256  # places: what these cost at worst goes beyond what may be spent


class Index(NamedTuple):
    """Curves that can be asked for the nearest one.

    Attributes
    ----------
    curves
        n lines and arcs.
    tree
        Chords of them.
    row
        (m,) the curve of each chord.
    sagitta_um
        How far a curve lies from its chords at most.
    effort
        How much has been asked of them.
    """

    curves: Curves
    tree: shapely.STRtree
    row: Ints
    sagitta_um: float
    effort: Effort


class Nearest(NamedTuple):
    """Rows (m,) of the nearest curves and the distances (m,) µm from them; of equally near ones the first."""

    row: Ints
    distance_um: Floats


def indexed(curves: Curves) -> Index:
    """The curves, one or more, with the tree over them."""
    sagitta = _SAGITTA_UM
    chords = _chords(curves, sagitta)
    if chords.sum() > _MOST_CHORDS:  # their number goes with the root of the sagitta
        sagitta *= float((chords.sum() / _MOST_CHORDS) ** 2)
        chords = _chords(curves, sagitta)
    row = np.repeat(np.arange(len(curves)), chords)
    at = np.arange(len(row)) - (np.cumsum(chords) - chords)[row]
    ends = [places(curves, row, (at + past) / chords[row]) for past in (0, 1)]
    chord = np.asarray(shapely.linestrings(np.stack(ends, axis=1)), dtype=np.object_)
    tree = shapely.STRtree(chord)
    return Index(curves, tree, row, sagitta if bool(curves.is_arc.any()) else 0.0, Effort(0.5 * (ends[0] + ends[1])))


def nearest(index: Index, place_um: Floats) -> Nearest:
    """The nearest curves to places (m, 2), exactly: of all curves whose chords come near enough.

    Raises DrawingError where that takes more than `MOST_HELD` allows.
    """
    if not len(place_um):
        return Nearest(np.empty(0, dtype=np.int64), np.empty(0))
    parts = [_nearest(index, place_um[at : at + _AT_ONCE]) for at in range(0, len(place_um), _AT_ONCE)]
    return Nearest(np.concatenate([part.row for part in parts]), np.concatenate([part.distance_um for part in parts]))


def _nearest(index: Index, place_um: Floats) -> Nearest:
    points = np.asarray(shapely.points(place_um), dtype=np.object_)
    (_, _), to_chord = index.tree.query_nearest(points, return_distance=True, all_matches=False)
    # The nearest curve has a chord no farther off than this; the last bits of the distances are granted.
    within = (to_chord + 2.0 * index.sagitta_um) * (1.0 + 1e-12) + 1e-9
    held = np.cumsum(index.effort.spend(place_um, within) + 1)
    parts = [_nearest_of(index, points[low:past], place_um[low:past], within[low:past]) for low, past in chunks(held)]
    return Nearest(np.concatenate([part.row for part in parts]), np.concatenate([part.distance_um for part in parts]))


def _nearest_of(index: Index, points: NDArray[np.object_], place_um: Floats, within_um: Floats) -> Nearest:
    place, chord = index.tree.query(points, predicate="dwithin", distance=within_um)
    row = index.row[chord]
    distance, _ = distance_to_curves(index.curves, row, place_um[place, 0], place_um[place, 1])
    order = np.lexsort((row, distance, place))
    first = order[np.searchsorted(place[order], np.arange(len(place_um)))]
    return Nearest(row[first], distance[first])


def _chords(curves: Curves, sagitta_um: float) -> Ints:
    """Numbers (n,) of chords: 1 on lines, on arcs so many that they keep the sagitta, R (1 − cos(step / 2))."""
    radius = np.where(curves.is_arc, curves.radius_um, 1.0)
    step = 2.0 * np.arccos(np.maximum(1.0 - sagitta_um / np.maximum(radius, sagitta_um), np.cos(np.pi / 4.0)))
    return np.maximum(np.ceil(np.abs(curves.sweep_rad) / step), 1.0).astype(np.int64)
