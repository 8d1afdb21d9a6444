"""The region that the wire sweeps on its way: a union of bands and stars, one to each stretch of the way.

The kerf is the union of discs about all places of the wire. Of a stretch along a line or an arc it is a band (`bands`).
Else take a stretch no longer than a disc's diameter: every disc on it holds the middle of the stretch. So their union
is star-shaped about the middle: each ray from there meets the border once, where it leaves the farthest disc. Both are
known in closed form. No buffer of a line is used: GEOS simplifies the line by 1 % of the distance first, 1 µm here
(`BufferInputLineSimplifier`).

The kerf of a run: the region that the wire removed, and how wide it is beside each block.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.shape.contours import Contour
from parser.shape.passes import find_passes, leads_of
from parser.toolpath import Toolpath
from sim.cut.kerf.bands import are_even, bands, bends_of, longest_bands_um
from sim.cut.kerf.edges import Edges, Range, edges_of, ranges
from sim.cut.kerf.stars import stars
from sim.cut.kerf.ways import WireWay, wire_ways
from sim.cut.regions import Region, Regions, cut_by_blocks, union_all, unions
from sim.table.trace import Trace

_STRETCH = 1.9  # offsets, at most; at 2 the discs at its ends would only just reach its middle
_BAND = 32.0  # offsets, at most: what lies round a box is cut out of no longer ones
_TURN_RAD = 0.5  # of a stretch, at most
_LEVEL = 3  # eight boxes together make one of the next level


Box = tuple[float, float, float, float]
"""Lowest x and y, highest x and y, µm."""


class Swept(NamedTuple):
    """The region that the wire sweeps on its way through one contour.

    Attributes
    ----------
    way
        The wire's way.
    border
        (s + 1,) int64, first place of each stretch, and one past the last place of the last one.
    is_band
        (s,) bool, whether it is swept as a band; else as a star.
    bend
        (s, 3) float64, centre and radius of the arc that it follows, the radius below 0 where it is clockwise; zeros
        along a line.
    chord_um, off_um
        (s, 2, 2) and (s,) float64, from the first place of each to its last, and how far places lie off that at most.
    offset_um
        (s,) half the width that the wire cuts on each.
    region_um
        The whole, empty where the wire did not come. Regions of stretches are made again where they are looked at.
    boxes
        (…, 4) float64, lowest x and y, highest x and y of the stretches' regions, then of eight of these together, and
        so on.
    """

    way: WireWay
    border: Ints
    is_band: Bools
    bend: Floats
    chord_um: Floats
    off_um: Floats
    offset_um: Floats
    region_um: Region
    boxes: tuple[Floats, ...]

    def up_to(self, stretch: int, at: int, since: int = 0, wider_um: float = 0.0) -> Region:
        """What is swept on a stretch from its place `since`, or its first one, to `at`: both are indices on the way.

        `wider_um` is added to the offset.
        """
        begin, place_um = max(since, int(self.border[stretch])), self.way.place_um
        bounds, own_um = np.array([[begin, at + 1]]), float(self.offset_um[stretch])
        offset_um = own_um + wider_um
        if not self.is_band[stretch]:
            whole = self.border[None, stretch : stretch + 2]
            made = stars(place_um, bounds, middles(self.way, whole), offset_um)
        elif np.hypot(*(place_um[at] - place_um[begin])) <= own_um:  # too short to tell where it leads
            made = stars(place_um, bounds, place_um[bounds[:, 0]], offset_um)
        else:
            made = bands(place_um, bounds, self.bend[None, stretch], offset_um)
        region: Region = made[0]
        return region

    def of_stretches(self, at: Ints) -> Regions:
        """Regions (k,) of some stretches."""
        bounds = np.stack([self.border[at], self.border[at + 1]], axis=1)
        return _regions(self.way, bounds, self.is_band[at], self.bend[at], self.offset_um[at])

    def stretches_near(self, box: Box) -> Ints:
        """Indices (k,) of the stretches whose regions come near a box, in order."""
        at = np.arange(len(self.boxes[-1]))
        for level in range(len(self.boxes) - 1, -1, -1):
            low_x, low_y, high_x, high_y = self.boxes[level][at].T
            at = at[(low_x <= box[2]) & (high_x >= box[0]) & (low_y <= box[3]) & (high_y >= box[1])]
            if level:
                within = (at[:, None] << _LEVEL) + np.arange(1 << _LEVEL)
                at = within[within < len(self.boxes[level - 1])]
        return at

    def places_near(self, box: Box) -> Ints:
        """Indices of the places on the way, in order, on stretches whose regions come near a box.

        Every place is among them that lies within the box, or an offset from it.
        """
        return self.places_of(self.stretches_near(box))

    def places_of(self, stretches: Ints) -> Ints:
        """Indices of the places on the way, in order, of stretches (k,)."""
        first, number = self.border[stretches], self.border[stretches + 1] - self.border[stretches]
        before = np.cumsum(number) - number
        places: Ints = np.arange(int(number.sum())) + np.repeat(first - before, number)
        return places


def swept_along(curves: Curves, way: WireWay, reach_um: Floats) -> Swept:
    """The region that a wire sweeps on its way along the rows (n,) of some curves, by its reach (n,) in each."""
    bends = bends_of(curves)
    first, is_band = _stretches(way, _longest_um(curves, reach_um), bends, reach_um)
    border, bend, offset_um = np.append(first, len(way.row)), bends[way.row[first]], reach_um[way.row[first]]
    regions = _regions(way, np.stack([first, border[1:]], axis=1), is_band, bend, offset_um)
    boxes = _boxes(np.asarray(shapely.bounds(regions)).reshape(-1, 4))
    return Swept(way, border, is_band, bend, *_chords(way.place_um, border), offset_um, _joined(regions), boxes)


def _chords(place_um: Floats, border: Ints) -> tuple[Floats, Floats]:
    """Chords (s, 2, 2) of stretches, from first to last place, and how far places lie off them at most (s,)."""
    number = np.diff(border)
    chord = place_um[np.stack([border[:-1], border[1:] - 1], axis=1)]
    if not len(number):
        return chord, np.empty(0)
    own, by = np.repeat(np.arange(len(number)), number), chord[:, 1] - chord[:, 0]
    square = np.maximum((by**2).sum(axis=1), np.finfo(np.float64).tiny)
    out = place_um - chord[own, 0]
    share = np.clip((out * by[own]).sum(axis=1) / square[own], 0.0, 1.0)
    off = out - share[:, None] * by[own]
    return chord, np.maximum.reduceat(np.hypot(off[:, 0], off[:, 1]), border[:-1])


def _regions(way: WireWay, bounds: Ints, is_band: Bools, bend: Floats, offset_um: Floats) -> Regions:
    """Regions (s,) of stretches, by their `bounds` (s, 2), with an offset (s,) each."""
    regions = np.empty(len(bounds), dtype=np.object_)
    for own_um in np.unique(offset_um).tolist():
        band, star = (np.flatnonzero((offset_um == own_um) & these) for these in (is_band, ~is_band))
        regions[band] = bands(way.place_um, bounds[band], bend[band], own_um)
        regions[star] = stars(way.place_um, bounds[star], middles(way, bounds[star]), own_um)
    return regions


def _longest_um(curves: Curves, reach_um: Floats) -> Floats:
    """Longest stretch allowed in each row (n,), µm; on tight arcs it is shorter, so that no stretch turns far."""
    shorter: Floats = np.fmin(_STRETCH * reach_um, _TURN_RAD * curves.radius_um)
    return shorter


def _stretches(way: WireWay, longest_um: Floats, bends: Floats, reach_um: Floats) -> tuple[Ints, Bools]:
    """Indices (s,) of the first place of each stretch, and whether it is a band. None runs on into the next block.

    The rays of a star miss the notch between two discs. Notches are sharp at corners only, and there a new star begins.
    """
    if not len(way.row):
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.bool_)
    changes = np.diff(way.row, prepend=-1) != 0
    along = way.along_um - way.along_um[changes][np.cumsum(changes) - 1]
    longest_band = longest_bands_um(bends, _BAND * reach_um, reach_um)
    is_long = _starts(changes, along, np.maximum(longest_band, longest_um)[way.row])
    long = np.flatnonzero(is_long)
    past, row = np.append(long[1:], len(way.row)), way.row[long]
    length = way.along_um[past - 1] - way.along_um[long]
    may_be = (length > longest_um[row]) & (longest_band[row] > 0.0)
    is_even = may_be & are_even(way.place_um, long, bends[row])
    in_band = np.repeat(is_even, past - long)
    is_first = np.where(in_band, is_long, is_long | _starts(changes, along, longest_um[way.row]))
    first = np.flatnonzero(is_first)
    return first, in_band[first]


def _starts(changes: Bools, along_um: Floats, longest_um: Floats) -> Bools:
    """Where stretches of some length begin (m,), along the way through each block."""
    number = np.floor(along_um / longest_um)
    starts: Bools = changes | (np.diff(number, prepend=-1.0) != 0.0)
    return starts


def middles(way: WireWay, bounds: Ints) -> Floats:
    """Places (s, 2) half way along each stretch, between its `bounds` (s, 2)."""
    half = 0.5 * (way.along_um[bounds[:, 0]] + way.along_um[bounds[:, 1] - 1])
    middle: Floats = way.place_um[np.searchsorted(way.along_um, half)]
    return middle


def _joined(regions: Regions) -> Region:
    """The union of regions, two by two: those that follow each other overlap."""
    while len(regions) > 1:
        pairs = unions(regions[:-1:2], regions[1::2])
        regions = np.append(pairs, regions[-1:]) if len(regions) % 2 else pairs
    whole: Region = regions[0] if len(regions) else shapely.Polygon()
    return whole


def _boxes(boxes: Floats) -> tuple[Floats, ...]:
    """Boxes (s, 4), and those of eight together, level by level up to a few."""
    levels = [boxes]
    while len(levels[-1]) > 1 << _LEVEL:
        first = np.arange(0, len(levels[-1]), 1 << _LEVEL)
        low, high = levels[-1][:, :2], levels[-1][:, 2:]
        together = np.minimum.reduceat(low, first), np.maximum.reduceat(high, first)
        levels.append(np.concatenate(together, axis=1))
    return tuple(levels)


@dataclass(frozen=True, eq=False)
class Kerf:
    """What the wire removed, c contours and n blocks.

    Attributes
    ----------
    toolpath
        The path that was run.
    reach_um
        (n,) half the width that the wire cuts in each block: its radius plus the spark gap there.
    usual_um
        (n,) the same by the spark gap of the pass alone, as sparks at the usual feed leave it: nominal sizes go by it.
    swept
        What the wire swept on each contour, with its polygon `region_um`.
    leads
        (n,) blocks that cut along no edge: ways to a pass and away from it.
    pass_edge
        (n,) number of the edge that each block's pass runs over, from 0; −1 of leads and jumps.
    region_um
        All of it: a shapely polygon or multipolygon.
    """

    toolpath: Toolpath
    reach_um: Floats
    usual_um: Floats
    swept: tuple[Swept, ...]
    leads: Bools
    pass_edge: Ints
    region_um: Region

    @property
    def offset_um(self) -> float:
        """Half the greatest width that the wire cuts in any block."""
        return float(self.reach_um.max())

    @property
    def area_mm2(self) -> float:
        """Area of all of it."""
        return self.region_um.area * 1e-6

    @cached_property
    def edges(self) -> Edges:
        """Both edges at stations along the blocks; who asks for pieces alone does without them."""
        ways = tuple(each.way for each in self.swept)
        return edges_of(self.toolpath, ~self.toolpath.is_jump, ways, self.reach_um)

    @cached_property
    def left_reach(self) -> Range:
        """How far the kerf reaches to the left of the ideal path, by block."""
        return ranges(self.edges, self.edges.left_um, len(self.toolpath))

    @cached_property
    def right_reach(self) -> Range:
        """How far it reaches to the right, by block."""
        return ranges(self.edges, self.edges.right_um, len(self.toolpath))

    @cached_property
    def width(self) -> Range:
        """How far it reaches to both sides together, by block."""
        return ranges(self.edges, self.edges.left_um + self.edges.right_um, len(self.toolpath))


def kerf_of(
    toolpath: Toolpath, trace: Trace, contours: Sequence[Contour], reach_um: Floats, usual_um: Floats | None = None
) -> Kerf:
    """Kerf of a run by where the wire really was; in each block (n,) it reaches above 0 to all sides of it.

    `usual_um` (n,) is what it reaches at the usual feed, where that is another.

    RegionError with the blocks of a contour whose kerf could not be worked out.
    """
    ways = wire_ways(trace, contours, float(reach_um.min()))
    swept = tuple(_swept(toolpath, contour, way, reach_um) for contour, way in zip(contours, ways, strict=True))
    passes = find_passes(toolpath)
    edge_of = np.array([*(pass_.edge for pass_ in passes.passes), -1], dtype=np.int64)
    return Kerf(
        toolpath=toolpath,
        reach_um=reach_um,
        usual_um=reach_um if usual_um is None else usual_um,
        swept=swept,
        leads=leads_of(passes, toolpath),
        pass_edge=edge_of[passes.of_row],
        region_um=union_all(each.region_um for each in swept),
    )


def _swept(toolpath: Toolpath, contour: Contour, way: WireWay, reach_um: Floats) -> Swept:
    with cut_by_blocks(contour.first, contour.last):
        return swept_along(toolpath, way, reach_um)
