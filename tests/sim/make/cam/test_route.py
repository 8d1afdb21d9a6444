"""The way through places: each once, short, and the same whatever the order in which they are given."""

import math
from itertools import permutations

import numpy as np
import pytest

from parser.geometry.curves import Floats, Ints
from sim.make.cam.order import (
    from_nearest_to_nearest,
    neighbours,
    route,
    shortened,
    travel_um,
)

SEEDS = range(40)


def places_at_random(seed: int, number: int) -> Floats:
    """Places in whole mm, some of them the same and many in rows, as holes of a plate are."""
    rng = np.random.default_rng(seed)
    return 1000.0 * rng.integers(0, int(rng.choice([5, 30, 200])), (number, 2))


def plain_neighbours(place: Floats, number: int) -> Floats:
    """Distances (n, k) of the nearest others of each, by all of them."""
    off = np.hypot(*(place[:, None] - place[None]).transpose(2, 0, 1))
    np.fill_diagonal(off, np.inf)
    return np.sort(off, axis=1)[:, :number]


def by_x(place: Floats) -> Floats:
    return np.ascontiguousarray(place[np.lexsort(place.T[::-1])])


@pytest.mark.parametrize("seed", SEEDS)
def test_it_passes_each_place_once_and_begins_where_it_must(seed: int) -> None:
    number = seed % 15
    place = places_at_random(seed, number)
    assert sorted(route(place).tolist()) == list(range(number))
    if number:
        bound = seed % number
        bounded = route(place, bound).tolist()
        assert bounded[0] == bound
        assert sorted(bounded) == list(range(number))


@pytest.mark.parametrize("seed", SEEDS)
def test_of_few_places_it_is_the_shortest_within_5_per_cent(seed: int) -> None:
    place = places_at_random(seed, 3 + seed % 5)
    bound = seed % 3 if seed % 2 else None
    orders = [list(one) for one in permutations(range(len(place))) if bound is None or one[0] == bound]
    shortest = min(travel_um(place[one]) for one in orders)
    assert travel_um(place[route(place, bound)]) <= 1.05 * shortest + 1e-6


def test_of_places_at_random_it_is_as_short_as_is_known_within_10_per_cent() -> None:
    """0.7124 √(n A) for many places at random on an area A (Johnson, McGeoch and Rothberg 1996)."""
    place = np.random.default_rng(0).random((2500, 2)) * 1e5
    assert travel_um(place[route(place)]) <= 1.10 * 0.7124 * math.sqrt(2500.0) * 1e5


@pytest.mark.parametrize("number", [5, 40, 400])
def test_it_is_as_long_in_whatever_order_the_places_are_given(number: int) -> None:
    rng = np.random.default_rng(number)
    place = places_at_random(number, number)
    length = travel_um(place[route(place)])
    for _ in range(5):
        again = place[rng.permutation(number)]
        assert travel_um(again[route(again)]) == length


@pytest.mark.parametrize("number", [4, 30, 300, 1200])
@pytest.mark.parametrize("is_bound", [False, True])
def test_changes_never_make_a_way_longer_and_keep_its_bound_end(number: int, is_bound: bool) -> None:
    place = by_x(places_at_random(number, number))
    near = neighbours(place, min(8, number - 1))
    rng = np.random.default_rng(number)
    for order in (from_nearest_to_nearest(place, number // 2), rng.permutation(number)):
        better: Ints = shortened(place, near, order, int(order[0]) if is_bound else -1)
        assert sorted(better.tolist()) == list(range(number))
        assert travel_um(place[better]) <= travel_um(place[order])
        assert not is_bound or better[0] == order[0]


@pytest.mark.parametrize("seed", SEEDS[:10])
def test_neighbours_are_the_nearest_of_all(seed: int) -> None:
    place = by_x(places_at_random(seed, 60))
    near = neighbours(place, 7)
    found = np.hypot(*(place[near] - place[:, None]).transpose(2, 0, 1))
    assert np.array_equal(found, plain_neighbours(place, 7))
    assert all(len({at, *row}) == 8 for at, row in enumerate(near.tolist()))


@pytest.mark.parametrize("seed", SEEDS[:10])
def test_from_nearest_to_nearest_goes_to_none_that_is_farther_than_another_one(seed: int) -> None:
    place = by_x(places_at_random(seed, 50))
    order = from_nearest_to_nearest(place, seed)
    assert order[0] == seed
    assert sorted(order.tolist()) == list(range(50))
    for at in range(49):
        off = np.hypot(*(place[order[at + 1 :]] - place[order[at]]).T)
        assert off[0] == off.min()
