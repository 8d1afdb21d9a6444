"""The part of the patent: its slot comes out word for word, as ISO for its mill and as 3B, and is read again."""

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from made_programs import plan_of
from twins import motion

from parser.dialect.reader import Choices
from parser.program import parse_program
from parser.toolpath import Point
from parser.write.draft import Draft
from parser.write.iso import iso_choices
from sim.check.path_checks import Demands, run_checks
from sim.make.cam.compensated_draft import draft_of_plan
from sim.make.wanted import (
    Wanted,
    begun,
    draft_for,
    read_with,
    written,
)
from sim.setup.making import Making

ISO = """\
N1 G00 X50.0 Y100.0
N2 M56
N3 G04 X4.00
N4 G03 X50.0 Y0.0 I0.0 J-50.0 F#61
N5 G01 X150.0 Y0.0
N6 G03 X150.0 Y100.0 I0.0 J50.0 F#61
N7 G01 X50.0 Y100.0
N8 M55
N9 M02
"""
THREE_B = ["B0B50000B100000GXNR2", "B100000B0B100000GXL1", "B0B50000B100000GXNR4", "B100000B0B100000GXL3"]
TO_ISO = Wanted("iso", iso_choices("patent-mill"))


def slot(space: Modelspace) -> None:
    """The four entities of the patent's drawing, in its order."""
    space.add_arc((50, 50), 50, 90, 270)
    space.add_arc((150, 50), 50, 270, 90)
    space.add_line((50, 0), (150, 0))
    space.add_line((50, 100), (150, 100))


@pytest.fixture(name="draft", scope="module")
def slot_draft(tmp_path_factory: pytest.TempPathFactory) -> Draft:
    """The slot on its contour, counter-clockwise from the patent's start."""
    making = Making(passes_um=(0.0,), direction="ccw", starts_um=(Point(50_000.0, 100_000.0),))
    return draft_of_plan(plan_of(drawn(tmp_path_factory.mktemp("slot"), slot), making))


def test_the_slot_is_the_patents_text_block_by_block(draft: Draft) -> None:
    remark, text = written(begun(draft, TO_ISO), TO_ISO).text.split("\n", 1)
    assert remark.startswith("(patent-mill")
    assert text == ISO


def test_the_slot_is_that_of_3b_block_by_block(draft: Draft) -> None:
    text = written(draft, Wanted("3b")).text
    assert motion(text) == THREE_B
    assert text.splitlines()[1] == "Start Point = 50.00000 , 100.00000 ; X , Y"
    assert text.splitlines()[-1] == "DD"


def test_the_patents_text_is_sound_and_read_as_it_was_drafted(draft: Draft) -> None:
    program = parse_program(ISO)
    assert program.reading.dialect == "patent-mill"
    assert not [finding for finding in run_checks(program, Demands()).findings if finding.code != "ISO112"]
    meant = begun(draft, TO_ISO)
    np.testing.assert_allclose(program.toolpath.end_um, meant.curves.end_um, atol=1e-6)
    np.testing.assert_allclose(program.toolpath.center_um, meant.curves.center_um, atol=1e-6)
    assert float(program.toolpath.length_um[1:].sum()) == pytest.approx(514_159.265359, abs=1e-3)


def test_figures_of_the_mill_are_parted_by_rapids_with_the_tool_up() -> None:
    text = "B9000B0B9000GXL1\nB9000B0B9000GXL3\nD\nB0B5500B5500GYL2\nD\nB9000B0B9000GXL1\nDD\n"
    made = in_mill_code(text)
    tool = ("M56", "G04 X4.00")
    assert made == [
        *(*tool, "G01 X9.0 Y0.0", "G01 X0.0 Y0.0", "M55", "M00", "G00 X0.0 Y5.5", "M00"),
        *(*tool, "G01 X9.0 Y5.5", "M55", "M02"),
    ]


def in_mill_code(text: str) -> list[str]:
    """Blocks without numbers; what is read of them are the rows of the text."""
    plan = draft_for(parse_program(text).toolpath, TO_ISO)
    made = written(plan, TO_ISO)
    back = parse_program(made.text, choices=Choices(dialect="patent-mill")).toolpath
    np.testing.assert_allclose(back.end_um, plan.curves.end_um, atol=1e-6)
    assert read_with(plan, TO_ISO).dialect == "patent-mill"
    return [line.split(" ", 1)[1] for line in made.text.splitlines()[1:]]
