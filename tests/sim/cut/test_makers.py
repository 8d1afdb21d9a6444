"""Each place of an edge belongs to the block whose wire made it, whatever passes ran beside it."""

import math

import numpy as np
import pytest
import shapely
from paths import Pen
from traced import STEEL, F, kerf_along, square

from parser.toolpath import Point, Toolpath
from sim.cut.kerf.swept import Kerf
from sim.cut.kerf.ways import NOBODY, last_beside, rows_that_made
from sim.cut.pieces.pieces import pieces_of


def along(ring: shapely.LinearRing, spacing: float = 7.0) -> np.ndarray:
    return shapely.get_coordinates(shapely.line_interpolate_point(ring, np.arange(0.0, ring.length, spacing)))


def made(kerf: Kerf, place_um: np.ndarray) -> np.ndarray:
    return rows_that_made([one.way for one in kerf.swept], place_um, kerf.offset_um)


def off_rows(path: Toolpath, place_um: np.ndarray) -> np.ndarray:
    """Distances (m, n) of places from each of n rows of lines, plainly: by shapely."""
    lines = shapely.linestrings(np.stack([path.start_um, path.end_um], axis=1))
    return shapely.distance(shapely.points(place_um)[:, None], lines)


def test_the_edge_of_a_roughed_and_trimmed_hole_is_the_trims():
    pen = Pen().to(1000, 0).arc(0, 0, 2 * math.pi).to(1040, 0).arc(0, 0, 2 * math.pi).to(0, 0)
    kerf = kerf_along(pen.path())
    (opening,) = pieces_of(kerf, None, STEEL).frame.openings_um
    assert set(made(kerf, along(opening.exterior)).tolist()) == {3}


def test_where_a_trim_is_missing_the_edge_is_the_roughs():
    pen = Pen().to(1000, 0).arc(0, 0, 2 * math.pi).to(1040, 0).arc(0, 0, math.pi).to(0, 0)
    kerf = kerf_along(pen.path())
    (opening,) = pieces_of(kerf, None, STEEL).frame.openings_um
    place = along(opening.exterior)
    rows = made(kerf, place)
    assert set(rows[place[:, 1] > F].tolist()) == {3}
    assert set(rows[place[:, 1] < -F].tolist()) == {1}


def test_of_two_passes_on_one_way_the_last_is_told():
    pen = Pen().to(1000, 0).arc(0, 0, 2 * math.pi).arc(0, 0, -2 * math.pi).to(0, 0)
    kerf = kerf_along(pen.path())
    (opening,) = pieces_of(kerf, None, STEEL).frame.openings_um
    place = along(opening.exterior)
    # Beside the start, the ends of both turns lie as near.
    assert set(made(kerf, place[np.abs(place[:, 1]) > 10.0]).tolist()) == {2}


def test_the_edge_of_the_work_is_nobodys():
    work = (Point(0, 0), Point(10_000, 0), Point(10_000, 5000), Point(0, 5000))
    kerf = kerf_along(Pen(3000, -500).to(3000, 5500).path())
    (part,) = pieces_of(kerf, work, STEEL).freed
    place = along(part.outline_um.exterior)
    rows = made(kerf, place)
    assert set(rows[place[:, 0] > 2899.99].tolist()) == {0}
    assert set(rows[place[:, 0] < 2899.5].tolist()) == {NOBODY}


@pytest.mark.parametrize("sagging", [0.0, 30.0])
def test_of_any_edge_the_nearest_row_tells(sagging):
    pen = square(Pen(-1000, 0).to(0, 0), 2000).to(30, 20)
    path = pen.to(1970, 20 + sagging).to(1970, 1970).to(20, 1970 - sagging).to(20, 20).path()
    kerf = kerf_along(path)
    (part,) = pieces_of(kerf, None, STEEL).freed
    place = along(part.outline_um.exterior)
    off = off_rows(path, place)
    by_that_row = off[np.arange(len(place)), made(kerf, place)]
    assert by_that_row == pytest.approx(off.min(axis=1), abs=0.1)


def test_nothing_cut_made_nothing():
    assert rows_that_made([], np.zeros((2, 2)), F).tolist() == [NOBODY, NOBODY]
    assert rows_that_made([], np.zeros((0, 2)), F).tolist() == []


def test_the_last_place_beside_one_is_that_of_all_pairs() -> None:
    rng = np.random.default_rng(23)
    wire = np.concatenate([np.cumsum(rng.normal(0.0, 3.0, (400, 2)), axis=0)] * 2)
    place = wire[:200] + rng.normal(0.0, 60.0, (200, 2))
    apart = np.hypot(*(place[:, None] - wire).T).T
    beside = apart <= apart.min(axis=1, keepdims=True) + 0.5
    last = np.where(apart.min(axis=1) < 40.0, len(wire) - 1 - np.argmax(beside[:, ::-1], axis=1), NOBODY)
    assert 20 < (last == NOBODY).sum() < 180
    assert last_beside(wire, place, 40.0, 0.5).tolist() == last.tolist()
