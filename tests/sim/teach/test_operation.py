"""Drills of operation: each is an incident that its remedy mends, judged by running on."""

from functools import cache

import pytest
from runs import scenario_run

from parser.findings.errors import SettingsError
from sim.process.cut import Started
from sim.process.ticks import hands
from sim.process.ticks import state as ticks
from sim.run.sparks import panel_cut
from sim.teach.operation.incidents import (
    ACTIONS,
    KINDS,
    REMEDIES,
    Action,
    OperationDrill,
    operation_drills,
    outcome,
)


@cache
def cut() -> Started:
    run = scenario_run("sparks-chip")
    return panel_cut(run, run.scenario)


@cache
def drills(number: int = 1) -> tuple[OperationDrill, ...]:
    return operation_drills(cut(), number, len(KINDS))


def of(kind: str, number: int = 1) -> OperationDrill:
    return next(drill for drill in drills(number) if drill.kind == kind)


def test_actions_have_the_numbers_of_hands() -> None:
    numbers = [
        *(hands.KNOB_UP, hands.KNOB_DOWN, hands.PUMP_ON, hands.DRUM_ON, hands.GENERATOR_ON, hands.GO_BACK),
        *(hands.THREAD_HERE, hands.THREAD_AT_START, hands.POWER_ON, hands.BEGIN_BLOCK_AGAIN, hands.CLEAR_ALARM),
    ]
    assert numbers == list(range(len(ACTIONS)))


@pytest.mark.parametrize("number", [1, 2])
def test_a_set_has_every_kind_and_each_is_proved(number: int) -> None:
    assert sorted(drill.kind for drill in drills(number)) == sorted(KINDS)
    for drill in drills(number):
        assert outcome(cut(), drill, ()) != hands.GOES_ON
        assert outcome(cut(), drill, REMEDIES[drill.kind]) == hands.GOES_ON


def test_the_same_set_is_the_same_and_another_is_elsewhere() -> None:
    again = operation_drills(cut(), 1, len(KINDS))
    assert [drill.state.tobytes() for drill in again] == [drill.state.tobytes() for drill in drills()]
    assert [drill.counters for drill in drills(2)] != [drill.counters for drill in drills()]


WRONG: list[tuple[str, tuple[Action, ...], int]] = [
    ("water", ("thread-here", "pump-on"), hands.STANDS),  # the next wire burns before the pump is on
    ("drum", ("thread-here", "drum-on"), hands.STANDS),
    ("water", ("drum-on", "thread-here"), hands.STANDS),
    ("too-fast", ("knob-down",), hands.SHORTS_THEN),
    ("too-slow", ("knob-up",), hands.TOO_SLOW),
    ("power", ("thread-here",), hands.STANDS),
    ("broken", ("power-on",), hands.STANDS),
    ("short", ("knob-up",), hands.STANDS),
]


@pytest.mark.parametrize(("kind", "actions", "comes_to"), WRONG)
def test_wrong_hands_and_a_wrong_order_do_not_mend_it(kind: str, actions: tuple[Action, ...], comes_to: int) -> None:
    assert outcome(cut(), of(kind), actions) == comes_to


def test_a_way_that_is_no_remedy_of_ours_counts_too() -> None:
    assert outcome(cut(), of("broken"), ("pump-on", "drum-on", "thread-start")) == hands.GOES_ON
    assert outcome(cut(), of("power"), ("block-again",)) == hands.GOES_ON


def test_instruments_show_what_happened() -> None:
    assert of("too-fast").strip[-40:, 1].mean() < 0.15
    assert of("too-slow").strip[-40:, 1].mean() > 0.7
    assert of("short").strip[-3:, 1].max() == 0.0
    assert of("broken").strip[-1, 1:].tolist() == [1.0, 0.0]
    assert of("power").strip[-1, 1:].tolist() == [0.0, 0.0]
    assert of("water").came_to == ticks.BROKEN
    assert all(drill.strip[-1, 0] == 0.0 and drill.strip[0, 0] < -3.0 for drill in drills())


def test_a_path_that_is_too_short_is_refused() -> None:
    short = cut()
    way = short.job.way._replace(along_um=short.job.way.along_um / 10.0)
    with pytest.raises(SettingsError, match="too short"):
        operation_drills(short._replace(job=short.job._replace(way=way)), 1, 1)
