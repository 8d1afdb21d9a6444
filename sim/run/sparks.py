"""A run under sparks: what is cut of its program, and what is told where the control stops."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from controller.motion.limits import corner_waits_s, path_of
from controller.stepping.steps import Steps, interpolate, words_of
from parser.dialect.reader import at_block
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding
from parser.program import Program
from parser.toolpath import Toolpath
from parser.units import from_mm
from sim.check.result import CheckState
from sim.cut.wire_rows import WireRows, wire_rows
from sim.measure.passes import PassFigures
from sim.process.cut import ProcessRun, Started, run_sparks, started
from sim.process.way import Work, is_cut, is_cut_again
from sim.run.dryrun import DryRun, Ending
from sim.setup.scenario import Scenario
from sim.setup.spark import Spark

MOST_PANEL_BLOCKS: Final = 20_000
"""Of a cut that a page drives: of more it would grow past 10 MB."""
_CLOSED_UM: Final = 50.0
_SPARKS: Final = "check-sparks"


def work_of(
    steps: Steps, toolpath: Toolpath, scenario: Scenario, figures: Sequence[PassFigures], wire: WireRows
) -> Work:
    """What a control under sparks cuts of a path, by what its passes came to, and by the wire in each row.

    A block cuts as wide as its kerf, one of a later pass what that takes off, and one that goes back over a line that
    was cut before cuts nothing.
    """
    width_um = 2.0 * wire.reach_um
    for each in figures:
        if each.of.number > 1 and not each.of.is_tab and each.stock is not None:
            width_um[each.of.first : each.of.last + 1] = each.stock.mean_um
    width_um[is_cut_again(toolpath)] = 0.0
    gap_um = wire.reach_um - scenario.wire.radius_um
    height_um, wire_um = from_mm(scenario.thickness_mm), scenario.wire.diameter_um
    waits_s = corner_waits_s(path_of(toolpath), scenario.machine.controller.limits)[1:]
    return Work(steps, words_of(toolpath), toolpath, width_um, gap_um, waits_s, height_um, wire_um, len(toolpath))


def cut_under_sparks(work: Work, scenario: Scenario, ended: Ending | None) -> ProcessRun | None:
    """Work cut under the sparks of a scenario, None without; up to the block in which its table `ended` early.

    SettingsError for an event in no block that is cut.
    """
    if scenario.spark is None:
        return None
    _refuse_elsewhere(work, scenario)
    rows = work.rows if ended is None else ended.row + 1
    return run_sparks(work._replace(rows=rows), scenario.spark, scenario.events)


def has_panel(run: DryRun) -> bool:
    """Whether a panel stands among the files of a run: it is under sparks, and somebody can drive its cut."""
    return run.process is not None and _can_be_driven(run)


def _can_be_driven(run: DryRun) -> bool:
    """Whether there is something to cut, in no more blocks than a page holds."""
    return bool((~run.toolpath.is_jump & (run.stepped.count > 0)).any()) and len(run.toolpath) <= MOST_PANEL_BLOCKS


def panel_cut(run: DryRun, scenario: Scenario) -> Started:
    """The cut of a run at its start, for who drives it, by the sparks of a scenario; SettingsError as above."""
    steps = interpolate(run.toolpath)
    work = work_of(steps, run.toolpath, scenario, run.pass_figures, wire_rows(run.toolpath, scenario, run.passes))
    _refuse_elsewhere(work, scenario)
    if not _can_be_driven(run):
        raise SettingsError("no-panel", name=run.program.name, blocks=len(run.toolpath), most=MOST_PANEL_BLOCKS)
    return started(work, scenario.spark or Spark(), scenario.events)


def _refuse_elsewhere(work: Work, scenario: Scenario) -> None:
    spark, toolpath = scenario.spark, work.toolpath
    if spark is not None and spark.threading == "reverse":
        open_um = float(np.hypot(*(toolpath.end_um[-1] - toolpath.start_um[0])))
        if open_um > _CLOSED_UM or toolpath.is_jump.any():
            raise SettingsError("reverse-needs-closed-path", open_um=open_um)
    for at, event in enumerate(scenario.events, start=1):
        if event.block is not None and not is_cut(work.toolpath, work.steps, event.block):
            raise SettingsError("event-block-not-cut", at=at, block=event.block, blocks=len(work.toolpath))


def stop_findings(program: Program, process: ProcessRun | None) -> Iterator[Finding]:
    """Finding 3B609 where the control stops before the program is through; none without sparks."""
    stopped = None if process is None else process.stopped
    if stopped is not None:
        why = f"stop-{stopped.kind}"
        yield at_block(program.toolpath, program.lines, "3B609", stopped.row, time_s=stopped.t_s, why=why)


def check_states(process: ProcessRun | None) -> tuple[CheckState, ...]:
    """How far the cut under sparks came; none without."""
    if process is None:
        return ()
    is_through = process.stopped is None
    return (CheckState(_SPARKS) if is_through else CheckState(_SPARKS, "incomplete", "reason-sparks"),)
