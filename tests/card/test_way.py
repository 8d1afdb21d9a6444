"""The way of a card: at any time it has the place and the speed that the card tells, whatever stopped or changed it."""

import random

import numpy as np
import pytest

from controller import GECard
from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings, Switches
from controller.card.way import Way, WayRecorder
from controller.stepping.pulses import Pulses
from parser.geometry.along import places_at
from parser.geometry.curves import CurveKind

PLACE_UM = 1e-6
SPEED_UM_S = 1e-3


class Seen:
    """A card with what was heard of it, and where it said that it was, µm, at times s."""

    def __init__(self, **settings) -> None:
        self.recorder, self.pulses, self.calls = WayRecorder(), list[Pulses](), list[Logged]()
        self.card = GECard(
            CardSettings(**settings),
            on_pulses=self.pulses.append,
            on_driven=self.recorder,
            on_call=self.calls.append,
        )
        self.card.GT_Open()
        self.places: list[tuple[float, float, float]] = []

    def look(self, ms: float) -> None:
        self.card.sleep(ms)
        x, y, *_ = self.card.GT_GetPrfPnt()[1]
        self.places.append((self.card.time_s, x, y))

    def way(self) -> Way:
        self.card.sleep(1e6)
        return self.recorder.way()


def held(seen: Seen) -> Way:
    """The way, held against where the card said that it was, and against its pulses."""
    way = seen.way()
    t_s, x, y = np.array(seen.places).T
    along = way.plan.at(t_s).along_um
    before = way.curves.before_um
    row = np.minimum(np.searchsorted(before, along, side="right") - 1, len(way.call) - 1)
    place = places_at(way.curves, row, np.minimum(along - before[row], way.curves.length_um[row]))
    assert np.abs(place - np.stack([x, y], axis=1)).max() < PLACE_UM
    assert np.array_equal(way.curves.start_um[1:], way.curves.end_um[:-1])
    assert way.plan.along_um[-1] == pytest.approx(way.curves.length_um.sum(), abs=PLACE_UM)
    pulses = Pulses._make(np.concatenate(column) for column in zip(*seen.pulses, strict=True))
    of = way.row_of(pulses.t_s, pulses.row)
    assert np.array_equal(way.number[of], pulses.row)
    assert (np.diff(of) >= 0).all()
    return way


def random_run(seed: int) -> Seen:
    """A list and immediate moves with waits, stops, overrides and a limit, looked at all the time."""
    rng = random.Random(seed)
    seen = Seen(
        call_s=rng.choice([2e-5, 1e-3]),
        switches=(Switches(negative=-4500.0 if seed % 4 else -2500.0),),
        carries_speed=seed % 2 == 0,
    )
    card = seen.card
    card.GT_SetSynAcc(0.05)
    card.GT_StrtList()
    x = y = z = 0.0
    for _ in range(12):
        card.GT_SetSynVel(rng.uniform(2.0, 12.0))
        if rng.random() < 0.5:
            x, y, z = rng.uniform(-3000.0, 5000.0), rng.uniform(-3000.0, 3000.0), rng.choice([z, z + 700.0])
            card.GT_LnXYZ(x, y, z)
        elif rng.random() < 0.7:
            u, v, angle = rng.uniform(-900.0, 900.0), rng.uniform(-900.0, 900.0), rng.choice([90.0, -200.0, 360.0])
            card.GT_ArcXY(x + u, y + v, angle)
            turned = complex(-u, -v) * np.exp(1j * np.radians(angle))
            x, y = x + u + turned.real, y + v + turned.imag
        else:
            card.GT_Delay(rng.randrange(80))
    card.GT_EndList()
    card.GT_StrtMtn()
    for _ in range(60):
        seen.look(rng.uniform(1.0, 120.0))
        doing = rng.random()
        if doing < 0.08:
            card.GT_Override(rng.uniform(0.3, 1.9))
        elif doing < 0.16:
            card.GT_StpMtn()
            seen.look(300.0)
            card.GT_RestoreMtn()
    return seen


@pytest.mark.alike(4)
@pytest.mark.parametrize("seed", range(12))
def test_it_is_where_the_card_says_at_any_time(seed: int) -> None:
    way = held(random_run(seed))
    assert len(way.call) > (3 if seed % 4 else 0)


def test_its_speed_is_that_of_the_card_in_the_plane() -> None:
    seen = Seen()
    seen.card.GT_SetSynVel(5.0)
    seen.card.GT_LnXYZ(3000.0, 0.0, 4000.0)
    told = []
    for _ in range(40):
        seen.look(20.0)
        told.append((seen.card.time_s, seen.card.GT_GetPrfVel()[1]))
    way = held(seen)
    t_s, speed = np.array(told).T
    assert np.abs(way.plan.at(t_s + 2e-5).speed_um_s - 600.0 * speed).max() < SPEED_UM_S


def test_an_arc_that_climbs_is_a_line_there_and_back() -> None:
    seen = Seen()
    seen.card.GT_SetSynVel(2.0)
    seen.card.GT_ArcYZ(1000.0, 0.0, 360.0)
    while not seen.card.status & 1:
        seen.look(35.0)
    way = seen.way()
    assert way.curves.end_um.tolist() == [pytest.approx([0.0, 2000.0]), pytest.approx([0.0, 0.0], abs=PLACE_UM)]
    t_s, _, y = np.array(seen.places).T
    along = way.plan.at(t_s).along_um
    assert np.abs(np.where(along < 2000.0, along, 4000.0 - along) - y).max() < 0.2, "cut into pieces of a degree"


def test_rows_are_the_calls_that_moved_and_what_only_climbs_is_a_rest() -> None:
    seen = Seen()
    card = seen.card
    card.GT_SetSynVel(20.0)
    for call in (lambda: card.GT_LnXY(1000.0, 0.0), lambda: card.GT_LnXYZ(1000.0, 0.0, 500.0)):
        assert call() == 0
        seen.look(3000.0)
    card.GT_ArcXY(1000.0, 500.0, 180.0)
    way = held(seen)
    assert [seen.calls[call - 1].name for call in way.call.tolist()] == ["GT_LnXY", "GT_ArcXY"]
    assert way.curves.kind.tolist() == [CurveKind.LINE, CurveKind.ARC]


def test_a_reset_on_the_way_ends_it_there() -> None:
    seen = Seen()
    seen.card.GT_LnXY(5000.0, 0.0)
    seen.look(900.0)
    seen.card.GT_Reset()
    seen.card.GT_LnXY(0.0, 100.0)
    way = seen.way()
    assert len(way.call) == 2
    assert way.curves.end_um[0].tolist() == pytest.approx([seen.places[0][1], 0.0], abs=1.0)
    assert way.curves.end_um[1].tolist() == pytest.approx([way.curves.end_um[0][0], 100.0], abs=1.0)


def test_blocks_of_the_look_ahead_come_from_their_own_calls() -> None:
    seen = Seen()
    card = seen.card
    card.GT_SwitchLookaheadMode(1)
    card.GT_InitLookAheadEx(2.0, 0.5, 0.1, 3, 1.0)
    card.GT_StrtList()
    for k in range(1, 6):
        card.GT_LnXYEx(100.0 * k, 50.0 * (k % 2), 10.0, 0, k)
    card.GT_M30()
    card.GT_StrtMtn()
    way = seen.way()
    assert [seen.calls[call - 1].arguments[-1] for call in way.call.tolist()] == [1, 2, 3, 4, 5]


def test_without_motion_in_the_plane_there_is_none() -> None:
    seen = Seen()
    assert len(seen.recorder.way().call) == 0
    seen.card.GT_LnXYZ(0.0, 0.0, 500.0)
    assert len(seen.way().call) == 0
