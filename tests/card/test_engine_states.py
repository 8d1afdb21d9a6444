"""The states of the card's motion and of its look-ahead: which one after which call, and that there are no others."""

import dataclasses
import random
from itertools import pairwise
from typing import get_args

import pytest
from watched import ABNORMAL, IDLE, Watched

from controller.card.core.call import Code
from controller.card.core.settings import Switches
from controller.card.engine import engine, motion
from controller.card.engine.entries import ORIGIN
from controller.card.engine.motion import (
    Braking,
    BrokenList,
    BrokenMove,
    CardMotion,
    Idle,
    ListRun,
    Move,
    Moving,
    Resting,
    Running,
    Waiting,
)
from controller.card.lookahead import (
    HostRules,
    ListLookAhead,
    Off,
    On,
    Unruled,
    ruled,
    switched_off,
    switched_on,
)

STATES = (*get_args(Resting), *get_args(Moving))


def state_of(watched):
    return watched.card._engine.motion.state


def told(state):
    """A state in words."""
    match state:
        case Running(task=task) | Braking(task=task):
            what = "list" if isinstance(task, ListRun) else f"move over {told(task.beneath)}"
            return f"{type(state).__name__.lower()} {what}"
        case BrokenMove(move=move):
            return f"broken move over {told(move.beneath)}"
        case BrokenList():
            return "broken list"
    return type(state).__name__.lower()


def stopped(watched):
    assert watched.card.GT_StpMtn() == 0
    watched.until_idle()


def idle():
    watched = Watched()
    watched.load((1000.0, 0.0))
    return watched


def list_runs():
    watched = idle()
    assert watched.card.GT_StrtMtn() == 0
    watched.card.sleep(500.0)
    return watched


def waiting():
    watched = list_runs()
    watched.until_idle()
    return watched


def list_brakes():
    watched = list_runs()
    assert watched.card.GT_StpMtn() == 0
    return watched


def list_broken():
    watched = list_brakes()
    watched.until_idle()
    return watched


def moving_from(watched):
    assert watched.card.GT_LnXY(0.0, 700.0) == 0
    watched.card.sleep(300.0)
    return watched


def move_brakes():
    watched = moving_from(Watched())
    assert watched.card.GT_StpMtn() == 0
    return watched


def broken_from(watched):
    stopped(moving_from(watched))
    return watched


CALLS = {
    "start": lambda card: card.GT_StrtMtn(),
    "restore": lambda card: card.GT_RestoreMtn(),
    "stop": lambda card: card.GT_StpMtn(),
    "open": lambda card: card.GT_StrtList(),
    "move": lambda card: card.GT_LnXY(-50.0, -50.0),
    "reset": lambda card: card.GT_Reset(),
}
REFUSED = Code.COMMAND
MOVE, MOVE_OVER_LIST = "running move over idle", "running move over broken list"
TABLE = {  # state: how it is come to, then the state after each of the calls, or that they are refused
    "idle": (idle, "running list", REFUSED, "idle", "idle", MOVE, "idle"),
    "waiting": (waiting, "waiting", REFUSED, "waiting", "idle", MOVE, "idle"),
    "running list": (list_runs, "running list", REFUSED, "braking list", REFUSED, REFUSED, "idle"),
    "braking list": (list_brakes, REFUSED, REFUSED, "braking list", REFUSED, REFUSED, "idle"),
    "broken list": (list_broken, "running list", "running list", "broken list", "idle", MOVE_OVER_LIST, "idle"),
    MOVE: (lambda: moving_from(idle()), REFUSED, REFUSED, "braking move over idle", REFUSED, REFUSED, "idle"),
    "braking move over idle": (move_brakes, REFUSED, REFUSED, "braking move over idle", REFUSED, REFUSED, "idle"),
    "broken move over idle": (
        lambda: broken_from(Watched()),
        "waiting",
        MOVE,
        "broken move over idle",
        "broken move over idle",
        MOVE,
        "idle",
    ),
    "broken move over broken list": (
        lambda: broken_from(list_broken()),
        REFUSED,  # the axes stand beside the break point of the list
        MOVE_OVER_LIST,
        "broken move over broken list",
        "broken move over idle",
        MOVE_OVER_LIST,
        "idle",
    ),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("before", TABLE)
def test_each_call_leads_from_each_state_to_one(before, call):
    reach, *after = TABLE[before]
    expected = dict(zip(CALLS, after, strict=True))[call]
    watched = reach()
    assert told(state_of(watched)) == before
    code = CALLS[call](watched.card)
    if isinstance(expected, Code):
        assert (code, told(state_of(watched))) == (expected, before)
    else:
        assert (code, told(state_of(watched))) == (0, expected)


def test_a_motion_comes_to_rest_in_the_state_that_its_task_leaves():
    for reach, rest in (
        (list_runs, "waiting"),
        (list_brakes, "broken list"),
        (lambda: moving_from(Watched()), "idle"),
        (lambda: moving_from(waiting()), "idle"),
        (lambda: moving_from(list_broken()), "broken list"),
        (move_brakes, "broken move over idle"),
    ):
        watched = reach()
        watched.until_idle()
        assert told(state_of(watched)) == rest


def test_a_list_that_waits_runs_what_is_pushed_and_waits_again():
    watched = waiting()
    watched.card.GT_AddList()
    assert watched.card.GT_LnXY(1500.0, 0.0) == 0
    assert told(state_of(watched)) == "running list"
    watched.until_idle()
    assert told(state_of(watched)) == "waiting"


def test_a_limit_brakes_and_breaks():
    watched = Watched(switches=(Switches(positive=300.0),))
    watched.card.GT_LnXY(1000.0, 0.0)
    while watched.card.GT_GetSts(1)[1] & 1 << 5 == 0:
        watched.card.sleep(1.0)
    assert told(state_of(watched)) == "braking move over idle"
    watched.until_idle()
    assert told(state_of(watched)) == "broken move over idle"
    assert watched.status() & ABNORMAL


def test_a_harder_stop_takes_over_and_a_softer_one_leaves_the_state_as_it_is():
    watched = list_brakes()
    soft = state_of(watched)
    watched.card.GT_EStpMtn()
    hard = state_of(watched)
    assert hard.deceleration_um_s2 > soft.deceleration_um_s2
    watched.card.GT_StpMtn()
    assert state_of(watched) is hard


def at_the_end_of_a_move_over_a_broken_list():
    """All of the move is run, but its last servo period, which is long here."""
    watched = Watched(servo_period_s=0.01)
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    watched.card.sleep(500.0)
    stopped(watched)
    watched.card.GT_LnXY(500.0, 300.0)
    while watched.point()[:2] != (500.0, 300.0):
        watched.card.sleep(0.02)
    assert not watched.status() & IDLE
    return watched


def test_a_move_stopped_with_nothing_left_gives_the_list_its_break_point_back():
    watched = at_the_end_of_a_move_over_a_broken_list()
    place = state_of(watched).task.beneath.place
    stopped(watched)
    assert state_of(watched) == BrokenList(place)
    assert watched.card.GT_GetBrkPnt() == (0, place)
    assert watched.card.GT_RestoreMtn() == Code.COMMAND, "the axes stand elsewhere"
    watched.card.GT_LnXY(*place[:2])
    watched.until_idle()
    assert watched.card.GT_RestoreMtn() == 0
    watched.until_idle()
    assert watched.places() == (1000, 0, 0, 0)


def test_a_move_that_was_gone_on_with_gives_the_list_its_break_point_back_at_its_end():
    watched = list_broken()
    place = state_of(watched).place
    broken_from(watched)
    assert watched.card.GT_GetBrkPnt()[1] != place
    watched.card.GT_RestoreMtn()
    watched.until_idle()
    assert watched.card.GT_GetBrkPnt() == (0, place)


def test_no_state_holds_what_it_cannot_have():
    names = {state: [key.name for key in dataclasses.fields(state)] for state in STATES}
    assert names == {
        Idle: [],
        Waiting: [],
        BrokenList: ["place"],
        BrokenMove: ["place", "move", "left"],
        Running: ["task", "stretch"],
        Braking: ["task", "stretch", "deceleration_um_s2"],
    }
    stretch = state_of(list_runs()).stretch
    with pytest.raises(ValueError, match=r"brakes with more than 0\.0"):
        Braking(ListRun(), stretch, 0.0)
    with pytest.raises(ValueError, match="nothing is left"):
        BrokenMove(ORIGIN, Move(Idle()), ())
    with pytest.raises(dataclasses.FrozenInstanceError):
        Running(ListRun(), stretch).stretch = None


LEGAL = {
    Idle: {Idle, Waiting, Running},
    Waiting: {Idle, Waiting, Running},
    BrokenList: {Idle, Waiting, BrokenList, Running},
    BrokenMove: {Idle, BrokenList, BrokenMove, Running},
    Running: {Running, Braking, Idle, Waiting, BrokenList},
    Braking: {Braking, Idle, BrokenList, BrokenMove},
}


def test_random_calls_take_every_legal_way_and_no_other(monkeypatch):
    seen = []

    class Seen(CardMotion):
        def __setattr__(self, name, value):
            if name == "state":
                seen.append(value)
            super().__setattr__(name, value)

    monkeypatch.setattr(engine, "CardMotion", Seen)
    rng = random.Random(20260401)
    ways = set()
    for _ in range(150):
        seen.clear()
        watched = Watched(capacity=8)
        card = watched.card
        calls = (
            *CALLS.values(),
            *(CALLS[name] for name in ("start", "restore", "stop", "stop")),
            lambda card: card.GT_LnXY(rng.randint(-300, 300), rng.randint(-300, 300)),
            lambda card: card.GT_AddList(),
            lambda card: card.GT_EndList(),
            lambda card: card.GT_Override(rng.choice([0.5, 1.0])),
            lambda card: card.GT_LnXY(*card.GT_GetBrkPnt()[1][:2]),
        )
        for _ in range(60):
            rng.choice(calls)(card)
            card.sleep(rng.choice([0.0, 1.0, 40.0, 600.0]))
        for before, after in pairwise(seen):
            ways.add((type(before), type(after)))
            if isinstance(before, motion.Moving) and isinstance(after, motion.Moving):
                assert before.task == after.task, "a motion keeps its task until it rests"
    legal = {(before, after) for before, others in LEGAL.items() for after in others}
    assert ways - legal == set()
    assert legal - ways == set(), "these should have been seen too"


RULES = HostRules(0.002, 5e5, 1e5, 1e6, 3, 1.0)


def test_the_look_ahead_keeps_blocks_only_while_it_is_on_with_rules():
    off, unruled, on = Off(), Unruled(), On(ListLookAhead(RULES))
    assert switched_on(off) == unruled
    assert isinstance(ruled(unruled, RULES), On)
    assert ruled(off, RULES) == Off(RULES)
    assert switched_on(Off(RULES)).look_ahead.rules == RULES
    assert switched_on(on) is on
    assert switched_off(on) == Off(RULES)
    assert switched_off(unruled) == switched_off(off) == off


def test_each_card_has_a_look_ahead_of_its_own():
    watched = Watched(cards=2)
    card = watched.card
    card.GT_SwitchLookaheadMode(1)
    card.GT_InitLookAheadEx(2.0, 0.5, 0.1, 3, 1.0)
    card.GT_SwitchtoCardNo(1)
    card.GT_Open()
    assert [type(mode) for mode in card._modes] == [On, Off]
    card.GT_SwitchLookaheadMode(1)
    assert [type(mode) for mode in card._modes] == [On, Unruled]
    card.GT_Reset()
    assert [type(mode) for mode in card._modes] == [On, Off]


def test_a_look_ahead_that_keeps_blocks_is_not_left():
    watched = Watched()
    card = watched.card
    card.GT_InitLookAheadEx(2.0, 0.5, 0.1, 3, 1.0)
    card.GT_SwitchLookaheadMode(1)
    card.GT_StrtList()
    assert card.GT_LnXYEx(1.0, 0.0, 1.0, 0, 1)[0] == 0
    (mode,) = card._modes
    with pytest.raises(ValueError, match="1 blocks are kept"):
        switched_off(mode)
    assert card.GT_SwitchLookaheadMode(0) == Code.COMMAND
    assert card.GT_EndLookaheadMode() == 0
    assert isinstance(card._modes[0], Off)
