"""The scale of deviations, the same in all charts of a run."""

from typing import Final

import numpy as np

from sim.show.draw.chart import Range, range_of
from sim.show.pictures.deviation.samples import Samples

LEAST_UM: Final = 0.5
SEEN: Final = 0.25
"""A tolerance shows where deviations come to this share of it; a wider one would flatten them to a line."""


def range_shown(samples: Samples) -> Range:
    """Range of the deviations of wire and steps in the cut, of 0, and of the tolerance where they come near it."""
    shown = [samples.wire_um[samples.cutting], samples.steps_um[samples.cutting], np.zeros(1)]
    reached = max(float(np.abs(one).max(initial=0.0)) for one in shown)
    if reached >= SEEN * samples.tolerance_um:
        shown.append(samples.tolerance_um * np.array([-1.0, 1.0]))
    return range_of(*shown, least=LEAST_UM)
