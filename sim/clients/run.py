"""A session as a dry run: the table follows the pulses that the calls made; where no machine is named, any pulses.

The table where nobody names a machine: it follows the pulses of the card, whatever they ask for.

A program for the card tells nothing of the machine that it was written for. To hold it against a table of another kind
would tell of lost steps that no machine loses.

``card`` of ``report.json``: what a program asked of the card, how it ended, and what it did not look at.

What came of a program for the card.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from controller.host.entries import Drive
from controller.motion.limits import row_limits
from controller.stepping.pulses import Pulses
from controller.stepping.steps import interpolate
from parser import __version__
from parser.findings.codes import Check
from parser.program import Program
from sim.base.progress import Progress, silent
from sim.check.result import CheckState, Coverage
from sim.check.travel import middle_mm, refusal, too_many_steps, travel_findings
from sim.clients.findings import call_text, unseen_findings
from sim.clients.listing import Again, again, program_of, pulses_again
from sim.clients.session import Ended, Questions, Session
from sim.clients.unseen import Unseen, unseen_of
from sim.run.dryrun import DryRun, PulseSink, travel_end
from sim.run.prepare import Prepared
from sim.run.report.document import finding_entry
from sim.run.report.model import CardDocument, ReportDocument
from sim.run.report.run_model import CardEntry
from sim.run.running import Along, run_along
from sim.setup.machine.machine import Machine
from sim.setup.machine.motor import Motor
from sim.setup.machine.table import TableModel
from sim.setup.scenario import Scenario
from sim.table.follow import Setup
from sim.table.motion import Motion
from sim.table.ticks import Sampling, choose_ticks, rhythm
from sim.table.trace import origin_um


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
    return run_along(Along(ready, motion, ended, _of_calls(read, motion), None), scenario, progress=progress, sink=sink)


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
    sampling = Sampling(scenario.trace_spacing_um, scenario.wire_lag_um)
    ticks = choose_ticks(toolpath, plan, rhythm(machine.table), sampling)
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


def card_document(read: Read, ended: Ended) -> CardEntry:
    """What the report has under ``card``; times s on the card's clock, lines those of ``calls.txt``."""
    session, again, unseen = read.session, read.again, read.unseen
    return {
        "ended": {"code": ended.exit_code, "signal": ended.signal or None, "is_stopped": ended.is_stopped},
        "calls": session.calls,
        "asked": _questions(read),
        "time_s": session.end_s,
        "went_on_s": again.went_on_s if math.isfinite(again.went_on_s) else None,
        "places": again.places,
        "status": f"{again.status:04x}",
        "refused": unseen.refused,
        "refused_unread": [
            {
                "line": refusal.event + 1,
                "call": call_text(session, refusal.event),
                "code": _code(read, refusal.event),
                "then": call_text(session, refusal.then),
            }
            for refusal in unseen.refusals
        ],
        "ended_on_limit": [
            {
                "line": each.event + 1,
                "t_s": each.met.t_s,
                "axis": each.met.axis,
                "limit": "positive" if each.met.is_positive else "negative",
                "then": None if each.then is None else call_text(session, each.then),
            }
            for each in unseen.on_limit
        ],
        "sleeps_too_short": [
            {
                "line": sleep.event + 1,
                "slept_s": sleep.slept_s,
                "needed_s": sleep.needed_s,
                "refused": [call_text(session, at) for at in sleep.refused],
            }
            for sleep in unseen.short_sleeps
        ],
    }


def without_motion(read: Read, name: str, ended: Ended) -> CardDocument:
    """The report of a program that moved neither X nor Y: of a run there is nothing to tell."""
    return {
        "schema": "drycut.card/1",
        "drycut": __version__,
        "verdict": "pass",
        "program": {"name": read.program.name, "title": name, "dialect": "GE card"},
        "findings": [finding_entry(finding) for finding in read.program.findings],
        "card": card_document(read, ended),
    }


def _questions(read: Read) -> int:
    """Questions among the calls."""
    return sum(event.count for event in read.session.events if isinstance(event, Questions))


def _code(read: Read, event: int) -> int:
    each_event = read.session.events[event]
    return 0 if isinstance(each_event, Questions) else each_event.answered


_MOVED_KG: Final = 25.0
_STIFFNESS_N_UM: Final = 400.0
"""With the mass 640 Hz: at 1 m/s² it lags by 0.06 µm."""
_FORCE_N: Final = 1e6
_TRAVEL_MM: Final = 10_000.0
NAME: Final = "follower, a table that follows every pulse"


def following(machine: Machine) -> Machine:
    """The machine with a table that follows its pulses in place of its own."""
    motor = Motor(
        kind="stepper",
        step_time_s=0.0005,
        electrical_period_um=1e6,
        following_error_limit_um=float("inf"),
        force_curve=((0.0, _FORCE_N),),
    )
    table = TableModel(
        travel_x_mm=_TRAVEL_MM,
        travel_y_mm=_TRAVEL_MM,
        saddle_mass_kg=0.1,
        carriage_mass_kg=_MOVED_KG,
        drive_stiffness_n_um=_STIFFNESS_N_UM,
        drive_damping_ratio=1.0,
        motor=motor,
    )
    return machine._replace(name=NAME, table=table, assumed=())
