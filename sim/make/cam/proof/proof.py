"""The proof of a written program: read back, checked, run on the machine, path and edge held against the drawing."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from parser.drawing.model import Drawing
from parser.findings.errors import ProgramError, SettingsError
from parser.findings.facts import OfAddedOffset, WithoutOffset
from parser.findings.findings import Finding
from parser.findings.remarks import Remark
from parser.geometry.curves import Bools, Ints
from parser.program import Program
from parser.shape.contours import runs
from parser.toolpath import Point
from parser.units import mm
from sim.base.progress import Progress, silent
from sim.make.cam.model import CutPlan
from sim.make.cam.proof.as_run import AsRun, as_run
from sim.make.cam.proof.falls import fall_faults, side_faults
from sim.make.cam.proof.result import Fault, Proof
from sim.make.cam.proof.target import Target, target_of
from sim.make.convert.proof import Proof as Written
from sim.measure.compare.compared_program import compare_program
from sim.measure.compare.findings import compare_cut, drawing_findings
from sim.measure.compare.result import Asked, Comparison
from sim.measure.compare.tables import by_block, by_entity
from sim.run.dryrun import DryRun
from sim.run.running import dry_run
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario

_MEASURED_UM = 0.05
"""A comparison of exact paths is right to 0.01 µm, and fillets of a drawing to 0.02 µm."""


class Given(NamedTuple):
    """What is proved: a program that was read back, the plan that it was written of, and its drawing, unfitted.

    `written` says how far the program's path lies off the plan's, of which whole steps explain `rounding_um`.
    """

    program: Program
    plan: CutPlan
    drawn: Drawing
    written: Written
    rounding_um: float


def proved(given: Given, scenario: Scenario, progress: Progress = silent) -> Proof:
    """Run a program on the machine of a scenario, and hold its path and what it cuts against the drawing."""
    plan = given.plan
    how = as_run(scenario, plan, given.program.toolpath)
    target, missing = target_of(given.drawn, plan)
    faults = (*_written_faults(given), *missing)
    none = Proof(None, given.written.off_um, None, None, (), faults, how.unproved, how.notes, how.scenario.wire)
    try:
        run = dry_run(given.program, how.scenario, progress)
    except ProgramError as error:
        return none._replace(findings=(*error.others, error.finding))
    except SettingsError as error:
        return none._replace(unproved=(*how.unproved, Remark("run", {"why": error.message})))
    progress("comparison", 0, 1)
    of_run, notes = _of_run(run, how)
    by_cut = _by_cut(given, run)
    ran = none._replace(run=run, findings=of_run, faults=(*faults, *by_cut), notes=(*how.notes, *notes))
    ran = ran._replace(unproved=(*how.unproved, *_unlooked(run)))
    if target is None or by_cut:
        return ran
    path, of_path = _path(given, target, run, how)
    cut, of_cut = _as_cut(given, target, run, how)
    return ran._replace(
        path=path,
        comparison=cut,
        findings=(*ran.findings, *of_cut.findings),
        faults=(*ran.faults, *of_path.faults, *of_cut.faults),
        unproved=(*ran.unproved, *of_path.unproved, *of_cut.unproved),
    )


def _of_run(run: DryRun, how: AsRun) -> tuple[tuple[Finding, ...], tuple[Remark, ...]]:
    """The findings of a run, and what is to be known to run the program so: of 4B, that its offset is worked in."""
    is_4b = any(isinstance(one.fact, WithoutOffset) for one in run.checked)
    if not is_4b or how.scenario.offset is not None or not how.has_offset:
        return run.findings, ()
    return tuple(one for one in run.findings if not isinstance(one.fact, OfAddedOffset)), (Remark("worked-in"),)


class _Found(NamedTuple):
    """What one look at a program finds."""

    faults: tuple[Fault, ...] = ()
    findings: tuple[Finding, ...] = ()
    unproved: tuple[Remark, ...] = ()


def _written_faults(given: Given) -> tuple[Fault, ...]:
    """That reading gives something else than was planned."""
    off_um, differs = given.written
    if differs:
        return (Fault("differs", {"what": differs}),)
    return (Fault("written", {"off": off_um, "bound": given.rounding_um}),) if off_um > given.rounding_um else ()


def _by_cut(given: Given, run: DryRun) -> tuple[Fault, ...]:
    """That the program has more contours than figures are cut, or fewer."""
    found, wanted = len(runs(run.toolpath)), len(given.plan.cuts)
    return () if found == wanted else (Fault("contours", {"found": found, "wanted": wanted}),)


def _unlooked(run: DryRun) -> Iterator[Remark]:
    """Checks that did not come to their end."""
    for check in run.coverage.checks:
        if check.state == "incomplete":
            yield Remark("check", {"check": check.name, "reason": check.reason})


def _path(given: Given, target: Target, run: DryRun, how: AsRun) -> tuple[Comparison | None, _Found]:
    """The path held against the offset of the drawing: as it is written where the controller adds the offset.

    It may lie off by the tolerance of the fit, by what rounding to steps moves it, and by gaps of the drawing.
    """
    on_contour = min(how.edge_um, default=0.0) <= 0.0
    toolpath = given.program.toolpath if on_contour else run.toolpath
    making, written = given.plan.making, given.written
    rounding_um = min(written.off_um, given.rounding_um)
    bound_um = making.tolerance_um + rounding_um + target.gap_um + target.drawing.flatten_um + _MEASURED_UM
    faults: list[Fault] = []
    first: Comparison | None = None
    for by_um in sorted(set(how.edge_um)):
        try:
            found = compare_program(toolpath, max(by_um, 0.0), target.drawing, Asked(bound_um, fitted=False))
        except SettingsError as error:
            return first, _Found(tuple(faults), (), (Remark("path", {"why": error.message}),))
        first = first or found
        faults += _off_faults(given, target, run, found, np.array(how.edge_um) == by_um)
    return first, _Found(tuple(faults))


def _off_faults(given: Given, target: Target, run: DryRun, found: Comparison, of_cut: Bools) -> Iterator[Fault]:
    """The worst place of the path past its bound, both ways, and leads that cut into parts, of some of the cuts."""
    number = _cut_of_block(run)
    bound_um = found.asked.tolerance_um
    for name, places in (("path", by_block(found)), ("uncut", by_entity(found))):
        here = [one for one in places if of_cut[number[one.block]] and one.deviation_um > bound_um]
        if not here:
            continue
        worst = max(here, key=lambda one: one.deviation_um)
        at = number[worst.block]
        values = {"off": worst.deviation_um, "bound": bound_um, **_mm(worst.where_um)}
        yield Fault(name, values, worst.where_um, given.plan.cuts[at].figure.number, worst.block)
    for gouge in found.gouges:
        at = number[gouge.block]
        if of_cut[at]:
            values = {"depth": gouge.depth_um, **_mm(gouge.where_um)}
            yield Fault("lead", values, gouge.where_um, given.plan.cuts[at].figure.number, gouge.block)


def _cut_of_block(run: DryRun) -> Ints:
    """Index of the cut that each block is of, by its number; of a jump that of the cut behind it."""
    block = run.toolpath.source.block
    cut = np.searchsorted(runs(run.toolpath)[:, 1], np.arange(len(run.toolpath)), side="right")
    of_block = np.zeros(int(block.max(initial=0)) + 1, dtype=np.int64)
    of_block[block] = np.minimum(cut, int(cut[~run.toolpath.is_jump].max(initial=0)))
    return of_block


def _mm(place: Point) -> dict[str, float]:
    return {"x_mm": mm(place.x), "y_mm": mm(place.y)}


def _as_cut(given: Given, target: Target, run: DryRun, how: AsRun) -> tuple[Comparison | None, _Found]:
    """The edge as cut, after steps and table, and what falls."""
    faults = [*side_faults(given.plan, target, run.toolpath)] if how.has_offset else []
    if run.remains is None or run.ended is not None:  # what an early end leaves uncut is no fault of its own
        return None, _Found(tuple(faults))
    faults += fall_faults(given.plan, target, run.remains.pieces, how.scenario.wire.reach_um)
    if not how.is_one_edge:
        return None, _Found(tuple(faults))
    tolerance_um = given.plan.making.held_to_um
    asked = DrawingTarget(Path(target.drawing.name), tolerance_um=tolerance_um, fit=False)
    found = compare_cut(run.program, run.remains, target.drawing, asked)
    return found, _Found(tuple(faults), tuple(drawing_findings(run.program, found)))
