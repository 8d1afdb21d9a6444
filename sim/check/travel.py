"""The table's travel: which block first leaves it."""

from typing import TYPE_CHECKING

import numpy as np

from controller.stepping.steps import Steps
from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.program import Program
from parser.toolpath import Axis, Toolpath
from parser.units import from_mm

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


def extents(toolpath: Toolpath) -> tuple[Floats, Floats]:
    """Lowest and highest places (n, 2) µm of each block."""
    low = np.minimum(toolpath.start_um, toolpath.end_um)
    high = np.maximum(toolpath.start_um, toolpath.end_um)
    arc = np.flatnonzero(toolpath.is_arc)
    first = np.minimum(toolpath.start_angle_rad[arc], toolpath.end_angle_rad[arc])
    reach = np.abs(toolpath.sweep_rad[arc])
    for quarter, (sign_x, sign_y) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
        passed = np.mod(quarter * np.pi / 2.0 - first, 2.0 * np.pi) <= reach
        rows = arc[passed]
        extreme = toolpath.center_um[rows] + toolpath.radius_um[rows, None] * np.array([sign_x, sign_y])
        axis = int(sign_x == 0)
        low[rows, axis] = np.minimum(low[rows, axis], extreme[:, axis])
        high[rows, axis] = np.maximum(high[rows, axis], extreme[:, axis])
    return low, high


ROUNDING_UM = 0.5
"""Half a step: a path may go so far beyond the travel."""
