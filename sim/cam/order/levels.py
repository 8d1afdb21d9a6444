"""What must be cut before what: figures by how deep they lie, and by the ranks of their layers."""

import math
from collections.abc import Sequence

import numpy as np

from parser.geometry.curves import Ints
from sim.cam.model import Figure
from sim.setup.making import Making


def levels(figures: Sequence[Figure], around: Sequence[int], making: Making) -> tuple[Ints, ...]:
    """Indices of figures that may be cut in any order, level after level.

    The deepest come first, so that a part falls only once its holes are cut, and islands before the pocket in which
    they stand. Layers with a rank come before that, the lowest first, and those without one last; but a figure waits
    for all that lies within it.
    """
    ranks = {wish.layer.casefold(): wish.rank for wish in making.layers if wish.rank is not None}
    rank = [float(ranks.get(figure.layer.casefold(), math.inf)) for figure in figures]
    for at in sorted(range(len(figures)), key=lambda one: -figures[one].depth):
        if around[at] >= 0:
            rank[around[at]] = max(rank[around[at]], rank[at])
    keys = [(rank[at], -figure.depth) for at, figure in enumerate(figures)]
    return tuple(np.array([at for at, key in enumerate(keys) if key == one]) for one in sorted(set(keys)))
