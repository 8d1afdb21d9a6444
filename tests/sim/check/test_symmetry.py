"""What is said of a program depends neither on which way it lies, nor on where, nor on what stands before it."""

import json
import random
import re
from typing import Any

import pytest
from pass_styles import STYLES, written
from places import CORPUS
from rough_and_trim import rough_and_trim

from parser.program import parse_program
from parser.shape.passes import find_passes
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

WIRE = CheckSettings(wire_diameter_um=180.0, spark_gap_um=10.0)
BLOCK = re.compile(r"B(\d*)B(\d*)B(\d+)(B\d+)?G([XY])(D{0,2})(L|NR|SR)([1-4])")
PRINT = re.compile(r"^([^;]*;\s*)(-?[\d.]+)(\s*,\s*)(-?[\d.]+)", re.MULTILINE)
FAULTS = json.loads((CORPUS / "faults/expected.json").read_text(encoding="utf-8"))
PLAIN = [name for name in FAULTS if name[:3] in ("3B2", "3B3") and name[:5] not in ("3B206", "3B201")]
"""Faults of geometry, in blocks of plain spelling."""
TURNED_WITH_IT = {"x", "y", "px", "py", "axis", "other", "ruled", "written", "others", "way", "word", "crossing"}
"""What a finding says of axes, labels and places."""


def turned(text: str) -> str:
    """The program a quarter turn on, counter-clockwise: X becomes Y, Y becomes −X."""
    text = PRINT.sub(lambda m: f"{m[1]}{-float(m[4]):.6f}{m[3]}{float(m[2]):.6f}", text)
    return BLOCK.sub(
        lambda m: f"B{m[2]}B{m[1]}B{m[3]}{m[4] or ''}G{'YX'['XY'.index(m[5])]}{m[6]}{m[7]}{int(m[8]) % 4 + 1}", text
    )


def said(text: str, name: str = "part.3b", before: int = 0) -> list[tuple[Any, ...]]:
    found = check_file(Job(name, text.encode(), WIRE)).findings
    return [
        (
            finding.code,
            finding.block - before if finding.block else 0,
            {
                key: pytest.approx(value, abs=1e-3) if isinstance(value, float) else value
                for key, value in finding.values.items()
                if key not in TURNED_WITH_IT
            },
        )
        for finding in found
        if finding.block
    ]


def passes(text: str) -> list[tuple[Any, ...]]:
    found = find_passes(parse_program(text).toolpath).passes
    return [(*one._replace(shift_um=0.0), pytest.approx(one.shift_um, abs=1e-3)) for one in found]


def texts() -> list[str]:
    rng = random.Random("symmetry")
    return [rough_and_trim(rng).text for _ in range(2)] + [written(rng, style).text for style in STYLES[:3]]


@pytest.mark.alike(12)
@pytest.mark.parametrize("name", PLAIN)
def test_a_fault_is_the_same_fault_whichever_way_the_part_lies(name: str) -> None:
    text = (CORPUS / "faults" / name).read_text(encoding="utf-8")
    expected = said(text, name)
    for _ in range(2):
        text = turned(text)
        assert said(text, name) == expected, text


FIRST = "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nD\nB0B900000B900000GYL4\nD\n"
"""A sound hole far off, and the jump away from it: four blocks."""


@pytest.mark.alike(8)
@pytest.mark.parametrize("name", [name for name in PLAIN if name.endswith(".3b") and "count" not in name])
def test_a_fault_is_the_same_fault_behind_a_sound_figure(name: str) -> None:
    text = (CORPUS / "faults" / name).read_text(encoding="utf-8")
    if not BLOCK.match(text) or PRINT.search(text) or "Start" in text:
        return  # it begins with a header, or says where it is
    alone, behind = said(text, name), said(FIRST + text, name, before=4)
    moved = {"first", "last", "number", "crossing", "other"}
    assert [one[:2] for one in behind] == [one[:2] for one in alone]
    for (_, _, here), (_, _, there) in zip(alone, behind, strict=True):
        for key in set(here) - moved:
            assert there[key] == here[key], key


@pytest.mark.parametrize("text", texts())
def test_passes_are_the_same_whichever_way_the_part_lies(text: str) -> None:
    expected = passes(text)
    for _ in range(3):
        text = turned(text)
        assert passes(text) == expected
