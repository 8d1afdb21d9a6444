"""How many small changes of our own code the tests notice: a random sample, and those that nothing noticed.

    PYTHONPATH=. python tests/tools/survivors.py planner --sample 100 --seed 2

Each change is made in memory, in a process of its own. The tests that call its function run on it, quick ones first,
until one fails. What survives is a border that no test stands at, code that is not needed, or a change that changes
nothing, such as another allowance for rounding: which of them, a person decides. Needs fork: Linux or macOS.
"""

import argparse
import json
import os
import random
import resource
import signal
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from importlib.machinery import SourceFileLoader
from types import CodeType, FrameType
from typing import NamedTuple
from unittest import mock

import ezdxf  # noqa: F401 - here, so that no process of a change has to load it
import hypothesis  # noqa: F401
import numpy as np
import pytest
import shapely  # noqa: F401
from code_mutants import Mutant, changed_lines, mutant
from places import ROOT


class Area(NamedTuple):
    """Folders whose code is changed, and folders or files whose tests are to notice it."""

    code: tuple[str, ...]
    tests: tuple[str, ...]


_READING = ("tests/parser", "tests/sim/check", "tests/sim/test_second_dialect.py")
_MOVING = ("tests/controller", "tests/sim/run/test_interpolators.py")
AREAS = {
    "checks": Area(("parser/threeb", "parser/shape", "sim/check"), _READING),
    "iso": Area(("parser/iso",), ("tests/parser/iso",)),
    "stepping": Area(("controller/stepping",), _MOVING),
    "planner": Area(("controller/motion",), _MOVING),
}
_CODE = tuple(f"{ROOT}/{code}" for area in AREAS.values() for code in area.code)
_MOST_TESTS_S = 60.0
"""Time that the tests of one change may take by themselves; those that take longest are left out."""
_MOST_S = 300  # until a change is taken to run without end
_MOST_BYTES = 6 << 30
_LOADED = "ignore::pytest.PytestAssertRewriteWarning"  # of plugins that are loaded before
_PYTEST = ("-q", "-x", "-m", "not alone", "-p", "no:cacheprovider", "--rootdir", str(ROOT), "-W", _LOADED)


class Runs(NamedTuple):
    """Which tests called the function of which lines: file -> line -> tests; and how long each test took, s."""

    lines: dict[str, dict[int, list[str]]]
    took_s: dict[str, float]

    def of(self, file: str, line: int) -> list[str]:
        """Tests that ran the function of a line, quick ones first; of no function, those that ran any of the file."""
        tests = self.lines.get(file, {})
        ran = tests.get(line) or {test for of in tests.values() for test in of}
        ordered = sorted(ran, key=lambda test: (self.took_s[test], test))
        past = np.cumsum([self.took_s[test] for test in ordered]) <= _MOST_TESTS_S
        return [test for test, fits in zip(ordered, past.tolist(), strict=True) if fits]


class Change(NamedTuple):
    """A change of a file by its number."""

    file: str
    number: int
    line: int


class _Recorder:
    """A plugin of pytest that records which test calls which functions of our code, by their lines."""

    def __init__(self) -> None:
        self.lines: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
        self.took_s: dict[str, float] = defaultdict(float)
        self._test, self._called = "", set[int]()

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        self._test, self._called = item.nodeid.partition("[")[0], set()
        began = time.perf_counter()
        sys.settrace(self._call)
        try:
            return (yield)
        finally:
            sys.settrace(None)
            self.took_s[self._test] += time.perf_counter() - began

    def _call(self, frame: FrameType, event: str, argument: object) -> None:
        code = frame.f_code
        if id(code) not in self._called:
            self._called.add(id(code))
            if code.co_filename.startswith(_CODE):
                of = self.lines[code.co_filename[len(str(ROOT)) + 1 :]]
                for _, _, line in code.co_lines():
                    of[line or code.co_firstlineno].add(self._test)


def changes(area: Area) -> list[Change]:
    """All changes of an area."""
    paths = [path for code in area.code for path in sorted((ROOT / code).rglob("*.py"))]
    return [
        Change(path.relative_to(ROOT).as_posix(), number, line)
        for path in paths
        for number, line in enumerate(changed_lines(path.read_text(encoding="utf-8")))
    ]


def recorded(area: Area) -> Runs:
    """Which tests of an area ran what. ValueError where a test fails on the code as it is."""
    reader, writer = os.pipe()
    child = os.fork()
    if not child:
        recorder = _Recorder()
        failed = pytest.main([*_PYTEST, *area.tests], plugins=[recorder])
        lines = {file: {line: sorted(tests) for line, tests in of.items()} for file, of in recorder.lines.items()}
        with os.fdopen(writer, "w") as out:
            json.dump([lines, recorder.took_s], out)
        os._exit(int(failed))
    os.close(writer)
    with os.fdopen(reader) as told:
        lines, took_s = json.load(told)
    if os.waitpid(child, 0)[1]:
        raise ValueError("the tests have to pass on the code as it is")
    return Runs({file: {int(line): tests for line, tests in of.items()} for file, of in lines.items()}, took_s)


def made(change: Change) -> Mutant:
    """The changed module."""
    return mutant((ROOT / change.file).read_text(encoding="utf-8"), change.number)


def is_noticed(change: Change, tests: list[str]) -> bool:
    """Whether a test fails on a change, or takes far too long, or far too much memory."""
    child = os.fork()
    if child:
        return os.waitpid(child, 0)[1] != 0
    signal.alarm(_MOST_S)
    resource.setrlimit(resource.RLIMIT_AS, (_MOST_BYTES, _MOST_BYTES))
    for stream in (1, 2):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
    code = compile(made(change).tree, change.file, "exec")
    with mock.patch.object(SourceFileLoader, "get_code", _with(str(ROOT / change.file), code)):
        os._exit(int(pytest.main([*_PYTEST, *tests])))


def _with(file: str, code: CodeType) -> Callable[[SourceFileLoader, str], CodeType | None]:
    usual = SourceFileLoader.get_code
    return lambda loader, name: code if loader.path == file else usual(loader, name)


def main() -> None:
    """Print the changes that survive, and how many of the sample were noticed."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("area", choices=sorted(AREAS))
    options.add_argument("--sample", type=int, default=150, help="how many changes are made (150)")
    options.add_argument("--seed", type=int, default=1, help="which ones (1)")
    asked = options.parse_args()
    area = AREAS[asked.area]
    sample = random.Random(asked.seed).sample(changes(area), asked.sample)
    runs = recorded(area)
    noticed = 0
    for change in sample:
        tests = runs.of(change.file, change.line)
        if tests and is_noticed(change, tests):
            noticed += 1
            continue
        _, before, after = made(change)
        print(f"{change.file}:{change.line}: {before}  ->  {after}  ({len(tests)} tests)", flush=True)
    share = noticed / len(sample)
    error = 1.96 * (share * (1.0 - share) / len(sample)) ** 0.5
    print(f"{noticed} of {len(sample)} noticed: {100 * share:.0f} % ± {100 * error:.0f} % (95 %)")


if __name__ == "__main__":
    main()
