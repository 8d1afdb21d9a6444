"""Threads that share a card: one fills the list, two ask where it is, and it ends where it does with one alone."""

import sys
import threading
from collections.abc import Callable, Iterator

import pytest

from controller import GECard
from controller.card.core.call import CrdSts
from controller.card.core.settings import CardSettings

PLACES = [(500.0 * (k % 7), 300.0 * (k % 5), 100.0 * k) for k in range(1, 61)]


@pytest.fixture(autouse=True)
def _often() -> Iterator[None]:
    """Threads that take turns after every few steps of Python meet where they would once in a thousand runs."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def fill(card: GECard) -> None:
    card.GT_StrtList()
    card.GT_MvXYZ(0.0, 0.0, 0.0, 20.0, 1.0)
    card.GT_EndList()
    card.GT_StrtMtn()
    for place in PLACES:
        card.GT_AddList()
        while card.GT_LnXYZ(*place) == 1:
            card.sleep(1.0)
        card.GT_EndList()


def together(*works: Callable[[], None]) -> list[BaseException]:
    """Run works in threads of their own; what they raised."""
    raised: list[BaseException] = []

    def guarded(work: Callable[[], None]) -> None:
        try:
            work()
        except BaseException as error:
            raised.append(error)

    threads = [threading.Thread(target=guarded, args=(work,)) for work in works]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60.0)
    return raised


@pytest.mark.parametrize("capacity", [4096, 8])
def test_two_that_ask_and_one_that_fills_end_as_one_alone(capacity: int) -> None:
    card = GECard(CardSettings(capacity=capacity))
    card.GT_Open()
    done = threading.Event()

    def ask() -> None:
        while not done.is_set():
            card.GT_GetPrfPnt()
            card.GT_GetCrdSts()

    def work() -> None:
        try:
            fill(card)
        finally:
            done.set()

    assert together(ask, ask, work) == []
    card.sleep(60_000.0)
    assert card.status == CrdSts.IDLE | CrdSts.LIST_EMPTY
    assert card.places == [[*map(int, PLACES[-1]), 0]]


def test_each_call_takes_its_time_whichever_thread_makes_it() -> None:
    card = GECard(CardSettings(call_s=1.0))

    def ask() -> None:
        for _ in range(500):
            card.GT_GetCrdSts()

    assert together(ask, ask, ask) == []
    assert card.time_s == 1500.0
