"""Random sessions of the card, made again from their logs: the axes end where they did, a run makes those pulses."""

import io
import random
from pathlib import Path

import numpy as np
import pytest

from controller import GECard
from controller.card.core.settings import CardSettings, Switches
from controller.card.log import CardLog
from controller.stepping.pulses import Pulses
from sim.cli.card import ClientOptions, scenario_of
from sim.clients.run import Read, read_again, run_client
from sim.clients.session import session_of

REST_MS = 1e6


class Sink:
    """Counts the pulses of a run, and keeps where the last one led."""

    def __init__(self) -> None:
        self.steps, self.last = 0, (0, 0)

    def open(self, origin_um: tuple[int, int]) -> None:
        self.last = origin_um

    def take(self, pulses: Pulses) -> None:
        self.steps += len(pulses.t_s)
        self.last = (int(pulses.x_um[-1]), int(pulses.y_um[-1]))


def random_session(seed: int) -> tuple[Read, list[list[int]], int]:
    """A session as it is read, where the axes of its card came to rest, and the pulses of the first card."""
    rng = random.Random(seed)
    switches = (Switches(negative=-3000.0, home=(-900.0, -700.0), index_every=250.0), Switches(positive=6000.0))
    settings = CardSettings(
        cards=2, call_s=rng.choice([1e-5, 1e-3]), capacity=rng.choice([3, 64]), switches=switches[: rng.randrange(3)]
    )
    stream, pulses = io.StringIO(), list[int]()
    log = CardLog(stream, settings)
    card = GECard(settings, on_pulses=lambda one: pulses.append(len(one.t_s)), on_call=log)
    card.GT_Open()
    card.GT_SetSynAcc(0.2)
    calls = (
        lambda: card.GT_LnXY(*(rng.uniform(-5000.0, 7000.0) for _ in "xy")),
        lambda: card.GT_LnXYZ(*(rng.uniform(-2000.0, 2000.0) for _ in "xyz")),
        lambda: card.GT_ArcXY(*(rng.uniform(-900.0, 900.0) for _ in "xy"), rng.choice([90.0, -360.0, 200.0])),
        lambda: card.GT_ArcZX(*(rng.uniform(-900.0, 900.0) for _ in "zx"), 120.0),
        lambda: card.GT_MvXY(*(rng.uniform(-900.0, 900.0) for _ in "xy"), 8.0, 0.1),
        lambda: card.GT_LnXYG0(*(rng.uniform(-900.0, 900.0) for _ in "xy")),
        lambda: card.GT_SetSynVel(rng.uniform(1.0, 20.0)),
        lambda: card.GT_Override(rng.uniform(0.2, 1.9)),
        lambda: card.GT_Delay(rng.randrange(200)),
        card.GT_StrtList,
        card.GT_AddList,
        card.GT_EndList,
        card.GT_StrtMtn,
        card.GT_StpMtn,
        card.GT_EStpMtn,
        card.GT_RestoreMtn,
        lambda: card.GT_CaptHome(1),
        lambda: card.GT_ClrSts(rng.randrange(1, 6)),
        lambda: card.GT_LmtSns(rng.randrange(256)),
        lambda: card.GT_MapCnt(1, rng.choice([1.0, 2.0])),
        lambda: card.GT_ZeroPos(rng.randrange(1, 4)),
        lambda: card.GT_Reset() if rng.random() < 0.3 else card.GT_GetMtnNm(),
        lambda: card.GT_SwitchtoCardNo(rng.randrange(2)) if rng.random() < 0.2 else card.GT_SwitchtoCardNo(0),
        lambda: [card.GT_GetCrdSts() for _ in range(rng.randrange(300))],
        lambda: card.sleep(rng.uniform(0.0, 900.0)),
        lambda: card.sleep(rng.uniform(0.0, 40.0)),
    )
    for _ in range(120):
        rng.choice(calls)()
    if rng.random() < 0.5:
        log.close(card)
    text = stream.getvalue()
    card.sleep(REST_MS)
    return read_again("card.log", session_of("card.log", text.splitlines(keepends=True))), card.places, sum(pulses)


@pytest.mark.alike(4)
@pytest.mark.parametrize("seed", range(40))
def test_the_axes_end_where_they_did(seed: int) -> None:
    found, places, _ = random_session(seed)
    assert found.again.places == places
    way = found.again.way
    assert np.array_equal(way.curves.start_um[1:], way.curves.end_um[:-1])
    if len(way.call):
        assert np.abs(way.curves.end_um[-1] - places[0][:2]).max() <= 1.0
        assert way.plan.along_um[-1] == pytest.approx(way.curves.length_um.sum(), abs=1.0 + 0.5 * len(way.call))


@pytest.mark.alike(2)
@pytest.mark.parametrize("seed", [0, 3, 5, 8])
def test_a_run_makes_the_pulses_of_the_card_and_its_table_follows(seed: int) -> None:
    found, places, count = random_session(seed)
    sink = Sink()
    scenario = scenario_of(ClientOptions(("client",), Path("out"), None, None, None, 1.0, None))
    run = run_client(found, scenario, sink=sink)
    assert (sink.steps, sink.last) == (count, tuple(places[0][:2]))
    assert len(run.stepped) == count
    assert run.ended is None
    assert run.deviations.steps.max_um < 2.0, "half a pulse in each axis, and what a reset leaves beside the path"
    assert run.deviations.table.max_um < 5.0
