"""Whose turn it is, where the kernel's view of the threads is taken while they move."""

import os
from collections.abc import Collection
from pathlib import Path

import pytest

from controller.card.abi import turns
from controller.card.abi.turns import Tasks, Turns

HIGHEST = int(Path("/proc/sys/kernel/pid_max").read_text("ascii"))


class Arriving(Tasks):
    """Threads of which another comes to the library, and leaves it, while the kernel is asked for the first time."""

    def __init__(self, passed: list[int]) -> None:
        super().__init__()
        self._passed, self.looks = passed, 0

    def only_one(self) -> bool:
        return False

    def at_work(self, waiting: Collection[int]) -> bool:
        self.looks += 1
        self._passed[:] = [2, 1]
        return False


def test_a_thread_that_comes_during_a_look_is_waited_for() -> None:
    passed = [1, 0]
    arriving = Arriving(passed)
    Turns(arriving, passed).take(lambda: 0.0)
    assert arriving.looks == 2


def told_by(looks: list[dict[int, tuple[bytes, bytes]]], monkeypatch: pytest.MonkeyPatch) -> Tasks:
    """Tasks of a kernel that tells so of the threads, state and runs, look by look."""
    at = iter(looks)
    now: dict[int, tuple[bytes, bytes]] = {}

    def listed() -> set[int]:
        now.clear()
        now.update(next(at))
        return set(now)

    monkeypatch.setattr(turns, "all_tasks", listed)
    monkeypatch.setattr(turns, "_task", lambda thread: turns.Task(now[thread][0], 0, now[thread][1]))
    return Tasks()


@pytest.mark.parametrize(
    ("second", "works"),
    [
        ({1: (b"S", b"4")}, False),
        ({1: (b"S", b"5")}, True),  # woken in between, and at rest again
        ({1: (b"R", b"4")}, True),
        ({1: (b"S", b"4"), 2: (b"S", b"0")}, True),  # begun in between
        ({}, False),  # ended
    ],
)
def test_threads_rest_where_two_looks_agree(
    second: dict[int, tuple[bytes, bytes]], works: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert told_by([{1: (b"S", b"4")}, second], monkeypatch).at_work([]) == works


def test_a_thread_that_runs_on_without_the_card_is_waited_for_no_longer(monkeypatch: pytest.MonkeyPatch) -> None:
    kernel = Tasks()
    monkeypatch.setattr(turns, "all_tasks", lambda: {1})
    ticks = iter([0, *range(turns.PATIENCE_TICKS - 1, 100)])
    monkeypatch.setattr(turns, "_task", lambda _: turns.Task(b"R", next(ticks), b"1"))
    assert kernel.at_work([])
    assert kernel.at_work([])
    assert not kernel.at_work([])


def test_threads_stand_in_the_order_in_which_they_began_though_numbers_begin_anew() -> None:
    process = os.getpid()
    began = [(process + later) % HIGHEST for later in (0, 1, 2, HIGHEST - process, HIGHEST - process + 301)]
    orders = [Tasks().order(thread) for thread in began]
    assert orders == sorted(orders)
