"""Unions and differences come out where GEOS gives up at full precision, and errors name the blocks."""

import numpy as np
import pytest
import shapely
from paths import Pen
from shapely.errors import GEOSException
from traced import F, kerf_along, square

from sim.cut import regions
from sim.cut.regions import RegionError, cut_by_blocks, difference, union, union_all, unions

# Outlines that cross themselves: at full precision GEOS answers with a TopologyException.
ONE = shapely.Polygon([(4, 5), (7, 9), (0, 1), (8, 9), (2, 3), (8, 4), (2, 8), (2, 4), (4, 5)])
OTHER = shapely.Polygon([(6, 5), (0, 0), (8, 7), (8, 5), (8, 3), (4, 7), (1, 3), (1, 4), (6, 5)])
SOUND = shapely.box(20, 20, 30, 30)


def whole(region: shapely.Polygon) -> shapely.Geometry:
    return shapely.make_valid(region, method="structure", keep_collapsed=False)


def test_geos_gives_up_on_these():
    with pytest.raises(GEOSException):
        shapely.union(ONE, OTHER)
    with pytest.raises(GEOSException):
        shapely.difference(ONE, OTHER)


def test_what_geos_gives_up_on_comes_out_on_a_grid():
    one, other = whole(ONE), whole(OTHER)
    both = shapely.union(one, other)
    for made, expected in (
        (union(ONE, OTHER), both),
        (union_all([ONE, OTHER]), both),
        (difference(ONE, OTHER), shapely.difference(one, other)),
    ):
        assert made.is_valid
        assert shapely.symmetric_difference(made, expected).area < 1e-3 * expected.length


def test_of_many_pairs_the_sound_ones_are_exact():
    made = unions(np.array([ONE, SOUND]), np.array([OTHER, shapely.box(25, 20, 40, 30)]))
    assert made.shape == (2,)
    assert made[0].area == pytest.approx(union(ONE, OTHER).area, abs=1e-9)
    assert made[1].equals(shapely.box(20, 20, 40, 30))


def test_a_kerf_made_on_the_grid_is_the_same(monkeypatch):
    path = square(Pen(-1000, 0).to(0, 0), 2000).path()
    exact = kerf_along(path).region_um
    true_union = shapely.union

    def only_on_a_grid(*geometries, grid_size=None):
        if grid_size is None:
            raise GEOSException("TopologyException: side location conflict")
        return true_union(*geometries, grid_size=grid_size)

    monkeypatch.setattr(regions.shapely, "union", only_on_a_grid)
    on_a_grid = kerf_along(path).region_um
    assert shapely.symmetric_difference(exact, on_a_grid).area < 2e-3 * exact.length


def test_an_error_names_the_blocks_of_the_innermost_question(monkeypatch):
    def never(*geometries, grid_size=None):
        raise GEOSException("TopologyException")

    monkeypatch.setattr(regions.shapely, "union", never)
    path = Pen().to(1000, 0).to(1000, 500).jump(5000, 0).to(6000, 0).to(6000, 2000).to(5000, 0).path()
    with pytest.raises(RegionError) as told, cut_by_blocks(1, 6):
        kerf_along(path, offset_um=F)
    assert (told.value.first, told.value.last) == (1, 2)
