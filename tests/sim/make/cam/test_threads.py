"""Thread points: in the waste, with a free lead of more than the offset; those asked for, or their refusal."""

import math
import random
from typing import Any

import numpy as np
import pytest
import shapely
from shapely.geometry.base import BaseGeometry

from parser.drawing.model import Drawing, Entity, Mark
from parser.geometry.along import places
from parser.geometry.curves import Curves, curves_between, joined
from parser.toolpath import Point
from sim.make.cam.leads import lead_in
from sim.make.cam.model import CannotCutError, Figure, Refusal, Thread
from sim.make.cam.threads import thread_notes, threads_of
from sim.setup.making import Making

REACH_UM = 120.0
NO_CURVES = curves_between(np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2)), np.empty(0))


def polygon(corner_um: Any) -> Curves:
    corner = np.array(corner_um, dtype=np.float64)
    return curves_between(corner, np.roll(corner, -1, axis=0), np.full_like(corner, np.nan), np.zeros(len(corner)))


def circle(x: float, y: float, radius: float) -> Curves:
    start, center = np.array([[x + radius, y]]), np.array([[x, y]])
    return curves_between(start, start, center, np.array([2.0 * np.pi]))


def box(x: float, y: float, wide: float, high: float) -> Curves:
    return polygon([(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)])


def figure(number: int, part: int, depth: int, contour: Curves) -> Figure:
    kind = "hole" if depth % 2 else "outline"
    return Figure(
        number,
        kind,
        part,
        depth,
        contour,
        np.zeros(len(contour), dtype=np.int64),
        Entity("LINE", "1", "0", ""),
        depth % 2 == 1,
    )


def drawing(marks: tuple[Mark, ...] = (), rings: Curves = NO_CURVES) -> Drawing:
    """A drawing with marks, and circles on the layer START; contours are given beside it."""
    entities = tuple(Entity("CIRCLE", str(at), "START", "") for at in range(len(rings)))
    return Drawing("d.dxf", "R2010", "mm", rings, np.arange(len(rings)), entities, (), 0, 0.0, (), (), marks)


def outline_of(contour: Curves) -> BaseGeometry:
    """A contour as a polygon whose sides lie within 0.1 µm of its arcs, up to a radius of 10 mm."""
    row = np.repeat(np.arange(len(contour)), np.where(contour.is_arc, 720, 1))
    share = np.concatenate([np.linspace(0.0, 1.0, 720, endpoint=False) if arc else [0.0] for arc in contour.is_arc])
    return shapely.Polygon(places(contour, row, share))


def waste(figures: list[Figure], at: int) -> BaseGeometry:
    """What may be cut through for a figure: within a hole aside from its islands; around an outline within its hole."""
    one, outlines = figures[at], [outline_of(other.contour) for other in figures]
    inside = outlines[at]
    if not one.runs_inside:
        homes = [
            outlines[k]
            for k, other in enumerate(figures)
            if other.depth == one.depth - 1 and outlines[k].contains(inside)
        ]
        inside = homes[0] if homes else inside.buffer(1e5)
    depth = one.depth + 1 if one.runs_inside else one.depth
    for k, other in enumerate(figures):
        if other.depth == depth and inside.contains(outlines[k].representative_point()):
            inside = inside.difference(outlines[k])
    return inside


def begun(one: Figure, thread: Thread, reach_um: float) -> Curves:
    """A stretch of the pass across from the entry, tangent to the contour there, as the first of a pass is."""
    out, place = np.array(thread.entry.out), np.array(thread.entry.place_um)
    start = place + reach_um * out
    return curves_between(start[None], (start + 100.0 * np.array([out[1], -out[0]]))[None], start[None], np.zeros(1))


def assert_led_in_the_waste(figures: list[Figure], threads: tuple[Thread, ...], reach_um: float = REACH_UM) -> None:
    for at, (one, thread) in enumerate(zip(figures, threads, strict=True)):
        free, place = waste(figures, at), np.array(thread.place_um)
        assert free.contains(shapely.Point(place))
        assert np.array_equal(place, np.round(place))
        assert np.hypot(*(place - thread.entry.place_um)) > reach_um
        if thread.lead == "point":
            continue
        way = lead_in(thread, begun(one, thread, reach_um))
        for row in range(len(way)):
            spread = places(way, np.full(200, row), np.linspace(0.0, 1.0, 200))
            kerf = shapely.LineString(spread).buffer(reach_um - 0.2, quad_segs=32)
            assert free.contains(kerf), f"figure {one.number}"


def plate(rng: random.Random) -> list[Figure]:
    """A plate with holes in a grid: round, square and narrow ones, polygons, pockets with islands; a part beside it."""
    number = rng.randint(1, 3)
    size = 12000.0
    figures = [figure(1, 1, 0, box(0.0, 0.0, size * number, size * number))]
    for cell in range(number * number):
        x, y = size * (cell % number) + 6000.0, size * (cell // number) + 6000.0
        form = rng.choice(["round", "square", "narrow", "turned", "pocket", "none"])
        radius = float(rng.choice([300, 1000, 2500, 5000]))
        at = len(figures) + 1
        if form == "round":
            figures.append(figure(at, 1, 1, circle(x + rng.random(), y + rng.random(), radius)))
        elif form == "square":
            figures.append(figure(at, 1, 1, box(x - radius, y - radius, 2 * radius, radius)))
        elif form == "narrow":
            figures.append(figure(at, 1, 1, box(x - 4000.0, y, 8000.0, rng.uniform(300.0, 900.0))))
        elif form == "turned":
            turn = rng.random() + np.linspace(0.0, 2.0 * np.pi, rng.randint(3, 9), endpoint=False)
            figures.append(
                figure(at, 1, 1, polygon(np.array([x, y]) + 4000.0 * np.array([np.cos(turn), np.sin(turn)]).T))
            )
        elif form == "pocket":
            figures.append(figure(at, 1, 1, box(x - 5000.0, y - 5000.0, 10000.0, 10000.0)))
            figures.append(figure(at + 1, at + 1, 2, circle(x, y + 1000.0, rng.uniform(500.0, 3500.0))))
    gap = rng.choice([400.0, 3000.0, 20000.0])
    figures.append(figure(len(figures) + 1, 90, 0, box(size * number + gap, 0.0, 8000.0, 8000.0)))
    rng.shuffle(figures)
    return figures


@pytest.mark.parametrize("seed", range(25))
def test_chosen_thread_points_lie_in_the_waste_with_a_free_lead_from_there(seed: int) -> None:
    rng = random.Random(seed)
    figures = plate(rng)
    making = Making(lead=rng.choice(["perpendicular", "arc", "tangent"]), lead_um=rng.choice([None, 400.0, 5000.0]))
    threads = threads_of(drawing(), figures, making, REACH_UM)
    assert all(thread.by == "chosen" for thread in threads)
    assert_led_in_the_waste(figures, threads)
    for one, thread in zip(figures, threads, strict=True):
        assert thread.lead == making.lead if one.runs_inside else thread.lead == "perpendicular"


@pytest.mark.alike(6)
@pytest.mark.parametrize("seed", range(25))
def test_any_thread_point_asked_for_gets_a_free_lead_or_is_refused_by_name(seed: int) -> None:
    rng = random.Random(seed)
    figures = plate(rng)
    low, high = -3000.0, 40000.0
    start = Point(float(rng.randint(int(low), int(high))), float(rng.randint(int(low), int(high))))
    lies_in = [at for at in range(len(figures)) if waste(figures, at).contains(shapely.Point(start))]
    making = Making(starts_um=(start,))
    refusal = refusal_of(figures, making)
    if refusal is None:
        found = threads_of(drawing(), figures, making, REACH_UM)
        asked = [at for at, thread in enumerate(found) if thread.by == "asked"]
        assert len(asked) == 1
        assert asked[0] in lies_in
        assert found[asked[0]].place_um == start
        assert_led_in_the_waste(figures, found)
        return
    off = min(shapely.Point(start).distance(outline_of(one.contour).exterior) for one in figures)
    assert refusal.places_um == (start,)
    assert (refusal.why == "start-nowhere") == (not lies_in)
    assert (refusal.why == "start-too-near") == (bool(lies_in) and off <= REACH_UM)
    assert refusal.why in {"start-nowhere", "start-too-near", "start-hidden"}


@pytest.mark.alike(8)
@pytest.mark.parametrize("seed", range(60))
def test_a_cut_starts_where_that_is_asked_for_or_is_refused_by_name(seed: int) -> None:
    """On the nearest place of the nearest contour, as shapely finds it, or its corner no farther than the reach."""
    rng = random.Random(seed)
    figures = plate(rng)
    edges = [outline_of(one.contour).exterior for one in figures]
    at = rng.randrange(len(figures))
    on = edges[at].interpolate(rng.random(), normalized=True)
    asked = Point(round(on.x + rng.uniform(-50.0, 50.0)), round(on.y + rng.uniform(-50.0, 50.0)))
    nearest = min(range(len(edges)), key=lambda one: edges[one].distance(shapely.Point(asked)))
    making = Making(entries_um=(asked,), lead_um=rng.choice([None, 400.0]))
    refusal = refusal_of(figures, making)
    if refusal is not None:
        assert (refusal.why, refusal.places_um) == ("enter-hidden", (asked,))
        entry = edges[nearest].interpolate(edges[nearest].project(shapely.Point(asked)))
        least = REACH_UM + 10.0  # a lead is that long at least, and as far from all else
        assert waste(figures, nearest).buffer(-least, quad_segs=64).distance(entry) > least + 0.5, "there is no room"
        return
    found = threads_of(drawing(), figures, making, REACH_UM)
    corner = min(math.dist(one, asked) for one in figures[nearest].contour.start_um.tolist())
    if corner > REACH_UM:  # into a corner the pass begins farther out than by the reach
        assert_led_in_the_waste(figures, found)
    entry = shapely.Point(found[nearest].entry.place_um)
    assert edges[nearest].distance(entry) < 0.2  # µm: as near as the chords of a circle lie to it
    off = edges[nearest].project(shapely.Point(asked))
    is_there = entry.distance(edges[nearest].interpolate(off)) < 20.0  # moved to whole µm across a lead in whole µm
    assert is_there or corner <= REACH_UM
    usual = threads_of(drawing(), figures, Making(lead_um=making.lead_um), REACH_UM)
    far = [one for one in range(len(figures)) if one != nearest and usual[one] != found[one]]
    assert all(math.dist(usual[one].place_um, found[nearest].place_um) < 2_000.0 for one in far), "others stay"


def refusal_of(figures: list[Figure], making: Making) -> Refusal | None:
    try:
        threads_of(drawing(), figures, making, REACH_UM)
    except CannotCutError as error:
        return error.refusal
    return None


PLATE = [figure(1, 1, 0, box(0, 0, 30000, 20000)), figure(2, 1, 1, box(2000, 2000, 8000, 6000))]


def threads(making: Making, seen: Drawing | None = None, reach_um: float = REACH_UM) -> tuple[Thread, ...]:
    return threads_of(seen or drawing(), PLATE, making, reach_um)


def why(making: Making, seen: Drawing | None = None, reach_um: float = REACH_UM) -> str:
    with pytest.raises(CannotCutError) as caught:
        threads(making, seen, reach_um)
    return caught.value.refusal.why


def test_the_wire_comes_to_the_middle_of_the_longest_line_as_long_a_way_as_is_asked() -> None:
    outer, inner = threads(Making(lead_um=1500.0))
    assert (outer.place_um, outer.entry.place_um) == (Point(15000, -1500), Point(15000, 0))
    assert (inner.place_um, inner.entry.place_um) == (Point(6000, 3500), Point(6000, 2000))


@pytest.mark.parametrize(
    "contour",
    [
        circle(5000, 7000, 900),
        circle(5000, 7000, 5000),
        box(0, 2000, 10000, 10000),
        box(-25000, 6000, 60000, 2000),
        polygon(
            [(5000 + 4000 * x, 7000 + 4000 * y) for x, y in ((1, 0), (0.5, 0.75**0.5), (-0.5, 0.75**0.5))]
            + [(5000 + 4000 * x, 7000 + 4000 * y) for x, y in ((-1, 0), (-0.5, -(0.75**0.5)), (0.5, -(0.75**0.5)))]
        ),
    ],
    ids=["circle 1.8", "circle 10", "square", "slot", "hexagon"],
)
def test_a_hole_up_to_ten_mm_wide_is_threaded_in_its_middle(contour: Curves) -> None:
    (thread,) = threads_of(drawing(), [figure(1, 1, 1, contour)], Making(), REACH_UM)
    assert math.dist(thread.place_um, (5000, 7000)) <= 1.0


def test_wider_holes_and_parts_are_threaded_near_the_edge_and_leads_asked_for_are_as_long() -> None:
    wide, part = box(0, 0, 10100, 10100), box(20000, 0, 4000, 4000)
    found = threads_of(drawing(), [figure(1, 1, 1, wide), figure(2, 2, 0, part)], Making(), REACH_UM)
    assert [math.dist(each.place_um, each.entry.place_um) for each in found] == [2000.0, 2000.0]
    (asked,) = threads_of(drawing(), [figure(1, 1, 1, circle(0, 0, 4000))], Making(lead_um=1000.0), REACH_UM)
    assert math.dist(asked.place_um, asked.entry.place_um) == 1000.0


def test_the_longest_side_takes_the_lead_though_another_one_has_more_room() -> None:
    """2.5 mm are room enough for a lead of 2 mm: it went to a shorter side, since that had 5."""
    part = polygon([(0, 0), (30000, 0), (29000, 10000), (1000, 10000)])
    found = threads_of(
        drawing(), [figure(1, 1, 0, part), figure(2, 2, 0, box(0, -15000, 30000, 10000))], Making(), REACH_UM
    )
    assert found[0].entry.place_um == Point(15000, 0)
    assert found[0].place_um == Point(15000, -2000)


def test_figures_of_one_waste_are_threaded_a_start_hole_apart() -> None:
    """The middles of all sides lie across from one another, 1 mm apart: each pair would share one place."""
    frame, island = box(0, 0, 20000, 10000), box(1000, 1000, 18000, 8000)
    found = threads_of(drawing(), [figure(1, 1, 1, frame), figure(2, 2, 2, island)], Making(), REACH_UM)
    assert math.dist(found[0].place_um, found[1].place_um) >= 1000.0


def test_an_island_that_is_round_is_threaded_a_start_hole_apart_from_its_hole() -> None:
    """Across the narrowest place of the waste both would share one, and a circle has other sides."""
    hole, island = box(0, 0, 3800, 3800), circle(1900, 1900, 350)
    found = threads_of(drawing(), [figure(1, 1, 1, hole), figure(2, 2, 2, island)], Making(), REACH_UM)
    assert math.dist(found[0].place_um, found[1].place_um) >= 1000.0


def test_it_comes_to_no_fillet_smaller_than_the_offset_where_there_is_anything_else() -> None:
    fillet = curves_between(np.array([[1e3, 0.0]]), np.array([[0.0, 1e3]]), np.zeros((1, 2)), np.array([np.pi / 2]))
    lines = polygon([(0.0, 1e3), (0.0, 0.0), (1e3, 0.0)]).picked(slice(2))
    for radius, row in ((1500.0, 0), (500.0, 1)):
        (thread,) = threads_of(drawing(), [figure(1, 1, 0, joined([fillet, lines]))], Making(), radius)
        assert (thread.entry.row == 0) == (row == 0 and radius < 1e3)


def test_a_hole_without_room_is_refused_by_number() -> None:
    with pytest.raises(CannotCutError) as caught:
        threads_of(drawing(), [figure(7, 1, 1, circle(0, 0, 125))], Making(), REACH_UM)
    assert caught.value.refusal.why == "no-room"
    assert dict(caught.value.refusal.values) == {"figures": "7", "least_mm": "0.13"}


def test_thread_points_asked_for_go_to_the_figures_in_whose_waste_they_lie() -> None:
    outer, inner = threads(Making(starts_um=(Point(6000, 4000), Point(-3000, 5000))))
    assert (outer.place_um, outer.entry.place_um) == (Point(-3000, 5000), Point(0, 5000))
    assert (inner.place_um, inner.entry.place_um) == (Point(6000, 4000), Point(6000, 2000))
    assert outer.by == inner.by == "asked"


def test_from_beside_a_corner_the_wire_comes_to_the_corner() -> None:
    outer, _ = threads(Making(starts_um=(Point(-2000, -3000),)))
    assert outer.entry.place_um == Point(0, 0)
    assert outer.entry.out == pytest.approx((-np.sqrt(0.5), -np.sqrt(0.5)))


@pytest.mark.parametrize(
    ("starts", "refused"),
    [
        ([(20000, 10000)], "start-nowhere"),
        ([(6000, 4000), (7000, 4000)], "start-twice"),
        ([(6000, 2100)], "start-too-near"),
        ([(6000, 2001)], "start-on-contour"),
    ],
)
def test_thread_points_that_cannot_be_are_refused(starts: list[tuple[float, float]], refused: str) -> None:
    assert why(Making(starts_um=tuple(Point(*one) for one in starts))) == refused


def test_a_cut_starts_on_the_place_across_from_its_thread_point_or_led_there_from_one_that_stands() -> None:
    outer, inner = threads(Making(entries_um=(Point(0, 15_000), Point(9990, 4000))))
    assert (outer.entry.place_um, outer.place_um, outer.by) == (Point(0, 15_000), Point(-2000, 15_000), "chosen")
    assert inner.entry.place_um == Point(10_000, 4000)
    outer, _ = threads(Making(starts_um=(Point(-3000, 5000),), entries_um=(Point(0, 9000),)))
    assert (outer.place_um, outer.entry.place_um, outer.by) == (Point(-3000, 5000), Point(0, 9000), "asked")
    for corner in (Point(0, 0), Point(10_000, 8000)):  # one of a part, one that waste lies in
        found = threads(Making(entries_um=(Point(corner.x + 40.0, corner.y),), lead="point"))
        assert corner in {thread.entry.place_um for thread in found}
    outer, _ = threads(Making(entries_um=(Point(3, 15_000),)), reach_um=0.0)
    assert (outer.place_um, outer.by) == (Point(0, 15_000), "contour")


def test_cuts_that_start_face_to_face_are_threaded_a_start_hole_apart() -> None:
    """Both points would lie midway between the parts, 2 mm from each: one lead is shorter."""
    pair = [figure(1, 1, 0, box(0, 0, 10_000, 10_000)), figure(2, 2, 0, box(14_000, 0, 10_000, 10_000))]
    making = Making(entries_um=(Point(10_000, 5000), Point(14_000, 5000)))
    found = threads_of(drawing(), pair, making, REACH_UM)
    assert [thread.entry.place_um for thread in found] == [Point(10_000, 5000), Point(14_000, 5000)]
    assert math.dist(*(thread.place_um for thread in found)) > 1000.0
    assert_led_in_the_waste(pair, found)


@pytest.mark.parametrize(
    ("making", "refused"),
    [
        (Making(entries_um=(Point(0, 5000), Point(0, 9000))), "enter-twice"),
        (Making(starts_um=(Point(-3000, 5000),), entries_um=(Point(30_000, 9000),)), "enter-hidden"),
    ],
)
def test_starts_of_cuts_that_cannot_be_are_refused(making: Making, refused: str) -> None:
    assert why(making) == refused


def test_a_thread_point_behind_an_island_is_led_round_it_or_refused() -> None:
    """From behind a wall as wide as the pocket but for two slits, no straight way leads to the side beyond it."""
    pocket = [figure(1, 1, 0, box(-1e4, -1e4, 3e4, 3e4)), figure(2, 1, 1, box(0, 0, 1e4, 1e4))]
    island = figure(3, 2, 2, circle(5000, 5000, 3000))
    found = threads_of(drawing(), [*pocket, island], Making(starts_um=(Point(5000, 9000),)), REACH_UM)
    assert_led_in_the_waste([*pocket, island], found)


def test_without_offset_the_wire_begins_on_the_contour_where_it_is_asked_to() -> None:
    outer, inner = threads(Making(starts_um=(Point(30000, 20000),)), reach_um=0.0)
    assert (outer.by, outer.place_um, outer.entry.place_um) == ("contour", Point(30000, 20000), Point(30000, 20000))
    assert (inner.by, inner.place_um) == ("contour", Point(6000, 2000))
    led, _ = threads(Making(lead_um=1000.0), reach_um=0.0)
    assert (led.by, led.place_um) == ("chosen", Point(15000, -1000))


def test_a_lead_asked_for_is_longer_than_the_offset() -> None:
    assert why(Making(lead_um=REACH_UM)) == "short-lead"


def test_points_and_circles_of_the_layer_of_thread_points_are_thread_points() -> None:
    seen = drawing((Mark((5000.0, 4000.0), "Start", 0.0), Mark((9e3, 4e3), "0", 0.0)), circle(-4000.0, 1000.0, 500.0))
    outer, inner = threads(Making(thread_layer="START"), seen)
    assert (outer.by, outer.place_um) == ("marked", Point(-4000, 1000))
    assert (inner.by, inner.place_um) == ("marked", Point(5000, 4000))
    asked = Making(thread_layer="START", starts_um=(Point(6000, 4000),))
    assert threads(asked, seen)[1].place_um == Point(6000, 4000)
    assert why(Making(thread_layer="STRAT"), seen) == "no-marks"
    assert why(Making(thread_layer="0"), drawing((Mark((2e4, 1e4), "0", 0.0),))) == "start-nowhere"


def test_a_point_alone_in_a_hole_is_its_thread_point_and_others_are_not() -> None:
    alone = Mark((5000.0, 4000.0), "0", 0.0)
    assert threads(Making(), drawing((alone,)))[1] == threads(Making(starts_um=(Point(5000, 4000),)))[1]._replace(
        by="marked"
    )
    for others in ((alone, Mark((8e3, 4e3), "0", 0.0)), (Mark((-5e3, 0.0), "0", 0.0),), (Mark((2e3, 4e3), "0", 0.0),)):
        assert threads(Making(), drawing(others)) == threads(Making())


def test_a_lead_to_a_point_goes_to_the_nearest_corner_in_the_waste_or_is_straight_across() -> None:
    outer, inner = threads(Making(lead="point", starts_um=(Point(3000, 3000), Point(-1000, -500))))
    assert (outer.lead, outer.entry.place_um) == ("point", Point(0, 0))
    assert (inner.lead, inner.entry.place_um) == ("point", Point(2000, 2000))
    middle, _ = threads(Making(lead="point", starts_um=(Point(15000, -130),)))
    assert middle.lead == "perpendicular"
    notes = thread_notes(PLATE, (middle, inner), Making(lead="point"))
    assert [(note.name, dict(note.values)) for note in notes] == [("straight-leads", {"figures": "1"})]


def test_a_lead_to_a_point_comes_midway_between_the_sides_of_its_corner() -> None:
    """Along a side it would cut free what is cut before the wire is round."""
    for thread, aside in zip(threads(Making(lead="point", lead_um=1500.0)), (1.0, np.sqrt(2.0)), strict=True):
        across, up = np.abs(np.array(thread.place_um) - np.array(thread.entry.place_um))
        assert across == up == pytest.approx((aside * REACH_UM + 1500.0) * np.sqrt(0.5), abs=1.0)


def test_round_leads_to_parts_are_straight_and_it_is_said() -> None:
    found = threads(Making(lead="arc"))
    assert [thread.lead for thread in found] == ["perpendicular", "arc"]
    notes = thread_notes(PLATE, found, Making(lead="arc"))
    assert [(note.name, dict(note.values)) for note in notes] == [("straight-to-parts", {"figures": "1"})]


def test_chosen_thread_points_in_one_waste_lie_a_start_hole_apart() -> None:
    # The longest sides of both face each other across 4 mm: each has room for a lead of 2 mm up to the same place.
    left = figure(1, 1, 0, polygon([(0, 0), (6000, -3000), (6000, 9000), (0, 6000)]))
    right = figure(2, 2, 0, polygon([(10000, -3000), (16000, 0), (16000, 6000), (10000, 9000)]))
    one, other = (thread.place_um for thread in threads_of(drawing(), [left, right], Making(), REACH_UM))
    assert math.dist(one, other) >= 1000.0


def test_leads_of_passes_back_and_forth_are_straight_and_it_is_said() -> None:
    making = Making(lead="tangent", passes_um=(180.0, 120.0))
    found = threads(making)
    assert {thread.lead for thread in found} == {"perpendicular"}
    assert [note.name for note in thread_notes(PLATE, found, making)] == ["straight-back"]
    assert threads(making._replace(returning="one-way"))[1].lead == "tangent"


def test_leads_with_no_room_for_the_length_that_is_asked_for_are_told() -> None:
    making = Making(lead_um=50_000.0)
    notes = thread_notes(PLATE, threads(making), making)
    assert [(note.name, dict(note.values)) for note in notes] == [("shorter-leads", {"figures": "2"})]
    making = Making(lead_um=500.0)
    assert thread_notes(PLATE, threads(making), making) == ()
