"""`[spark]` and `[[event]]`: what files say, what they may not say, and how they are written again."""

import tomllib
from pathlib import Path

import pytest

from parser.findings.errors import SettingsError
from sim.setup.machine.machine import load_machine, machine_sections
from sim.setup.scenario import load_scenario, scenario_sections, under_sparks
from sim.setup.spark import PRESETS, Event, Spark
from sim.setup.toml.keys import toml_text


def folder(tmp_path: Path, text: str) -> Path:
    (tmp_path / "program.3b").write_text("B100B0B100GXL1 DD", "utf-8")
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    return tmp_path


def test_a_scenario_without_sparks_has_none_and_its_machine_neither(tmp_path: Path) -> None:
    scenario = load_scenario(folder(tmp_path, ""))
    assert scenario.spark is None
    assert scenario.events == ()
    assert scenario.machine.spark is None


def test_an_empty_table_asks_for_usual_sparks(tmp_path: Path) -> None:
    assert load_scenario(folder(tmp_path, "[spark]")).spark == Spark()


def test_events_alone_ask_for_sparks_too(tmp_path: Path) -> None:
    scenario = load_scenario(folder(tmp_path, '[[event]]\nkind = "break"\nblock = 1'))
    assert scenario.spark == Spark()
    assert scenario.events == (Event("break", block=1),)


def test_a_law_fills_what_nobody_gave() -> None:
    assert Spark(law="duty").filled == PRESETS["duty"]
    assert Spark(law="duty", set_value=0.6).filled == PRESETS["duty"]._replace(set_value=0.6)


def test_sparks_of_the_machine_count_where_the_scenario_has_none(tmp_path: Path) -> None:
    written = toml_text(machine_sections(load_machine("dk7740")._replace(spark=Spark(mode="I9", seed=4))))
    (tmp_path / "own.toml").write_text(written, "utf-8")
    plain = load_scenario(folder(tmp_path, 'machine = "own.toml"'))
    assert plain.spark is None
    assert under_sparks(plain).spark == Spark(mode="I9", seed=4)
    assert under_sparks(plain, 9).spark == Spark(mode="I9", seed=9)
    own = load_scenario(folder(tmp_path, 'machine = "own.toml"\n[spark]\nmode = "I1"'))
    assert under_sparks(own).spark == Spark(mode="I1")


def test_what_is_written_reads_as_the_same(tmp_path: Path) -> None:
    text = """
[spark]
mode = "I13"
law = "duty"
set_value = 0.6
least_feed_mm_min = 0.3
back_feed_mm_min = 9.0
most_mm2_min = 90.0
threading = "place"
seed = 77
[[event]]
kind = "set"
at_s = 3.5
set_value = 0.25
[[event]]
kind = "short"
per_h = 12.0
seed = 5
clear_mm = 0.3
"""
    scenario = load_scenario(folder(tmp_path, text))
    again = tmp_path / "again"
    again.mkdir()
    written = toml_text(scenario_sections(scenario))
    (again / "machine.toml").write_text(toml_text(machine_sections(scenario.machine)), "utf-8")
    (again / "program.3b").write_bytes((tmp_path / "program.3b").read_bytes())
    (again / "scenario.toml").write_text(written, "utf-8")
    assert tomllib.loads(written)["spark"]["back_feed_mm_min"] == 9.0
    read = load_scenario(again)
    assert (read.spark, read.events) == (scenario.spark, scenario.events)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('[[event]]\nkind = "short"', "give one of them"),
        ('[[event]]\nkind = "short"\nblock = 1\nat_s = 1.0', "give one of them"),
        ('[[event]]\nkind = "set"\nblock = 1', "has a set_value"),
        ('[[event]]\nkind = "short"\nblock = 1\nset_value = 0.2', "has a set_value"),
        ('[[event]]\nkind = "short"\nblock = 1\nseed = 2', "only with per_h"),
        ('[[event]]\nkind = "flood"\nblock = 1', "flood"),
        ('[spark]\nmode = "I3"', "I3"),
        ("[spark]\nset_value = 1.0", "0.99"),
        ("[spark]\nsparks = 1", "sparks"),
        ("\n".join(['[[event]]\nkind = "break"\nblock = 1'] * 1001), "no more than 1000"),
    ],
)
def test_what_does_not_go_together_is_refused_by_its_place(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(SettingsError, match=r"scenario\.toml: ") as refused:
        load_scenario(folder(tmp_path, text))
    assert says in str(refused.value)
