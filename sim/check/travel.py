"""The table's travel: which block first leaves it."""

from typing import TYPE_CHECKING

import numpy as np

from controller.stepping.steps import Steps
from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.extents import extents
from parser.program import Program
from parser.toolpath import Axis
from parser.units import from_mm

if TYPE_CHECKING:
    from sim.setup.machine.table_model import TableModel


def travel_findings(
    program: Program, steps: Steps, table: "TableModel", start_um: tuple[float, float]
) -> list[Finding]:
    """Finding 3B401 for the first block that leaves the travel, as stepped from a start on the table."""
    toolpath = program.toolpath
    low, high = extents(toolpath)
    # The table stands where the steps of earlier blocks left it, not where these should have ended.
    shift = np.array(start_um) + steps.corner_um[:-1] - toolpath.start_um
    travel = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    beyond = np.maximum(-(low + shift), high + shift - travel)
    out = np.flatnonzero((beyond > _ROUNDING_UM).any(axis=1))
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


_ROUNDING_UM = 0.5  # half a step
