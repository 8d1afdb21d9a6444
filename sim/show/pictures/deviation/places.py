"""The worst places of a cut: where the wire is furthest off, no two of them in one view."""

from itertools import product
from typing import Final

import numpy as np

from parser.geometry.curves import Ints
from sim.show.draw.flatten import bounds_um
from sim.show.pictures.deviation.samples import Samples

MOST: Final = 4
APART_UM: Final = 80.0
"""No two places are closer together than this: a view is smaller."""
APART: Final = 0.05
"""While enough places keep it, no two are closer than this share of the path's longer side."""
STRETCH_UM: Final = 200.0
"""The worst place of each stretch of this length is a candidate, after the worst places of the blocks."""
CANDIDATES: Final = 1000
LEAST_UM: Final = 0.05
"""Places where the wire is off by less do not show, but for the worst one."""


def worst_places(samples: Samples) -> Ints:
    """Samples (≤ `MOST`,) of the worst places, the worst first: of different blocks while there are others.

    Empty where nothing was cut.
    """
    cut = np.flatnonzero(samples.cutting)
    of_blocks = worst_of(samples, cut, samples.trace.row[cut])
    of_stretches = worst_of(samples, cut, np.floor(samples.along_um[cut] / STRETCH_UM).astype(np.int64))
    candidates = [*of_blocks[:CANDIDATES].tolist(), *of_stretches[:CANDIDATES].tolist()]
    low, high = bounds_um(samples.run.toolpath)
    taken: list[int] = []
    for apart, at in product((max(APART * float((high - low).max()), APART_UM), APART_UM), candidates):
        if len(taken) < MOST and _clear(samples, taken, at, apart):
            taken.append(at)
    off = np.abs(samples.wire_um[taken])
    return np.array(taken, dtype=np.int64)[np.argsort(-off, kind="stable")]


def worst_of(samples: Samples, chosen: Ints, group: Ints) -> Ints:
    """Of samples (m,) in groups (m,), which never fall, the worst of each group: its first one; the worst first."""
    off = np.abs(samples.wire_um[chosen])
    first = np.flatnonzero(np.diff(group, prepend=-1))
    worst = np.maximum.reduceat(off, first) if len(first) else off
    among = np.flatnonzero(off == np.repeat(worst, np.diff(first, append=len(off))))
    best = among[np.flatnonzero(np.diff(group[among], prepend=-1))]
    return chosen[best[np.argsort(-off[best], kind="stable")]]


def _clear(samples: Samples, taken: list[int], at: int, apart_um: float) -> bool:
    """Whether a sample is the first, or the wire is off there and it stands apart from those taken."""
    if not taken:
        return True
    by = samples.trace.wire_um[taken] - samples.trace.wire_um[at]
    return bool(abs(samples.wire_um[at]) >= LEAST_UM and np.hypot(by[:, 0], by[:, 1]).min() >= apart_um)
