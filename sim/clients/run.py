"""A session as a dry run: the table follows the pulses that the calls made.

What came of a program for the card.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.host.entries import Drive
from controller.motion.limits import row_limits
from controller.stepping.point_by_point import interpolate
from controller.stepping.pulses import Pulses
from parser.findings.codes import Check
from parser.program import Program
from sim.base.progress import Progress, silent
from sim.check.result import CheckState, Coverage
from sim.check.travel import middle_mm, refusal, too_many_steps, travel_findings
from sim.clients.findings import unseen_findings
from sim.clients.listing import program_of
from sim.clients.repeated import Again, again, pulses_again
from sim.clients.session import Session
from sim.clients.started import Ended
from sim.clients.unseen import Unseen, unseen_of
from sim.run.dryrun import DryRun, PulseSink
from sim.run.ending import travel_end
from sim.run.prepare import Prepared
from sim.run.report.model import CardDocument, ReportDocument
from sim.run.running import Along, run_along
from sim.setup.scenario import Scenario
from sim.table.follow import Setup
from sim.table.motion import Motion
from sim.table.trace import origin_um
from sim.table.when.ticks import choose_ticks, rhythm


class Read(NamedTuple):
    """A session, what its card did, what its program did not look at, and both as a program."""

    session: Session
    again: Again
    unseen: Unseen
    program: Program


def read_again(name: str, session: Session) -> Read:
    """Make the calls of a session again. CardLogError where the log `name` cannot be repeated."""
    made = again(name, session)
    unseen = unseen_of(session, made)
    program = program_of(session, made)
    return Read(session, made, unseen, replace(program, findings=unseen_findings(session, unseen, program.lines)))


def run_client(read: Read, scenario: Scenario, progress: Progress = silent, sink: PulseSink | None = None) -> DryRun:
    """Let the table follow what the calls made; the path lies in the middle of the travel, if nothing else is said.

    ProgramError where it makes more steps than any table does.
    """
    progress("plan", 0, 1)
    table = scenario.machine.table
    scenario = replace(scenario, start_mm=scenario.start_mm or middle_mm(read.program.toolpath, table), offset=None)
    ready = _ready(read, scenario)
    motion = _motion(read, scenario)
    ended = None if scenario.past_stop else travel_end(ready, motion, scenario)
    if ended is not None:
        motion = motion.until(ended.t_s)
    return run_along(Along(ready, motion, ended, _of_calls(read, motion), None), scenario, None, progress, sink)


def _ready(read: Read, scenario: Scenario) -> Prepared:
    program = read.program
    steps = interpolate(program.toolpath)
    beyond = too_many_steps(program, steps)
    if beyond:
        raise refusal(program, beyond)
    travel = travel_findings(program, steps, scenario.machine.table, scenario.start_um)
    n = len(program.toolpath)
    not_asked = (CheckState(name, "not asked", why) for name, why in program.reading.not_asked.items())
    coverage = Coverage(n, n, n, n, (*not_asked, CheckState(Check.TRAVEL)))
    feeds = scenario.machine.feeds(scenario.thickness_mm)
    return Prepared(program, steps, None, feeds, (*program.findings, *travel), coverage)


def _motion(read: Read, scenario: Scenario) -> Motion:
    machine, toolpath, plan = scenario.machine, read.program.toolpath, read.again.way.plan
    controller = machine.controller
    x, y = controller.limits.axis_speed_um_s
    limits = row_limits(toolpath, machine.feeds(scenario.thickness_mm), controller.limits)
    drive = Drive(toolpath, limits, plan, origin_um(toolpath), "card")
    table = Setup(machine.table, scenario.start_um, origin_um(toolpath), (x, y), machine.engine)
    ticks = choose_ticks(toolpath, plan, rhythm(machine.table), scenario.trace_spacing_um)
    return Motion(drive, read.session.settings, table, ticks)


def _of_calls(read: Read, motion: Motion) -> Iterator[Pulses]:
    """The pulses of the card, each with its row of the path."""
    way = read.again.way
    for pulses in pulses_again(read.session, read.again, motion.until_s):
        row = way.row_of(pulses.t_s, pulses.row.astype(np.int64)).astype(np.int32)
        yield pulses._replace(row=np.maximum.accumulate(row))


class ClientRun(NamedTuple):
    """What came of a program for the card.

    Attributes
    ----------
    read
        Its calls, what the card did, and what it did not look at.
    ended
        How it ended.
    run
        The table under its pulses; None where neither X nor Y moved.
    report
        All of it as ``report.json`` has it.
    """

    read: Read
    ended: Ended
    run: DryRun | None
    report: ReportDocument | CardDocument
