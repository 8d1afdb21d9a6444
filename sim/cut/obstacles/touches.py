"""Where a moving point meets bodies that stand still: the engine's queries, asked only where the point comes near.

A way of hundreds of thousands of samples is looked at in stretches. Numpy tells by boxes which stretches come near;
those are halved for as long as the band round their chord meets the body, down to single moves between samples.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pymunk
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from sim.cut.obstacles.bodies import BodyShapes

STRETCH = 256
"""Samples in a stretch, at most."""

_GRACE_UM = 1e-3  # added to the band, so that it holds all its samples whichever way they were rounded


class Way(NamedTuple):
    """Places of a point, in stretches that each belong to one block.

    Attributes
    ----------
    place_um
        (n, 2) float64.
    ends
        (k, 2) int64, first and last sample of each stretch, in order. Where the next stretch follows at once, it begins
        with the sample that this one ends with.
    boxes_um
        (k, 2, 2) float64, lowest and highest (x, y) of each stretch.
    """

    place_um: Floats
    ends: Ints
    boxes_um: Floats

    def kept(self, which: NDArray[np.bool_]) -> "Way":
        """The way with some of its stretches, (k,) bool."""
        return self._replace(ends=self.ends[which], boxes_um=self.boxes_um[which])


class Touch(NamedTuple):
    """A touch on the move that ends in a sample, at a share of the move from the sample before."""

    sample: int
    share: float


def way_of(place_um: Floats, row: Ints) -> Way:
    """Way through places (n, 2), n ≥ 2; `row` (n,) is that of the move that ends in each place."""
    last = len(row) - 1
    borders = np.flatnonzero(np.diff(row[1:])) + 1
    cuts = np.unique(np.concatenate([np.arange(0, last, STRETCH), borders, [last]]))
    ends = np.stack([cuts[:-1], cuts[1:]], axis=1)
    low = np.minimum(np.minimum.reduceat(place_um, ends[:, 0]), place_um[ends[:, 1]])
    high = np.maximum(np.maximum.reduceat(place_um, ends[:, 0]), place_um[ends[:, 1]])
    return Way(place_um, ends, np.stack([low, high], axis=1))


def touches(way: Way, pieces: BodyShapes) -> Iterator[Touch]:
    """Every move of a way that touches a body, in order; a move that begins in touch touches at once, at share 0."""
    near = way.kept(_near(way.boxes_um, pieces.boxes_um))
    for (low, high), (lowest, highest) in zip(near.ends.tolist(), near.boxes_um.tolist(), strict=True):
        yield from _halved(pieces.near(lowest, highest), way.place_um, low, high)


def _near(boxes_um: Floats, bodies_um: Floats) -> NDArray[np.bool_]:
    """Which boxes (k, 2, 2) meet one of the bodies (m, 2, 2)."""
    near = _meet(boxes_um, np.stack([bodies_um[:, 0].min(axis=0), bodies_um[:, 1].max(axis=0)]))
    some = boxes_um[near]
    any_ = np.zeros(len(some), dtype=np.bool_)
    for body in bodies_um:
        any_ |= _meet(some, body)
    near[near] = any_
    return near


def _meet(boxes_um: Floats, box_um: Floats) -> NDArray[np.bool_]:
    (left, bottom), (right, top) = box_um
    low, high = boxes_um[:, 0], boxes_um[:, 1]
    meets: NDArray[np.bool_] = (low[:, 0] <= right) & (high[:, 0] >= left) & (low[:, 1] <= top) & (high[:, 1] >= bottom)
    return meets


def _halved(shapes: Sequence[pymunk.Shape], place_um: Floats, low: int, high: int) -> Iterator[Touch]:
    """Touches between two samples, in order: the halves are looked at where the band round the chord meets a body."""
    first, last = place_um[low].tolist(), place_um[high].tolist()
    band = _bulge_um(place_um[low : high + 1]) + _GRACE_UM if high - low > 1 else 0.0
    hits = [hit for shape in shapes if (hit := shape.segment_query(first, last, band)) is not None]
    if not hits:
        return
    if high - low == 1:
        yield Touch(high, min(hit.alpha for hit in hits))
        return
    met = [hit.shape for hit in hits if hit.shape is not None]
    middle = (low + high) // 2
    yield from _halved(met, place_um, low, middle)
    yield from _halved(met, place_um, middle, high)


def _bulge_um(place_um: Floats) -> float:
    """How far places (n, 2) lie from the chord of the first and the last, at most."""
    chord, to = place_um[-1] - place_um[0], place_um - place_um[0]
    square = max(float(chord @ chord), float(np.finfo(np.float64).tiny))
    off = to - np.clip(to @ chord / square, 0.0, 1.0)[:, None] * chord
    return float(np.hypot(off[:, 0], off[:, 1]).max())
