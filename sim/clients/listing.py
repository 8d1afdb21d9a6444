"""A session as a text to read, and made again on a card: the way that it drove, when it stood, what stopped it.

A session as a text to read, a line for each event, and as a program whose blocks are the calls that moved.
"""

import math
from collections.abc import Iterator
from dataclasses import fields, replace
from typing import Final, NamedTuple

import numpy as np

from controller.card.calls.base import Logged, slice_of
from controller.card.core.state import LimitMet
from controller.card.engine.motion import Driven
from controller.card.ge import GECard
from controller.card.log import LONGEST_S, CardLogError, Damaged, call
from controller.card.way import Way, WayRecorder
from controller.stepping.pulses import Pulses
from parser.dialect.reader import BlockCounts, Reading, Spelling
from parser.findings.codes import Check
from parser.findings.findings import Finding
from parser.geometry.curves import Bools, CurveKind, Curves
from parser.program import Program
from parser.text.source import LineIndex, Source
from parser.toolpath import Toolpath
from sim.clients.session import ClientCall, Event, Questions, Session

_MOMENT_S: Final = 1e-9


class Again(NamedTuple):
    """What a card did in a session.

    Attributes
    ----------
    way
        Along which it drove X and Y; its calls are numbers of `limit_calls`, from 1.
    limit_calls
        The calls that were made again, sleeps left out.
    moving_s
        Spans in which it moved, waits in its list included, s.
    limits
        Limit switches that stopped it, those of the first card: the table follows that one.
    places, status
        Where the axes of each card stand when all is over, pulses, and the coordinate status of the first card.
    went_on_s
        For how long it moved after the last call; inf where it had not come to rest by then.
    """

    way: Way
    limit_calls: tuple[ClientCall, ...]
    moving_s: tuple[tuple[float, float], ...]
    limits: tuple[LimitMet, ...]
    places: list[list[int]]
    status: int
    went_on_s: float


def again(name: str, session: Session) -> Again:
    """Make the calls of a session again. CardLogError where the card answers otherwise than the log `name` says."""
    recorder, spans, heard = WayRecorder(), _Spans(), list[Logged]()

    def driven(each_driven: Driven) -> None:
        recorder(each_driven)
        spans.add(each_driven.stretch.start.clock_s, each_driven.until_s)

    card = GECard(session.settings, on_driven=driven, on_call=heard.append)
    stops = tuple(
        event
        for event in session.events
        if isinstance(event, ClientCall) and not event.is_sleep and not event.is_question
    )
    for each in stops:
        card.wait_until(each.call.t_s)
        try:
            call(card, each.call)
        except Damaged as error:
            raise CardLogError("in-line", file=name, line=each.line, message=error.message) from None
        if heard.pop() != each.call:
            raise CardLogError("card-answers-otherwise", name=name, line=each.line)
    stands = _to_rest(card, session.end_s)
    card.GT_SwitchtoCardNo(0)
    last_s = spans.joined[-1][1] if spans.joined else 0.0
    went_on_s = max(last_s - session.end_s, 0.0) if stands else math.inf
    return Again(recorder.way(), stops, tuple(spans.joined), card.limits_met, card.places, card.status, went_on_s)


def pulses_again(session: Session, made: Again, until_s: float) -> Iterator[Pulses]:
    """Make the calls again: the pulses of the first card up to a time on its clock."""
    due: list[Pulses] = []
    card = GECard(session.settings, on_pulses=due.append)

    def waited(t_s: float) -> Iterator[Pulses]:
        slice_s = slice_of(t_s - card.time_s)
        while True:
            card.wait_until(min(card.time_s + slice_s, t_s))
            yield from due
            due.clear()
            if card.time_s >= t_s:
                return

    for each in made.limit_calls:
        if each.call.t_s > until_s:
            break
        yield from waited(each.call.t_s)
        call(card, each.call)
    yield from waited(min(until_s, made.moving_s[-1][1] if made.moving_s else 0.0))


def _to_rest(card: GECard, since_s: float) -> bool:
    """Let the card go on until it stands; whether it comes to rest."""
    card.wait_until(since_s)
    step_s = 0.01
    while card.is_moving:
        if card.time_s - since_s > LONGEST_S:
            return False
        card.wait_until(card.time_s + step_s)
        step_s *= 2.0
    return True


class _Spans:
    """Spans of time in order, those that meet joined."""

    def __init__(self) -> None:
        self.joined: list[tuple[float, float]] = []

    def add(self, begin_s: float, end_s: float) -> None:
        if self.joined and begin_s - self.joined[-1][1] < _MOMENT_S:
            begin_s, _ = self.joined.pop()
        self.joined.append((begin_s, end_s))


NAME: Final = "calls.txt"
"""Of the text, as a file."""
_DIALECT: Final = "GE card"
_NOT_ASKED: Final = (
    Check.GRAMMAR,
    Check.ORDER,
    Check.HEADER,
    Check.BLOCKS,
    Check.PRINTED_ENDS,
    Check.CONTOURS,
    Check.SENSES,
    Check.CROSSINGS,
    Check.PASSES,
    Check.CORNERS,
)


def listing_of(session: Session) -> str:
    """The events of a session, one a line: time, s, and the call with its answer, or what was asked and how often."""
    return "".join(f"{_line(event)}\n" for event in session.events)


def _line(event: Event) -> str:
    if isinstance(event, Questions):
        questions_text = ", ".join(
            f"{text} ×{times.often}" if times.often > 1 else text for text, times in event.calls.items()
        )
        return f"{event.t_s:12.6f}  ? {questions_text}"
    call = event.call
    arguments = ", ".join(map(repr, call.arguments))
    answer = f" = {call.answer!r}" if call.answer is not None else ""
    return f"{call.t_s:12.6f}  {call.name}({arguments}){answer}"


def program_of(session: Session, again: Again, findings: tuple[Finding, ...] = ()) -> Program:
    """The session as a program: its text is the listing, and each row of its path came from a call."""
    text = listing_of(session)
    lines = LineIndex(text)
    toolpath = _toolpath(text, lines, session, again)
    n = len(toolpath)
    return Program(
        name=NAME,
        encoding="utf-8",
        text=text,
        lines=lines,
        reading=Reading(
            dialect=_DIALECT,
            counts=BlockCounts(n, n, n),
            damages=(),
            spelling=Spelling(
                clockwise="GT_ArcXY", counter_clockwise="GT_ArcXY", end="GT_Close", pause="GT_StpMtn", rapid="GT_LnXYG0"
            ),
            is_drawing=False,
            not_asked=dict.fromkeys(_NOT_ASKED, "reason-calls"),
        ),
        header={},
        toolpath=toolpath,
        findings=findings,
        mender=None,
    )


def _toolpath(text: str, lines: LineIndex, session: Session, again: Again) -> Toolpath:
    way, n = again.way, len(again.way.call)
    line_of = {id(event): number for number, event in enumerate(session.events, start=1)}
    made = [again.limit_calls[call - 1] for call in way.call.tolist()]
    line = np.array([line_of[id(each)] for each in made], dtype=np.int64)
    spans = np.array([_span(text, lines, int(number)) for number in line], dtype=np.int64).reshape(-1, 2)
    names = [each.call.name for each in made]
    positions = np.array([name.startswith("GT_Mv") or "G0" in name for name in names], dtype=np.bool_)
    curves = _with_jumps(way.curves, positions)
    return Toolpath(
        **{field.name: getattr(curves, field.name) for field in fields(Curves)},
        printed_end_um=np.full((n, 2), np.nan),
        words=None,
        source=Source(text, np.arange(1, n + 1), spans, line, ("",) * n),
        stops=(),
    )


def _with_jumps(curves: Curves, positions: Bools) -> Curves:
    """Positioning moves and rapid lines as jumps: there nothing is cut."""
    return replace(curves, kind=np.where(positions & ~curves.is_arc, CurveKind.JUMP, curves.kind).astype(np.int64))


def _span(text: str, lines: LineIndex, number: int) -> tuple[int, int]:
    """The call of a line, without its time."""
    first, past = lines.bounds(number)
    return first + text[first:past].index("GT_"), past
