"""The proof of a written program: read back, checked, run on the machine, its edge held against the drawing."""

from dataclasses import replace
from pathlib import Path
from typing import Literal, NamedTuple

from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.program import Program
from sim.cam.model import CutPlan
from sim.measure.compare.findings import compare_cut, drawing_findings
from sim.measure.compare.result import Comparison
from sim.run.dryrun import DryRun, dry_run
from sim.setup.part import DrawingTarget, Offset, OffsetPass
from sim.setup.scenario import Scenario
from sim.table.motion import Progress, silent


class Proof(NamedTuple):
    """What a run of a written program shows.

    Attributes
    ----------
    run
        The run.
    path_um
        How far the written path lies off that which was planned.
    comparison
        The edge as cut beside the contours of the drawing that were cut; None where there is no edge.
    findings
        Of the run and of the comparison.
    """

    run: DryRun
    path_um: float
    comparison: Comparison | None
    findings: tuple[Finding, ...]

    @property
    def verdict(self) -> Literal["pass", "fail"]:
        """Whether the program may be written."""
        return "fail" if any(one.severity is Severity.ERROR for one in self.findings) else "pass"


def proved(program: Program, plan: CutPlan, scenario: Scenario, path_um: float, progress: Progress = silent) -> Proof:
    """Run a program on the machine of a scenario, and hold what it cuts against the drawing."""
    run = dry_run(program, _as_it_runs(scenario, plan), progress)
    if run.remains is None:
        return Proof(run, path_um, None, run.findings)
    target = DrawingTarget(Path(plan.drawing.name), tolerance_um=plan.making.part_tolerance_um, fit=False)
    found = compare_cut(run.program, run.remains, plan.drawing, target)
    return Proof(run, path_um, found, (*run.findings, *drawing_findings(run.program, found)))


def _as_it_runs(scenario: Scenario, plan: CutPlan) -> Scenario:
    """The scenario with all that the proof looks at; the controller adds the offset that the program leaves to it."""
    asked = replace(scenario, kerf=True, drawing=None, start_mm=None)
    if any(plan.passes_um):
        return asked
    return replace(asked, offset=Offset((OffsetPass(scenario.wire.reach_um),), plan.cuts[0].side))
