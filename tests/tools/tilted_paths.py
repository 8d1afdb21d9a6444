"""Paths of a wire that leans, made by another road than the code: contours of corners, and pairs that are walked."""

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from controller.taper.tilted import Heights
from parser.controller_words import Taper
from parser.geometry.curves import Curves, Floats, Ints, curves_between
from parser.text.source import Source
from parser.toolpath import Toolpath

HEIGHTS = Heights(work_um=40_000.0, program_um=0.0, lower_guide_um=-60_000.0, upper_guide_um=140_000.0)
SQUARE = [(10, -5), (10, 0), (20, 0), (20, 20), (0, 20), (0, 0), (10, 0), (10, -5)]
"""Corners, mm, of a square of 20 mm that a wire comes to at the middle of an edge, and leaves there."""


Arcs = Mapping[int, tuple[tuple[float, float], float]]
"""Centres mm and sweeps of rows that are arcs."""


def contour(places_mm: Sequence[tuple[float, float]], arcs: Arcs = MappingProxyType({})) -> Curves:
    """Lines between places; those of `arcs` are arcs."""
    places = 1000.0 * np.array(places_mm, dtype=np.float64)
    center, sweep = np.full((len(places) - 1, 2), np.nan), np.zeros(len(places) - 1)
    for row, (middle, by) in arcs.items():
        center[row], sweep[row] = 1000.0 * np.array(middle), by
    return curves_between(places[:-1], places[1:], center, sweep)


def toolpath_of(curves: Curves) -> Toolpath:
    """Some curves as a toolpath without a text."""
    n = len(curves)
    source = Source("", np.arange(1, n + 1), np.zeros((n, 2), dtype=np.int64), np.ones(n, dtype=np.int64), ("",) * n)
    return Toolpath(
        **{name: getattr(curves, name) for name in Curves.__slots__},
        printed_end_um=np.full((n, 2), np.nan),
        words=None,
        source=source,
        stops=(),
    )


def lean(path: Curves, side: int, angle_rad: float) -> Taper:
    """One angle from the first row on, taken back by the last."""
    sides = np.full(len(path), side, dtype=np.int64)
    sides[-1] = 0
    return Taper(sides, np.full(len(path), angle_rad))


_EIGHTHS = [(10, 0), (10, 10), (0, 10), (-10, 10), (-10, 0), (-10, -10), (0, -10), (10, -10), (10, 0)]
SQUARE_UP = toolpath_of(contour([(0, 0), *_EIGHTHS, (0, 0)]))
"""A square of 20 mm in eight halves of its sides, with a way there and back from its middle."""
_ROUND = [(8.0 * math.cos(at), 8.0 * math.sin(at)) for at in np.arange(9) * math.pi / 4.0]
ROUND = contour([(0, 0), *_ROUND, (0, 0)], dict.fromkeys(range(1, 9), ((0, 0), math.pi / 4.0)))
"""A circle of 8 mm radius in eight arcs, likewise."""


def random_pair(seed: int) -> tuple[Toolpath, Curves, Callable[[Ints, Floats, float], Floats]]:
    """Two closed contours of lines and arcs, matched; and where the wire is at shares of rows, at a share of height."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(4, 9))
    lower, upper = (_ring(rng, n, size) for size in (20.0, float(rng.uniform(8.0, 30.0))))

    def walked(row: Ints, share: Floats, height: float) -> Floats:
        low, high = (
            np.stack([_walk(of, *at) for at in zip(row.tolist(), share, strict=True)]) for of in (lower, upper)
        )
        return low * (1.0 - height) + high * height

    return toolpath_of(lower), upper, walked


def _ring(rng: np.random.Generator, n: int, size_mm: float) -> Curves:
    """n rows round the origin; about half of them are arcs over their chords."""
    at = 2.0 * math.pi * (np.arange(n) + rng.uniform(-0.2, 0.2, n)) / n
    out = size_mm * rng.uniform(0.7, 1.3, n)
    places = [(r * math.cos(a), r * math.sin(a)) for r, a in zip(out, at, strict=True)]
    places.append(places[0])
    arcs = {}
    for row in np.flatnonzero(rng.random(n) < 0.5).tolist():
        start, end = np.array(places[row]), np.array(places[row + 1])
        sweep = float(rng.uniform(0.2, 1.5) * rng.choice([-1, 1]))
        chord = end - start
        middle = 0.5 * (start + end) + np.array([-chord[1], chord[0]]) * 0.5 / math.tan(0.5 * sweep)
        arcs[row] = ((float(middle[0]), float(middle[1])), sweep)
    return contour(places, arcs)


def _walk(curves: Curves, row: int, share: float) -> Floats:
    """A place (2,) along a row: straight on, or by turning its start about its centre."""
    start, sweep = curves.start_um[row], float(curves.sweep_rad[row])
    if not sweep:
        return start + share * (curves.end_um[row] - start)
    cos, sin = math.cos(share * sweep), math.sin(share * sweep)
    x, y = (start - curves.center_um[row]).tolist()
    return curves.center_um[row] + np.array([x * cos - y * sin, x * sin + y * cos])
