"""Four axes: a table that moves the lower guide, a head that moves the upper one against it, and the wire between."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.motion.limits import Feeds
from controller.motion.plan import Plan
from controller.taper.axes import AxisLimits, guide_pulses, plan_guides, whole_um
from controller.taper.tilted import TiltedPath
from parser.geometry.curves import Floats, Ints, total_before
from parser.units import from_mm
from sim.setup.machine.guides import Guides
from sim.setup.machine.machine import Machine
from sim.table.follow import Following, Setup
from sim.table.losses import Loss
from sim.table.ticks import Sampling, choose_ticks, rhythm
from sim.table.trace import Trace


class FourAxes(NamedTuple):
    """How both guides moved.

    Attributes
    ----------
    path, plan
        What they followed.
    lower, aside
        Traces of the lower guide, and of the upper one against it; rows are those of the tilted path.
    lost_xy, lost_uv
        What the drives lost.
    pulses
        How many pulses X and Y, and U and V were given.
    """

    path: TiltedPath
    plan: Plan
    lower: Trace
    aside: Trace
    lost_xy: tuple[Loss, ...]
    lost_uv: tuple[Loss, ...]
    pulses: tuple[int, int]

    def wire_um(self, z_um: float) -> Floats:
        """Where the wire was at a height (n, 2), at the samples of the lower guide."""
        heights = self.path.heights
        share = (z_um - heights.lower_guide_um) / heights.span_um
        aside = [np.interp(self.lower.t_s, self.aside.t_s, column) for column in self.aside.table_um.T]
        wire: Floats = self.lower.table_um + share * np.stack(aside, axis=1)
        return wire

    def shares(self) -> Floats:
        """(n,) the share of its row that was to be done at each sample of the lower guide."""
        length = self.path.ruled.length_um
        done = self.plan.at(self.lower.t_s).along_um - total_before(length)[self.lower.row]
        size = length[self.lower.row]
        return np.clip(done / np.where(size > 0.0, size, 1.0), 0.0, 1.0)


def follow_tilted(  # noqa: PLR0913, PLR0917 - what moves, by what, how fast, and how closely it is watched
    path: TiltedPath,
    feeds: Feeds,
    machine: Machine,
    guides: Guides,
    start_um: tuple[float, float],
    rests: Ints,
    sampling: Sampling,
) -> FourAxes:
    """Let a table and its head follow a tilted path; the head as the machine's own table where nobody says another."""
    limits = machine.controller.limits
    (fast_x, fast_y), (fast_u, fast_v) = limits.axis_speed_um_s, guides.speed_um_s
    (quick_x, quick_y), (quick_u, quick_v) = limits.axis_acceleration_um_s2, guides.acceleration_um_s2
    axes = AxisLimits((fast_x, fast_y, fast_u, fast_v), (quick_x, quick_y, quick_u, quick_v))
    planned, ruled = plan_guides(path, feeds, limits, axes, rests), path.ruled
    plan = planned.plan
    longer = ruled.upper if ruled.upper.length_um.sum() > ruled.lower.length_um.sum() else ruled.lower
    ways = replace(longer, length_um=ruled.length_um)
    head = guides.head(machine.table)
    x, y, u, v = whole_um(path.axes_um(np.zeros(1, dtype=np.int64), np.zeros(1)))[0].tolist()
    middle_um = from_mm(head.travel_x_mm) / 2.0, from_mm(head.travel_y_mm) / 2.0
    pairs = [
        (machine.table, start_um, (x, y), (fast_x, fast_y)),
        (head, middle_um, (u, v), (fast_u, fast_v)),
    ]
    tables = [
        Following(Setup(model, start, origin, speed, machine.engine), choose_ticks(ways, plan, rhythm(model), sampling))
        for model, start, origin, speed in pairs
    ]
    counts = [0, 0]
    for both in guide_pulses(path, planned):
        for at, (table, pulses) in enumerate(zip(tables, both, strict=True)):
            if len(pulses.t_s):
                table.take(pulses)
                counts[at] += len(pulses.t_s)
    moved = [table.finish() for table in tables]
    (lower, _, lost_xy, *_), (aside, _, lost_uv, *_) = moved
    return FourAxes(path, plan, lower, aside, lost_xy, lost_uv, (counts[0], counts[1]))
