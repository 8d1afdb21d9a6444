"""The table where nobody names a machine: it follows the pulses of the card, whatever they ask for.

A program for the card tells nothing of the machine that it was written for. To hold it against a table of another kind
would tell of lost steps that no machine loses.

``card`` of ``report.json``: what a program asked of the card, how it ended, and what it did not look at.
"""

import math
from typing import Final

from parser import __version__
from sim.clients.findings import call_text
from sim.clients.run import Read
from sim.clients.session import Questions
from sim.clients.started import Ended
from sim.run.report.card_model import CardEntry
from sim.run.report.document import finding_entry
from sim.run.report.model import CardDocument
from sim.setup.machine.machine import Machine
from sim.setup.machine.table_model import Motor, TableModel


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
