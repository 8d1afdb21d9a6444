"""The table of settings: a key is read, written, shown and documented, and what is written makes the same again."""

import re
from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from places import MACHINES, ROOT

from parser.findings.catalogue import Bilingual
from parser.findings.errors import SettingsError
from parser.program import load_program
from sim.setup import limits, shop, technology
from sim.setup import scenario as scenarios
from sim.setup import wire as wires
from sim.setup.key_tables import renewed
from sim.setup.key_words import words, words_of
from sim.setup.machine import machine as machines
from sim.setup.machine import table
from sim.setup.machine.machine import load_machine, machine_sections
from sim.setup.quiz import QUIZ
from sim.setup.scenario import Scenario, load_scenario, scenario_sections
from sim.setup.toml.keys import Key, Section, toml_text
from sim.setup.toml.kinds import MM_AS_UM, Number, OneOf
from sim.setup.toml.reader import Bound
from sim.setup.wire import Wire
from sim.show.report_page.page import Setting, setting_groups

SECTIONS = (*scenarios.SECTIONS, *machines.SECTIONS)
NOT_ENGLISH = re.compile(r"[\u2e80-\uffef]")
EACH = [pytest.param(section, key, id=f"{section.name} {key.name}") for section in SECTIONS for key in section.keys]
DOCUMENT = (ROOT / "docs" / "scenarios.md").read_text("utf-8")
Add = Callable[[Any, Section, dict[Key, dict[str, str]]], None]


@pytest.fixture
def add(monkeypatch: pytest.MonkeyPatch) -> Add:
    """Adds keys with their words to a section of a module, as an edit of the table would."""

    def longer(module: Any, section: Section, keys: dict[Key, dict[str, str]]) -> None:
        new = replace(section, keys=(*section.keys, *keys))
        monkeypatch.setattr(module, section.name.upper(), new)
        for whole in (machines, scenarios):
            sections = tuple(new if one is section else one for one in whole.SECTIONS)
            monkeypatch.setattr(whole, "SECTIONS", sections)
        for key, said in keys.items():
            monkeypatch.setitem(words()["keys"][section.name], key.name, said)

    return longer


def shown(scenario: Scenario, key: str) -> Setting:
    program = load_program(b"B500B0B500GXL1\nDD\n", "part.3b")
    settings = [setting for group in setting_groups(scenario, program) for setting in group.settings]
    return next(setting for setting in settings if setting.key == key)


def documented(key: str) -> str:
    return next(line for line in renewed(DOCUMENT, "en").splitlines() if line.startswith(f"| `{key}` |"))


def machine_of(path: Path, more: str) -> str:
    path.write_text((MACHINES / "dk7740.toml").read_text("utf-8").replace("[table]\n", f"[table]\n{more}\n"), "utf-8")
    return str(path)


def test_a_key_added_to_the_table_is_read_written_shown_and_documented(
    monkeypatch: pytest.MonkeyPatch, add: Add, tmp_path: Path
) -> None:
    pitch = Number(Bound(-100.0, 100.0), "µm")
    said = {"en": "pitch error of X", "zh": "X 螺距误差", "meaning": "error of the screw"}
    x = Key("pitch_error_x_um", pitch, "pitch_error_um.0", default=0.0)
    y = Key("pitch_error_y_um", pitch, "pitch_error_um.1", default=0.0)
    fields = (*table.TableModel._fields, "pitch_error_um")
    monkeypatch.setattr(table, "TableModel", namedtuple("TableModel", fields))
    add(table, table.TABLE, {x: said, y: {**said, "en": "pitch error of Y"}})

    read = load_machine(machine_of(tmp_path / "m.toml", "pitch_error_x_um = 3.5"))
    assert read.table[-1] == (3.5, 0.0)
    with pytest.raises(SettingsError, match=r"\[table\]: pitch_error_x_um is 101; it must lie between -100 and 100"):
        load_machine(machine_of(tmp_path / "m.toml", "pitch_error_x_um = 101"))

    text = toml_text(machine_sections(read))
    assert "\npitch_error_x_um = 3.5\npitch_error_y_um = 0.0\n" in text
    (tmp_path / "again.toml").write_text(text, "utf-8")
    assert load_machine(str(tmp_path / "again.toml")) == read

    setting = Setting(Bilingual("pitch error of X", "X 螺距误差"), "pitch_error_x_um", Bilingual("3.5", "3.5"), "µm")
    assert shown(Scenario("part", Path("part.3b"), read), "pitch_error_x_um") == setting
    row = "| `[table] pitch_error_x_um` | µm | −100 to 100 | 0 | error of the screw |"
    assert documented("[table] pitch_error_x_um") == row
    assert row not in DOCUMENT


def test_a_key_added_to_the_wire_is_read_written_shown_and_documented(
    monkeypatch: pytest.MonkeyPatch, add: Add, tmp_path: Path
) -> None:
    @dataclass(frozen=True)
    class Coated(Wire):
        coating_um: float = 0.0

    key = Key("coating_mm", Number(Bound(0.0, 0.02), "mm", MM_AS_UM), "coating_um", default=0.001)
    monkeypatch.setattr(wires, "Wire", Coated)
    add(wires, wires.WIRE, {key: {"en": "coating", "zh": "镀层", "meaning": "zinc round the core"}})

    (tmp_path / "scenario.toml").write_text("[wire]\ncoating_mm = 0.013\nlag_um = 3", "utf-8")
    read = load_scenario(tmp_path)
    assert read.wire == Coated(180.0, 10.0, 3.0, coating_um=13.0)

    text = toml_text(scenario_sections(read)).replace('"machine.toml"', '"dk7740"')
    assert "lag_um = 3.0\ncoating_mm = 0.013\n" in text
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    assert load_scenario(tmp_path) == read

    assert shown(read, "coating_mm") == Setting(
        Bilingual("coating", "镀层"), "coating_mm", Bilingual("0.013", "0.013"), unit="mm"
    )
    assert documented("[wire] coating_mm") == "| `[wire] coating_mm` | mm | 0 to 0.02 | 0.001 | zinc round the core |"


def test_a_key_without_a_place_in_what_it_fills_is_no_key(add: Add, tmp_path: Path) -> None:
    said = {"en": "lost", "zh": "无", "meaning": "kept by nothing"}
    add(table, table.TABLE, {Key("lost_um", Number(Bound(0.0, 1.0)), default=0.0): said})
    with pytest.raises(TypeError, match="lost_um"):
        load_machine(machine_of(tmp_path / "m.toml", ""))


@pytest.mark.parametrize("name", [path.stem for path in sorted(MACHINES.glob("*.toml"))])
def test_a_shipped_machine_is_read_from_what_it_is_written_as(name: str, tmp_path: Path) -> None:
    machine = load_machine(name)
    (tmp_path / "m.toml").write_text(toml_text(machine_sections(machine)), "utf-8")
    assert load_machine(str(tmp_path / "m.toml")) == machine


def test_every_key_has_words_and_all_words_have_a_key() -> None:
    sections = (*SECTIONS, *shop.SECTIONS, *limits.SECTIONS, *technology.SECTIONS)
    told = {(section, key) for section, keys in words()["keys"].items() for key in keys}
    assert told == {(section.name, key.name) for section in sections for key in section.keys}
    chosen = [key.kind for section in sections if section is not QUIZ for key in section.keys]
    assert words()["values"].keys() == {word for kind in chosen if isinstance(kind, OneOf) for word in kind.words}
    assert words()["kinds"].keys() == {key.kind.name for section in sections for key in section.keys}


@pytest.mark.parametrize(("section", "key"), EACH)
def test_words_of_a_key_are_there_in_both_languages(section: Section, key: Key) -> None:
    said = words_of(section, key)
    assert said.name.en.isascii()
    assert not said.name.zh.isascii()
    assert not said.meaning.zh.isascii()
    assert not any(NOT_ENGLISH.search(text.en) for text in said)
    assert all(of.en and of.zh for of in (said.name, said.meaning))


UNITS = {
    "mm2_min": "mm²/min",
    "mm_min": "mm/min",
    "n_s_mm": "N s/mm",
    "g_cm3": "g/cm³",
    "mm_s3": "mm/s³",
    "mm_s2": "mm/s²",
    "mm_s": "mm/s",
    "n_um": "N/µm",
    "n_mm": "N/mm",
    "mm": "mm",
    "um": "µm",
    "urad": "µrad",
    "ppm": "ppm",
    "us": "µs",
    "ms": "ms",
    "kg": "kg",
    "hz": "Hz",
    "per_s": "1/s",
    "deg": "°",
    "n": "N",
    "v": "V",
    "s": "s",
    "h": "/h",
}
"""Units by the ends of keys, longer ones first."""


@pytest.mark.parametrize(("section", "key"), EACH)
def test_the_end_of_a_key_is_its_unit(section: Section, key: Key) -> None:
    assert key in section.keys
    assert key.kind.unit == next((unit for end, unit in UNITS.items() if key.name.endswith(f"_{end}")), "")
