"""The table's travel: which block first leaves it.

Programs that ask for more than any table can do: numbers and steps beyond all bounds (3B206).
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from controller.stepping.point_by_point import interpolate
from controller.stepping.steps import Steps
from parser.controller_words import Axis
from parser.dialect.reader import at_block
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, TooLarge, telling
from parser.geometry.curves import Floats, extents
from parser.program import Program
from parser.text.source import Field
from parser.toolpath import Toolpath
from parser.units import from_mm, mm

if TYPE_CHECKING:
    from sim.setup.machine.machine import TableModel

MAX_STEPS = 300_000_000
"""Steps that one run takes: 240 m of path, two months of cutting; a word damaged to nine digits asks for more."""


def too_many_steps(program: Program, steps: Steps) -> list[Finding]:
    """Finding 3B206 where a program makes more steps than any table does."""
    if len(steps) <= MAX_STEPS:
        return []
    row = int(np.argmax(steps.count))
    of = program.toolpath, program.lines
    found = at_block(*of, "3B206", row, Field.COUNT, what="too-many-steps", limit=MAX_STEPS)
    return [found.with_fact(TooLarge())]


def refusal(program: Program, findings: Sequence[Finding]) -> ProgramError:
    """Error of a program that asks for more than any table can do, of which one of the findings tells."""
    finding, _ = next(telling(program.toolpath.source.names.named(findings), TooLarge))
    return ProgramError(finding, excerpt=program.excerpt(finding.line))


def refuse_too_large(program: Program) -> None:
    """ProgramError (3B206) for a program with numbers, or more steps, than any table does."""
    if any(telling(program.findings, TooLarge)):
        raise refusal(program, program.findings)
    beyond = too_many_steps(program, interpolate(program.toolpath))
    if beyond:
        raise refusal(program, beyond)


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
