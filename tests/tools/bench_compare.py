"""A cut edge against a drawing of as many entities, and every curve against every curve beside it."""

import time
from typing import NamedTuple

import numpy as np
from compare_cases import drawing_from, edge_from

from parser.geometry.curves import Curves, Floats, curves_between
from parser.geometry.distance import distance_to_curves
from sim.measure.compare.compare import compare
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.result import FitRequest
from sim.measure.compare.starts import Placement, placed, spread


class Compared(NamedTuple):
    """Seconds of a whole comparison, and for the nearest curve of one place by tree and by all pairs."""

    whole_s: float
    tree_s: float
    all_pairs_s: float


def wavy(n: int) -> Curves:
    """A closed contour of n curves about a circle of R 50 mm, two lines to one arc."""
    angle = np.arange(n) * (2.0 * np.pi / n)
    radius = 50_000.0 + 2000.0 * np.sin(40.0 * angle) + 500.0 * np.cos(7.0 * angle)
    start = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    end = np.roll(start, -1, axis=0)
    sweep = np.where(np.arange(n) % 3 == 2, 0.3, 0.0)
    by = end - start
    across = np.stack([-by[:, 1], by[:, 0]], axis=1) / (2.0 * np.tan(0.15))
    return curves_between(start, end, 0.5 * (start + end) + across, sweep)


def compared(n: int) -> Compared:
    """Compare n blocks, turned and shifted, with n entities."""
    drawn = wavy(n)
    edge = placed(drawn, Placement(0.7, (1000.0, 2000.0), mirror=False))
    began = time.perf_counter()
    found = compare(edge_from([edge]), drawing_from([drawn]), FitRequest(5.0))
    whole = time.perf_counter() - began
    if not found.passes:
        raise ValueError(f"a drawing laid on itself lies {found.max_um} µm off")
    place = spread(drawn, 2 * n).place_um + 3.0
    began = time.perf_counter()
    by_tree = nearest(indexed(drawn), place).distance_um
    tree = (time.perf_counter() - began) / len(place)
    every = max(1, len(place) // 200)
    began = time.perf_counter()
    by_all = all_pairs(drawn, place[::every])
    all_ = (time.perf_counter() - began) / len(by_all)
    if np.abs(by_tree[::every] - by_all).max() > 1e-6:
        raise ValueError("the tree and all pairs find other distances")
    return Compared(whole, tree, all_)


def all_pairs(curves: Curves, place_um: Floats) -> Floats:
    """Distances (m,) of places from the nearest of all curves, each looked at."""
    row = np.arange(len(curves))
    least = [distance_to_curves(curves, row, *(np.full(len(row), by) for by in at))[0].min() for at in place_um]
    return np.array(least)


def compare_lines(n: int) -> list[str]:
    """What the benchmark prints of a comparison."""
    times = compared(n)
    ratio = times.all_pairs_s / times.tree_s
    return [
        f"compare             {times.whole_s:.2f} s, {n:,} blocks against {n:,} entities, fitted, both ways",
        f"nearest curve       {times.tree_s * 1e6:.1f} µs a place with its tree, by all pairs {ratio:.0f} times",
    ]
