"""Progress: every stage of a run is told in the order announced, from the first second on, with the time left."""

import time
from collections.abc import Callable
from pathlib import Path

import pytest
from places import ROOT
from runs import plain_scenario

from parser.program import Program, parse_program, read_program
from sim.cli import progress
from sim.cli.progress import WEIGHTS, StageProgress
from sim.jobs.run_into import run_into, stages_of_files
from sim.setup.scenario import Scenario, load_scenario
from sim.show.texts.texts import texts

TEXT = "B0B900B900GYL2 B900B0B900GXL1 B0B900B900GYL4 B900B0B900GXL3 DD"
Case = Callable[[], tuple[Program, Scenario]]


def with_drawing() -> tuple[Program, Scenario]:
    scenario = load_scenario(ROOT / "scenarios" / "round-hole")
    return read_program(scenario.program), scenario


@pytest.mark.alike(1)
@pytest.mark.parametrize(
    ("case", "trace"),
    [
        (lambda: (parse_program(TEXT), plain_scenario()), False),
        (lambda: (parse_program(TEXT), plain_scenario(kerf=True)), True),
        (with_drawing, False),
    ],
)
def test_a_run_tells_of_each_stage_that_was_announced_in_its_order(case: Case, trace: bool, tmp_path: Path) -> None:
    program, scenario = case()
    told: list[str] = []
    run_into(tmp_path / "out", program, scenario, lambda stage, done, total: told.append(stage), trace=trace)
    assert list(dict.fromkeys(told)) == stages_of_files(scenario, trace=trace)


def test_every_weight_is_of_a_stage_that_has_a_text() -> None:
    assert set(WEIGHTS) <= set(texts("progress"))


def lines_of(monkeypatch: pytest.MonkeyPatch, quiet_s: float, between_s: float) -> list[str]:
    said: list[str] = []
    monkeypatch.setattr(progress, "_QUIET_S", quiet_s)
    monkeypatch.setattr(progress, "_BETWEEN_LINES_S", between_s)
    monkeypatch.setattr(progress, "moves_cursor", lambda stream: False)
    monkeypatch.setattr(progress, "say", lambda line, err: said.append(line))
    return said


def until(said: list[str], count: int) -> None:
    ends = time.monotonic() + 20.0
    while len(said) < count and time.monotonic() < ends:
        time.sleep(0.005)


def test_a_stage_that_tells_nothing_more_is_told_of_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    said = lines_of(monkeypatch, 0.01, 0.01)
    with StageProgress("checks", "run", "pages") as told:
        told("checks", 0, 1)
        told("run", 1, 4)
        before = len(said)
        until(said, before + 3)
    assert len(said) >= before + 3
    assert "step 2 of 3, running card and table, about " in said[-1]
    shares = [int(line.rpartition(", ")[2].removesuffix("%")) for line in said[before:]]
    assert shares == sorted(shares)
    # Of weight 6 one was done and a quarter of one of 4; while it tells nothing, nine tenths of the rest at most.
    assert 33 <= shares[0] <= shares[-1] <= 78


def test_short_work_and_work_that_is_over_say_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    said = lines_of(monkeypatch, 30.0, 30.0)
    with StageProgress("run") as told:
        told("run", 1, 2)
        told.finish()
        told("run", 2, 2)
    assert said == []


def test_a_stage_that_was_not_announced_comes_last(monkeypatch: pytest.MonkeyPatch) -> None:
    said = lines_of(monkeypatch, 0.01, 30.0)
    with StageProgress() as told:
        told("check", 5, 10)
        until(said, 1)
    assert said[0].startswith("drycut: check, about ")
    assert 50 <= int(said[0].rpartition(", ")[2].removesuffix("%")) <= 95
