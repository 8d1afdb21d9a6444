"""The card: takes a load, runs it, keeps position and status, and hands out every pulse once."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import program_text, programs

from controller.card import CardError, Status, StepCard
from controller.plan import Feeds, Plan, plan_runs
from controller.point_by_point import interpolate
from controller.steps import Steps
from parser.program import parse_program

FEEDS = Feeds(50.0, 400.0, 1000.0)


def load(text: str) -> tuple[Steps, Plan]:
    toolpath = parse_program(text).toolpath
    return interpolate(toolpath), plan_runs(toolpath, FEEDS)


def test_status_follows_load_start_and_end() -> None:
    card = StepCard()
    assert card.status is Status.EMPTY
    with pytest.raises(CardError, match="empty"):
        card.start()
    card.load(*load("B10B0B10GXL1"))
    assert card.status is Status.READY
    with pytest.raises(CardError, match="ready"):
        card.take()
    card.start()
    assert card.status is Status.RUNNING
    with pytest.raises(CardError, match="running"):
        card.load(*load("B10B0B10GXL1"))
    assert card.take(4).x_um.tolist() == [1, 2, 3, 4]
    assert card.position_um == (4, 0)
    card.take()
    assert card.status is Status.FINISHED
    assert len(card.take().t_s) == 0


def test_the_next_load_goes_on_from_the_position() -> None:
    card = StepCard()
    for _ in range(2):
        card.load(*load("B10B0B10GXL1"))
        card.start()
        card.take()
    assert card.position_um == (20, 0)


def test_time_passes_as_the_plan_says() -> None:
    card = StepCard()
    steps, plan = load("B1000B0B1000GXL1")
    card.load(steps, plan)
    card.start()
    pulses = card.take()
    assert card.time_s == pulses.t_s[-1] == pytest.approx(plan.duration_s)
    assert pulses.t_s[499] == pytest.approx(plan.duration_s / 2)
    # At the feed of 50 µm/s a step comes every 20 ms.
    assert np.diff(pulses.t_s[100:900]) == pytest.approx(0.02)


@given(programs, st.integers(20, 400))
def test_pulses_add_up_to_the_end_whatever_they_are_taken_by(program: list, most: int) -> None:
    steps, plan = load(program_text(program))
    card = StepCard()
    card.load(steps, plan)
    card.start()
    times, number = [], 0
    while card.status is Status.RUNNING:
        pulses = card.take(most)
        number += len(pulses.t_s)
        times.append(pulses.t_s)
        assert card.position_um == (pulses.x_um[-1], pulses.y_um[-1])
    assert number == len(steps)
    assert card.position_um == tuple(steps.corner_um[-1])
    t_s = np.concatenate(times)
    assert np.diff(t_s).min(initial=0.0) >= -1e-9
    assert t_s[-1] <= plan.duration_s
