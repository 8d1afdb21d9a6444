"""Figures of each pass: length, time, stock and largest deviation."""

from typing import NamedTuple

import numpy as np

from controller.motion.plan import Plan
from parser.geometry.curves import Floats
from parser.shape.passes import Pass, Passes
from parser.toolpath import Point, Toolpath
from sim.measure.deviation.across import across_um
from sim.measure.passes.stock import Stock, WireTaken, stocks_of
from sim.table.trace import Trace


class Worst(NamedTuple):
    """The largest deviation of the wire, µm, and where it was met first."""

    deviation_um: float
    place_um: Point


class PassFigures(NamedTuple):
    """What a pass came to.

    Attributes
    ----------
    of
        The pass.
    length_um, time_s
        Length of its ideal path, and planned time on it.
    stock
        How much it takes off; None where the wire did not come to it.
    worst
        Where the wire deviates most; None where it did not come to it.
    """

    of: Pass
    length_um: float
    time_s: float
    stock: Stock | None
    worst: Worst | None


def figures_of_passes(
    toolpath: Toolpath, passes: Passes, block_time_s: Floats, way: WireTaken, reach_um: float
) -> tuple[PassFigures, ...]:
    """Figures of all passes, in the order they are cut, of the way that the wire took as far as the machine ran.

    `block_time_s` (n,) is the planned time in each block, `reach_um` half the width of the kerf.
    """
    stocks = stocks_of(toolpath, passes.passes, way, reach_um)
    return tuple(
        PassFigures(
            of=pass_,
            length_um=float(toolpath.length_um[pass_.first : pass_.last + 1].sum()),
            time_s=float(block_time_s[pass_.first : pass_.last + 1].sum()),
            stock=stock,
            worst=_worst(way.on(pass_)),
        )
        for pass_, stock in zip(passes.passes, stocks, strict=True)
    )


def wire_taken(toolpath: Toolpath, plan: Plan, trace: Trace) -> WireTaken:
    """The way that the wire took in a trace."""
    along = plan.at(trace.t_s).along_um
    off = across_um(toolpath, trace, trace.wire_um, along)
    return WireTaken(trace.row, trace.wire_um, along, off, trace.t_s)


def _worst(way: WireTaken) -> Worst | None:
    """The place of a way that lies farthest from the path, the first such; None where there is none."""
    if not len(way.row):
        return None
    at = int(np.argmax(np.abs(way.off_um)))
    return Worst(abs(float(way.off_um[at])), Point(*way.place_um[at].tolist()))
