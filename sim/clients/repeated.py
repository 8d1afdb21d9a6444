"""A session made again on a card: the way that it drove, when it stood, and where a limit stopped it."""

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

from controller.card.calls.base import Logged, slice_of
from controller.card.core.state import LimitMet
from controller.card.engine.motion import Driven
from controller.card.ge import GECard
from controller.card.log import LONGEST_S, CardLogError, Damaged, call
from controller.card.way import Way, WayRecorder
from controller.stepping.pulses import Pulses
from sim.clients.session import ClientCall, Session

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
