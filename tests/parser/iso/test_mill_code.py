"""A program of a mill is none of a wire machine, and is told by what no wire machine does."""

import pytest

from parser.dialect.reader import Choices
from parser.findings.errors import ProgramError
from parser.iso.profiles.profile import PROFILES
from parser.program import parse_program

PATH = "G92 X0 Y0\nG90\n{}\nG01 X0 Y5000\nX5000 Y5000\nM02\n"


@pytest.mark.parametrize(
    ("line", "what", "word"),
    [
        ("T1 M06", "mill-tool", "M06"),
        ("T1 M6 S5000 M03", "mill-tool", "M6"),
        ("G43 Z50. H01", "mill-length", "G43"),
        ("S5000 M03", "mill-spindle", "M03"),
        ("M04 S300", "mill-spindle", "M04"),
        ("G00 Z5.\nG01 Z-2.", "mill-depth", "Z-2."),
    ],
)
def test_what_tells_a_mill_is_named(line: str, what: str, word: str) -> None:
    for dialect in ("", *PROFILES):
        with pytest.raises(ProgramError) as caught:
            parse_program(PATH.format(line), choices=Choices(dialect=dialect))
        finding = caught.value.finding
        assert (finding.code, finding.values["what"], finding.values["detail"]) == ("ISO100", what, word)
        assert word in caught.value.excerpt


@pytest.mark.parametrize(
    "line",
    [
        "M03",
        "S1 D1",
        "T84",
        "G92 X0 Y0 Z0.",
        "Z10.",
        "Z-5.",
        "G92 Z-5.\nG92 Z5.",
        "(T1 M06)",
        "M31 (S5000 M03)",
        "G49 G80",
    ],
)
def test_what_wire_machines_are_told_is_no_mill(line: str) -> None:
    assert len(parse_program(PATH.format(line)).toolpath)
