"""What is looked at near a piece alone comes out as with all that was cut: which places cut it, and what it touches."""

import math

import numpy as np
import pytest
import shapely
from crossing_ways import flower, lattice
from paths import Pen
from traced import STEEL, F, kerf_along, pieces_along, trace_of

from sim.cut import play, sizes
from sim.cut.kerf.edges import nominal_region
from sim.cut.kerf.stars import SIMPLER_UM, rays, stars
from sim.cut.kerf.ways import rows_that_made
from sim.cut.pieces import cut_on, kept_edges
from sim.cut.pieces.kept_edges import lie_on
from sim.cut.pieces.pieces import pieces_of
from sim.cut.play import plays_of, shifted_until, sides_of
from sim.cut.sizes import sizes_of
from sim.cut.walls import room_of, walls_of


@pytest.mark.parametrize("path", [lattice(4), flower()], ids=["lattice", "flower"])
def test_pieces_touch_the_walls_near_them_as_among_all_walls(path, monkeypatch):
    pieces = pieces_along(path)
    monkeypatch.setattr(play, "_NEAR_UM", 300.0)
    near = plays_of(pieces, 90.0)
    monkeypatch.setattr(play, "_NEAR_UM", 1e6)
    for one, other in zip(near, plays_of(pieces, 90.0), strict=True):
        within = one.exact_to_um + other.exact_to_um
        shifts = [[shift.by_um for shift in play.shifts] for play in (one, other)]
        assert np.isfinite(shifts[0]).any()
        # Directions along a wall graze it or not by less than the outlines are exact to.
        grazing = sum(abs(a - b) > 10.0 * within for a, b in zip(*shifts, strict=True) if a != b)
        assert grazing <= 1
        assert one.pinch.width_um == pytest.approx(other.pinch.width_um, abs=within)


def test_walls_ahead_are_those_that_a_piece_meets_on_its_way_and_no_others_are_left_where_it_says_so():
    """Also where the wire stands far from the piece: rows come free at their one end, and pieces lie at the other."""
    pieces = pieces_along(lattice(4))
    walls, toward_deg, said = walls_of(pieces), np.linspace(0.0, 360.0, 16, endpoint=False), set()
    for piece in pieces.freed:
        outline = shapely.Polygon(piece.outline_um.exterior)
        room, edge = room_of(walls, outline, piece.freed.wire_um, piece.freed.t_s), sides_of(outline.exterior)
        every = shifted_until(edge, sides_of(room.within(1e9)[0]), np.radians(toward_deg))
        for far_um in (300.0, 3000.0, 12_000.0):
            lines, is_all = room.ahead(toward_deg, far_um)
            said.add(is_all)
            ahead = shifted_until(edge, sides_of(lines), np.radians(toward_deg))
            for one, other in zip(ahead, every, strict=True):
                assert one.by == other.by or (not is_all and min(one.by, other.by) > far_um)
    assert said == {False, True}


@pytest.mark.alike(1)
@pytest.mark.parametrize("path", [lattice(4), flower()], ids=["lattice", "flower"])
def test_places_near_a_piece_are_found_by_the_chords_of_their_stretches(path):
    (swept,) = kerf_along(path).swept
    rng = np.random.default_rng(6)
    for x, y in rng.uniform(0.0, 4000.0, (12, 2)):
        piece = shapely.Point(x, y).buffer(rng.uniform(50.0, 600.0))
        shapely.prepare(piece)
        inside = cut_on._inside(piece, cut_on.Rest(swept, 100), F)
        near = shapely.distance(piece, shapely.points(swept.way.place_um)) <= (1.0 - cut_on._SPARED) * F
        assert inside.tolist() == [at for at in np.flatnonzero(near).tolist() if at >= 100]


@pytest.mark.parametrize("path", [lattice(4), flower()], ids=["lattice", "flower"])
def test_what_is_kept_has_the_sizes_near_it_that_it_has_in_all_of_the_stock(path, monkeypatch):
    kerf = kerf_along(path, trace_of(path, stray=lambda place, row: place * 1.001))
    pieces = pieces_of(kerf, None, STEEL)
    near = sizes_of(path, kerf, pieces, None, np.zeros((len(path), 2)))
    monkeypatch.setattr(sizes, "_BESIDE", 1e6)
    whole = sizes_of(path, kerf, pieces, None, np.zeros((len(path), 2)))
    assert len(near.boxes) > 3
    assert near.radii == whole.radii
    assert near.distances == whole.distances
    for one, other in zip(near.boxes, whole.boxes, strict=True):
        assert one.nominal_um == pytest.approx(other.nominal_um, abs=1e-6)


def test_a_part_that_the_ideal_path_leaves_hanging_is_asked_for_in_all_of_the_stock():
    path = Pen(-1000, 0).to(0, 0).to(2000, 0).to(2000, 2000).to(0, 2000).to(0, 300).path()
    kerf = kerf_along(path, trace_of(path, stray=lambda place, row: place - (0.0, 150.0) * (row == 4)[:, None]))
    (box,) = sizes_of(path, kerf, pieces_of(kerf, None, STEEL), None, np.zeros((len(path), 2))).boxes
    assert max(box.cut_um) < 1820.0
    assert min(box.nominal_um) > 2000.0


def test_a_slight_turn_leaves_no_notch_in_the_nominal_kerf():
    for turn in (0.0, 1e-12, 1e-6, -1e-6, 1e-3, 0.05, -0.3):
        path = Pen(0, 0).to(500, 0).to(500 + 500 * math.cos(turn), 500 * math.sin(turn)).path()
        kerf = nominal_region(path, ~path.is_jump, np.full(len(path), F))
        outer = 2.0 * F * 1000.0 + math.pi * F * F + abs(turn) / 2.0 * F * F - math.tan(abs(turn) / 2.0) * F * F
        assert kerf.is_valid
        assert kerf.area == pytest.approx(outer, abs=5.0)
        assert kerf.length == pytest.approx(2000.0 + 2.0 * math.pi * F, abs=8.0)


def test_a_star_reaches_to_the_farthest_disc_along_each_ray():
    rng = np.random.default_rng(3)
    place = np.cumsum(rng.uniform(0.0, 3.0, (60, 2)), axis=0) * 0.8
    middle, toward = place[30:31], rays(F)
    out = place - middle
    along, across = out @ toward.T, out @ np.stack([-toward[:, 1], toward[:, 0]])
    reach = (along + np.sqrt(F**2 - across**2)).max(axis=0)
    (star,) = stars(place, np.array([[0, 60]]), middle, F)
    border = np.array(star.exterior.coords)[:-1]
    assert len(border) <= len(toward)
    off = np.array([star.exterior.distance(point) for point in shapely.points(middle + reach[:, None] * toward)])
    assert off.max() <= SIMPLER_UM * (1.0 + 1e-9)


def test_of_places_equally_near_the_last_is_told_as_by_all_distances():
    path = flower()
    (swept,) = kerf_along(path).swept
    way, rng = swept.way, np.random.default_rng(4)
    place = way.place_um[rng.integers(0, len(way.row), 400)] + rng.uniform(-1.2 * F, 1.2 * F, (400, 2))
    off = np.hypot(*(place[:, None] - way.place_um).transpose(2, 0, 1))
    least = off.min(axis=1)
    last = np.array([np.flatnonzero(one <= near + 0.04)[-1] for one, near in zip(off, least, strict=True)])
    expected = np.where(least < F + 0.2, way.row[last], -1)
    assert rows_that_made([way], place, F).tolist() == expected.tolist()


def test_places_lie_on_rings_of_long_sides_as_by_all_distances():
    rng = np.random.default_rng(5)
    rings = [shapely.box(-size, -size, size, size).exterior for size in range(3000, 60000, 3000)]
    rings += [shapely.Point(0, 90000).buffer(20000, quad_segs=400).exterior]
    share = rng.random(4000)
    on = np.concatenate([shapely.get_coordinates(ring.interpolate(share[:200], normalized=True)) for ring in rings])
    place = np.concatenate([on + rng.normal(0.0, 0.15, on.shape), rng.uniform(-6e4, 6e4, (2000, 2))])
    off = np.min([shapely.distance(ring, shapely.points(place)) for ring in rings], axis=0)
    sure = np.abs(off - kept_edges._ON_UM) > 1e-6
    assert (lie_on(rings, place) == (off <= kept_edges._ON_UM))[sure].all()
