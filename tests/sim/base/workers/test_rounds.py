"""Jobs over processes: each is done once, whatever becomes of a worker."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest
from places import ROOT

from sim.base.workers import rounds
from sim.base.workers.rounds import Lost, Processes, in_order, results

needs_kill = pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="has no such signal")


def squared(number: int) -> int:
    return number * number


def dying_at_7(number: int) -> int:
    if number == 7:
        os.kill(os.getpid(), signal.SIGKILL)
    return squared(number)


def killed_once(job: tuple[int, Path]) -> int:
    number, mark = job
    if number == 7 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return squared(number)


def failing_at_7(number: int) -> int:
    if number == 7:
        raise ZeroDivisionError("boom")
    return squared(number)


@pytest.mark.parametrize("size", [1, 3, 50])
def test_every_job_has_its_result_once_and_in_order(size: int) -> None:
    found = results(squared, enumerate(range(20)), Processes(2), size)
    assert list(in_order(found)) == [number * number for number in range(20)]


def test_jobs_are_taken_as_there_is_room_for_them() -> None:
    taken: list[int] = []

    def jobs():
        for number in range(20):
            taken.append(number)
            yield number, number

    pool = Processes(1)
    next(results(squared, jobs(), pool))
    assert len(taken) <= pool.ahead() + 1


@needs_kill
@pytest.mark.parametrize("size", [1, 4])
def test_a_job_that_kills_its_worker_is_told_and_takes_no_other_with_it(size: int) -> None:
    found = dict(results(dying_at_7, enumerate(range(12)), Processes(2), size))
    assert found == {number: Lost() if number == 7 else number * number for number in range(12)}


@needs_kill
def test_a_job_whose_worker_is_killed_once_is_done_again(tmp_path: Path) -> None:
    jobs = [(number, tmp_path / "killed") for number in range(12)]
    assert dict(results(killed_once, enumerate(jobs), Processes(2))) == {n: n * n for n in range(12)}
    assert (tmp_path / "killed").exists()


def test_an_error_ends_all_and_no_process_stays() -> None:
    with pytest.raises(ZeroDivisionError, match="boom"):
        list(results(failing_at_7, enumerate(range(100)), Processes(2)))
    assert multiprocessing.active_children() == []


SLEEPERS = """
import os, sys, time
from sim.base.workers.rounds import Processes

if __name__ == "__main__":
    with Processes(1).open() as pool:
        print(pool.submit(os.getpid).result(), flush=True)
        pool.submit(time.sleep, 60).result()
"""


@needs_kill
def test_workers_end_with_the_process_that_started_them(tmp_path: Path) -> None:
    script = tmp_path / "sleepers.py"
    script.write_text(SLEEPERS, "utf-8")
    first = subprocess.Popen(
        [sys.executable, script], stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": str(ROOT)}
    )
    assert first.stdout is not None
    worker = int(first.stdout.readline())
    first.kill()
    first.wait()
    end_s = time.monotonic() + 10.0
    while is_alive(worker) and time.monotonic() < end_s:
        time.sleep(0.02)
    assert not is_alive(worker)
    first.stdout.close()


def is_alive(process: int) -> bool:
    """Whether a process runs; one that is dead, and waits for its parent to look, does not."""
    try:
        state = Path(f"/proc/{process}/stat").read_text("utf-8").rpartition(")")[2].split()[0]
    except FileNotFoundError:
        if Path("/proc").is_dir():
            return False
        try:
            os.kill(process, 0)
        except ProcessLookupError:
            return False
        return True
    return state not in "ZX"


def ready_late(mark: Path) -> None:
    """As `_ready`, of all workers but the first one late."""
    try:
        mark.touch(exist_ok=False)
    except FileExistsError:
        time.sleep(0.4)
    READY()


READY = rounds._ready


@needs_kill
def test_a_worker_that_is_told_to_end_before_it_is_ready_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rounds, "_ready", partial(ready_late, tmp_path / "mark"))
    handler = signal.signal(signal.SIGTERM, lambda number, frame: None)  # as one whose error nobody takes
    try:
        assert dict(results(dying_at_7, [(7, 7)], Processes(2))) == {7: Lost()}
    finally:
        signal.signal(signal.SIGTERM, handler)
    assert multiprocessing.active_children() == []
