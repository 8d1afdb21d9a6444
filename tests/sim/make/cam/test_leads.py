"""Leads: from the thread point to the pass, round into it where that is asked, and back the way they came."""

import numpy as np
import pytest

from parser.drawing.model import Entity
from parser.geometry.along import directions, places
from parser.geometry.curves import Curves, curves_between
from parser.toolpath import Point
from sim.make.cam.leads import (
    are_free,
    balls_um,
    lead_in,
    lead_of,
    lead_out,
    nearest,
    room_of,
)
from sim.make.cam.model import Entry, Figure, Thread
from sim.setup.making import LeadIn

SQUARE = np.array([[0.0, 0.0], [1e4, 0.0], [1e4, 1e4], [0.0, 1e4]])


def closed(corner: np.ndarray) -> Curves:
    return curves_between(corner, np.roll(corner, -1, axis=0), np.full_like(corner, np.nan), np.zeros(len(corner)))


def hole(contour: Curves) -> Figure:
    return Figure(
        1, "hole", 1, 1, contour, np.zeros(len(contour), dtype=np.int64), Entity("LINE", "1", "0", ""), runs_inside=True
    )


def ring(radius: float) -> Curves:
    start = np.array([[radius, 0.0]])
    return curves_between(start, start, np.zeros((1, 2)), np.array([2.0 * np.pi]))


@pytest.mark.parametrize("form", ["perpendicular", "arc", "tangent"])
@pytest.mark.parametrize("turn", [0.0, 0.3, 2.0, 4.0])
@pytest.mark.parametrize("is_left", [True, False])
def test_each_form_joins_both_ends_in_the_circle_about_the_thread_point(
    form: LeadIn, turn: float, is_left: bool
) -> None:
    heading = np.array([np.cos(turn), np.sin(turn)])
    out = np.array([-heading[1], heading[0]]) * (1.0 if is_left else -1.0)
    end = np.array([300.0, -200.0])
    start = end + 1500.0 * out
    way = lead_of(form, start, end, heading)
    assert way.start_um[0] == pytest.approx(start)
    assert way.end_um[-1] == pytest.approx(end)
    assert way.start_um[1:] == pytest.approx(way.end_um[:-1])
    arriving, leaving = directions(way).arriving, directions(way).leaving
    for row in range(len(way)):
        spread = places(way, np.full(100, row), np.linspace(0.0, 1.0, 100))
        assert spread[-1] == pytest.approx(way.end_um[row], abs=1e-6)
        assert (np.hypot(*(spread - start).T) <= 1500.0 + 1e-6).all()
    if form == "perpendicular":
        assert len(way) == 1
    else:
        assert arriving[-1] == pytest.approx(heading, abs=1e-9)
    if form == "tangent":
        assert leaving[1] == pytest.approx(arriving[0], abs=1e-9)


def test_a_lead_that_is_short_or_does_not_come_across_is_straight() -> None:
    heading = np.array([1.0, 0.0])
    for start in ([0.0, 10.0], [500.0, 500.0]):
        assert lead_of("arc", np.array(start), np.zeros(2), heading).is_arc.tolist() == [False]
    assert len(lead_of("arc", np.zeros(2), np.zeros(2), heading)) == 0


@pytest.mark.parametrize("form", ["perpendicular", "arc", "tangent"])
def test_a_pass_goes_back_as_it_came_and_from_elsewhere_straight(form: LeadIn) -> None:
    thread = Thread(Point(5000, 2000), "asked", Entry(0, 5e3, Point(5000, 0), Point(0.0, 1.0)), form)
    around = closed(np.array([[5e3, 100.0], [9.9e3, 100.0], [9.9e3, 9.9e3], [100.0, 9.9e3], [100.0, 100.0]]))
    into, out = (lead(thread, around) for lead in (lead_in, lead_out))
    assert out.start_um == pytest.approx(into.end_um[::-1])
    assert out.end_um == pytest.approx(into.start_um[::-1])
    assert out.sweep_rad == pytest.approx(-into.sweep_rad[::-1])
    early = lead_out(thread, around.picked(slice(2)))
    assert (early.start_um.tolist(), early.end_um.tolist()) == ([[9.9e3, 9.9e3]], [[5e3, 2e3]])


@pytest.mark.parametrize("radius", [200.0, 900.0, 5000.0])
def test_the_largest_circle_in_a_round_hole_is_the_hole(radius: float) -> None:
    angle = np.linspace(0.0, 6.0, 13)
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    room = room_of([hole(ring(radius))])
    assert balls_um(room, radius * way, -way, 2000.0) == pytest.approx(np.full(13, min(radius, 2000.0)), abs=2e-3)


def test_the_largest_circle_beside_a_side_of_a_square_touches_the_next_one() -> None:
    """At a distance d from the corner it touches both sides: its radius is d, and half the side at most."""
    along = np.array([100.0, 2000.0, 4999.0, 5000.0, 7000.0])
    room = room_of([hole(closed(SQUARE))])
    place, out = np.stack([along, np.zeros(5)], axis=1), np.tile([0.0, 1.0], (5, 1))
    wanted = np.minimum(along, 1e4 - along)
    assert balls_um(room, place, out, 1e5) == pytest.approx(wanted, abs=2e-3)


def test_a_circle_is_free_as_far_as_nothing_lies_within() -> None:
    for seed in range(20):
        rng = np.random.default_rng(seed)
        turn = np.sort(rng.uniform(0.0, 2.0 * np.pi, 12))
        contour = closed(rng.uniform(2e3, 9e3, (12, 1)) * np.stack([np.cos(turn), np.sin(turn)], axis=1))
        room, row = room_of([hole(contour)]), np.arange(12)
        place = places(contour, row, np.full(12, 0.5))
        by = contour.end_um - contour.start_um
        out = np.stack([-by[:, 1], by[:, 0]], axis=1) / contour.length_um[:, None]
        radius = balls_um(room, place, out, 3000.0)
        clear = nearest(room, place + radius[:, None] * out, 4000.0).distance_um
        assert clear == pytest.approx(radius, abs=2e-3)
        # A larger one holds some of the contour, unless it is as large as is asked.
        larger = nearest(room, place + 1.01 * radius[:, None] * out, 4000.0).distance_um
        assert ((larger < 1.01 * radius - 1e-3) | (radius == 3000.0)).all()


def test_ways_are_free_up_to_the_distance_at_which_they_pass() -> None:
    room = room_of([hole(closed(SQUARE))])
    way = curves_between(
        np.array([[5e3, 5e3], [5e3, 5e3]]), np.array([[5e3, 300.0], [1e3, 7e3]]), np.zeros((2, 2)), np.zeros(2)
    )
    assert are_free(room, way, 300.0).tolist() == [True, True]
    assert are_free(room, way, 300.1).tolist() == [False, True]
    assert are_free(room, way, 1000.1).tolist() == [False, False]
