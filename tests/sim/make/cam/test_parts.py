"""Parts of drawings: nesting and numbers are right for every drawing; what is not certain is refused by its name."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest
import shapely
from drawings_dxf import points_on
from drawn_loops import Nested, Piece, arc, as_drawn, circle, drawing_of, nested, polygon, square

from parser.drawing.model import Entity, FitFigures, LeftOut
from parser.geometry.curves import curves_between
from sim.make.cam.model import CannotCutError, Figure, Parts, Refusal
from sim.make.cam.parts import parts_of
from sim.setup.making import LayerWish, Making


def _parts(*entities: list[Piece], gap_um: float = 10.0, loose: bool = False) -> Parts:
    drawn = [[piece] for entity in entities for piece in entity] if loose else list(entities)
    return parts_of(drawing_of(drawn, gap_um), Making(gap_um=gap_um))


def _refused(*entities: list[Piece], loose: bool = False) -> Refusal:
    with pytest.raises(CannotCutError) as caught:
        _parts(*entities, loose=loose)
    return caught.value.refusal


def _kinds(parts: Parts) -> list[tuple[int, str, int]]:
    return [(figure.part, figure.kind, figure.depth) for figure in parts.figures]


def _left(parts: Parts) -> list[str]:
    return [left.why for left in parts.left_out]


def _area(figure: Figure) -> float:
    curves = figure.contour
    (x0, y0), (x1, y1) = (curves.start_um / 1e3).T, (curves.end_um / 1e3).T
    bulge = np.where(curves.is_arc, (curves.radius_um / 1e3) ** 2 * (curves.sweep_rad - np.sin(curves.sweep_rad)), 0.0)
    return float(0.5 * (x0 * y1 - x1 * y0 + bulge).sum())


def _places(refusal: Refusal) -> list[tuple[float, float]]:
    return [(round(x / 1e3, 3), round(y / 1e3, 3)) for x, y in refusal.places_um]


# Every drawing


@pytest.mark.alike(6)
@pytest.mark.parametrize("seed", range(25))
def test_random_nested_drawings_come_out_as_the_parts_that_they_were_made_of(seed):
    rng = random.Random(seed)
    truth = nested(rng, 24)
    parts = parts_of(drawing_of(as_drawn(rng, truth)), Making())
    assert len(parts.figures) == len(truth)
    boxes = np.array([shapely.MultiPoint(points_on(figure.contour, 400)).bounds for figure in parts.figures])
    known = np.array([shapely.MultiPoint(_all_dense(one.pieces)).bounds for one in truth])
    off = np.abs(boxes[None] - known[:, None]).max(axis=2)
    of = np.argmin(off, axis=1).tolist()
    assert (off.min(axis=1) < 5.0).all()
    depths: list[int] = []
    for number, one in enumerate(truth):
        depths.append(0 if one.around < 0 else depths[one.around] + 1)
        figure = parts.figures[of[number]]
        assert (figure.depth, figure.kind) == (depths[-1], "hole" if depths[-1] % 2 else "outline")
        assert _area(figure) == pytest.approx(one.area, rel=1e-9)
        if figure.kind == "hole":
            assert figure.part == parts.figures[of[one.around]].part
    assert len({figure.part for figure in parts.figures if figure.kind == "outline"}) == sum(d % 2 == 0 for d in depths)
    assert set(_left(parts)) <= {"drawn-twice", "overlaps"}


@pytest.mark.parametrize("seed", range(6))
def test_figures_and_their_numbers_are_the_same_whatever_the_order_and_the_way_of_entities(seed):
    truth = nested(random.Random(seed), 16)
    tables = []
    for order in range(4):
        rng = random.Random(1000 * seed + order)
        entities = [[piece] for one in truth for piece in one.pieces]
        rng.shuffle(entities)
        entities = [[one[0].turned()] if rng.random() < 0.5 else one for one in entities]
        figures = parts_of(drawing_of(entities), Making()).figures
        tables.append([(one.number, one.kind, one.part, one.contour) for one in figures])
    for table in tables[1:]:
        for (number, kind, part, curves), (*expected, first) in zip(table, tables[0], strict=True):
            assert [number, kind, part] == expected
            np.testing.assert_allclose(curves.start_um, first.start_um, atol=1e-6)
            np.testing.assert_allclose(curves.sweep_rad, first.sweep_rad, atol=1e-9)


@pytest.mark.parametrize("seed", range(10))
def test_contours_close_to_the_last_bit_with_gaps_too_and_no_curve_leaves_its_place(seed):
    """Ends that lie up to 7 µm off each other."""
    rng = random.Random(seed)
    truth = nested(rng, 12)

    def off(place: tuple[float, float]) -> tuple[float, float]:
        return place[0] + rng.uniform(-2.5e-3, 2.5e-3), place[1] + rng.uniform(-2.5e-3, 2.5e-3)

    entities = []
    for one in truth:
        for piece in one.pieces:
            if piece.sweep:
                cut = rng.uniform(0.0, 3e-3) / math.dist(piece.start, piece.center) / abs(piece.sweep)
                entities.append([piece.between(cut, 1.0)] if abs(piece.sweep) < 6.0 else [piece])
            else:
                entities.append([Piece(off(piece.start), off(piece.end))])
    rng.shuffle(entities)
    parts = parts_of(drawing_of(entities), Making())
    assert len(parts.figures) == len(truth)
    assert sorted(map(_area, parts.figures)) == pytest.approx(sorted(one.area for one in truth), rel=2e-3)
    drawn = shapely.union_all([shapely.LineString(_dense(piece)) for (piece,) in entities])
    for figure in parts.figures:
        curves = figure.contour
        assert (curves.end_um == np.roll(curves.start_um, -1, axis=0)).all()
        assert (curves.length_um > 1.0).all()
        arcs = curves.picked(curves.is_arc)
        for place in (arcs.start_um, arcs.end_um):
            np.testing.assert_allclose(np.hypot(*(place - arcs.center_um).T), arcs.radius_um, atol=2e-3)
        assert shapely.distance(shapely.points(points_on(curves, 33)), drawn).max() < 10.0


def _all_dense(pieces: list[Piece]) -> np.ndarray:
    return np.concatenate([_dense(piece) for piece in pieces])


def _dense(piece: Piece) -> np.ndarray:
    return 1000.0 * np.array([piece.at(share) for share in np.linspace(0.0, 1.0, 400 if piece.sweep else 2)])


# What is drawn once too often


@pytest.mark.parametrize(
    ("again", "left"),
    [
        ([circle(0, 0, 5)], ["drawn-twice"]),
        ([arc(0, 0, 5, 0, 180), arc(0, 0, 5, 180, 360)], ["drawn-twice", "drawn-twice"]),
        ([arc(0, 0, 5, 20, 75)], ["drawn-twice"]),
        ([circle(0, 0, 5.0005)], ["drawn-twice"]),
        ([[piece.turned() for piece in arc(0, 0, 5, 350, 370)]], ["drawn-twice"]),
    ],
)
def test_a_circle_drawn_again_otherwise_is_one(again, left):
    for entities in ([circle(0, 0, 5), *again], [*again, circle(0, 0, 5)]):
        parts = _parts(*entities)
        assert _kinds(parts) == [(1, "outline", 0)]
        assert _left(parts) == left
        assert _area(parts.figures[0]) == pytest.approx(math.pi * 25, rel=3e-4)


def _edge(first: float, last: float, y: float = 0.0) -> list[Piece]:
    return [Piece((first, y), (last, y))]


@pytest.mark.parametrize(
    ("edges", "left"),
    [
        ([_edge(0, 20), _edge(0, 8), _edge(8, 20)], ["drawn-twice", "drawn-twice"]),
        ([_edge(0, 14), _edge(20, 6)], ["overlaps"]),
        ([_edge(0, 20), _edge(0, 20, -0.0005)], ["drawn-twice"]),
        ([_edge(20, 0, -0.0005), _edge(0, 20)], ["drawn-twice"]),
        ([_edge(0, 20), _edge(3, 7)], ["drawn-twice"]),
        ([_edge(0, 9), _edge(5, 15), _edge(11, 20)], ["overlaps", "overlaps"]),
        ([_edge(0, 9), _edge(9, 20), _edge(4, 16)], ["drawn-twice"]),
    ],
)
def test_an_edge_drawn_again_otherwise_is_one(edges, left):
    sides = square(0, 0, 20)[1:]
    parts = _parts(*edges, *([side] for side in sides))
    assert _kinds(parts) == [(1, "outline", 0)]
    assert sorted(set(_left(parts))) == sorted(set(left))
    assert _area(parts.figures[0]) == pytest.approx(400, rel=1e-4)
    # Nothing of it is cut twice.
    assert parts.figures[0].contour.length_um.sum() == pytest.approx(80_000, abs=2.0)


def test_a_loop_that_was_fitted_twice_is_one():
    """Two chains of arcs within the tolerance of one curve, with nodes in other places."""
    rings = []
    for nodes, off in ((24, 0.0), (17, 0.1)):
        angle = off + 2 * np.pi * np.arange(nodes) / nodes
        places = 5000.0 * np.column_stack([np.cos(angle), np.sin(angle)])
        bend = np.full(nodes, 2 * np.pi / nodes)
        rings.append(curves_between(places, np.roll(places, -1, axis=0), places + (0.7 * off), bend))
    pieces = [
        [
            Piece(tuple(a / 1e3), tuple(b / 1e3), (0.0005 * at, 0.0), float(sweep))
            for a, b, sweep in zip(ring.start_um, ring.end_um, ring.sweep_rad, strict=True)
        ]
        for at, ring in enumerate(rings)
    ]
    parts = parts_of(replace(drawing_of(pieces), fit=FitFigures(2.0, 2.0, 41, 0)), Making())
    assert (len(parts.figures), _left(parts)) == (1, ["drawn-twice"])


# What touches, crosses or divides


@pytest.mark.parametrize("loose", [True, False])
def test_squares_that_share_a_corner_are_two(loose):
    parts = _parts(square(0, 0, 10), square(10, 10, 10), loose=loose)
    assert _kinds(parts) == [(1, "outline", 0), (2, "outline", 0)]
    assert [_area(figure) for figure in parts.figures] == pytest.approx([100, 100])


@pytest.mark.parametrize("loose", [True, False])
def test_a_hole_that_touches_its_outline_is_a_hole_still(loose):
    for hole in (polygon([(0, 0), (10, 5), (5, 10)]), polygon([(0, 20), (10, 15), (10, 25)]), circle(45, 25, 5)):
        parts = _parts(square(0, 0, 50), hole, loose=loose)
        assert _kinds(parts) == [(1, "hole", 1), (1, "outline", 0)]


def test_a_figure_eight_of_one_entity_is_two_loops():
    parts = _parts(polygon([(0, 0), (5, 5), (10, 10), (10, 0), (5, 5), (0, 10)]))
    assert [_area(figure) for figure in parts.figures] == pytest.approx([25, 25])


@pytest.mark.parametrize(
    ("entities", "why", "places"),
    [
        ([polygon([(0, 0), (10, 10), (10, 0), (0, 10)])], "crosses-itself", [(5, 5)]),
        ([polygon([(0, 0), (10, 0), (10, 10), (5, -5), (0, 10)])], "crosses-itself", [(3.333, 0), (6.667, 0)]),
        ([polygon([(0, 0), (10, 0), (10, 10), (5, 0), (0, 10)])], "crosses-itself", [(5, 0)]),
        ([square(0, 0, 10), square(5, 5, 10)], "crossing", [(5, 10), (10, 5)]),
        ([circle(0, 0, 5), circle(6, 0, 5)], "crossing", [(3, -4), (3, 4)]),
        (
            [
                polygon([(0, 0), (10, 0), (10, 5), (10, 10), (5, 10), (0, 10)]),
                polygon([(5, 5), (10, 5), (15, 5), (15, 15), (5, 15), (5, 10)]),
            ],
            "crossing",
            [(5, 10), (10, 5)],
        ),
        ([square(0, 0, 10), square(10, 0, 10)], "shared-edge", [(10, 5)]),
        ([square(0, 0, 10), square(10, 2, 20)], "shared-edge", [(10, 6)]),
        ([square(0, 0, 30), square(0, 5, 10)], "shared-edge", [(0, 10)]),
    ],
)
def test_what_crosses_or_shares_an_edge_is_refused_by_name_and_place(entities, why, places):
    refusal = _refused(*entities)
    assert refusal.why == why
    assert _places(refusal) == places
    assert dict(refusal.values)["entity"].startswith(("LWPOLYLINE", "LINE"))


def test_contours_that_cross_by_less_than_a_fit_may_move_them_touch():
    drawing = drawing_of([square(0, 0, 50), circle(4.997, 25, 5)])
    with pytest.raises(CannotCutError, match="crossing"):
        parts_of(drawing, Making())
    fitted = replace(drawing, fit=FitFigures(2.0, 1.9, 1, 4))
    assert _kinds(parts_of(fitted, Making())) == [(1, "hole", 1), (1, "outline", 0)]


def test_a_cut_there_and_back_within_one_entity_is_refused():
    slit = [(0, 0), (10, 0), (10, 5), (7, 5), (7, 6), (6, 6), (6, 5), (7, 5), (10, 5), (10, 10), (0, 10)]
    assert _refused(polygon(slit)).why == "crosses-itself"


def test_a_line_across_a_contour_is_left_out_and_the_contour_is_cut():
    for divider in ([_edge(0, 20, 8)], [[Piece((0, 5), (7, 7)), Piece((7, 7), (0, 15))]]):
        parts = _parts(*([side] for side in square(0, 0, 20)), *divider)
        assert (_kinds(parts), _left(parts)) == ([(1, "outline", 0)], ["divides"])
        assert _area(parts.figures[0]) == pytest.approx(400.0)


@pytest.mark.parametrize("ends", [((0, 0), (20, 20)), ((20, 0), (0, 20))])
def test_a_contour_that_a_line_divides_from_corner_to_corner_is_not_cut(ends):
    """Two sides and the line close as well as four sides do."""
    lines = [*([side] for side in square(0, 0, 20)), [Piece(*ends)]]
    assert _refused(*lines).why == "divided"
    parts = _parts(*lines, square(50, 0, 10))
    assert (_kinds(parts), _left(parts)) == ([(2, "outline", 0)], ["divides", "divided"])


def test_squares_of_lines_that_share_an_edge_are_not_cut_as_one():
    entities = square(0, 0, 10), square(10, 0, 10)
    assert _refused(*entities, loose=True).why == "divided"
    parts = _parts(*entities, square(50, 0, 10), loose=True)
    assert [round(_area(figure)) for figure in parts.figures] == [100]
    assert "divided" in _left(parts)


# What stays uncut beside what is cut


def test_contours_that_cross_stay_uncut_and_the_others_are_cut():
    parts = _parts(
        square(0, 0, 10), square(5, 5, 10), circle(40, 0, 5), polygon([(60, 0), (70, 10), (70, 0), (60, 10)])
    )
    assert _kinds(parts) == [(4, "outline", 0)] or len(parts.figures) == 1
    assert sorted(_left(parts)) == ["crosses-itself", "crossing", "crossing"]
    assert len(parts.uncut) == 3


def test_a_hole_stays_a_hole_where_its_outline_is_not_cut():
    hole = circle(10, 10, 3)
    for outline in (
        [[side] for side in polygon([(0, 0), (20, 0), (20, 20), (0, 20)])[:3]],  # one side is missing
        [polygon([(0, 0), (20, 0), (20, 20), (0, 20)]), square(-5, -5, 10)],  # another square crosses it
        [[_edge(0, 19.7)[0]], *([side] for side in square(0, 0, 20)[1:])],  # it has a gap
    ):
        parts = _parts(*outline, hole)
        (figure,) = parts.figures
        assert (figure.kind, figure.runs_inside, figure.depth) == ("hole", True, 1)


def test_numbers_do_not_depend_on_what_is_cut():
    whole = _parts(square(0, 0, 20), circle(10, 10, 3), square(30, 0, 20), circle(40, 10, 3))
    assert [figure.number for figure in whole.figures] == [1, 2, 3, 4]
    crossed = _parts(square(0, 0, 20), circle(10, 10, 3), square(30, 0, 20), circle(40, 10, 3), circle(10, 16, 5))
    assert [figure.number for figure in crossed.figures if figure.part == crossed.figures[-1].part] == [4, 5]


def _damaged(rng: random.Random, truth: list[Nested]) -> tuple[list[list[Piece]], set[int]]:
    """Entities of a drawing with damage, and the numbers of the contours that are not whole any more."""
    wrong, contours, more = set[int](), [], []
    for number, one in enumerate(truth):
        kind = rng.choice(["whole", "whole", "whole", "gap", "missing", "crossed"])
        pieces = one.pieces
        if kind == "gap":
            share = rng.uniform(0.05, 0.9) / (2.0 * math.dist(pieces[-1].start, pieces[-1].at(0.5)))
            pieces = [*pieces[:-1], pieces[-1].between(0.0, 1.0 - min(share, 0.4))]
        elif kind == "missing" and len(pieces) > 2:
            pieces = pieces[:-1]
        elif kind == "crossed":
            more.append(circle(*pieces[0].at(0.5), 0.1))
        else:
            contours.append(one)
            continue
        wrong.add(number)
        contours.append(one._replace(pieces=pieces))
    return [*as_drawn(rng, contours), *more], wrong


@pytest.mark.alike(8)
@pytest.mark.parametrize("seed", range(60))
def test_a_contour_of_a_damaged_drawing_is_cut_on_its_right_side_or_not_at_all(seed):
    rng = random.Random(1000 + seed)
    truth = nested(rng, 24)
    entities, wrong = _damaged(rng, truth)
    try:
        parts = parts_of(drawing_of(entities), Making())
    except CannotCutError:
        assert wrong
        return
    known = np.array([shapely.MultiPoint(_all_dense(one.pieces)).bounds for one in truth])
    depths: list[int] = []
    for one in truth:
        depths.append(0 if one.around < 0 else depths[one.around] + 1)
    cut = set()
    for figure in parts.figures:
        off = np.abs(known - shapely.MultiPoint(points_on(figure.contour, 400)).bounds).max(axis=1)
        of = int(np.argmin(off))
        # At a cusp two arcs run within 1 µm of each other: the shorter one then ends on the other.
        assert off[of] < (500.0 if of in wrong else 5.0)
        assert _area(figure) == pytest.approx(truth[of].area, rel=1e-3 if of in wrong else 1e-9)
        assert figure.kind == ("hole" if depths[of] % 2 else "outline")
        cut.add(of)
    told = {left.why for left in parts.left_out}
    assert len(cut - wrong) == len(truth) - len(wrong) or "within-open" in told
    if wrong:
        assert told & {"almost-closed", "open", "crossing"}


def test_what_lies_in_an_open_chain_is_cut_where_its_side_is_said():
    corner = [*square(0, 0, 20)[:2]], circle(14, 6, 2)
    assert _refused(*corner).why == "within-open"
    drawing = drawing_of(list(corner))
    for making in (Making(side="inside"), Making(layers=(LayerWish("0", side="outside"),))):
        assert len(parts_of(drawing, making).figures) == 1


def _sheet(*entities: list[Piece], text_mm: tuple[float, float] | None = (250.0, 20.0)) -> Parts:
    drawing = drawing_of(list(entities))
    text = [LeftOut(Entity("TEXT", "1", "0", ""), "text", (1e3 * text_mm[0], 1e3 * text_mm[1]))] if text_mm else []
    return parts_of(replace(drawing, left_out=(*drawing.left_out, *text)), Making())


def _box(x: float, y: float, wide: float, high: float) -> list[Piece]:
    return polygon([(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)])


def test_a_part_in_the_frame_of_a_sheet_is_no_hole():
    part = square(100, 100, 40), circle(120, 120, 5)
    for frame in ([_box(0, 0, 420, 297)], [_box(0, 0, 420, 297), _box(25, 5, 390, 287)], [_box(0, 0, 277, 190)]):
        parts = _sheet(*part, *frame)
        assert [(figure.kind, figure.depth) for figure in parts.figures] == [("hole", 1), ("outline", 0)]
        assert _left(parts).count("frame") == len(frame)


@pytest.mark.parametrize(
    ("frame", "text_mm"),
    [
        (_box(0, 0, 420, 297), None),  # no text in it
        (_box(0, 0, 420, 297), (500.0, 0.0)),
        (_box(0, 0, 425, 297), (250.0, 20.0)),  # no size of a sheet
        (_box(0, 0, 210, 297), (20.0, 20.0)),  # not about all else
        (polygon([(0, 0), (420, 0), (420, 297), (10, 297), (0, 287)]), (250.0, 20.0)),  # no rectangle
    ],
)
def test_a_plate_is_no_frame(frame, text_mm):
    parts = _sheet(square(100, 100, 40), circle(300, 30, 5), frame, text_mm=text_mm)
    assert "frame" not in _left(parts)


def test_a_frame_alone_is_a_plate():
    assert _kinds(_sheet(_box(0, 0, 420, 297))) == [(1, "outline", 0)]


# What does not close


@pytest.mark.parametrize("gap_mm", [0.02, 0.05, 0.3, 3.0])
def test_a_contour_that_almost_closes_is_left_out_with_its_place_and_its_gap(gap_mm):
    sides = [_edge(0, 20 - gap_mm), *([side] for side in square(0, 0, 20)[1:])]
    refusal = _refused(*sides)
    assert (refusal.why, _places(refusal)) == ("almost-closed", [(round(20 - gap_mm / 2, 3), 0)])
    assert dict(refusal.values)["gap_mm"] == f"{gap_mm:g}"
    assert _kinds(_parts(*sides, gap_um=float(dict(refusal.values)["joins_um"]))) == [(1, "outline", 0)]
    parts = _parts(*sides, square(50, 0, 10))
    assert (_kinds(parts), _left(parts)) == ([(2, "outline", 0)], ["almost-closed"])
    (left,) = parts.left_out
    assert left.gap_um == pytest.approx(1000.0 * gap_mm)
    assert left.place_um == pytest.approx((20_000.0 - 500.0 * gap_mm, 0.0))


@pytest.mark.parametrize("beside", [[], [[Piece((25, 0), (45, 0))]]])
def test_a_contour_without_one_of_its_sides_is_told_whatever_lies_near_it(beside):
    parts = _parts(*([side] for side in square(0, 0, 20)[1:]), square(50, 0, 10), *beside)
    assert _left(parts)[0] == "almost-closed"
    assert len(parts.uncut) == 1


def test_two_chains_whose_ends_are_near_each_other_are_one_contour_that_is_not_cut():
    halves = [Piece((0, 0), (10, 0)), Piece((10, 0), (10, 10))], [Piece((10.5, 10), (0, 10)), Piece((0, 10), (0, 0.5))]
    assert _places(_refused(*halves)) == [(0, 0.25), (10.25, 10)]
    parts = _parts(*halves, circle(5, 5, 2))
    assert (_left(parts), len(parts.uncut)) == (["almost-closed", "almost-closed"], 1)
    assert parts.figures[0].kind == "hole"


def test_a_contour_open_by_more_than_a_gap_can_bridge_is_told_without_one():
    assert _refused(*([side] for side in square(0, 0, 200)[1:])).why == "wide-open"


def test_free_lines_are_left_out_with_their_place_and_told():
    marks = [_edge(-8, 8), [Piece((0, -8), (0, 8))], _edge(30, 30.005), [Piece((5, 0), (9, 4))]]
    parts = _parts(circle(0, 0, 5), *marks)
    assert _kinds(parts) == [(1, "outline", 0)]
    assert [(left.why, left.place_um) for left in parts.left_out] == [
        ("open", (-8000.0, 0.0)),
        ("open", (0.0, -8000.0)),
        ("dot", (30000.0, 0.0)),
        ("open", (5000.0, 0.0)),
    ]
    assert parts.left_out[3].gap_um == 3000.0  # from (5, 0) to (8, 0)


def test_strokes_of_a_mark_are_no_contour_however_near_their_ends():
    cross = [_edge(-0.4, 0.4), [Piece((0, -0.4), (0, 0.4))]]
    assert _left(_parts(circle(0, 0, 5), *cross)) == ["open", "open"]


def test_a_tail_at_a_contour_is_left_out_even_within_one_entity():
    tailed = [Piece((-5, 0), (0, 0)), *square(0, 0, 10)]
    for entities in ([tailed], [[piece] for piece in tailed]):
        parts = _parts(*entities)
        assert (_kinds(parts), _left(parts)) == ([(1, "outline", 0)], ["open"])


def test_dots_are_left_out_and_small_circles_are_not_however_wide_the_gap():
    parts = _parts(square(0, 0, 50), circle(10, 10, 0.004), circle(20, 10, 0.3), gap_um=1000.0)
    assert (_kinds(parts), _left(parts)) == ([(1, "hole", 1), (1, "outline", 0)], ["dot"])


def test_a_contour_of_no_width_is_left_out():
    thin = polygon([(0, 0), (20, 0.0004), (40, 0), (20, -0.0004)])
    parts = _parts(square(-50, -50, 200), thin)
    assert (_kinds(parts), _left(parts)) == ([(1, "outline", 0)], ["no-width"])
    assert _refused(thin).why == "no-contour"


@pytest.mark.parametrize("lines", [[_edge(0, 10)], [_edge(0, 10), [Piece((3, 5), (9, 20))]]])
def test_a_drawing_of_open_lines_alone_is_refused(lines):
    refusal = _refused(*lines)
    assert (refusal.why, len(refusal.places_um)) == ("no-contour", len(lines))


# Numbers


def test_parts_are_numbered_from_left_to_right_and_holes_before_their_outline():
    parts = _parts(
        square(100, 0, 50),
        circle(140, 10, 3),
        circle(110, 10, 3),
        square(0, 0, 50),
        square(10, 10, 30),
        circle(25, 25, 5),
    )
    assert _kinds(parts) == [
        (1, "hole", 1),
        (1, "outline", 0),
        (2, "outline", 2),
        (3, "hole", 1),
        (3, "hole", 1),
        (3, "outline", 0),
    ]
    assert [figure.number for figure in parts.figures] == [1, 2, 3, 4, 5, 6]
    assert [figure.runs_inside for figure in parts.figures] == [True, False, False, True, True, False]
    assert parts.figures[3].contour.center_um[0].tolist() == [110_000, 10_000]


def test_circles_on_the_layer_of_thread_points_are_no_contours():
    drawing = drawing_of([circle(0, 0, 5), circle(0, 0, 0.5)])
    small = drawing.entities[1]._replace(layer="Start")
    drawing = replace(drawing, entities=(drawing.entities[0], small))
    assert len(parts_of(drawing, Making(thread_layer="START")).figures) == 1
    assert len(parts_of(drawing, Making()).figures) == 2


# Whatever is drawn


def _anything(rng: random.Random) -> list[list[Piece]]:
    """Lines, arcs, polylines and circles between the places of a small grid: much touches, crosses and lies twice."""

    def place() -> tuple[float, float]:
        return float(rng.randint(0, 4)), float(rng.randint(0, 4))

    def piece(start: tuple[float, float], end: tuple[float, float]) -> Piece:
        bulge = rng.choice([0.0, 0.0, 1.0, -0.5, 0.2])
        if not bulge:
            return Piece(start, end)
        lift = (1.0 - bulge**2) / (4.0 * bulge)
        x, y = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
        return Piece(start, end, (x - (end[1] - start[1]) * lift, y + (end[0] - start[0]) * lift), 4 * math.atan(bulge))

    entities = [circle(*place(), rng.choice([0.5, 1.0, 2.0])) for _ in range(rng.randint(0, 2))]
    for _ in range(rng.randint(1, 3)):
        through = [place() for _ in range(rng.randint(2, 5))]
        ends = zip(through, [*through[1:], through[0]], strict=True)
        entities.append([piece(a, b) for a, b in ends if a != b])
    return [entity for entity in entities if entity]


@pytest.mark.deeper
def test_what_is_accepted_of_anything_that_may_be_drawn_nests_and_does_not_cross():
    accepted = []
    for seed in range(120):
        try:
            parts = _parts(*_anything(random.Random(seed)))
        except CannotCutError:
            continue
        figures = parts.figures
        uncut = [shapely.Polygon(points_on(each.contour, 300)).buffer(0.0) for each in parts.uncut]
        rings = [shapely.LinearRing(points_on(figure.contour, 300)) for figure in figures]
        bodies = [shapely.Polygon(ring).buffer(0.0) for ring in rings]
        accepted.append(len(figures))
        for figure, ring, body in zip(figures, rings, bodies, strict=True):
            assert body.area == pytest.approx(abs(shapely.Polygon(ring).area), rel=1e-4), seed
            within = [other.intersection(body).area / body.area for other in bodies if other.area > body.area]
            assert all(share < 1e-3 or share > 1.0 - 1e-3 for share in within), seed
            inner = body.representative_point()
            around = sum(share > 0.5 for share in within) + sum(other.contains(inner) for other in uncut)
            assert around == figure.depth or parts.uncut, seed
    assert len(accepted) > 10
    assert max(accepted) > 1
