"""On which side of each loop the part lies, where no lead-in tells: as loops lie in each other."""

from collections.abc import Sequence

import numpy as np
import shapely

from parser.geometry.curves import Ints
from sim.measure.compare.rings import Ring, orientation, polygon


def nested_sides(rings: Sequence[Ring]) -> Ints:
    """Side (k,) of each ring's part, +1 left, −1 right, if outermost rings are parts and those in them holes."""
    shapes = [polygon(ring.curves) for ring in rings]
    begins = shapely.points([ring.curves.start_um[0] for ring in rings])
    inner, _ = shapely.STRtree(shapes).query(begins, predicate="within")
    depth = np.bincount(inner, minlength=len(rings))
    turns = np.array([orientation(ring.curves) for ring in rings], dtype=np.int64)
    return turns * np.where(depth % 2 == 0, 1, -1)
