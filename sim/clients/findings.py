"""Findings on what a program did not look at, at their lines in the listing."""

from collections.abc import Iterator

from parser.findings.findings import Finding
from parser.text.source import LineIndex
from sim.clients.session import ClientCall, Session
from sim.clients.unseen import Unseen


def unseen_findings(session: Session, unseen: Unseen, lines: LineIndex) -> tuple[Finding, ...]:
    """GEC401 for refused calls, GEC402 for limits, GEC403 for sleeps, in the order of the listing.

    What was refused because of a sleep is told there.
    """
    found = [*_refusals(session, unseen, lines), *_limits(unseen, lines), *_sleeps(session, unseen, lines)]
    return tuple(sorted(found, key=lambda each: each.line))


def call_text(session: Session, event: int) -> str:
    """The call of an event as it is written: ``GT_LnXY(10.0, 0.0)``."""
    each_event = session.events[event]
    assert isinstance(each_event, ClientCall)  # noqa: S101 - found so
    return f"{each_event.call.name}({', '.join(map(repr, each_event.call.arguments))})"


def _refusals(session: Session, unseen: Unseen, lines: LineIndex) -> Iterator[Finding]:
    of_sleeps = {at for sleep in unseen.short_sleeps for at in sleep.refused}
    for refusal in unseen.refusals:
        if refusal.event in of_sleeps:
            continue
        told_events = session.events[refusal.event]
        assert isinstance(told_events, ClientCall)  # noqa: S101 - found so
        yield lines.finding(
            "GEC401",
            _span(lines, refusal.event),
            call=call_text(session, refusal.event),
            answer=told_events.answered,
            function=told_events.call.name,
            then=call_text(session, refusal.then),
        )


def _limits(unseen: Unseen, lines: LineIndex) -> Iterator[Finding]:
    for each in unseen.on_limit:
        side = "limit-positive" if each.met.is_positive else "limit-negative"
        yield lines.finding("GEC402", _span(lines, each.event), axis=each.met.axis, side=side, t_s=each.met.t_s)


def _sleeps(session: Session, unseen: Unseen, lines: LineIndex) -> Iterator[Finding]:
    for sleep in unseen.short_sleeps:
        yield lines.finding(
            "GEC403",
            _span(lines, sleep.event),
            slept_s=sleep.slept_s,
            needed_s=sleep.needed_s,
            short_s=sleep.needed_s - sleep.slept_s,
            call=call_text(session, sleep.refused[0]),
            more=len(sleep.refused) - 1,
        )


def _span(lines: LineIndex, event: int) -> tuple[int, int]:
    """Of an event, behind its time."""
    first, past = lines.bounds(event + 1)
    text = lines.text[first:past]
    return first + len(text) - len(text.lstrip(" 0123456789.")), past
