"""Findings on what a program did not look at, at their lines in the listing."""

from collections.abc import Iterator

from parser.findings.findings import Finding
from parser.text.lines import LineIndex
from sim.clients.said import Session, Told
from sim.clients.unseen import Unseen


def unseen_findings(session: Session, unseen: Unseen, lines: LineIndex) -> tuple[Finding, ...]:
    """GEC401 for refused calls, GEC402 for limits, GEC403 for sleeps, in the order of the listing.

    What was refused because of a sleep is told there.
    """
    found = [*_refusals(session, unseen, lines), *_limits(unseen, lines), *_sleeps(session, unseen, lines)]
    return tuple(sorted(found, key=lambda one: one.line))


def call_text(session: Session, event: int) -> str:
    """The call of an event as it is written: ``GT_LnXY(10.0, 0.0)``."""
    one = session.events[event]
    assert isinstance(one, Told)  # noqa: S101 - found so
    return f"{one.call.name}({', '.join(map(repr, one.call.arguments))})"


def _refusals(session: Session, unseen: Unseen, lines: LineIndex) -> Iterator[Finding]:
    of_sleeps = {at for sleep in unseen.short_sleeps for at in sleep.refused}
    for one in unseen.refusals:
        if one.event in of_sleeps:
            continue
        told = session.events[one.event]
        assert isinstance(told, Told)  # noqa: S101 - found so
        yield lines.finding(
            "GEC401",
            _span(lines, one.event),
            call=call_text(session, one.event),
            answer=told.answered,
            function=told.call.name,
            then=call_text(session, one.then),
        )


def _limits(unseen: Unseen, lines: LineIndex) -> Iterator[Finding]:
    for one in unseen.on_limit:
        side = "limit-positive" if one.met.is_positive else "limit-negative"
        yield lines.finding("GEC402", _span(lines, one.event), axis=one.met.axis, side=side, t_s=one.met.t_s)


def _sleeps(session: Session, unseen: Unseen, lines: LineIndex) -> Iterator[Finding]:
    for one in unseen.short_sleeps:
        yield lines.finding(
            "GEC403",
            _span(lines, one.event),
            slept_s=one.slept_s,
            needed_s=one.needed_s,
            short_s=one.needed_s - one.slept_s,
            call=call_text(session, one.refused[0]),
            more=len(one.refused) - 1,
        )


def _span(lines: LineIndex, event: int) -> tuple[int, int]:
    """Of an event, behind its time."""
    first, past = lines.bounds(event + 1)
    text = lines.text[first:past]
    return first + len(text) - len(text.lstrip(" 0123456789.")), past
