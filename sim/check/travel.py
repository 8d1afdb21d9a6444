"""The table's travel: which block first leaves it."""

from typing import TYPE_CHECKING

import numpy as np

from controller.stepping.steps import Steps
from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.geometry.extents import extents
from parser.program import Program
from parser.told.step_words import Axis
from parser.toolpath import Toolpath
from parser.units import from_mm, mm

if TYPE_CHECKING:
    from sim.setup.machine.table_model import TableModel


def travel_findings(
    program: Program, steps: Steps, table: "TableModel", start_um: tuple[float, float]
) -> list[Finding]:
    """Finding 3B401 for the first block that leaves the travel, as stepped from a start on the table."""
    toolpath = program.toolpath
    beyond = beyond_um(toolpath, steps, table, start_um)
    out = np.flatnonzero((beyond > ROUNDING_UM).any(axis=1))
    if not len(out):
        return []
    row = int(out[0])
    axis = int(np.argmax(beyond[row]))
    return [
        at_block(
            toolpath,
            program.lines,
            "3B401",
            row,
            x_mm=table.travel_x_mm,
            y_mm=table.travel_y_mm,
            axis=Axis(axis).name,
            by=float(beyond[row, axis]),
        )
    ]


def beyond_um(toolpath: Toolpath, steps: Steps, table: "TableModel", start_um: tuple[float, float]) -> Floats:
    """How far (n, 2) µm each block goes beyond the travel in X and Y, as stepped from a start on the table; ≤ 0 within.

    The table stands where the steps of earlier blocks left it, not where these should have ended.
    """
    low, high = extents(toolpath)
    shift = np.array(start_um) + steps.corner_um[:-1] - toolpath.start_um
    travel = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    beyond: Floats = np.maximum(-(low + shift), high + shift - travel)
    return beyond


def middle_mm(toolpath: Toolpath, table: "TableModel") -> tuple[float, float] | None:
    """Where a path begins, mm on the table, so that it lies in the middle of the travel; None without a path."""
    if not len(toolpath):
        return None
    low, high = extents(toolpath)
    ahead = toolpath.start_um[0] - 0.5 * (low.min(axis=0) + high.max(axis=0))
    x, y = (0.5 * np.array([table.travel_x_mm, table.travel_y_mm]) + mm(ahead)).tolist()
    return x, y


ROUNDING_UM = 0.5
"""Half a step: a path may go so far beyond the travel."""
