"""Schemas of the files that users write: what drycut takes they take, and what they name is what it reads."""

import json
import random
import tomllib
from pathlib import Path

import pytest
from fuzzing.toml_trees import change, toml_of
from jsonschema import Draft202012Validator
from places import ROOT
from schema_pages import pages

from parser.findings.errors import DrycutError
from sim.check.settings import read as settings_files
from sim.check.settings.read import settings_schema
from sim.setup.key_tables import machine_schema, scenario_schema
from sim.setup.machine.machine import load_machine
from sim.setup.scenario import load_scenario

SCENARIO = Draft202012Validator(scenario_schema())
MACHINE = Draft202012Validator(machine_schema())
SETTINGS = Draft202012Validator(settings_schema())
SCENARIOS = sorted((ROOT / "scenarios").glob("*/scenario.toml"))
MACHINES = sorted((ROOT / "sim" / "setup" / "machine").rglob("*.toml"))
IN_FULL = """
root = true
machine = "dk7740"
machines = "."
technology = "cr12.toml"
material = "Cr12"
thickness_mm = 40
start_mm = [120.0, 200.0]
open = true
select = ["3B2"]
ignore = ["3B102"]
fail_on = "warning"
include = ["*.TAP"]
exclude = ["old"]
baseline = "known.json"
help_uri = "https://wiki/{code}"
dialect = "fast-wire"
unit = "um"
registers_mm = { D1 = 0.1 }
end_marks = ["QQ"]
pause_marks = ["P"]
wire = { diameter_mm = 0.18, spark_gap_mm = 0.01 }
dialects = { makino = { extends = "fanuc", g = { 145 = "switch" } }, ona = "ona.toml" }
per_file_ignores = { "a*.3b" = ["3B3"] }
"""


def wrong(validator: Draft202012Validator, text: str) -> list[str]:
    return [error.message for error in validator.iter_errors(tomllib.loads(text))]


def test_the_files_in_docs_are_the_schemas_of_today() -> None:
    for path, text in pages():
        assert path.read_text("utf-8") == text, path.name
        Draft202012Validator.check_schema(json.loads(text))


@pytest.mark.parametrize("path", SCENARIOS, ids=lambda path: path.parent.name)
def test_shipped_scenarios_fit_their_schema(path: Path) -> None:
    assert wrong(SCENARIO, path.read_text("utf-8")) == []


@pytest.mark.parametrize("path", MACHINES, ids=lambda path: path.stem)
def test_shipped_machines_fit_their_schema(path: Path) -> None:
    assert wrong(MACHINE, path.read_text("utf-8")) == []


def test_settings_in_full_fit_theirs_which_names_the_keys_that_are_read() -> None:
    assert wrong(SETTINGS, IN_FULL) == []
    assert set(settings_schema()["properties"]) == set(settings_files.KEYS) == set(tomllib.loads(IN_FULL))


@pytest.mark.parametrize(
    ("validator", "text", "said"),
    [
        (SCENARIO, "[work]\nthickness_mm = -4", "-4 is less than the minimum"),
        (SCENARIO, "thicknes_mm = 4", "'thicknes_mm' was unexpected"),
        (SCENARIO, "[wire]\ndiameter_mm = 'thick'", "'thick' is not of type 'number'"),
        (SCENARIO, "[offset]\nby_mm = 0.1\nside = 'up'", "'up' is not one of ['left', 'right']"),
        (SCENARIO, "[[pass]]\ndirection = 'same'", "'by_mm' is a required property"),
        (SCENARIO, "[expect]\nverdict = {least = 1}", "is not valid under any of the given schemas"),
        (MACHINE, "name = 'mill'", "'table' is a required property"),
        (SETTINGS, "fail_on = 'note'", "'note' is not one of ['error', 'incomplete', 'warning']"),
        (SETTINGS, "end_marks = ['ABCDE']", "'ABCDE' does not match"),
    ],
)
def test_what_is_wrong_is_named(validator: Draft202012Validator, text: str, said: str) -> None:
    assert any(said in message for message in wrong(validator, text)), wrong(validator, text)


def settings_of(path: Path) -> settings_files.SettingsFile:
    return settings_files.read_settings(tomllib.loads(path.read_text("utf-8")), path, path.name)


@pytest.mark.parametrize("seed", range(4))
def test_what_drycut_takes_the_schemas_take(seed: int, tmp_path: Path) -> None:
    """Files changed at random in keys and values: none that is read is refused by its schema."""
    rng = random.Random(seed)
    seeds = [*(path.read_bytes() for path in (*SCENARIOS, *MACHINES)), IN_FULL.encode()]
    kinds = (
        ([path.read_text("utf-8") for path in SCENARIOS], SCENARIO, "scenario.toml", lambda _: load_scenario(tmp_path)),
        ([path.read_text("utf-8") for path in MACHINES], MACHINE, "mill.toml", lambda path: load_machine(str(path))),
        (
            [IN_FULL],
            SETTINGS,
            "drycut.toml",
            settings_of,
        ),
    )
    taken = 0
    for number in range(120):
        texts, validator, name, read = kinds[number % 3]
        tree = tomllib.loads(rng.choice(texts))
        change(rng, tree, seeds, ["name", "by_mm", "x"])
        try:
            text = toml_of(tree, rng)
            found = tomllib.loads(text)
            (tmp_path / name).write_text(text, "utf-8")
            read(tmp_path / name)
        except (DrycutError, ValueError, RecursionError):
            continue
        taken += 1
        plain = json.loads(json.dumps(found, default=str))  # dates are texts to JSON, and so to editors
        assert [error.message for error in validator.iter_errors(plain)] == [], text
    assert taken >= 10
