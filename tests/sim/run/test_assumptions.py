"""What a run took for granted: told in report, page and summary, and in both languages."""

from dataclasses import replace
from pathlib import Path

import pytest
from places import MACHINES
from runs import run_text, scenario_run

from parser.findings.errors import SettingsError
from parser.program import read_program
from sim.run.dryrun import assumptions_of
from sim.run.report import build_report
from sim.run.running import dry_run
from sim.setup.machine.machine import load_machine
from sim.setup.scenario import load_scenario
from sim.setup.wire import DEFAULT_WIRE
from sim.show.refusals import taken_for_granted
from sim.show.terminal.run import print_summary

LINE = "B100B0B100GXL1 DD"


@pytest.fixture
def program(tmp_path: Path) -> Path:
    path = tmp_path / "part.3b"
    path.write_text(LINE, "utf-8")
    return path


def test_a_program_alone_runs_on_the_default_machine_and_says_so(
    program: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = dry_run(read_program(program), replace(load_scenario(program), may_stay_open=True))
    assert build_report(run)["assumptions"] == {
        "program": [],
        "machine_by_default": True,
        "machine_values": list(load_machine("dk7740").assumed),
        "drawing_compared": False,
        "wire_bows": False,
    }
    english = " ".join(sentence.en for sentence in taken_for_granted(run))
    for told in ("default machine, DK7740", "14 of its values", "mass of the saddle", "No drawing", "Wire lag was off"):
        assert told in english
    chinese = " ".join(sentence.zh for sentence in taken_for_granted(run))
    for told in ("默认", "14 项是估计值", "没有与图纸比较", "未计钼丝滞后"):
        assert told in chinese
    print_summary(run, None)
    assert "Run on the default machine, DK7740" in " ".join(capsys.readouterr().out.split())


def test_a_machine_that_is_named_is_no_default(program: Path, tmp_path: Path) -> None:
    (tmp_path / "scenario.toml").write_text('program = "part.3b"\nmachine = "dk7732"', "utf-8")
    assert not load_scenario(tmp_path).machine_by_default
    (tmp_path / "scenario.toml").write_text('program = "part.3b"', "utf-8")
    assert load_scenario(tmp_path).machine_by_default


def test_what_was_looked_at_is_not_among_what_was_not() -> None:
    punch = scenario_run("punch")
    assert assumptions_of(punch).compared
    assert not any("drawing" in sentence.en for sentence in taken_for_granted(punch))
    bowed = run_text(LINE, wire=replace(DEFAULT_WIRE, lag=20.0), may_stay_open=True)
    assert assumptions_of(bowed).wire_bows
    assert not any("lag" in sentence.en for sentence in taken_for_granted(bowed))


def test_a_machine_without_the_mark_assumes_nothing(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    shipped = (MACHINES / "dk7740.toml").read_text("utf-8")
    head, rest = shipped.split("assumed = [", 1)
    file.write_text(head + rest.split("]", 1)[1], "utf-8")
    own = load_machine(str(file))
    assert own == load_machine("dk7740")._replace(assumed=())
    told = taken_for_granted(run_text(LINE, machine=own, may_stay_open=True))
    assert told[0].en == "Run on the machine DK7740 class, stepper drives."
    assert not any("assumed" in sentence.en for sentence in told)


@pytest.mark.parametrize(("mark", "why"), [('["mass"]', "'mass', which is no key"), ('"saddle_mass_kg"', "a list")])
def test_a_mark_names_keys(tmp_path: Path, mark: str, why: str) -> None:
    file = tmp_path / "own.toml"
    shipped = (MACHINES / "dk7740.toml").read_text("utf-8")
    head, rest = shipped.split("assumed = [", 1)
    file.write_text(f"{head}assumed = {mark}{rest.split(']', 1)[1]}", "utf-8")
    with pytest.raises(SettingsError, match=why):
        load_machine(str(file))


@pytest.mark.parametrize("name", sorted(path.stem for path in MACHINES.glob("*.toml")))
def test_every_value_that_a_comment_calls_assumed_is_marked(name: str) -> None:
    marked = load_machine(name).assumed
    lines = (MACHINES / f"{name}.toml").read_text("utf-8").splitlines()
    assumed = [line.split(" = ")[0] for line in lines if " = " in line and "# assumed" in line and line[0] != "#"]
    assert assumed
    assert set(assumed) <= set(marked)
