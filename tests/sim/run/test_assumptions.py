"""What a run took for granted: told in report, page and summary, and in both languages."""

import re
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
from sim.setup.machine.machine import load_machine, machine_sections
from sim.setup.scenario import load_scenario
from sim.setup.toml.keys import toml_text
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
        "machine_measured": [],
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


def machine_file(folder: Path, measured: str) -> Path:
    """The shipped machine, with backlash in X that is assumed no more."""
    text = (MACHINES / "dk7740.toml").read_text("utf-8").replace(' "backlash_x_um",', "", 1)
    path = folder / "own.toml"
    path.write_text(text.replace("assumed = [", f"measured = {measured}\nassumed = [", 1), "utf-8")
    return path


def test_a_measured_value_stands_with_its_margin(tmp_path: Path) -> None:
    own = load_machine(str(machine_file(tmp_path, "{ backlash_x_um = 0.25 }")))
    run = run_text(LINE, machine=own, may_stay_open=True)
    assumed = build_report(run)["assumptions"]
    assert assumed["machine_measured"] == [{"key": "backlash_x_um", "value": 2.0, "within": 0.25}]
    assert "backlash_x_um" not in assumed["machine_values"]
    said = taken_for_granted(run)
    assert "13 of its values are assumed" in " ".join(sentence.en for sentence in said)
    assert any(
        re.fullmatch(r"Measured, with 95 % intervals: backlash.* 2 ± 0\.25 µm\.", sentence.en) for sentence in said
    )
    assert any("实测值（带 95 % 区间）：" in sentence.zh and "2 ± 0.25 µm" in sentence.zh for sentence in said)
    (tmp_path / "again.toml").write_text(toml_text(machine_sections(own)), "utf-8")
    assert load_machine(str(tmp_path / "again.toml")) == own


@pytest.mark.parametrize(
    ("measured", "why"),
    [
        ("{ mass = 1 }", "'mass', which is no number"),
        ("{ kind = 1 }", "'kind', which is no number"),
        ("{ area_rate_mm2_min = -1 }", "measured: area_rate_mm2_min"),
        ('{ area_rate_mm2_min = "1" }', "number"),
        ("{ backlash_y_um = 0.3 }", "in assumed and in measured"),
        ('["backlash_x_um"]', "a table of keys"),
    ],
)
def test_a_margin_is_one_of_a_number_of_the_file(tmp_path: Path, measured: str, why: str) -> None:
    with pytest.raises(SettingsError, match=why):
        load_machine(str(machine_file(tmp_path, measured)))


@pytest.mark.parametrize("name", sorted(path.stem for path in MACHINES.glob("*.toml")))
def test_every_value_that_a_comment_calls_assumed_is_marked(name: str) -> None:
    marked = load_machine(name).assumed
    lines = (MACHINES / f"{name}.toml").read_text("utf-8").splitlines()
    assumed = [line.split(" = ")[0] for line in lines if " = " in line and "# assumed" in line and line[0] != "#"]
    assert assumed
    assert set(assumed) <= set(marked)
