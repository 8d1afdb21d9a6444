"""Any sequence of calls: nothing raises, a refused call changes nothing, and the card keeps its own word."""

import math

import numpy as np
import pytest
from depth import examples
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from plain import PlainBlock, plain_steps
from watched import EMPTY, IDLE, Watched

from controller.card.core.settings import Switches
from controller.card.engine.motion import Waiting

PERIOD_S = 200e-6
AXES = range(1, 5)
HOST_ERROR = 1 << 7  # tells of refused calls

coordinates = st.integers(-300, 300) | st.floats(-300.0, 300.0).map(lambda x: round(x, 2))
awkward = st.sampled_from([0.0, -1.0, 1e-12, 1e300, -1e300, math.inf, math.nan])
speeds = st.floats(0.05, 20.0).map(lambda x: round(x, 3))
accelerations = st.floats(0.001, 1.0).map(lambda x: round(x, 3))
blocks = st.sampled_from(
    [
        (30, 40, 40, 1, 1, 0, 50.0),
        (100, 3, 100, 0, 3, 0, math.hypot(100, 3)),
        (20, 0, 40, 0, 1, 1, math.pi * 20),
        (0, 25, 50, 1, 2, -1, math.pi * 25),
        (12, 16, 70, 0, 1, 1, 1.6 * math.pi * 20),
        (0, 0, 5, 0, 1, 0, 5.0),
        (5, 0, 5, 1, 1, 0, 5.0),
        (1, 0, 4, 0, 1, 1, 6.0),
        (5, 5, 5, 2, 1, 0, 7.0),
        (5, 5, 5000, 0, 1, 0, 7.0),
    ]
)


def plain_end(block, at):
    x, y, count, axis, quadrant, turn, _ = block
    letter = {0: "L", 1: "NR", -1: "SR"}[turn]
    places = plain_steps(PlainBlock(x, y, count, "XY"[axis], letter, quadrant))
    return (round(at[0]) + places[-1][0], round(at[1]) + places[-1][1])


class CardMachine(RuleBasedStateMachine):
    """Random calls on a small list; `end` is where the model sees the list end, None where it does not know."""

    @initialize(
        carries_speed=st.booleans(),
        switches=st.sampled_from(
            [(), (Switches(negative=-150.0, positive=200.0, home=(40.0, 60.0), index_every=25.0),)]
        ),
        jerk_pulse_ms3=st.sampled_from([math.inf, 1e-3]),
        call_s=st.sampled_from([1e-30, 20e-6]),
    )
    def make(self, **chosen):
        self.calls_take_time = chosen["call_s"] > 1e-9
        self.watched = Watched(capacity=6, servo_period_s=PERIOD_S, **chosen)
        self.card = self.watched.card
        self.card.sleep(1.0)  # from here on, a call of 1e-30 s takes no time
        self.is_open, self.end, self.checked, self.pulsed_s = False, None, 0, 0.0

    def readable(self):
        card = self.card
        points = card.GT_GetPrfPnt(), card.GT_GetBrkPnt(), card.GT_GetSegPnt(), card.GT_GetPrfVel()
        words = (
            card.GT_GetCrdSts(),
            card.GT_GetMtnNm(),
            card.GT_GetExOpt(),
            [card.GT_GetSts(axis)[1] & ~HOST_ERROR for axis in AXES],
        )
        pulses = [card.GT_GetAtlPos(axis) for axis in AXES]
        engine = card._engine
        return points, words, pulses, repr(engine.speeds), engine.list.is_open, list(engine.list.entries)

    def call(self, name, *arguments):
        """Answer of a call; where calls take no time, a refused one has changed nothing."""
        if self.calls_take_time:
            return getattr(self.card, name)(*arguments)
        before = self.readable()
        code = getattr(self.card, name)(*arguments)
        assert code in (0, 1, 2, 3, 4, 5, 6, 7)
        if code:
            assert self.readable() == before
        return code

    def add(self, code, end):
        if code == 0:
            self.end = end if self.is_open else None

    def pulses_of(self, *place):
        return tuple(value + own.zero for value, own in zip(place, self.card._state.axes, strict=False))

    def list_end(self):
        return self.card._engine.list_end()

    @rule(x=coordinates | awkward, y=coordinates)
    def line(self, x, y):
        self.add(self.call("GT_LnXY", x, y), self.pulses_of(x, y))

    @rule(x=coordinates, y=coordinates)
    def rapid(self, x, y):
        self.add(self.call("GT_LnXYG0", x, y), self.pulses_of(x, y))

    @rule(place=st.tuples(coordinates, coordinates, coordinates, coordinates))
    def four_axes(self, place):
        self.add(self.call("GT_LnXYZA", *place), self.pulses_of(*place))

    @rule(x=coordinates, y=coordinates, vel=speeds | awkward, acc=accelerations)
    def position(self, x, y, vel, acc):
        self.add(self.call("GT_MvXY", x, y, vel, acc), self.pulses_of(x, y))

    @rule(x=coordinates, y=coordinates, angle=st.sampled_from([90.0, -90.0, 180.0, -270.0, 360.0, 33.3, 0.0, 361.0]))
    def arc(self, x, y, angle):
        began = self.list_end() if self.is_open else None
        code = self.call("GT_ArcXY", x, y, angle)
        if began is not None:
            centre = complex(*self.pulses_of(x, y))
            turned = centre + (complex(*began[:2]) - centre) * np.exp(1j * math.radians(angle))
            self.add(code, (turned.real, turned.imag))
        else:
            self.add(code, None)

    @rule(x=coordinates, y=coordinates, r=st.sampled_from([0.0, 50.0, -80.0, 400.0, -400.0]), sense=st.integers(-1, 2))
    def arc_by_radius(self, x, y, r, sense):
        self.add(self.call("GT_ArcXYP", x, y, r, sense), self.pulses_of(x, y))

    @rule(block=blocks)
    def step(self, block):
        began = self.list_end()
        code = self.call("step_block", *block)
        if code == 0:
            self.end = plain_end(block, began)

    @rule(vel=speeds | awkward)
    def speed(self, vel):
        self.call("GT_SetSynVel", vel)

    @rule(vel=speeds | awkward)
    def end_speed(self, vel):
        self.call("GT_SetDccVel", vel)

    @rule(vel=st.sampled_from([0.0, 0.1, 3.0, -1.0]))
    def start_speed(self, vel):
        self.call("GT_SetStrtVel", vel)

    @rule(k=st.sampled_from([0.3, 1.0, 1.9, 0.0, 2.0, -1.0]))
    def override(self, k):
        self.call("GT_Override", k)

    @rule(name=st.sampled_from(["GT_StpMtn", "GT_EStpMtn"]))
    def stop(self, name):
        assert self.call(name) == 0

    @rule()
    def restore(self):
        self.call("GT_RestoreMtn")

    @rule()
    def start(self):
        has_entries = not self.watched.status() & EMPTY
        if self.call("GT_StrtMtn") == 0 and has_entries and not self.calls_take_time:
            moves = [entry for entry in self.card._engine.list.entries if entry.kind is not None]
            assert not moves or not self.watched.status() & IDLE

    @rule()
    def open_list(self):
        if self.call("GT_StrtList") == 0:
            self.is_open, self.end = True, None

    @rule()
    def add_to_list(self):
        assert self.call("GT_AddList") == 0
        self.is_open = True

    @rule()
    def end_list(self):
        assert self.call("GT_EndList") == 0
        self.is_open = False

    @rule(bit=st.integers(0, 17), level=st.integers(0, 2))
    def output(self, bit, level):
        self.call("GT_BufIOBit", bit, level)

    @rule(ms=st.integers(-1, 200))
    def wait(self, ms):
        self.call("GT_Delay", ms)

    @rule(axis=st.integers(0, 5), name=st.sampled_from(["GT_LmtsOn", "GT_LmtsOff", "GT_CaptHome", "GT_CaptIndex"]))
    def switches(self, axis, name):
        self.call(name, axis)

    @rule(axis=st.integers(1, 4))
    def zero(self, axis):
        if self.call("GT_ZeroPos", axis) == 0:
            self.end = None  # the profile may have moved to the whole pulse

    @rule(ms=st.sampled_from([0.0, 0.05, 1.0, 7.3, 40.0, 150.0, 600.0]))
    def sleep(self, ms):
        self.card.sleep(ms)

    @precondition(lambda self: not self.is_open)
    @rule()
    def reset(self):
        assert self.call("GT_Reset") == 0
        self.end = None
        assert self.watched.status() == IDLE | EMPTY

    @rule()
    def come_to_rest(self):
        self.watched.until_idle(200.0)
        before = self.watched.places()
        self.card.sleep(100.0)
        assert self.watched.places() == before
        assert self.card.GT_GetPrfVel() == (0, 0.0)
        assert not any(self.card.GT_GetSts(axis)[1] >> 10 & 1 for axis in AXES)

    @invariant()
    def pulses_are_places(self):
        if not hasattr(self, "card"):
            return
        places = self.watched.places()
        new = self.watched.collected[self.checked :]
        at = self.last if self.checked else (0, 0)
        for pulses in new:
            xy = np.stack([pulses.x_um, pulses.y_um], axis=1)
            assert (np.abs(np.diff(xy, axis=0, prepend=[at])).sum(axis=1) == 1).all()
            at = tuple(xy[-1].tolist())
            assert (np.diff(pulses.t_s, prepend=self.pulsed_s) >= 0.0).all()
            self.pulsed_s = pulses.t_s[-1]
            assert pulses.t_s[-1] <= self.card.time_s + PERIOD_S
        self.last, self.checked = at, len(self.watched.collected)
        assert places[:2] == at

    @invariant()
    def profile_is_near_the_pulses(self):
        if not hasattr(self, "card"):
            return
        engine = self.card._engine.motion
        lag = 0.5 + 1.01 * (np.abs(engine.velocity()) + 50e3 * PERIOD_S) * PERIOD_S * 2 if engine.moving else 0.5
        far = np.abs(np.array(engine.place()) - np.array(engine.pulses_out()))
        assert (far <= lag + 1e-6).all()

    @invariant()
    def list_ends_where_it_says(self):
        if not hasattr(self, "card") or self.end is None:
            return
        if self.watched.status() == IDLE | EMPTY and isinstance(self.card._engine.motion.state, Waiting):
            point = self.card._engine.motion.place()
            assert point[: len(self.end)] == pytest.approx(self.end, abs=1e-6)


TestCardStates = CardMachine.TestCase
TestCardStates.settings = settings(
    max_examples=examples(60),
    stateful_step_count=40,
    deadline=None,
    derandomize=True,
    suppress_health_check=list(HealthCheck),
)
