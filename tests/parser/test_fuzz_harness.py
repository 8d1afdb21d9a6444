"""The fuzz harness finds what it is for: each planted fault is told with its number, and the others are still tried."""

import os
import subprocess
import sys
from pathlib import Path

import guided_fuzz
import pytest
from fuzzing import planted
from fuzzing.minimise import minimised, shortest
from fuzzing.pool import Pool
from fuzzing.promises import of_document, unclean
from fuzzing.target import SEED
from fuzzing.targets import TARGETS
from fuzzing.worker import Done, Failure, Task, tried
from places import ROOT


@pytest.mark.deeper
@pytest.mark.alone
def test_every_planted_fault_is_told_with_the_number_of_its_input() -> None:
    task = Task(planted.PLANTED, SEED, 0, planted.LAST, most_wall_s=4.0)
    with Pool(1) as pool:
        told = list(pool.run([task]))
    found = {one.number: one.promise for one in told if isinstance(one, Failure)}
    assert set(found) == {
        *(planted.RAISES, planted.HANGS, planted.HOGS, planted.DIES, planted.SPINS, planted.CHANGES),
    }
    assert "KeyError" in found[planted.RAISES]
    assert "planted.py" in found[planted.RAISES]
    assert found[planted.HANGS].startswith("never came back")
    assert "in _hangs" in found[planted.HANGS]
    assert "MB more than any before" in found[planted.HOGS]
    assert "exit code 17" in found[planted.DIES]
    assert "of processor time" in found[planted.SPINS]
    assert "otherwise the second time" in found[planted.CHANGES]
    done = [one for one in told if isinstance(one, Done)]
    assert done[-1].task.past == planted.LAST
    assert sum(one.inputs for one in done) == planted.LAST - planted.DIES - 1


def test_an_input_that_fails_is_made_as_short_as_the_fault_allows(tmp_path: Path) -> None:
    task = Task(planted.PLANTED, SEED, planted.RAISES, planted.RAISES + 1)
    [promise], _ = tried(task, planted.RAISES, tmp_path / "input")
    assert minimised(Failure(planted.PLANTED, SEED, planted.RAISES, promise)) == b"KEY"


def test_the_shortest_part_of_a_command_line_is_found() -> None:
    words = tuple("abcdefghij")
    assert shortest(words, lambda kept: "c" in kept and "h" in kept) == ["c", "h"]


@pytest.mark.parametrize("name", TARGETS)
def test_an_input_is_made_from_its_number_alone(name: str) -> None:
    target = TARGETS[name]
    before = [target.input(SEED, number) for number in range(20)]
    assert [target.input(SEED, number) for number in reversed(range(20))] == before[::-1]
    assert len(set(before)) > 10


@pytest.mark.parametrize("name", guided_fuzz.TEXTS_AND_FILES)
def test_what_is_fuzzed_by_what_it_reaches_is_a_text_or_a_file(name: str) -> None:
    assert isinstance(TARGETS[name].input(SEED, 0), bytes)


@pytest.mark.deeper
def test_an_input_that_broke_a_promise_is_tried_again_from_its_file(tmp_path: Path) -> None:
    """Without atheris, which is installed by `make guided` alone."""
    (tmp_path / "iso-1").write_bytes(b"%\nO0027\nG91 S1 D1\nG92")
    tool = ROOT / "tests" / "tools" / "guided_fuzz.py"
    command = [sys.executable, tool, "--target", "iso", "--file", tmp_path / "iso-1"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert (done.returncode, done.stdout) == (0, "")


def test_what_a_terminal_would_obey_is_not_clean() -> None:
    assert list(unclean("a\tb\nµ 加工")) == []
    assert list(unclean("\x1b[2J\u202e\x9b")) == ["prints U+001B", "prints U+009B", "prints U+202E"]


def test_a_document_that_its_readers_refuse_is_told() -> None:
    assert list(of_document("json", '{"a": 1}')) == []
    assert list(of_document("json", '{"a": NaN}')) == ["is not well-formed: NaN is no JSON"]
    assert next(of_document("junit", "<a>")).startswith("is not well-formed")


def test_a_fault_in_the_making_of_an_input_ends_no_worker() -> None:
    target = planted.PLANTED._replace(make=planted.cannot)
    with Pool(1) as pool:
        told = list(pool.run([Task(target, SEED, 0, 2)]))
    assert [one.number for one in told if isinstance(one, Failure)] == [0, 1]
