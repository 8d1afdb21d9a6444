"""Settings that options and fields of a page give: each row of a key is the same at every door."""

import operator
from pathlib import Path

import pytest
from command import run_inside

from parser.findings.errors import SettingsError
from sim.cli.options import parameter
from sim.cli.scenario_options import overridden, overrides_of
from sim.serve.page.form import scenario_of
from sim.serve.page.runs import KEYS
from sim.setup.key_tables import scenario_schema
from sim.setup.settable import FIELDS, SETTABLE
from sim.setup.toml.keys import Key
from sim.setup.toml.kinds import Number
from sim.show.open_page.page import open_page

ROWS = pytest.mark.parametrize("path", SETTABLE)
NOTHING = {parameter(key): None for key in SETTABLE.values()}
PROGRAM = Path("part.3b")


def kind_of(key: Key) -> Number:
    assert isinstance(key.kind, Number)
    return key.kind


def middle(key: Key) -> float:
    """A value that the file may have, not the usual one."""
    bound = kind_of(key).bound
    return round((bound.low * 3.0 + bound.high) / 4.0, 3)


def length_um(key: Key, value: float) -> float:
    return value * 1000.0 if kind_of(key).unit == "mm" else value


@ROWS
def test_an_option_takes_the_place_of_the_files_value(path: str) -> None:
    key = SETTABLE[path]
    scenario = overridden(PROGRAM, overrides_of({**NOTHING, parameter(key): length_um(key, middle(key))}))
    assert operator.attrgetter(path)(scenario) == kind_of(key).inside(middle(key))


@ROWS
def test_an_option_out_of_its_bounds_is_named(path: str) -> None:
    key = SETTABLE[path]
    with pytest.raises(SettingsError, match=rf"{key.option} in {kind_of(key).unit} is"):
        overridden(PROGRAM, overrides_of({**NOTHING, parameter(key): length_um(key, kind_of(key).bound.high * 2.0)}))


@ROWS
@pytest.mark.parametrize("command", ["run", "draw", "replay"])
def test_commands_that_run_a_scenario_offer_it(path: str, command: str) -> None:
    assert SETTABLE[path].option in run_inside(command, "--help").stdout.decode()


@ROWS
def test_the_schema_of_scenarios_has_it(path: str) -> None:
    tables = scenario_schema()["properties"].values()
    assert any(SETTABLE[path].name in table.get("properties", {}) for table in tables)


@pytest.mark.parametrize("form", FIELDS)
def test_a_field_of_the_page_gives_the_same_as_the_option(form: str) -> None:
    key = FIELDS[form]
    values = {**dict.fromkeys((*KEYS, "drawing_file"), ""), form: f"{middle(key)}"}
    (path,) = (path for path, of in SETTABLE.items() if of is key)
    scenario = scenario_of(values, PROGRAM)
    assert operator.attrgetter(path)(scenario) == kind_of(key).inside(middle(key))
    with pytest.raises(SettingsError, match="must lie between"):
        scenario_of({**values, form: "1e9"}, PROGRAM)


@pytest.mark.parametrize("form", FIELDS)
def test_the_page_has_the_field_with_what_is_usual(form: str) -> None:
    page, _ = open_page(())
    low, high = kind_of(FIELDS[form]).bound
    usual = f'inputmode="decimal" size="7" placeholder="{FIELDS[form].default:g}" data-low="{low}" data-high="{high}"'
    assert f'<input name="{form}" {usual}>' in page


def test_dependent_values_are_taken_all_at_once(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text("B10B0B10GXL1\nDD\n", "ascii")
    text = "program = 'part.3b'\n[work]\nthickness_mm = 40.0\n[wire]\nlag_um = 20.0\n"
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    scenario = overridden(tmp_path, overrides_of({**NOTHING, "thickness": 2e6, "wire_lag": 0.0}))
    assert (scenario.thickness_mm, scenario.wire_lag_um) == (2000.0, 0.0)
