"""Machine and scenario files: every key known, every bound kept, every complaint names file and key."""

from pathlib import Path
from time import process_time

import pytest
from places import MACHINES

from parser.findings.errors import FileUnreadableError, SettingsError
from sim.base.units import clock, parse_length
from sim.setup.machine.machine import load_machine
from sim.setup.scenario import load_scenario
from sim.setup.toml.reader import load_toml

SHIPPED = MACHINES / "dk7740.toml"


def changed(tmp_path: Path, old: str, new: str) -> str:
    text = SHIPPED.read_text("utf-8")
    assert old in text
    path = tmp_path / "m.toml"
    path.write_text(text.replace(old, new), "utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("saddle_mass_kg = 180.0", "saddle_mass_kg = -180.0", r"m\.toml: \[table\]: saddle_mass_kg is -180"),
        ("saddle_mass_kg = 180.0", "saddle_mass_kg = nan", "saddle_mass_kg is nan"),
        ("saddle_mass_kg = 180.0", "saddle_mass_kg = inf", "saddle_mass_kg is inf"),
        ("saddle_mass_kg = 180.0", "saddle_mass_kg = " + "9" * 400, "saddle_mass_kg is inf"),
        ("saddle_mass_kg = 180.0", "saddle_mass_kg = " + "9" * 5000, "is no TOML"),
        ("saddle_mass_kg = 180.0", "saddle_mass_kg = true", "saddle_mass_kg is a number; found True"),
        ("saddle_mass_kg = 180.0", "saddle_mass_kg = '180'", "saddle_mass_kg is a number"),
        ("saddle_mass_kg", "sadle_mass_kg", "unknown key 'sadle_mass_kg'; did you mean saddle_mass_kg"),
        ("saddle_mass_kg = 180.0", "", "saddle_mass_kg is missing"),
        ("[cutting]", "[cuting]", "unknown key 'cuting'; did you mean cutting"),
        ("[table]", "[table", "is no TOML"),
        ("name = ", "# name = ", "name is a text and must be given"),
    ],
)
def test_bad_machine_files_are_refused(tmp_path: Path, old: str, new: str, complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        load_machine(changed(tmp_path, old, new))


def test_unknown_and_missing_machines_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="known: dk7732, dk7740"):
        load_machine("dk7741")
    with pytest.raises(FileUnreadableError, match=r"nowhere\.toml"):
        load_machine(str(tmp_path / "nowhere.toml"))


def test_feed_is_area_rate_over_thickness_up_to_the_step_limit() -> None:
    machine = load_machine("dk7740")
    assert machine.feeds(40.0).cut_um_s == pytest.approx(105.0 / 40.0 / 60.0 * 1000.0)
    assert machine.feeds(1.0).cut_um_s == 180.0  # steps/s of 1 µm


def folder(tmp_path: Path, text: str) -> Path:
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("titel = 'x'", "unknown key 'titel'; did you mean title"),
        ("start_mm = 3", r"start_mm is \[x, y\]"),
        ("start_mm = [1, 'a']", "start_mm is a number"),
        ("wire = 3", r"wire is a table, \[wire\]"),
        ("[wire]\ndiameter_mm = 5", "diameter_mm is 5"),
        ("[work]\nthickness = 5", "did you mean thickness_mm"),
        ("[drawing]\nfile = '/'", "file is the name of a file; found '/'"),
        ("program = '.'", "program is the name of a file; found '.'"),
        ("[expect]\nverdict = {minimum = 3}", "verdict is a value or"),
        ("[expect]\nx = {min = 3, max = 2}", "x is a value or"),
        ("[" + "a." * 5000 + "b]", "is nested too deep"),
        ("title = 0x" + "f" * 5000, "holds a whole number of more than 2,048 bits"),
        ("[expect]\nx = [[1, 0x" + "f" * 5000 + "]]", "holds a whole number of more than 2,048 bits"),
        ("machine = 'none'", "machine 'none' is not shipped"),
    ],
)
def test_bad_scenarios_are_refused(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        load_scenario(folder(tmp_path, text))


def test_a_folder_without_scenario_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match=r"without scenario\.toml"):
        load_scenario(tmp_path)


def test_defaults_of_a_scenario(tmp_path: Path) -> None:
    scenario = load_scenario(folder(tmp_path, ""))
    assert scenario.title == tmp_path.name
    assert scenario.program == tmp_path / "program.3b"
    assert scenario.start_um == (200_000.0, 250_000.0)  # the table's centre
    assert scenario.wire.kerf_um == pytest.approx(200.0)


def test_a_machine_file_beside_the_scenario(tmp_path: Path) -> None:
    changed(tmp_path, "DK7740 class, stepper drives", "mine")
    assert load_scenario(folder(tmp_path, "machine = 'm.toml'")).machine.name == "mine"


@pytest.mark.parametrize(
    ("text", "length_um"),
    [("40mm", 40_000.0), ("0.18 mm", 180.0), ("10um", 10.0), ("10µm", 10.0), ("1in", 25_400.0), (".5cm", 5000.0)],
)
def test_lengths_carry_their_unit(text: str, length_um: float) -> None:
    assert parse_length(text) == length_um


@pytest.mark.parametrize("text", ["40", "mm", "4 0mm", "40mmm", "", "1e3mm", "nan mm", "40 furlongs"])
def test_lengths_without_unit_are_refused(text: str) -> None:
    with pytest.raises(SettingsError, match="is no length"):
        parse_length(text)


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.04, "0.0 s"),
        (12.44, "12.4 s"),
        (59.97, "60.0 s"),
        (185.0, "3 min 5 s"),
        (3599.7, "1 h 0 min"),
        (8820.0, "2 h 27 min"),
    ],
)
def test_durations_for_people(seconds: float, text: str) -> None:
    assert clock(seconds) == text


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("a = " + "[" * 10_000 + "]" * 10_000, "nested too deep"),
        ("a = " + "{a=" * 10_000 + "1" + "}" * 10_000, "nested too deep"),
        (".".join(["a"] * 300_000) + " = 1", "nested too deep: a key has more than 50 parts"),
        ("[" + " . ".join(['"a"', "'b'", "c-1"] * 30) + "]", "nested too deep: a key has more than 50 parts"),
        ("#" * 1_000_001, "longer than 1,000,000 characters"),
        ("a = " + '"' + "x" * 900_000, "is no TOML"),
        ("a" * 900_000, "is no TOML"),
        ('"' * 900_000, "is no TOML"),
    ],
)
def test_hostile_settings_end_in_one_line_at_once(tmp_path: Path, content: str, said: str) -> None:
    (tmp_path / "drycut.toml").write_text(content, "utf-8")
    start = process_time()
    with pytest.raises(SettingsError, match=said):
        load_toml(tmp_path / "drycut.toml")
    assert process_time() - start < 1.0


def test_keys_of_as_many_parts_as_may_be_are_read(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(".".join(["a"] * 50) + ' = "1.2.3"\n', "utf-8")
    assert list(load_toml(tmp_path / "a.toml")) == ["a"]
