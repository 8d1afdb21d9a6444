"""What a program did not look at: calls that were refused, moves that ended on a limit, sleeps that were too short.

A log does not show whether a program looked at what a call returned. It shows what the program did next: after a
refusal one that looked makes the call again, asks `GT_GetCmdSts`, stops, clears, or ends. After a limit it asks for the
status of the axis, or clears it, before it moves again. What it did otherwise is told, and nothing else.
"""

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Final, NamedTuple

from controller.card.core.call import Code
from controller.card.core.state import LimitMet
from sim.clients.listing import Again
from sim.clients.session import ClientCall, Event, Questions, Session

_ANSWERS: Final = frozenset(
    (
        *("GT_StpMtn", "GT_EStpMtn", "GT_Reset", "GT_HardRst", "GT_Close", "GT_AxisOff"),
        *("GT_ClrSts", "GT_RstSts", "GT_Open", "GT_EndLookaheadMode"),
    )
)
"""What a program calls when something went wrong."""
_BESIDE: Final = frozenset(("GT_AddList", "GT_EndList"))
"""Programs open the list and close it around each entry, refused or not."""
_TRIES: Final = 200
"""A call that is made again is looked for among so many: other threads call in between."""
_MOVES: Final = ("GT_Ln", "GT_Arc", "GT_Mv")
_STARTS: Final = frozenset(("GT_StrtMtn", "GT_RestoreMtn"))
_NEEDS_REST: Final = (*_MOVES, "GT_ZeroPos", "GT_StrtList", "GT_StrtMtn", "GT_RestoreMtn")
"""Calls that are refused because something moves."""
_OPENS: Final = {"GT_StrtList": True, "GT_AddList": True, "GT_EndList": False, "GT_Reset": False, "GT_HardRst": False}
"""Whether the list is open after these."""
_MOMENT_S: Final = 1e-9
_STATUS: Final = ("GT_GetCrdSts", "GT_GetSts")


class Refusal(NamedTuple):
    """A call that was refused, and the one that the program went on with; events by their index."""

    event: int
    then: int


class OnLimit(NamedTuple):
    """A move that a limit switch ended, the event before that, and the one that the program went on with, if any."""

    met: LimitMet
    event: int
    then: int | None


class ShortSleep(NamedTuple):
    """A sleep that ended before the axes stood, what was refused so, how long it was and should have been, s."""

    event: int
    refused: tuple[int, ...]
    slept_s: float
    needed_s: float


class Unseen(NamedTuple):
    """What a program did not look at, and how many calls were refused in all."""

    refused: int
    refusals: tuple[Refusal, ...]
    on_limit: tuple[OnLimit, ...]
    short_sleeps: tuple[ShortSleep, ...]


def unseen_of(session: Session, again: Again) -> Unseen:
    """What a program did not look at."""
    events, times = session.events, [_began_s(event) for event in session.events]
    refused = [at for at, event in enumerate(events) if isinstance(event, ClientCall) and event.answered]
    first_card = _to_first_card(events)
    wanted_rest = set(refused) & first_card - _into_list(events)
    short = _short_sleeps(events, wanted_rest, again.moving_s)
    unread = (Refusal(at, then) for at in refused if (then := _went_on(events, at)) is not None)
    before = (max(bisect_right(times, met.t_s) - 1, 0) for met in again.limits)
    pairs = zip(again.limits, before, strict=True)
    call_s = session.settings.call_s
    found = (_on_limit(events, met, at, first_card, call_s) for met, at in pairs)
    on_limit = (each for each in found if each is not None)
    return Unseen(len(refused), tuple(unread), tuple(on_limit), tuple(_by_sleep(short)))


def _went_on(events: Sequence[Event], at: int) -> int | None:
    """The call that a program went on with after a refusal; None where it looked, or called nothing more."""
    call = _call_at(events[at]).call
    if isinstance(events[min(at + 1, len(events) - 1)], Questions) and _asks(events[at + 1], "GT_GetCmdSts"):
        return None
    first: int | None = None
    for n, (index, each) in enumerate(_calls(events, at + 1)):
        if (each.call.name, each.call.arguments) == (call.name, call.arguments) or n >= _TRIES:
            return None if n < _TRIES else first
        if first is None and each.call.name not in _BESIDE:
            if each.call.name in _ANSWERS:
                return None
            first = index
    return first


def _to_first_card(events: Sequence[Event]) -> set[int]:
    """Events that are about the first card, whose way is known: it is the one that is selected at first."""
    card, about = 0, set[int]()
    for index, event in enumerate(events):
        if isinstance(event, ClientCall) and event.call.name == "GT_SwitchtoCardNo" and not event.answered:
            card = event.call.arguments[0]
        if card == 0:
            about.add(index)
    return about


def _into_list(events: Sequence[Event]) -> set[int]:
    """Path calls that were made while the list was open: those are stored, and need no rest."""
    is_open, stored = False, set[int]()
    for index, each in _calls(events, 0):
        if not each.answered and each.call.name in _OPENS:
            is_open = _OPENS[each.call.name]
        if is_open and each.call.name.startswith(_MOVES):
            stored.add(index)
    return stored


def _on_limit(
    events: Sequence[Event], met: LimitMet, before: int, first_card: set[int], call_s: float
) -> OnLimit | None:
    """The move that a limit ended behind an event; None where the program looked before it moved again.

    A question is answered `call_s` after it was asked.
    """
    asked_s = met.t_s - call_s - _MOMENT_S
    ways = (f"GT_GetSts({met.axis})", "GT_GetLmtSwt()")
    clears = {("GT_ClrSts", met.axis), ("GT_RstSts", met.axis)}
    for at in (at for at in range(before, len(events)) if at in first_card):
        event = events[at]
        if isinstance(event, Questions):
            if any(way in event.calls and event.calls[way].last_s >= asked_s for way in ways):
                return None
        elif at > before and event.call.arguments and (event.call.name, event.call.arguments[0]) in clears:
            return None
        elif at > before and not event.answered and (event.call.name.startswith(_MOVES) or event.call.name in _STARTS):
            return OnLimit(met, before, at)
    return OnLimit(met, before, None)


def _short_sleeps(
    events: Sequence[Event], wanted_rest: set[int], moving_s: Sequence[tuple[float, float]]
) -> Iterator[ShortSleep]:
    """The sleep before each call that was refused because the axes still moved, where the program waited so alone."""
    begins = [begin for begin, _ in moving_s]
    span, slept, first, has_asked = -1, 0.0, -1, False
    for index, event in enumerate(events):
        now = bisect_right(begins, _began_s(event)) - 1
        if now != span:  # what was slept and asked before this motion is not about it
            span, slept, first, has_asked = now, 0.0, -1, False
        if isinstance(event, Questions):
            has_asked = has_asked or _asks(event, *_STATUS)
        elif event.is_sleep:
            slept, first = slept + float(event.call.arguments[0]) / 1e3, first if first >= 0 else index
        elif index in wanted_rest and _is_for_rest(event) and first >= 0 and not has_asked:
            end_s = moving_s[span][1] if span >= 0 else 0.0
            if event.call.t_s < end_s:
                yield ShortSleep(first, (index,), slept, end_s - _began_s(events[first]))


def _is_for_rest(client_call: ClientCall) -> bool:
    """Whether a call was refused because the axes are to stand for it."""
    return client_call.answered == Code.COMMAND and client_call.call.name.startswith(_NEEDS_REST)


def _by_sleep(sleeps: Iterable[ShortSleep]) -> Iterator[ShortSleep]:
    """One for each sleep, with all that was refused because of it."""
    for _, ones in groupby(sleeps, key=lambda short_sleep: short_sleep.event):
        first, *others = ones
        yield first._replace(refused=(*first.refused, *(at for other in others for at in other.refused)))


def _call_at(event: Event) -> ClientCall:
    assert isinstance(event, ClientCall)  # noqa: S101 - found so
    return event


def _calls(events: Sequence[Event], since: int) -> Iterator[tuple[int, ClientCall]]:
    """Calls from an event on that may change something, with their indices."""
    for index in range(since, len(events)):
        event = events[index]
        if isinstance(event, ClientCall) and not event.is_sleep:
            yield index, event


def _asks(event: Event, *names: str) -> bool:
    return isinstance(event, Questions) and any(text.startswith(f"{name}(") for text in event.calls for name in names)


def _began_s(event: Event) -> float:
    return event.t_s if isinstance(event, Questions) else event.call.t_s
