"""Thread points that lie apart: where one start hole is, there is no room for another one."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import shapely

from parser.geometry.curves import Bools, Floats, Ints
from sim.cam.model import Thread

HOLE_UM: Final = 1000.0
"""Thread points lie apart by a start hole of 1 mm (assumed).

A reader of 3B takes what ends within a kerf of a figure's corner for another pass over it (`parser.shape.beside`): so
near to one thread point no jump leads to another one.
"""


def are_apart(place_um: Floats, kept_um: Floats) -> Bools:
    """(m,) which of places (m, 2) lie apart from all that are kept (k, 2)."""
    apart = np.ones(len(place_um), dtype=np.bool_)
    apart[_near(place_um, kept_um)[0]] = False
    return apart


def crowded(threads: Mapping[int, Thread], kept_um: Floats) -> list[int]:
    """Figures whose thread points lie near those that are kept (k, 2), or near that of another figure that stays."""
    figures = sorted(threads)
    place_um = np.array([threads[at].place_um for at in figures]).reshape(-1, 2)
    moving = ~are_apart(place_um, kept_um)
    one, other = _near(place_um, place_um)
    for first, second in sorted(zip(other.tolist(), one.tolist(), strict=True)):
        if first < second and not moving[first]:
            moving[second] = True
    return [figures[at] for at in np.flatnonzero(moving).tolist()]


def _near(place_um: Floats, kept_um: Floats) -> tuple[Ints, Ints]:
    """Pairs of places (m, 2) and of those that are kept (k, 2) that lie nearer than a start hole, by their rows."""
    tree = shapely.STRtree(np.asarray(shapely.points(kept_um), dtype=np.object_))
    place, kept = tree.query(shapely.points(place_um), predicate="dwithin", distance=HOLE_UM)
    return place, kept
