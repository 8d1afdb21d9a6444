"""Promises that hold for any input at all, tried on many: ``PYTHONPATH=. python tests/tools/fuzz.py``, `make fuzz`.

Every input is made from its own number and the seed, so that one that breaks a promise is made again by its number:
``python tests/tools/fuzz.py --target dxf --number 12345``.
"""

import argparse
import os
import sys
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from fuzzing.minimise import kind_of, minimised
from fuzzing.pool import Pool
from fuzzing.target import SEED, Input, Target
from fuzzing.targets import TARGETS
from fuzzing.worker import Done, Failure, Task
from hostile import HOSTILE

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

MOST_HOSTILE_S = 15.0
"""Time that a hostile program of some MB may take; on an idle core none takes 5 s."""
_SHOWN = 3
"""Failures of one kind that are printed; the others are counted."""
_TASKS = 400
"""So many tasks does a target have, so that all end at about the same time."""
_MOST_A_TASK = 200


class Found(NamedTuple):
    """What came of the inputs of one target."""

    inputs: int
    took_s: float
    slowest: tuple[float, int]
    reached: Counter[str]

    def and_of(self, done: Done) -> "Found":
        return Found(
            self.inputs + done.inputs,
            self.took_s + done.took_s,
            max(self.slowest, done.slowest),
            self.reached + done.reached,
        )

    def line(self, name: str) -> str:
        rate = self.inputs / self.took_s if self.took_s else 0.0
        ends = ", ".join(f"{number:,} {ending or 'done'}" for ending, number in self.reached.most_common(8))
        slowest = f"slowest {self.slowest[0]:.2f} s (number {self.slowest[1]})"
        return f"{name:10}{self.inputs:12,} inputs{rate:8,.0f}/s of one core; {slowest}; {ends}"


def main() -> None:
    asked = _options()
    targets = [TARGETS[asked.target]] if asked.target else list(TARGETS.values())
    if asked.number is not None:
        sys.exit(_one(targets[0], asked.seed, asked.number))
    begin = time.perf_counter()
    found = {target.name: Found(0, 0.0, (0.0, 0), Counter()) for target in targets}
    kinds: dict[tuple[str, str], list[Failure]] = {}
    with Pool(asked.workers) as pool:
        for told in pool.run(_tasks(targets, asked.seed, asked.first, asked.inputs, begin + asked.seconds)):
            if isinstance(told, Done):
                found[told.task.target.name] = found[told.task.target.name].and_of(told)
                continue
            alike = kinds.setdefault((told.target.name, kind_of(told.promise)), [])
            alike.append(told)
            if len(alike) <= _SHOWN:
                print(f"{told.target.name} {told.number}: {told.promise}", flush=True)
    for name, of_target in found.items():
        print(of_target.line(name))
    for (name, kind), alike in sorted(kinds.items(), key=lambda entry: -len(entry[1])):
        print(f"{len(alike):8,} {name}: {kind}")
    total, broken = sum(one.inputs for one in found.values()), sum(map(len, kinds.values()))
    print(f"{total:,} inputs in {time.perf_counter() - begin:,.0f} s, {broken:,} broke a promise")
    late = _hostile() if asked.hostile else 0
    sys.exit(bool(kinds or late))


def _options() -> argparse.Namespace:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--inputs", type=int, default=1_000_000, help="over all targets, by their shares")
    options.add_argument("--target", choices=list(TARGETS), help="this one alone")
    options.add_argument("--first", type=int, default=0, help="number of the first input")
    options.add_argument("--seed", type=int, default=SEED)
    options.add_argument("--seconds", type=float, default=float("inf"), help="begin nothing more after so long")
    options.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    options.add_argument("--hostile", action="store_true", help="also time programs of some MB, bad on purpose")
    options.add_argument("--number", type=int, help="try this input of the target, and make it shorter if it fails")
    asked = options.parse_args()
    if asked.number is not None and asked.target is None:
        options.error("--number needs --target")
    return asked


def _tasks(targets: Sequence[Target], seed: int, first: int, inputs: int, until: float) -> Iterator[Task]:
    """Tasks of all targets, side by side, until the time is over."""
    whole = sum(target.share for target in targets)
    tasks = []
    for target in targets:
        mine = round(inputs * target.share / whole)
        size = max(1, min(_MOST_A_TASK, -(-mine // _TASKS)))
        lows = range(first, first + mine, size)
        tasks += [((low - first) / mine, Task(target, seed, low, min(low + size, first + mine))) for low in lows]
    for _, task in sorted(tasks, key=lambda entry: entry[0]):
        if time.perf_counter() > until:
            return
        yield task


def _one(target: Target, seed: int, number: int) -> int:
    """Try one input; show it, and what it breaks with the shortest input that breaks the same."""
    _show("input", target.input(seed, number))
    with Pool(1) as pool:
        failures = [told for told in pool.run([Task(target, seed, number, number + 1)]) if isinstance(told, Failure)]
    for failure in failures:
        print(f"{target.name} {number}: {failure.promise}")
        _show("shortest", minimised(failure))
    return int(bool(failures))


def _show(what: str, data: Input) -> None:
    print(f"{what}: {len(data)} {'bytes' if isinstance(data, bytes) else 'words'}\n{data!r}")


def _hostile() -> int:
    """Time of each hostile program, and how many took too long."""
    late = 0
    for name, program in HOSTILE.items():
        data = program(10**5).encode()
        begin = time.perf_counter()
        check_file(Job("hostile.3b", data, CheckSettings()))
        taken = time.perf_counter() - begin
        late += taken > MOST_HOSTILE_S
        print(f"{name:40}{len(data) / 1e6:6.2f} MB{taken:8.2f} s")
    return late


if __name__ == "__main__":
    main()
