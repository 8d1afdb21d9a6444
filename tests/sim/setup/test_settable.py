"""Settings that options and fields of a page give: each row of a key is the same at every door."""

import operator
import tomllib
from pathlib import Path

import click
import pytest
from command import run_inside

from parser.findings.errors import SettingsError
from sim.cli.options import parameter
from sim.cli.program_options import making_of, options_of, program_options, writing_of
from sim.cli.scenario_options import COMPARISON, overridden, overrides_of
from sim.serve.page.form import scenario_of
from sim.serve.page.runs import KEYS
from sim.setup import making
from sim.setup.key_tables import scenario_schema
from sim.setup.making import Making, ToMake, Writing
from sim.setup.settable import FIELDS, SETTABLE
from sim.setup.toml.keys import Key
from sim.setup.toml.kinds import Number, Truth
from sim.show.open_page.page import open_page

NUMBERS = pytest.mark.parametrize("path", [path for path, key in SETTABLE.items() if isinstance(key.kind, Number)])
FLAGS = pytest.mark.parametrize("path", [path for path, key in SETTABLE.items() if isinstance(key.kind, Truth)])
ROWS = pytest.mark.parametrize("path", SETTABLE)
NOTHING = {parameter(key): None for key in (*SETTABLE.values(), *COMPARISON)}
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


@NUMBERS
def test_an_option_takes_the_place_of_the_files_value(path: str) -> None:
    key = SETTABLE[path]
    scenario = overridden(PROGRAM, overrides_of({**NOTHING, parameter(key): length_um(key, middle(key))}))
    assert operator.attrgetter(path)(scenario) == kind_of(key).inside(middle(key))


@NUMBERS
def test_an_option_out_of_its_bounds_is_named(path: str) -> None:
    key = SETTABLE[path]
    with pytest.raises(SettingsError, match=rf"{key.option} in {kind_of(key).unit} is"):
        overridden(PROGRAM, overrides_of({**NOTHING, parameter(key): length_um(key, kind_of(key).bound.high * 2.0)}))


@FLAGS
@pytest.mark.parametrize("own", ["", "true", "false"])
def test_a_flag_makes_it_true_whatever_the_file_says(path: str, own: str, tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_text("B10B0B10GXL1\nDD\n", "ascii")
    (tmp_path / "scenario.toml").write_text(f"{SETTABLE[path].name} = {own}\n" if own else "", "utf-8")
    without = overridden(tmp_path, overrides_of(dict(NOTHING)))
    assert operator.attrgetter(path)(without) is (own == "true")
    given = overridden(tmp_path, overrides_of({**NOTHING, parameter(SETTABLE[path]): True}))
    assert operator.attrgetter(path)(given) is True


@ROWS
@pytest.mark.parametrize("command", ["run", "draw", "replay"])
def test_commands_that_run_a_scenario_offer_it(path: str, command: str) -> None:
    assert SETTABLE[path].option in run_inside(command, "--help").stdout.decode()


@ROWS
def test_the_schema_of_scenarios_has_it(path: str) -> None:
    top = scenario_schema()["properties"]
    assert SETTABLE[path].name in top or any(
        SETTABLE[path].name in table.get("properties", {}) for table in top.values()
    )


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
    usual = (
        f'inputmode="decimal" size="7" placeholder="{FIELDS[form].default or 0:g}" data-low="{low}" data-high="{high}"'
    )
    assert f'<input name="{form}" {usual}>' in page


def test_dependent_values_are_taken_all_at_once(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text("B10B0B10GXL1\nDD\n", "ascii")
    text = "program = 'part.3b'\n[work]\nthickness_mm = 40.0\n[wire]\nlag_um = 20.0\n"
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    scenario = overridden(tmp_path, overrides_of({**NOTHING, "thickness": 2e6, "wire_lag": 0.0}))
    assert (scenario.thickness_mm, scenario.wire_lag_um) == (2000.0, 0.0)


# Of each option of ``drycut program``: what is typed, and what its key of ``[program]`` says for the same.
TYPED: dict[str, tuple[list[str], str]] = {
    "tolerance_um": (["4um"], "4.0"),
    "pick": (["2F", "12.5,8"], "['2F', '12.5,8']"),
    "spare": (["2F", "12.5,8"], "['2F', '12.5,8']"),
    "passes_mm": (["0.18mm", "120um"], "[0.18, 0.12]"),
    "side": (["outside"], "'outside'"),
    "direction": (["cw"], "'cw'"),
    "order": (["3,1,2"], "[3, 1, 2]"),
    "starts_mm": (["1,2", "3mm,-4mm"], "[[1.0, 2.0], [3.0, -4.0]]"),
    "entries_mm": (["1,2", "3mm,-4mm"], "[[1.0, 2.0], [3.0, -4.0]]"),
    "thread_layer": (["HOLES"], "'HOLES'"),
    "lead": (["arc"], "'arc'"),
    "lead_mm": (["2mm"], "2.0"),
    "overcut_mm": (["500um"], "0.5"),
    "tab_mm": (["3mm"], "3.0"),
    "slug_tab_mm": (["3mm"], "3.0"),
    "rough_first": ([], "true"),
    "corners": (["round"], "'round'"),
    "no_core": ([], "true"),
    "common_edges": ([], "true"),
    "lag_um": (["20um"], "20.0"),
    "form": (["aligned"], "'aligned'"),
    "end_code": (["MJ"], "'MJ'"),
    "pause_code": (["DP"], "'DP'"),
    "crlf": ([], "true"),
    "encoding": (["gbk"], "'gbk'"),
    "compensation": (["kept"], "'kept'"),
    "decimals": (["3"], "3"),
}
OFFERED = {key.name: key for key in making.PROGRAM.keys if key.option}


def test_each_key_of_a_program_with_an_option_is_tried() -> None:
    assert list(OFFERED) == list(TYPED)
    assert len(OFFERED) >= len(making.PROGRAM.keys) - 2  # but for the file, and the way of passes


@pytest.mark.parametrize("name", TYPED)
def test_an_option_of_a_program_says_what_its_key_says(name: str) -> None:
    typed, written = TYPED[name]
    key = OFFERED[name]
    line = [word for value in typed for word in (key.option, value)] or [key.option]
    command = program_options(click.Command("program", callback=lambda **_: None))
    options = options_of(command.make_context("program", line).params)
    asked = ToMake()._replace(making=making_of(Making(), options), writing=writing_of(Writing(), options))
    read = making.PROGRAM.read_in(tomllib.loads(f"[program]\n{name} = {written}\n"), "scenario.toml")
    assert asked.making == Making(**read["making"])
    assert asked.writing == Writing(**read["writing"])
    assert (asked.making, asked.writing) != (Making(), Writing())
