"""When pieces come free: as the whole kerf says, put together anew for every place that is looked at."""

from typing import NamedTuple

import numpy as np
import pytest
import shapely
from crossing_ways import flower, lattice, loops, walk
from traced import STEEL, kerf_along

from parser.toolpath import Toolpath
from sim.cut.kerf.swept import Kerf
from sim.cut.pieces.pieces import Piece, pieces_of, stock_of
from sim.cut.regions import Region, difference, union_all

GRAZED = 2
"""Places by which a moment may be off: where a kerf grazes another one, 0.05 µm of width are as much way; else 1."""
GRAZED_BY_WALK = 8
"""The same on walks at random, whose kerfs meet at flatter angles than those of squares."""


class Place(NamedTuple):
    """A place of the wire: the index of its contour, and its own on the way through that."""

    contour: int
    at: int


class Sweeping:
    """All of a kerf so far, up to any place, and the stock that it leaves."""

    def __init__(self, kerf: Kerf) -> None:
        self.swept, self.stock = kerf.swept, stock_of(kerf, None)
        self.stretches = [(c, s) for c, swept in enumerate(kerf.swept) for s in range(len(swept.is_band))]
        self.regions = [kerf.swept[c].of_stretches(np.array([s]))[0] for c, s in self.stretches]

    def round_it(self, kerfs: list[Region], point: shapely.Point) -> Region:
        """What the kerfs leave in one piece with a place."""
        left = shapely.get_parts(difference(self.stock, union_all(kerfs)))
        return left[shapely.contains(left, point)][0]

    def parts(self, kerfs: list[Region], piece: shapely.Point, frame: shapely.Point) -> bool:
        return not self.round_it(kerfs, piece).contains(frame)

    def up_to(self, place: Place) -> list[Region]:
        """The kerf so far: whole stretches, and the last one up to the place."""
        swept = self.swept[place.contour]
        own = int(np.searchsorted(swept.border, place.at, side="right")) - 1
        number = self.stretches.index((place.contour, own))
        return [*self.regions[:number], swept.up_to(own, place.at)]

    def parted_at(self, piece: shapely.Point, frame: shapely.Point) -> Place:
        """The first place at which the kerf parts a piece from the frame, by halving."""
        low, high = 0, len(self.regions)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if self.parts(self.regions[:middle], piece, frame) else (middle, high)
        (contour, own), before = self.stretches[low], [union_all(self.regions[:low])] if low else []
        swept = self.swept[contour]
        first, last = int(swept.border[own]) - 1, int(swept.border[own + 1]) - 1
        while last - first > 1:
            at = (first + last) // 2
            first, last = (first, at) if self.parts([*before, swept.up_to(own, at)], piece, frame) else (at, last)
        return Place(contour, last)


def place_of(kerf: Kerf, piece: Piece) -> Place:
    contour = piece.freed.contour - 1
    return Place(contour, int(np.searchsorted(kerf.swept[contour].way.t_s, piece.freed.t_s)))


def assert_free_as_the_whole_kerf_says(path: Toolpath, most: int = GRAZED) -> int:
    """A piece that others part from the frame with more in a body comes free when it comes off that; gives how many."""
    kerf = kerf_along(path)
    sweeping, pieces = Sweeping(kerf), pieces_of(kerf, None, STEEL)
    frame, grazed, loose = shapely.Point(*np.array(sweeping.stock.bounds[:2]) + 1.0), 0, 0
    points = [piece.outline_um.representative_point() for piece in pieces.freed]
    for piece, point in zip(pieces.freed, points, strict=True):
        moment, parted = place_of(kerf, piece), sweeping.parted_at(point, frame)
        if parted.contour == moment.contour and abs(moment.at - parted.at) <= most:
            grazed += abs(moment.at - parted.at) > 1
            continue
        loose += 1
        assert moment > parted
        before, after = (
            sweeping.round_it(sweeping.up_to(moment._replace(at=moment.at + by)), point) for by in (-most, most)
        )
        assert before.area - after.area > 1e4, "it loses more than the wire cuts on those places"
        assert shapely.contains(before, points).sum() > shapely.contains(after, points).sum(), "it came off others"
    assert grazed <= 2 + len(points) // 10
    return loose


@pytest.mark.alike(2)
@pytest.mark.parametrize("path", [lattice(3), flower(), lattice(6)], ids=["lattice", "flower", "larger"])
def test_pieces_of_a_way_that_crosses_itself_come_free_as_the_whole_kerf_says(path: Toolpath) -> None:
    assert assert_free_as_the_whole_kerf_says(path) == 0


@pytest.mark.alike(3)
@pytest.mark.parametrize("seed", range(40))
def test_pieces_of_squares_that_cross_come_free_as_the_whole_kerf_says(seed: int) -> None:
    assert_free_as_the_whole_kerf_says(loops(seed))


@pytest.mark.alike(2)
@pytest.mark.parametrize("seed", range(40))
def test_pieces_of_walks_come_free_as_the_whole_kerf_says(seed: int) -> None:
    assert_free_as_the_whole_kerf_says(walk(seed), GRAZED_BY_WALK)
