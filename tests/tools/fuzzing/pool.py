"""Workers that try inputs side by side. One that dies is replaced, and the input that it died of is told."""

import multiprocessing
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from multiprocessing.connection import Connection, wait
from pathlib import Path
from types import TracebackType
from typing import Self

from fuzzing.worker import Done, Failure, Task, death, work

_SPAWN = multiprocessing.get_context("spawn")


class _Worker:
    """One process, and the folder in which it works."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._start()

    def _start(self) -> None:
        self.folder.mkdir(parents=True, exist_ok=True)
        self.position = _SPAWN.Value("q", 0, lock=False)
        self.connection, far = _SPAWN.Pipe()
        # No daemon, as those may have no children: a command on two programs has workers of its own.
        self._process = _SPAWN.Process(target=work, args=(far, self.position, self.folder), daemon=False)
        self._process.start()
        far.close()

    def begin(self, task: Task) -> None:
        self.task, self.position.value = task, task.low
        self.connection.send(task)

    def died(self) -> Iterator[Failure | Done | Task]:
        """The failure of a process that died, and what is left of its task. Another process takes its place."""
        self.connection.close()
        self._process.join()
        number, task = self.position.value, self.task
        yield Failure(task.target, task.seed, number, death(self.folder, self._process.exitcode))
        shutil.rmtree(self.folder, ignore_errors=True)
        self._start()
        if number + 1 < task.past:
            yield task._replace(low=number + 1)

    def end(self) -> None:
        self._process.kill()
        self._process.join()
        self.connection.close()


class Pool:
    """A number of workers; to be used in a ``with`` block, which ends them."""

    def __init__(self, workers: int = os.cpu_count() or 1) -> None:
        self._folder = Path(tempfile.mkdtemp(prefix="drycut-fuzz-"))
        self._workers = [_Worker(self._folder / str(number)) for number in range(workers)]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        for worker in self._workers:
            worker.end()
        shutil.rmtree(self._folder, ignore_errors=True)

    def run(self, tasks: Iterable[Task]) -> Iterator[Failure | Done]:
        """Do tasks in any order; each failure as it is found, and the end of each task that came to one."""
        left, waiting = iter(tasks), list[Task]()
        busy: dict[Connection, _Worker] = {}
        idle = list(self._workers)
        while True:
            while idle and (task := waiting.pop() if waiting else next(left, None)):
                worker = idle.pop()
                worker.begin(task)
                busy[worker.connection] = worker
            if not busy:
                return
            for ready in wait(list(busy)):
                assert isinstance(ready, Connection)
                try:
                    found = ready.recv()
                except (EOFError, ConnectionResetError):
                    worker = busy.pop(ready)
                    for told in worker.died():
                        if isinstance(told, Task):
                            waiting.append(told)
                        else:
                            yield told
                    idle.append(worker)
                    continue
                if isinstance(found, Done):
                    idle.append(busy.pop(ready))
                yield found
