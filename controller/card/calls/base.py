"""The core of the card: its clock, its cards, and the one way every call goes.

Threads may share it: one call at a time is made, and the others wait for it.
"""

import math
from collections.abc import Callable, Iterator
from threading import RLock
from typing import Any, NamedTuple, TypeAlias

from controller.card.core.call import Code, Function, Refused, read_arguments
from controller.card.core.settings import CardSettings
from controller.card.core.state import AxisState, CardState
from controller.card.engine.engine import Engine
from controller.card.engine.motion import Driven
from controller.stepping.pulses import Pulses

LONGEST_S = 1e9
"""A card is simulated for 31 years at most: until then its clock tells servo periods apart to a thousandth."""
_SLICE_S = 10.0
_MOST_SLICES = 100_000
_OK = int(Code.OK)
Hook: TypeAlias = Callable[[str, int], object]
"""What `GT_HookCommand` is given: told the name of each call that was made, and its code."""


def slice_of(seconds: float) -> float:
    """Simulated time, s, after which who lets a card run for so many seconds takes its pulses.

    So few pulses are held at a time, and no more than `_MOST_SLICES` slices are made of years.
    """
    return max(_SLICE_S, seconds / _MOST_SLICES)


class Logged(NamedTuple):
    """One call as logged: time when it was made, s; name; arguments; answer; coordinate status after it."""

    t_s: float
    name: str
    arguments: tuple[Any, ...]
    answer: Any
    status: int


class CardBase:
    """Clock, cards and call path; the groups of functions build on it.

    Parameters
    ----------
    settings
        Of all cards.
    on_pulses
        Told the pulses of X and Y of the first card as they are worked out, in order.
    on_call
        Told every call.
    on_driven
        Told what the first card has driven its axes along, a piece each time that its motion is planned anew or ends.
    """

    def __init__(
        self,
        settings: CardSettings = CardSettings(),  # noqa: B008 - frozen
        *,
        on_pulses: Callable[[Pulses], None] | None = None,
        on_call: Callable[[Logged], None] | None = None,
        on_driven: Callable[[Driven], None] | None = None,
    ) -> None:
        self.settings = settings
        self._on_call = on_call
        self._states = [CardState() for _ in range(settings.cards)]
        self._engines = [
            Engine(settings, state, *((on_pulses, on_driven) if number == 0 else (None, None)))
            for number, state in enumerate(self._states)
        ]
        self._now_s = 0.0
        self._alone = RLock()
        self._hook: Hook | None = None
        self._is_telling = False
        self._logged = 0
        self._select(0)

    @property
    def time_s(self) -> float:
        """Simulated time since the card was made."""
        return self._now_s

    def sleep(self, ms: float) -> None:
        """Let simulated time pass, as a program's own sleep does; the pulses due by then are handed out.

        TypeError where ms is no number, ValueError where it is negative or goes beyond `LONGEST_S` on the card's clock.
        """
        with self._alone:
            for _ in self.sleeping(ms, math.inf):
                pass

    def sleeping(self, ms: float, slice_s: float) -> Iterator[None]:
        """`sleep` for ms in slices of s: after each of them the pulses due by then are handed out.

        It is one call in the log, made when it is over.

        Errors are those of `sleep`, raised when the first slice is asked for.
        """
        began = self._now_s
        end_s = began + _slept_s(ms, began)
        while True:
            with self._alone:
                self._reach(min(self._now_s + slice_s, end_s))
                for engine in self._engines:
                    engine.motion.hand_out_heard()
                is_over = self._now_s >= end_s
                if is_over:
                    self._log(began, "sleep", (ms,), None)
            yield
            if is_over:
                return

    def wait_until(self, t_s: float) -> None:
        """Let simulated time pass up to a moment; none where that has passed. No function of the library, not logged.

        ValueError beyond `LONGEST_S`.
        """
        if not t_s <= LONGEST_S:
            raise ValueError(f"a card is simulated up to {LONGEST_S:g} s, not {t_s} s")
        with self._alone:
            if t_s > self._now_s:
                self._reach(t_s)
            for engine in self._engines:
                engine.motion.hand_out_heard()

    def _select(self, number: int) -> None:
        """Let the calls go to a card, counted from 0."""
        self._number = number
        self._state, self._engine = self._states[number], self._engines[number]

    def _axis(self, number: int) -> AxisState:
        """Axis 1 to 4. Refused with 7 where the card has none of that number."""
        if not 1 <= number <= self.settings.axes:
            raise Refused(Code.PARAMETER)
        return self._state.axes[number - 1]

    def _pass(self, seconds: float) -> None:
        self._reach(self._now_s + seconds)

    def _reach(self, t_s: float) -> None:
        self._now_s = t_s
        for engine in self._engines:
            engine.sequencer.advance(self._now_s)

    def _called(self, function: Function, given: tuple[Any, ...]) -> Any:
        with self._alone:
            began, hook = self._now_s, self._hook
            self._pass(self.settings.call_s)
            answer = self._answer(function, given)
            name = function.body.__name__
            self._log(began, name, given, answer)
            if hook is not None:
                self._tell(hook, name, answer[0] if isinstance(answer, tuple) else answer)
            return answer

    def _tell(self, hook: Hook, name: str, code: int) -> None:
        """Tell the program's hook of a call; of those that the hook itself makes it is not told."""
        if self._is_telling:
            return
        self._is_telling = True
        try:
            hook(name, code)
        finally:
            self._is_telling = False

    def _answer(self, function: Function, given: tuple[Any, ...]) -> Any:
        body, readers, zeros, when_closed, _ = function
        if not (self._state.opened or when_closed):
            return (int(Code.CLOSED), *zeros) if zeros else int(Code.CLOSED)
        try:
            values = body(self, *read_arguments(readers, given))
        except Refused as refused:
            self._refuse(function, given, refused)
            return (int(refused.code), *self._filled(function, given, refused)) if zeros else int(refused.code)
        if not zeros:
            return _OK
        return (_OK, *values) if len(zeros) > 1 else (_OK, values)

    def _filled(self, function: Function, given: tuple[Any, ...], refused: Refused) -> tuple[Any, ...]:
        """Values of the out-parameters of a refused call."""
        return function.zeros

    def _refuse(self, function: Function, given: tuple[Any, ...], refused: Refused) -> None:
        """Keep what a refused call leaves behind."""
        self._state.command_status = refused.command_status

    def _log(self, began: float, name: str, arguments: tuple[Any, ...], answer: Any) -> None:
        self._logged += 1
        if self._on_call is not None:
            self._on_call(Logged(began, name, arguments, answer, self._engine.coordinate_status()))


def _slept_s(ms: float, now_s: float) -> float:
    """Seconds of a sleep; TypeError and ValueError as `CardBase.sleep` has them."""
    try:
        fits = 0.0 <= ms <= (LONGEST_S - now_s) * 1000.0
    except TypeError:
        raise TypeError(f"a sleep takes a number of ms, not {ms!r}") from None
    if not fits:
        raise ValueError(f"a sleep takes 0 ms or more, up to {LONGEST_S:g} s on the clock, not {ms} ms")
    return float(ms) / 1000.0
