"""Dialects of a shop's own: what they say is what is read, and what no profile can have is named with its place."""

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from parser.dialect.reader import Choices, OwnDialect
from parser.findings.errors import SettingsError
from parser.iso.profiles import profile as profiles_module
from parser.iso.profiles.profile import PROFILES, own_dialect, own_dialect_text, profile
from parser.program import parse_program
from parser.text.places import KeyPlaces

FOLDER = Path(profiles_module.__file__).parent
PROGRAM = "O0001\nG92 X0 Y0\nG90 G01 X5000 Y0\nG145\nX5000 Y5000\nX0 Y5000\nX0 Y0\nM02\n"


def own(text: str, name: str = "makino") -> OwnDialect:
    return own_dialect(name, tomllib.loads(text), KeyPlaces(f"{name}.toml", text))


@pytest.mark.parametrize("name", PROFILES)
def test_what_the_profiles_say_may_stand_in_a_file_of_ones_own(name: str) -> None:
    text = (FOLDER / f"{name}.toml").read_text("utf-8")
    assert replace(profile(own(text)), name=name) == profile(name)
    assert own(own_dialect_text(own(text))) == own(text)
    assert profile(own(f'extends = "{name}"\n')) == replace(profile(name), name="makino")


def test_a_word_that_the_dialect_knows_is_read() -> None:
    before = {finding.code for finding in parse_program(PROGRAM, choices=Choices(dialect="fanuc")).findings}
    read = parse_program(PROGRAM, choices=Choices(dialect=own('extends = "fanuc"\n[g]\n145 = "switch"\n')))
    assert "ISO203" in before
    assert "ISO203" not in {finding.code for finding in read.findings}
    assert read.reading.dialect == "makino"


def test_numbers_have_the_scale_that_the_dialect_says() -> None:
    tenths = parse_program(PROGRAM.replace("G145\n", ""), choices=Choices(dialect=own("integer_um = 0.1\n")))
    assert tenths.toolpath.end_um.max() == pytest.approx(500.0)


@pytest.mark.parametrize(
    ("text", "place", "said"),
    [
        ('extends = "fanuk"\n', "makino.toml:1:1", "unknown"),
        ("\nintger_um = 1\n", "makino.toml:2:1", "unknown-key"),
        ('[g]\n  145 = "swich"\n', "makino.toml:2:3", "dialect-one-of"),
        ('[g]\n"04" = "once"\n', "makino.toml:2:1", "dialect-code"),
        ('[m]\n"1000" = "stop"\n', "makino.toml:2:1", "dialect-code"),
        ("integer_um = -1\n", "makino.toml:1:1", "dialect-length"),
        ("integer_um = nan\n", "makino.toml:1:1", "dialect-length"),
        ("may_be_inch = 1\n", "makino.toml:1:1", "dialect-truth"),
        ('letters = "xy"\n', "makino.toml:1:1", "dialect-letters"),
        ('calls = ["somewhere"]\n', "makino.toml:1:1", "dialect-list"),
        ("meant_twice = [true]\n", "makino.toml:1:1", "dialect-list"),
        ("[range]\nF = [9, 0]\n", "makino.toml:2:1", "dialect-range"),
        ('[rules]\nouter = "square"\n', "makino.toml:2:1", "dialect-one-of"),
        ("[rules]\ninner = 1\n", "makino.toml:2:1", "unknown-key"),
        ("g = 1\n", "makino.toml:1:1", "dialect-table"),
        ('name = "x"\n', "makino.toml:1:1", "unknown-key"),
    ],
)
def test_what_no_profile_can_have_is_refused_with_its_place(text: str, place: str, said: str) -> None:
    with pytest.raises(SettingsError) as raised:
        own(text)
    assert str(raised.value).startswith(f"{place}: ") or f"{place}:" in str(raised.value)
    assert said


@pytest.mark.parametrize("name", ["fanuc", "Makino", "my dialect", "", "x" * 41])
def test_a_name_that_is_taken_or_none_is_refused(name: str) -> None:
    with pytest.raises(SettingsError):
        own("", name)


VALUES = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=3), st.lists(st.integers(), max_size=3)
)


@given(st.dictionaries(st.sampled_from([*profiles_module.Profile.__dataclass_fields__, "x"]), VALUES, max_size=3))
def test_any_values_are_a_dialect_or_a_complaint(values: dict[str, Any]) -> None:
    try:
        made = own_dialect("makino", values, KeyPlaces("makino.toml", ""))
    except SettingsError:
        return
    assert profile(made).name == "makino"
    parse_program(PROGRAM, choices=Choices(dialect=made))
