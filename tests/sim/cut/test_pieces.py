"""The pieces that a kerf leaves: what comes free where and when, of what size, and what frees nothing."""

import math
import random
from collections.abc import Iterable

import numpy as np
import pytest
import shapely
from paths import Pen
from sound_cam import Line
from sound_shapes import SHAPES, placed
from traced import STEEL, F, kerf_along, pieces_along, square, trace_of

from parser.toolpath import Point, Toolpath
from sim.cut.pieces import cells
from sim.cut.pieces.pieces import pieces_of
from sim.cut.regions import Region, union_all


def punch(side: float = 2000.0) -> Toolpath:
    """A square, led in from the left of its lower left corner, and out the same way."""
    pen = square(Pen(-1000, 0).to(0, 0), side)
    return pen.to(-1000, 0).path()


def die(side: float = 2000.0) -> Toolpath:
    """A square around the start point, led in to the middle of its right side, where it ends, and out again."""
    half = side / 2
    pen = Pen().to(half, 0).to(half, half).to(-half, half).to(-half, -half).to(half, -half).to(half, 0)
    return pen.to(0, 0).path()


def test_a_punch_frees_a_part_smaller_by_the_offset_all_round():
    (part,) = pieces_along(punch()).freed
    assert part.kind == "part"
    assert part.outline_um.bounds == pytest.approx((F, F, 2000 - F, 2000 - F), abs=0.05)
    assert part.area_mm2 == pytest.approx(1.8**2, abs=1e-4)
    assert part.center_um == pytest.approx((1000, 1000), abs=0.1)
    assert part.mass_g == pytest.approx(1.8**2 * 40 * 7.85e-3, abs=1e-4)


def test_a_die_frees_a_slug_and_leaves_an_opening_larger_by_the_offset_all_round():
    pieces = pieces_along(die())
    (slug,) = pieces.freed
    assert slug.kind == "slug"
    assert slug.area_mm2 == pytest.approx(1.8**2 - 0.9 * 0.2 - math.pi * 0.1**2 / 2, abs=1e-4)
    (opening,) = pieces.frame.openings_um
    assert opening.bounds == pytest.approx((-1100, -1100, 1100, 1100), abs=0.05)


def test_a_piece_comes_free_where_its_closing_kerf_first_meets_the_older_one():
    path = punch()
    (part,) = pieces_along(path).freed
    # Down the left side, the disc's front meets that of the lead-in two offsets above the corner.
    assert part.freed.contour == 1
    assert part.freed.block == 5
    assert part.freed.wire_um == pytest.approx((0.0, 2 * F), abs=3.0)
    samples = (1000 + 3 * 2000 + 2000 - 2 * F) / 5.0
    assert part.freed.t_s == pytest.approx(1e-3 * samples, abs=1.1e-3)
    assert part.bridge.place_um == pytest.approx((0.0, F), abs=3.0)
    assert part.bridge.left_um == pytest.approx(2000 - 2 * F, abs=3.0)
    assert part.bridge.closes_on_block in (1, 2)
    assert part.bridge.last_mm_block == 5
    assert part.bridge.last_mm_t_s == pytest.approx(part.freed.t_s - 1000 / 5 * 1e-3, abs=1.1e-3)


@pytest.mark.parametrize("path", [punch(), die(), Pen().to(700, 0).arc(0, 0, 2 * math.pi).to(0, 0).path()])
def test_the_kerf_just_before_the_moment_does_not_free_the_piece(path):
    kerf = kerf_along(path)
    pieces = pieces_of(kerf, None, STEEL)
    (piece,) = pieces.freed
    way = kerf.swept[0].way
    at = int(np.searchsorted(way.t_s, piece.freed.t_s))

    def encloses(past: int, radius: float) -> bool:
        places = np.concatenate([way.place_um[: past - 20 : 4], way.place_um[past - 20 : past]])
        discs = shapely.buffer(shapely.points(places), radius, quad_segs=24)
        return len(shapely.union_all(discs).interiors) > 0

    # Half a µm is what the plain discs may leave of the kerf between them; two places are some 5 µm.
    assert encloses(at + 3, F + 0.5)
    assert not encloses(at - 2, F - 0.5)


def test_a_lead_out_along_the_old_kerf_cuts_on_no_more_than_the_cusp():
    (part,) = pieces_along(punch()).freed
    assert part.cut_after_um <= 2 * F
    assert not part.early


def test_a_wire_that_goes_on_through_a_free_piece_comes_early():
    pen = square(Pen(-1000, 0).to(0, 0), 2000)
    (part,) = (piece for piece in pieces_along(pen.to(1500, 1500).path()).freed)
    assert part.early
    assert part.cut_after_um == pytest.approx(1500 * math.sqrt(2), abs=300)


def test_a_way_back_through_its_own_kerf_in_a_free_piece_does_not_count():
    pen = square(Pen(-1000, 0).to(0, 0), 2000)
    (once,) = pieces_along(pen.to(1000, 1000).path()).freed
    (there_and_back,) = pieces_along(pen.to(0, 0).to(-1000, 0).path()).freed
    assert there_and_back.cut_after_um == pytest.approx(once.cut_after_um, abs=F)
    assert there_and_back.early


def test_a_hole_that_is_cut_in_a_part_once_it_is_free_comes_late():
    pen = square(Pen(-1000, 0).to(0, 0), 3000).jump(1500, 1500).to(2000, 1500).arc(1500, 1500, 2 * math.pi)
    part, slug = pieces_along(pen.path()).freed
    assert (part.kind, part.early, slug.kind, slug.early) == ("part", True, "slug", False)
    assert part.cut_after_um == pytest.approx(500 + 2 * math.pi * 500, abs=2 * F)


def test_what_is_cut_of_a_piece_at_the_edge_of_the_work_is_not_early():
    work = (Point(0, 0), Point(10_000, 0), Point(10_000, 5000), Point(0, 5000))
    path = Pen(4000, -500).to(4000, 5500).jump(2000, 5500).to(2000, -500).path()
    assert [piece.early for piece in pieces_along(path, work).freed] == [False, False]


def test_a_slug_may_be_left_by_another_way_as_long_as_the_lead_in():
    def led_out(by: float) -> Toolpath:
        return Pen().to(2000, 0).arc(0, 0, 2 * math.pi).to(2000 - 0.8 * by, 0.6 * by).path()

    (slug, *_), (other, *_) = (pieces_along(led_out(by)).freed for by in (2000.0, 3000.0))
    assert (slug.kind, slug.early) == ("slug", False)
    assert slug.cut_after_um > 1500
    assert (other.kind, other.early) == ("slug", True)


def test_a_slug_whose_bridge_another_contour_cuts_is_a_slug():
    pen = Pen().to(1000, 0).to(1000, 1000).to(-1000, 1000).to(-1000, -1000).to(1000, -1000).to(1000, -600)
    (slug,) = pieces_along(pen.jump(300, -600).to(1000, -600).to(1000, 0).path()).freed
    assert (slug.kind, slug.freed.contour) == ("slug", 2)


def test_a_part_whose_bridge_another_contour_cuts_is_a_part():
    pen = Pen(-1000, 0).to(0, 0).to(2000, 0).to(2000, 2000).to(0, 2000).to(0, 600).jump(-700, 300)
    (part,) = pieces_along(pen.to(0, 300).to(0, 600).to(0, 0).path()).freed
    assert (part.kind, part.freed.contour) == ("part", 2)


def test_the_moment_is_before_what_is_cut_into_a_piece_later():
    pen = square(Pen(-1000, 0).to(0, 0), 2000)
    first, second = sorted(
        pieces_along(pen.to(2000, 2000).to(3000, 3000).path()).freed, key=lambda piece: piece.center_um.x
    )
    assert first.freed == second.freed
    assert first.freed.block == 5
    assert first.early


def rounds(count: int) -> Toolpath:
    """A punch of 2 mm that the wire goes round again and again."""
    pen = Pen(-1000, 0).to(0, 0)
    for _ in range(count):
        pen = square(pen, 2000.0)
    return pen.to(-1000, 0).path()


def kerfs_put_together(path: Toolpath, monkeypatch: pytest.MonkeyPatch) -> int:
    """How many kerfs are put together to find the one piece of a path, the same as that of one round."""
    counts = []

    def counted(regions: Iterable[Region]) -> Region:
        counts.append(len(tuple(regions)))
        return union_all(regions)

    with monkeypatch.context() as patched:
        patched.setattr(cells, "union_all", counted)
        (part,) = pieces_along(path).freed
    assert part.freed.block == 5
    assert part.outline_um.bounds == pytest.approx((F, F, 2000 - F, 2000 - F), abs=0.05)
    return sum(counts)


def test_rounds_on_the_same_way_cost_no_more_the_more_there_were(monkeypatch: pytest.MonkeyPatch) -> None:
    ten, twenty = (kerfs_put_together(rounds(count), monkeypatch) for count in (10, 20))
    assert twenty <= 2.5 * ten + 20  # with a union of all earlier rounds for each: four times as many


@pytest.mark.parametrize("more", [150.3, 151.0, 151.7, 160.0])
def test_the_piece_is_that_of_the_moment_also_at_the_end_of_a_stretch(more):
    # The kerf is worked out in stretches of 190 µm; 950 µm down the last side one of them ends.
    pen = square(Pen(-500, 0).to(0, 0), 1000 + more).to(30, 30)
    pieces = pieces_along(square(pen, 940 + more).path()).freed
    part = max(pieces, key=lambda piece: piece.area_mm2)
    assert part.cut_after_um == pytest.approx(4 * (940 + more), rel=0.1)


def test_a_hole_cut_first_is_a_slug_of_its_own_and_a_hole_in_the_part():
    pen = Pen(1000, 1000).to(1400, 1000).arc(1000, 1000, 2 * math.pi).to(1000, 1000).jump(-1000, 0).to(0, 0)
    pieces = pieces_along(square(pen, 2000).path())
    slug, part = pieces.freed
    assert (slug.kind, slug.freed.contour, part.kind, part.freed.contour) == ("slug", 1, "part", 2)
    assert part.area_mm2 == pytest.approx(1.8**2 - math.pi * 0.5**2, abs=2e-4)
    assert len(part.outline_um.interiors) == 1


def test_a_contour_that_a_table_with_lost_steps_leaves_open_frees_nothing():
    def lost(place, row):
        return place + np.where((row >= 3)[:, None], (0.0, 300.0), (0.0, 0.0))

    assert len(pieces_along(punch()).freed) == 1
    assert pieces_along(punch(), stray=lost).freed == ()


def test_a_contour_that_the_trace_does_not_come_to_the_end_of_frees_nothing():
    path = punch()
    assert pieces_of(kerf_along(path, trace_of(path).until(1.0)), None, STEEL).freed == ()


def test_a_parting_cut_frees_the_smaller_side_of_the_work():
    work = (Point(0, 0), Point(10_000, 0), Point(10_000, 5000), Point(0, 5000))
    pieces = pieces_along(Pen(3000, -500).to(3000, 5500).path(), work)
    (part,) = pieces.freed
    assert part.kind == "part"
    assert part.outline_um.bounds == pytest.approx((0, 0, 2900, 5000), abs=0.05)
    assert part.freed.wire_um == pytest.approx((3000, 5000 - F), abs=6)
    assert part.bridge.closes_on_block is None
    assert pieces.frame.area_mm2 == pytest.approx(6.9 * 5.0, abs=1e-3)
    assert pieces.frame.mass_g == pytest.approx(6.9 * 5.0 * 40 * 7.85e-3, abs=1e-3)


def test_two_cuts_free_a_corner_together():
    work = (Point(0, 0), Point(10_000, 0), Point(10_000, 5000), Point(0, 5000))
    path = Pen(3000, -500).to(3000, 2000).jump(-500, 2000).to(3000, 2000).path()
    (part,) = pieces_along(path, work).freed
    assert part.freed.contour == 2
    assert part.freed.block == 3
    assert part.bridge.closes_on_block == 1
    assert part.outline_um.bounds == pytest.approx((0, 0, 2900, 1900), abs=0.05)


def test_crumbs_are_counted_and_left_out():
    # Beside its lead-in the wire leaves by a way that encloses a strip of 12 by 40 µm between the kerfs.
    pen = square(Pen(-1000, 0).to(0, 0), 2000).to(-300, 212).to(-340, 212).to(-640, 0)
    pieces = pieces_along(pen.path())
    assert [piece.kind for piece in pieces.freed] == ["part"]
    assert pieces.crumbs == 1


def test_no_cut_leaves_no_pieces():
    pieces = pieces_along(Pen().jump(1000, 0).path())
    assert (pieces.freed, pieces.frame.openings_um, pieces.crumbs) == ((), (), 0)


def drawn(shape, start) -> Toolpath:
    """A lead-in from `start` to a contour, and the contour."""
    pen = Pen(*start).to(*shape.start)
    for move in shape.moves:
        if isinstance(move, Line):
            pen.to(*move.to)
        else:
            pen.arc_to(*move.to, *move.center, move.turn)
    return pen.path()


@pytest.mark.alike(4)
@pytest.mark.parametrize("family", SHAPES, ids=lambda family: family.__name__)
def test_pieces_of_any_contour_are_what_a_fine_buffer_leaves(family):
    rng = random.Random(family.__name__)
    shape = placed(family(rng, 4000.0), rng.uniform(0, 6.0), rng.random() < 0.5)
    path = drawn(shape, (shape.start[0] + 9000.0, shape.start[1] + 1000.0))
    trace = trace_of(path, 4.0)
    ring = shapely.Polygon(trace.wire_um[trace.row > 0])
    left = shapely.get_parts(shapely.LineString(trace.wire_um[trace.row > 0]).buffer(F, quad_segs=64))
    lead = shapely.LineString(trace.wire_um[trace.row == 0]).buffer(F, quad_segs=64)
    expected = shapely.get_parts(shapely.difference(ring, shapely.union_all([*left, lead])))
    areas = sorted(part.area * 1e-6 for part in expected if part.area >= 1000.0)
    found = pieces_of(kerf_along(path, trace), None, STEEL).freed
    perimeter_mm = sum(part.length for part in expected) * 1e-3
    # GEOS may be off by 1 % of the offset: 1 µm along the edge.
    assert sorted(piece.area_mm2 for piece in found) == pytest.approx(areas, abs=1e-3 * perimeter_mm + 1e-9)
