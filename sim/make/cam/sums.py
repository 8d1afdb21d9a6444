"""What each figure of a made program comes to: blocks, length and time, and the time of each of its passes."""

from typing import NamedTuple

import numpy as np

from parser.shape.contours import runs
from parser.toolpath import Toolpath
from sim.make.cam.maker import Made
from sim.run.dryrun import DryRun


class FigureSum(NamedTuple):
    """What a figure comes to, all its passes with their leads.

    Attributes
    ----------
    first_block, blocks, length_um
        Of the program as written; 0 where it has not as many contours as there are figures.
    time_s
        What it takes on the machine of the proof; None where nothing ran.
    pass_s
        Of each pass, the cut-off behind them, without leads; empty where nothing ran, or the run has other passes.
    """

    first_block: int = 0
    blocks: int = 0
    length_um: float = 0.0
    time_s: float | None = None
    pass_s: tuple[float, ...] = ()


def figure_sums(made: Made) -> tuple[FigureSum, ...]:
    """One for each cut of the plan, in running order: jumps part them, in the text and in what ran."""
    toolpath, run = made.program.toolpath, made.proof and made.proof.run
    number = len(made.plan.cuts)
    written, ran = _rows(toolpath, number), _rows(run.toolpath, number) if run is not None else []
    sums = [_written(toolpath, *rows) for rows in written] or [FigureSum()] * number
    if run is None or not ran:
        return tuple(sums)
    passes = [len(cut.passes) + len(cut.cut_off) for cut in made.plan.cuts]
    return tuple(_timed(one, run, rows, many) for one, rows, many in zip(sums, ran, passes, strict=True))


def _rows(toolpath: Toolpath, number: int) -> list[list[int]]:
    """The first row of each figure and one past its last; none where the path has not as many contours."""
    found: list[list[int]] = runs(toolpath).tolist()
    return found if len(found) == number else []


def _written(toolpath: Toolpath, first: int, past: int) -> FigureSum:
    return FigureSum(int(toolpath.source.block[first]), past - first, float(np.sum(toolpath.length_um[first:past])))


def _timed(one: FigureSum, run: DryRun, rows: list[int], passes: int) -> FigureSum:
    first, past = rows
    time_s = run.block_time_s
    found = [each for each in run.passes.passes if first <= each.first < past]
    pass_s = [float(np.sum(time_s[each.first : each.last + 1])) for each in found]
    told = tuple(pass_s) if len(pass_s) == passes else ()
    return one._replace(time_s=float(np.sum(time_s[first:past])), pass_s=told)
