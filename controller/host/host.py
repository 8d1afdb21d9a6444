"""The host's part: a toolpath driven through the card, call by call, as a program on the machine's computer does it."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from controller.card.calls.base import Logged, slice_of
from controller.card.core.call import LIST_FULL, Code, CrdSts
from controller.card.core.settings import UM_S_PER_PULSE_MS, CardSettings
from controller.card.ge import GECard
from controller.host.entries import Drive, blocks_told, entries_of, shapes_told
from controller.stepping.pulses import Pulses
from controller.stepping.steps import words_of
from parser.findings.errors import ControllerError

AXES = (1, 2)  # X and Y
_AT_ONCE = 1 << 17
"""Pulses that are taken from the card at a time, at most: each time takes a twentieth of a millisecond."""


class Host:
    """Drives one program through a card of its own.

    Parameters
    ----------
    drive
        What is driven.
    settings
        Of the card.
    on_call
        Told every call.
    until_s
        Time from the start of motion at which the machine is to stop, whatever is left of the program. Pulses that the
        card makes while it brakes from there are handed out too.
    """

    def __init__(
        self,
        drive: Drive,
        settings: CardSettings,
        on_call: Callable[[Logged], None] | None = None,
        until_s: float = math.inf,
    ) -> None:
        self._until_s = until_s
        self._due: list[Pulses] = []
        self.card = GECard(settings, on_pulses=self._due.append, on_call=on_call)
        self._drive = drive
        words = words_of(drive.toolpath) if drive.interpolation == "point-by-point" else None
        self._entries = entries_of(drive, words)
        self._row_of = np.concatenate([[0], self._entries.row]).astype(np.int32)
        self._steps_words = words is not None
        shapes = shapes_told(self._entries) if words is None else blocks_told(drive, self._entries, words)
        self._told: list[tuple[float, ...]] = shapes
        self._end_s = drive.plan.time_at(np.cumsum(drive.limits.length_um)[self._entries.row])
        fastest = math.sqrt(2.0) * float(drive.plan.speed_um_s.max(initial=1.0))  # pulses/s of both axes
        self._slice_s = _AT_ONCE / fastest
        self._pushed = 0
        self._began_s: float | None = None

    def pulses(self) -> Iterator[Pulses]:
        """Run the whole program, and hand on its pulses as the card makes them.

        They are in program coordinates, with times from the start of motion and the rows of the toolpath.
        ControllerError where the card refuses a call that it should take.
        """
        self._prepare()
        push = self._push_words if self._steps_words else self._push_geometry
        entries = self._entries
        speeds, accelerations = entries.speed_pulse_ms.tolist(), entries.acceleration_pulse_ms2.tolist()
        ends, waits = entries.end_pulse_ms.tolist(), entries.wait_ms.tolist()
        for entry, (speed, acceleration) in enumerate(zip(speeds, accelerations, strict=True)):
            if entry and speed != speeds[entry - 1]:
                self._must(self.card.GT_SetSynVel, speed)
            if entry and acceleration != accelerations[entry - 1]:
                self._must(self.card.GT_SetSynAcc, acceleration)
            if ends[entry] >= 0.0:  # else NaN
                self._must(self.card.GT_SetDccVel, ends[entry])
            yield from push(entry)
            if self._is_over:
                break
            self._pushed += 1
            if waits[entry]:
                yield from self._push(self.card.GT_Delay, waits[entry])
        yield from self._finish()

    def _prepare(self) -> None:
        """Open the card, and begin its list where the axes stand; that entry sets speed and acceleration."""
        card, entries = self.card, self._entries
        self._must(card.GT_Open)
        self._must(card.GT_Reset)
        for axis in AXES:
            for call in (card.GT_ClrSts, card.GT_AxisOn, card.GT_ZeroPos):
                self._must(call, axis)
        start_speed = float(self._drive.limits.border_um_s[0]) / UM_S_PER_PULSE_MS
        if start_speed > 0.0:
            self._must(card.GT_SetStrtVel, start_speed)
        self._must(card.GT_StrtList)
        if len(entries.row):
            motion = float(entries.speed_pulse_ms[0]), float(entries.acceleration_pulse_ms2[0])
            self._must(card.GT_MvXY, 0.0, 0.0, *motion)

    def _push_words(self, entry: int) -> Iterator[Pulses]:
        return self._push(self.card.step_block, *self._told[entry])

    def _push_geometry(self, entry: int) -> Iterator[Pulses]:
        call = self.card.GT_ArcXY if self._entries.angle_deg[entry] else self.card.GT_LnXY
        return self._push(call, *self._told[entry])

    def _push(self, call: Callable[..., int], *arguments: float) -> Iterator[Pulses]:
        """Make a call that needs room in the list, when there is room; the pulses that go out until then."""
        while (code := call(*arguments)) == Code.COMMAND and self.card.GT_GetCmdSts()[1] == LIST_FULL:
            yield from self._make_room()
            if self._is_over:
                return
        if code != Code.OK:
            raise _refused(call, arguments, code)

    def _must(self, call: Callable[..., int], *arguments: float) -> None:
        code = call(*arguments)
        if code != Code.OK:
            raise _refused(call, arguments, code)

    @property
    def _is_over(self) -> bool:
        """Whether the time has come at which the machine is to stop."""
        return self._began_s is not None and self.card.time_s >= self._began_s + self._until_s

    def _make_room(self) -> Iterator[Pulses]:
        """Let the card run until about half of its list is done."""
        done = self._pushed - self.card.settings.capacity // 2
        return self._sleep_until(float(self._end_s[min(max(done, 0), self._pushed - 1)]))

    def _sleep_until(self, t_s: float) -> Iterator[Pulses]:
        """Sleep until a time from the start of motion, 1 ms at least; starts the list where it does not run yet."""
        if self._began_s is None:
            self._start()
        began = self._began_s or 0.0
        return self._sleep(max((began + min(t_s, self._until_s) - self.card.time_s) * 1e3, 1.0))

    def _sleep(self, ms: float) -> Iterator[Pulses]:
        """Sleep, and hand on the pulses that go out."""
        for _ in self.card.sleeping(ms, max(slice_of(ms / 1e3), self._slice_s)):
            yield from map(self._placed, self._due)
            self._due.clear()

    def _start(self) -> None:
        """Start the list with a servo period, so that what the card samples does not depend on the calls before."""
        card = self.card
        period_s, call_s = card.settings.servo_period_s, card.settings.call_s
        begins_s = math.ceil((card.time_s + call_s) / period_s) * period_s
        card.sleep(max(begins_s - call_s - card.time_s, 0.0) * 1e3)
        self._must(card.GT_StrtMtn)
        self._began_s = card.time_s

    def _finish(self) -> Iterator[Pulses]:
        """Close the list, wait for its end or stop it, ask where the axes stand."""
        card = self.card
        self._must(card.GT_EndList)
        yield from self._sleep_until(self._drive.plan.duration_s)
        if self._is_over:
            self._must(card.GT_EStpMtn)
        while not card.GT_GetCrdSts()[1] & CrdSts.IDLE:
            yield from self._sleep(1.0)
        for axis in AXES:
            card.GT_GetAtlPos(axis)
        self._must(card.GT_Close)

    def _placed(self, pulses: Pulses) -> Pulses:
        """Pulses of the card from the start of motion, in program coordinates, with rows of the toolpath."""
        began = self._began_s or 0.0  # no pulse comes before the start
        x0, y0 = self._drive.origin_um
        t_s = np.maximum(pulses.t_s - began, 0.0)
        return Pulses(t_s, pulses.x_um + np.int32(x0), pulses.y_um + np.int32(y0), self._row_of[pulses.row])


def _refused(call: Any, arguments: tuple[float, ...], code: int) -> ControllerError:
    arguments_text = ", ".join(map(str, arguments))
    return ControllerError(
        "card-refused", call=call.__name__, arguments=arguments_text, code=code, name=Code(code).name.lower()
    )
