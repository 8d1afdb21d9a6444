"""The document of the card against the card: functions, codes, bits, settings, and the programs that it shows."""

import csv
import os
import re
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest
from places import ROOT

from controller.card.core.call import (
    LATCHED,
    AxisSts,
    Code,
    CrdSts,
)
from controller.card.core.settings import CardSettings

PAGE = (ROOT / "docs" / "card.md").read_text(encoding="utf-8")
EXAMPLE, LOGGED = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
PRINTED, LOG = re.findall(r"```text\n(.*?)```", PAGE, flags=re.DOTALL)


def section(heading: str) -> str:
    """From a heading to the next of its kind or above."""
    level, _, _ = heading.partition(" ")
    text = PAGE.partition(f"\n{heading}\n")[2]
    return re.split(rf"^#{{1,{len(level)}}} ", text, flags=re.MULTILINE)[0]


def rows(heading: str) -> list[list[str]]:
    """Cells of the table rows of a section, without the heads."""
    lines = [line for line in section(heading).splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines]
    heads = {n for n, row in enumerate(cells) if row[0] == "---"}
    return [row for n, row in enumerate(cells) if n not in heads and n + 1 not in heads]


def run(code: str, folder: Path) -> str:
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_every_function_stands_once_in_the_tables() -> None:
    named = [name for row in rows("## Functions") for name in re.findall(r"`(GT_\w+)`", row[0])]
    with (ROOT / "controller" / "card" / "abi" / "ge-functions.csv").open(encoding="utf-8") as file:
        assert sorted(named) == sorted(row["function"] for row in csv.DictReader(file))


def test_codes_are_those_of_the_card() -> None:
    assert [int(row[0].replace("−", "-")) for row in rows("## Codes")] == [int(code) for code in Code]


def test_bits_are_those_of_the_card() -> None:
    written = {row[0]: row[2] for row in rows("## Status words")}
    own = {f"{bit.bit_length() - 1}": "latched" if bit in LATCHED else "live" for bit in AxisSts}
    assert {bit: kind for bit, kind in written.items() if kind in ("latched", "live")} == {**own, "12–13": "live"}
    table = section("## Status words").partition("Axis status")[0]
    assert re.findall(r"^\| (\d+) \|", table, flags=re.MULTILINE) == [f"{bit.bit_length() - 1}" for bit in CrdSts]


def test_settings_stand_with_their_defaults() -> None:
    own = [[f"`{key.name}`", repr(getattr(CardSettings(), key.name))] for key in fields(CardSettings)]
    assert [row[:2] for row in rows("## Settings")] == own


def test_the_example_prints_what_is_shown(tmp_path: Path) -> None:
    assert run(EXAMPLE, tmp_path) == PRINTED


def test_the_log_is_what_is_shown(tmp_path: Path) -> None:
    assert run(LOGGED, tmp_path) == ""
    written = (tmp_path / "part.log").read_text("utf-8").splitlines()
    shown = LOG.splitlines()
    assert len(shown) == len(written)
    for short, whole in zip(shown, written, strict=True):
        assert whole == short or (short.endswith("…") and whole.startswith(short.removesuffix("…")))


@pytest.mark.parametrize(
    "name", ["sleep", "set_input", "step_block", "places", "status", "servo", "backlash", "recorded"]
)
def test_what_is_not_in_the_library_is_named(name: str) -> None:
    assert re.search(rf"`card\.{name}\b", section("## Calls"))
