"""Passes over each edge of a run, and what each came to."""

import numpy as np

from controller.motion.plan import Plan
from parser.geometry.curves import Floats
from parser.shape.passes import Passes, find_passes
from sim.measure.passes.figures import PassFigures, figures_of_passes, wire_taken
from sim.run.ending import Ending
from sim.run.prepare import Prepared
from sim.setup.scenario import Scenario
from sim.table.trace import Trace


def passes_of(
    ready: Prepared, scenario: Scenario, plan: Plan, cut: Trace, ended: Ending | None
) -> tuple[Passes, tuple[PassFigures, ...], Floats]:
    """Passes over each edge, what they came to, and planned times (n + 1,) s: of each block's start, and the last end.

    `cut` is the trace as far as the machine ran, until where it `ended`.
    """
    toolpath = ready.program.toolpath
    passes = find_passes(toolpath) if ready.offset is None else ready.offset.edge_passes
    border_s = plan.border_s(ready.steps.along_um)
    time_s = np.diff(np.minimum(border_s, ended.t_s if ended else plan.duration_s))
    way = wire_taken(toolpath, plan, cut)
    return passes, figures_of_passes(toolpath, passes, time_s, way, scenario.wire.reach_um), border_s
