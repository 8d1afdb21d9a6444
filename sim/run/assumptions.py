"""What a run took for granted, and what it did not look at: no run without a finding is to promise more than it can."""

from typing import NamedTuple

from parser.dialect.reader import Assumption
from sim.run.dryrun import DryRun
from sim.setup.machine.machine import Machine


class Assumptions(NamedTuple):
    """What was taken for granted in a run.

    Attributes
    ----------
    machine
        The machine.
    by_default
        Whether nobody named one.
    program
        What the text of the program leaves open.
    values
        Keys of its values that nobody has measured, as its file says.
    compared
        Whether the cut was held against a drawing.
    wire_bows
        Whether the wire bows back; else it runs straight.
    """

    machine: Machine
    by_default: bool
    program: tuple[Assumption, ...]
    values: tuple[str, ...]
    compared: bool
    wire_bows: bool


def assumptions_of(run: DryRun) -> Assumptions:
    """What was taken for granted in a run."""
    scenario = run.scenario
    return Assumptions(
        machine=scenario.machine,
        by_default=scenario.machine_by_default,
        program=run.program.reading.assumptions,
        values=scenario.machine.assumed,
        compared=run.comparison is not None,
        wire_bows=scenario.wire_lag_um > 0.0,
    )
