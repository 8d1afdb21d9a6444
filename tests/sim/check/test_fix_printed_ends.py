"""A mend from a printed end is certain only where it leaves a sound block."""

from pathlib import Path

import pytest

from sim.check.settings import CheckSettings
from sim.cli.check.mends import fix_file

CIRCLE = "N2: B9900B0B39600GYNR1;9.900,0.000\nDD\n"


def fixed(path: Path, line: str) -> str:
    path.write_text(f"N1: {line};9.900,0.000\n{CIRCLE}")
    fix_file(path, path.name, CheckSettings())
    return path.read_text().partition("N1: ")[2].partition(";")[0]


@pytest.mark.parametrize(
    ("written", "mended"),
    [
        pytest.param("B9900B0B9800GXL1", "B9900B0B9900GXL1", id="J alone is wrong"),
        pytest.param("B9800B0B9800GXL1", "B9800B0B9800GXL1", id="X and J are wrong: J alone would not fit X"),
    ],
)
def test_a_count_length_is_mended_where_it_fits_the_line(tmp_path: Path, written: str, mended: str) -> None:
    assert fixed(tmp_path / "part.3b", written) == mended


def test_thousands_of_wrong_printed_ends_are_not_mended_one_by_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def asked(*_: object) -> None:
        raise AssertionError("a wrong end was looked at alone")

    monkeypatch.setattr("parser.threeb.mend.suspects.printed_mends", asked)
    monkeypatch.setattr("parser.threeb.print_checks.is_misprint", asked)
    path = tmp_path / "part.3b"
    path.write_text("".join(f"B9B0B9GXL1;{0.009 + i % 2}00,0.000\nB9B0B9GXL3;0.000,0.000\n" for i in range(200)) + "DD")
    text = path.read_text()
    assert fix_file(path, path.name, CheckSettings()).diff == ""
    assert path.read_text() == text
