"""What is cut before what: nesting first, then ranks of layers, then the shortest way; or the order that is asked."""

import random

import numpy as np
import pytest

from parser.drawing.model import Entity
from parser.geometry.curves import curves_between
from parser.toolpath import Point
from sim.make.cam.model import CannotCutError, Entry, Figure, Thread
from sim.make.cam.order import around, in_order
from sim.make.cam.parts import refuse_strange_layers, with_sides
from sim.make.cam.passes import way_of
from sim.setup.making import LayerWish, Making

MM = 1000.0


def square(number: int, part: int, depth: int, box_mm: tuple[float, float, float], layer: str = "0") -> Figure:
    """A figure that is a square: its lower left corner and its side."""
    x, y, side = (MM * one for one in box_mm)
    corner = np.array([[x, y], [x + side, y], [x + side, y + side], [x, y + side]])
    contour = curves_between(corner, np.roll(corner, -1, axis=0), np.full((4, 2), np.nan), np.zeros(4))
    kind = "hole" if depth % 2 else "outline"
    return Figure(
        number, kind, part, depth, contour, np.zeros(4, dtype=np.int64), Entity("LINE", "1", layer, ""), depth % 2 == 1
    )


def threaded(figure: Figure) -> Thread:
    x, y = figure.contour.start_um[0].tolist()
    return Thread(Point(x, y), "chosen", Entry(0, 0.0, Point(x, y), Point(0.0, -1.0)))


def ordered(figures: list[Figure], making: Making) -> list[int]:
    """Numbers of the figures as they are cut."""
    return [figures[at].number for at in in_order(figures, [threaded(one) for one in figures], making)]


PLATE = [
    square(1, 1, 0, (0, 0, 100)),
    square(2, 1, 1, (10, 10, 60)),
    square(3, 2, 2, (20, 20, 30)),
    square(4, 2, 3, (25, 25, 5)),
    square(5, 1, 1, (80, 80, 5), "SMALL"),
    square(6, 3, 0, (200, 0, 10), "SMALL"),
]
"""A plate with a pocket, an island with a hole in the pocket, another hole; a part beside it."""


def test_what_lies_directly_around_each_figure() -> None:
    assert around(PLATE) == (-1, 0, 1, 2, 0, -1)


def test_the_deepest_come_first_and_outlines_last() -> None:
    order = ordered(PLATE, Making())
    assert order[:2] == [4, 3]
    assert set(order[2:4]) == {2, 5}
    assert set(order[4:]) == {1, 6}


def test_ranks_of_layers_go_before_depth_but_not_before_what_lies_within() -> None:
    assert ordered(PLATE, Making(layers=(LayerWish("small", rank=1),)))[:2] == [5, 6]
    first_others = Making(layers=(LayerWish("0", rank=1), LayerWish("SMALL", rank=2)))
    # The plate waits for its hole of the second layer.
    assert ordered(PLATE, first_others)[:3] == [4, 3, 2]
    assert ordered(PLATE, first_others)[3] == 5


def test_the_order_that_is_asked_for_is_kept() -> None:
    assert ordered(PLATE, Making(order=(6, 5, 4, 3, 2, 1))) == [6, 5, 4, 3, 2, 1]


@pytest.mark.parametrize(
    ("order", "wrong"), [((1, 2), "3, 4, 5, 6"), ((6, 5, 4, 3, 2, 1, 7), "7"), ((6, 5, 4, 3, 2, 1, 1), "1")]
)
def test_an_order_without_a_figure_or_with_one_too_many_is_refused_by_number(
    order: tuple[int, ...], wrong: str
) -> None:
    with pytest.raises(CannotCutError) as caught:
        ordered(PLATE, Making(order=order))
    assert caught.value.refusal.why == "order-incomplete"
    assert dict(caught.value.refusal.values) == {"all": "6", "wrong": wrong}


def test_an_order_that_cuts_out_what_has_still_to_be_cut_within_is_refused() -> None:
    with pytest.raises(CannotCutError) as caught:
        ordered(PLATE, Making(order=(4, 2, 3, 5, 1, 6)))
    assert caught.value.refusal.why == "order-falls"
    assert dict(caught.value.refusal.values) == {"number": "3", "around": "2"}


@pytest.mark.alike(5)
@pytest.mark.parametrize("seed", range(20))
def test_in_nested_squares_at_random_nothing_is_cut_before_what_lies_within(seed: int) -> None:
    rng = random.Random(seed)
    figures: list[Figure] = []
    lies_in: dict[int, tuple[int, ...]] = {}

    def fill(box: tuple[float, float, float], depth: int, part: int, inside: tuple[int, ...]) -> None:
        number = len(figures) + 1
        lies_in[number] = inside
        figures.append(square(number, part if depth % 2 else number, depth, box, rng.choice("AB")))
        own = figures[-1].part
        for row in range(4 if depth < 4 and rng.random() < 0.7 else 0):
            third = box[2] / 2.0
            inner = (box[0] + third * (row % 2) + 0.1 * third, box[1] + third * (row // 2) + 0.1 * third, 0.8 * third)
            fill(inner, depth + 1, own, (*inside, number))

    for at in range(3):
        fill((200.0 * at, 0.0, 100.0), 0, 0, ())
    rng.shuffle(figures)
    outer = around(figures)
    for figure, at in zip(figures, outer, strict=True):
        assert (figures[at].number if at >= 0 else None) == (lies_in[figure.number] or (None,))[-1]
    wishes = (LayerWish("A", rank=rng.choice([None, 1, 2])), LayerWish("B", rank=rng.choice([None, 1, 2])))
    order = ordered(figures, Making(layers=wishes))
    assert sorted(order) == sorted(lies_in)
    for number, inside in lies_in.items():
        assert all(order.index(number) < order.index(one) for one in inside)


def test_the_wire_runs_inside_of_holes_and_outside_of_parts_or_as_is_asked() -> None:
    assert [one.runs_inside for one in with_sides(PLATE, Making())] == [False, True, False, True, True, False]
    assert all(one.runs_inside for one in with_sides(PLATE, Making(side="inside")))
    wish = LayerWish("small", side="outside")
    assert [one.runs_inside for one in with_sides(PLATE, Making(side="inside", layers=(wish,)))] == [True] * 4 + [
        False,
        False,
    ]


def test_one_side_has_the_wire_on_the_left_of_all_contours() -> None:
    for figure in PLATE:
        way = way_of(figure, Making())
        assert way.side.name == "LEFT"
        assert way.is_ccw == figure.runs_inside
        for direction in ("ccw", "cw"):
            asked = way_of(figure, Making(direction=direction))
            assert asked.is_ccw == (direction == "ccw")
            assert (asked.side.name == "LEFT") == (asked.is_ccw == figure.runs_inside)


def test_a_wish_for_a_layer_without_a_figure_is_refused_by_its_name() -> None:
    wishes = LayerWish("SMALL", rank=1), LayerWish("smalls", side="inside")
    with pytest.raises(CannotCutError) as caught:
        refuse_strange_layers(PLATE, Making(layers=wishes))
    refusal = caught.value.refusal
    assert refusal.why == "no-such-layer"
    assert dict(refusal.values)["layer"] == "smalls"
    assert "SMALL" in dict(refusal.values)["layers"].split(", ")
