"""``--dialect``, ``--unit`` and ``--offset D0=…``, and the keys of files that say the same, as a user meets them."""

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from checking import SOUND, drycut
from command import run_inside
from iso_at_home import DIE, ROUNDS, ROUNDS_BOX_UM, ROUNDS_CUT_UM
from jsonschema import Draft202012Validator
from places import ROOT

from parser.dialect.reader import (
    UNITS,
    Choices,
    merged,
    register_name,
)
from parser.program import dialects, load_program
from sim.check.result import Programmed, programmed_of
from sim.check.settings import CheckSettings
from sim.cli.options import offsets_of, register_set
from sim.setup.key_words import value_word
from sim.setup.machine.machine import load_machine
from sim.setup.scenario import MACHINE_FILE, load_scenario, scenario_sections
from sim.setup.toml.keys import toml_text
from sim.show.texts.texts import texts

SCHEMA = json.loads((ROOT / "docs" / "check.schema.json").read_text("utf-8"))


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    for name, text in {"die.iso": DIE, "part.3b": SOUND, "rounds.nc": ROUNDS}.items():
        (tmp_path / name).write_text(text, "ascii")
    return tmp_path


def checked(*args: object) -> list[dict[str, Any]]:
    _, out, err = drycut("check", *args, "--format", "json")
    assert err == ""
    document = json.loads(out)
    assert [error.message for error in Draft202012Validator(SCHEMA).iter_errors(document)] == []
    files: list[dict[str, Any]] = document["files"]
    return files


def offset_um(choices: Choices) -> float:
    """The offset of the die, as its program is read."""
    compensation = load_program(DIE.encode(), "die.iso", choices).toolpath.compensation
    assert compensation is not None
    return float(compensation.by_um[0])


# What a check says


def test_the_rounds_are_programmed_as_often_as_they_are_called(shop: Path) -> None:
    (file,) = checked(shop / "rounds.nc")
    said = file["programmed"]
    assert (said["lines"], said["arcs"], said["rapids"]) == (6, 3, 0)
    assert said["cut_length_um"] == pytest.approx(ROUNDS_CUT_UM, abs=1e-5)
    assert said["box_um"] == pytest.approx(ROUNDS_BOX_UM, abs=1e-6)
    assert (said["first_um"], said["last_um"]) == ([0.0, 0.0], [30000.0, 0.0])


def test_a_program_without_blocks_that_move_has_no_place() -> None:
    nothing = load_program(b"G92 X0 Y0\nG90\nM02\n", "part").toolpath
    assert programmed_of(nothing) == Programmed()


def test_programs_of_both_families_are_checked_together(shop: Path) -> None:
    named = {Path(file["name"]).name: file for file in checked(shop)}
    assert [file["dialect"] for file in named.values()] == ["fast-wire", "3B", "skd2"]
    assert named["part.3b"]["assumptions"] == []
    what = [assumption["what"] for assumption in named["die.iso"]["assumptions"]]
    assert what[:2] == ["dialect", "unit"]
    assert all(assumption["why"] for assumption in named["die.iso"]["assumptions"])


def test_what_was_assumed_is_one_line_of_a_file(shop: Path) -> None:
    _, out, _ = drycut("check", "die.iso", cwd=shop)
    assert out.count("ISO112") == 1
    assert "read as (ISO112): dialect fast-wire (" in out
    _, out, _ = drycut("check", "die.iso", "--lang", "zh", cwd=shop)
    assert "按以下约定读入（ISO112）：系统 fast-wire（" in out


# What it is read with


def test_a_dialect_is_for_iso_alone(shop: Path) -> None:
    dialect = {file["name"][-3:]: file["dialect"] for file in checked(shop, "--dialect", "common")}
    assert dialect == {"iso": "common", ".3b": "3B", ".nc": "common"}


@pytest.mark.parametrize(("unit", "side_um"), [("um", 20_000.0), ("mm", 20_000_000.0), ("inch", 50_800.0)])
def test_a_unit_scales_what_is_programmed(shop: Path, unit: str, side_um: float) -> None:
    x0, _, x1, _ = checked(shop / "die.iso", "--unit", unit)[0]["programmed"]["box_um"]
    assert x1 - x0 == pytest.approx(side_um)


def test_the_nearest_value_of_a_register_counts() -> None:
    shipped = load_machine("dk7740")
    controller = shipped.controller._replace(registers=(("D1", 10.0), ("H1", 5.0)))
    machine = shipped._replace(controller=controller)
    settings = CheckSettings(machine=machine)
    assert offset_um(settings.choices) == 10.0
    settings = replace(settings, registers=(("D1", 20.0),))
    assert offset_um(settings.choices) == 20.0
    settings = settings.with_options({"registers": (("D1", 30.0),)})
    assert offset_um(settings.choices) == 30.0
    assert settings.choices.registers == (("D1", 30.0), ("H1", 5.0))


def test_keys_of_files_say_what_options_say(shop: Path, tmp_path: Path) -> None:
    machine = toml_text_of_machine().replace(
        "[controller]\n", "[controller]\nregisters_mm = { D1 = 0.05, D2 = 0.07 }\n"
    )
    (shop / "machine.toml").write_text(machine, "utf-8")
    keys = 'dialect = "common"\nunit = "mm"\nregisters_mm = { d01 = 0.11 }\nmachine = "machine.toml"\n'
    (shop / "scenario.toml").write_text('program = "die.iso"\n' + keys, "utf-8")
    read_with = Choices(dialect="common", unit="mm", registers=(("D1", 110.0), ("D2", 70.0)))
    scenario = load_scenario(shop)
    assert scenario.choices == read_with
    (shop / "again").mkdir()
    (shop / "again" / "scenario.toml").write_text(toml_text(scenario_sections(scenario)), "utf-8")
    (shop / "again" / MACHINE_FILE).write_text(machine, "utf-8")
    assert load_scenario(shop / "again").choices == read_with
    (shop / "drycut.toml").write_text(f"root = true\n{keys}", "utf-8")
    (file,) = checked(shop / "die.iso")
    assert file["dialect"] == "common"
    assert file["programmed"]["box_um"][2] == pytest.approx(10_000_000.0)


def toml_text_of_machine() -> str:
    return (ROOT / "sim" / "setup" / "machine" / "dk7740.toml").read_text("utf-8")


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (("--dialect", "agie"), "--dialect: dialect is one of fast-wire, classroom,"),
        (("--unit", "cm"), "'cm' is not one of 'um', 'mm', 'inch'"),
        (("--offset", "0.1mm"), "'0.1mm' names no register; write it such as D0=0.1mm"),
        (("--offset", "X1=0.1mm"), "'X1' is no offset register; write it such as D0=0.1mm"),
        (("--offset", "D1=0.1"), "'0.1' is no length"),
        (("--offset", "D1=11mm"), "--offset D1 in mm is 11; it must lie between -10 and 10"),
    ],
)
def test_what_cannot_be_is_bad_use(shop: Path, options: tuple[str, ...], complaint: str) -> None:
    code, out, err = drycut("check", shop / "die.iso", *options)
    assert (code, out) == (2, "")
    assert complaint in err


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ('dialect = "agie"', "dialect is one of fast-wire, classroom,"),
        ('unit = "cm"', "unit is one of um, mm, inch; found 'cm'"),
        ("registers_mm = 0.1", "registers_mm is a table"),
        ("registers_mm = { X1 = 0.1 }", "registers_mm: 'X1' is no offset register"),
        ("registers_mm = { D1 = 11.0 }", "registers_mm: D1 is 11; it must lie between -10 and 10"),
    ],
)
def test_keys_are_read_strictly(shop: Path, line: str, complaint: str) -> None:
    (shop / "drycut.toml").write_text(f"root = true\n{line}\n", "utf-8")
    code, _, err = drycut("check", shop / "die.iso")
    assert code == 2
    assert complaint in err


def test_offsets_of_a_run_are_registers_and_one_of_the_controller() -> None:
    given = offsets_of([register_set("h001=-20um"), (180.0, 100.0), register_set("D0=0.1mm")])
    assert given.registers == (("H1", -20.0), ("D0", 100.0))
    assert given.plain == (180.0, 100.0)


def test_two_offsets_of_the_controller_are_bad_use(shop: Path) -> None:
    code, _, err = drycut("run", shop / "part.3b", "--offset", "0.1mm", "--offset", "0.2mm", "--side", "left")
    assert code == 2
    assert "--offset is given again for registers alone" in err


def test_names_of_registers_are_told_without_leading_zeros() -> None:
    assert [register_name(text) for text in ("D0", "d01", " H000 ", "H0123", "D", "1", "D-1", "X1")] == [
        *("D0", "D1", "H0", "H123"),
        *[""] * 4,
    ]
    assert merged([(("D1", 1.0), ("H2", 2.0)), (("D1", 3.0),)]) == (("D1", 3.0), ("H2", 2.0))


def test_the_help_names_every_dialect() -> None:
    told = texts("options")["dialect"]
    assert ", ".join(dialects()) in told.en
    assert "、".join(dialects()) in told.zh


@pytest.mark.parametrize("schema", ["check", "report"])
def test_schemas_know_every_dialect(schema: str) -> None:
    text = (ROOT / "docs" / f"{schema}.schema.json").read_text("utf-8")
    (known,) = {node["pattern"] for node in nodes(json.loads(text)) if "4B" in str(node.get("pattern", ""))}
    names = {"3B", "4B", "3B+4B", "PMAC", *dialects()} | ({"GE card"} if schema == "report" else set())
    assert [name for name in names if not re.search(known, name)] == []
    assert re.search(known, "makino"), "of a shop's own"
    assert [name for name in ("", "Makino", "ISO", "my dialect") if re.search(known, name)] == []


def nodes(node: Any) -> Iterator[dict[str, Any]]:
    if isinstance(node, dict):
        yield node
    for inner in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from nodes(inner)


def test_every_dialect_has_a_name_for_people() -> None:
    for name in (*dialects(), *UNITS):
        assert value_word(name).zh


def test_a_strict_dialect_makes_the_order_of_words_an_error(tmp_path: Path) -> None:
    path = tmp_path / "part.iso"
    path.write_text("G92 X0 Y0\nG90\nX5000 Y0 G01\nX5000 Y5000\nX0 Y0\nM02\n", "ascii")
    told = {}
    for dialect in ("common", "strict"):
        done = run_inside("check", path, "--dialect", dialect, "--format", "json", "--statistics")
        (file,) = json.loads(done.stdout)["files"]
        told[dialect] = file["dialect"], file["verdict"], [(one["code"], one["severity"]) for one in file["findings"]]
    assert told == {
        "common": ("common", "pass", [("ISO130", "note")]),
        "strict": ("strict", "fail", [("ISO130", "error")]),
    }
    table = run_inside("check", path, "--dialect", "strict", "--statistics", "--lang", "en").stdout.decode()
    assert re.search(r"^ISO130 +error +1  words in an unusual order$", table, re.MULTILINE)
