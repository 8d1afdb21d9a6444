"""Which figure lies directly around each one."""

from collections.abc import Sequence

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Floats
from parser.geometry.extents import extents
from parser.geometry.inside import is_inside
from sim.make.cam.model import Figure

_PLACES = 8  # of a contour that say within which others it lies; some of them may lie on one that touches it


def around(figures: Sequence[Figure]) -> tuple[int, ...]:
    """Index of the figure directly around each one, −1 where there is none: of a hole the outline of its part."""
    outlines = {figure.part: at for at, figure in enumerate(figures) if figure.kind == "outline"}
    found = [outlines.get(figure.part, -1) if figure.kind == "hole" else -1 for figure in figures]
    islands = np.array([at for at, one in enumerate(figures) if one.kind == "outline" and one.depth], dtype=np.int64)
    if len(islands):
        spread = np.stack([_spread(figures[at]) for at in islands.tolist()])
        depth = np.array([figures[at].depth for at in islands.tolist()])
        for at, figure in enumerate(figures):
            if figure.kind == "hole":
                which = np.flatnonzero(depth == figure.depth + 1)
                for one in islands[which[_lie_within(figure, spread[which])]].tolist():
                    found[one] = at
    return tuple(found)


def _spread(figure: Figure) -> Floats:
    """Places (`_PLACES`, 2) along a contour."""
    length = np.linspace(0.0, 1.0, _PLACES, endpoint=False) * figure.contour.length_um.sum()
    before = figure.contour.before_um
    row = np.clip(np.searchsorted(before, length, side="right") - 1, 0, len(figure.contour) - 1)
    return places(figure.contour, row, (length - before[row]) / figure.contour.length_um[row])


def _lie_within(figure: Figure, spread_um: Floats) -> list[bool]:
    """Whether contours with places (k, m, 2) lie within a figure: those that lie in its box are looked at."""
    low, high = (edge(ends, axis=0) for edge, ends in zip((np.min, np.max), extents(figure.contour), strict=True))
    within = [False] * len(spread_um)
    in_box = ((spread_um >= low) & (spread_um <= high)).all(axis=2).mean(axis=1) > 0.5
    for at in np.flatnonzero(in_box).tolist():
        within[at] = bool(is_inside(figure.contour, spread_um[at]).mean() > 0.5)
    return within
