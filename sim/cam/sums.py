"""What each figure of a made program comes to: blocks, length and time."""

from typing import NamedTuple

import numpy as np

from parser.shape.contours import runs
from sim.cam.maker import Made


class FigureSum(NamedTuple):
    """What a figure comes to, all its passes with their leads.

    Attributes
    ----------
    blocks, length_um
        Of the program as written.
    time_s
        What it takes on the machine of the proof; None where nothing ran.
    """

    blocks: int
    length_um: float
    time_s: float | None


def figure_sums(made: Made) -> tuple[FigureSum, ...]:
    """One for each cut of the plan, in running order: jumps part them, in the text and in what ran."""
    toolpath, run = made.program.toolpath, made.proof and made.proof.run
    times: list[float | None] = [None] * len(made.plan.cuts)
    if run is not None and len(ran := runs(run.toolpath)) == len(times):
        times = [float(np.sum(run.block_time_s[first:past])) for first, past in ran.tolist()]
    return tuple(
        FigureSum(past - first, float(np.sum(toolpath.length_um[first:past])), time_s)
        for (first, past), time_s in zip(runs(toolpath).tolist(), times, strict=False)
    )
