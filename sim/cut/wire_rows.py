"""How far the wire reaches, and how far it lags, in each row of a path: as the technology has it for the row's pass."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.shape.passes import Passes, find_passes, pass_numbers
from parser.toolpath import Toolpath
from sim.setup.scenario import Scenario


class WireRows(NamedTuple):
    """The wire by row.

    Attributes
    ----------
    reach_um
        (n,) half the width of the kerf.
    lag_um
        (n,) how far the wire bows back behind its guides.
    spread_um
        (n, 2) by how much the reach may be less, below 0, and by how much more: the interval of the gap.
    """

    reach_um: Floats
    lag_um: Floats
    spread_um: Floats


def wire_rows(toolpath: Toolpath, scenario: Scenario, passes: Passes | None = None) -> WireRows:
    """The wire in each row of a path; its passes are found where nobody knows them yet."""
    number = np.ones(len(toolpath), dtype=np.int64)
    if scenario.technology is not None:
        number = pass_numbers(toolpath, find_passes(toolpath) if passes is None else passes)
    numbers = range(1, int(number.max(initial=1)) + 1)
    gaps = [scenario.technology_of(each).gap_um for each in numbers]
    reach, lag, spread = (
        np.array([scenario.reach_um(each) for each in numbers]),
        np.array([scenario.lag_um(each) for each in numbers]),
        np.array([(gap.least - gap.value, gap.most - gap.value) for gap in gaps]),
    )
    return WireRows(reach[number - 1], lag[number - 1], spread[number - 1])
