"""Programs as each family writes them, by a writer of its own: what is read of them is what was drawn."""

import random

import numpy as np
import pytest
from iso_programs import FAMILIES, program
from iso_writer import IsoProgram

from parser.dialect.reader import Choices
from parser.findings.codes import Severity
from parser.program import Program, parse_program
from sim.check.file_check import Job, check_file
from sim.check.result import programmed_of
from sim.check.settings import CheckSettings

PROGRAMS = [(family, number) for family in FAMILIES for number in range(6)]


def read(made: IsoProgram, choices: Choices) -> Program:
    return parse_program(made.text, "made.iso", choices=choices)


def held(made: IsoProgram, program: Program) -> None:
    """Hold what a program runs against its strokes."""
    found = programmed_of(program.toolpath, program.reading.threadings)
    assert (found.lines, found.arcs, found.rapids) == tuple(map(made.count, ("line", "arc", "rapid")))
    off = 3.0 * made.resolution_um
    assert found.cut_length_um == pytest.approx(made.cut_length_um, abs=3.0 * off * made.count("arc") + 1e-3)
    assert found.box_um == pytest.approx(made.box_um, abs=off)
    ends = [stroke.end for stroke in made.strokes]
    ran = program.toolpath.end_um[~program.toolpath.is_jump | (found.rapids > 0)]
    np.testing.assert_allclose(ran, ends, rtol=0.0, atol=1e-6)
    assert found.first_um == pytest.approx(made.strokes[0].start, abs=1e-6)


@pytest.mark.parametrize(("family", "number"), PROGRAMS)
def test_a_program_read_by_its_profile_runs_what_was_drawn(family: str, number: int) -> None:
    made = program(random.Random(number), family)
    held(made, read(made, Choices(dialect=family, unit=made.unit)))


@pytest.mark.alike(16)
@pytest.mark.parametrize(("family", "number"), PROGRAMS)
def test_a_sound_program_is_silent(family: str, number: int) -> None:
    made = program(random.Random(number), family)
    registers = (("D0", 125.0), ("D1", 125.0))  # of Robofil and FANUC, whose tables stand outside of the program
    settings = CheckSettings(dialect=family, unit=made.unit, registers=registers)
    result = check_file(Job("made.iso", made.text.encode(), settings))
    told = {found.code for found in result.findings if found.severity is not Severity.NOTE}
    # A lead that compensates from its middle on is a corner with the first block: what lies behind it stays.
    assert told <= ({"ISO514"} if family == "sodick" else set())
    assert result.verdict == "pass"


@pytest.mark.parametrize(("family", "number"), PROGRAMS)
def test_a_program_is_told_by_its_marks(family: str, number: int) -> None:
    made = program(random.Random(number), family)
    read_so = read(made, Choices())
    if family != "classroom":  # whole numbers may be of any unit: it is chosen
        assert read_so.reading.dialect == family
        held(made, read_so)
