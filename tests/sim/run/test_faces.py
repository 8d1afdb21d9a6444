"""Both faces of a leaning cut beside their drawings, by the exact path: closed forms, and what is refused."""

import math
from dataclasses import replace
from pathlib import Path

import ezdxf
import pytest
from runs import plain_scenario

from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from parser.findings.errors import SettingsError
from parser.program import Program, parse_program
from sim.measure.compare.result import FitRequest
from sim.run.faces import CutOffset, compared_faces
from sim.setup.part import SIDES
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings, UpperProgram

PUNCH = """B0B5000B5000GYL2
B10000B0B10000GXL1
B0B20000B20000GYL2
B20000B0B20000GXL3
B0B20000B20000GYL4
B10000B0B10000GXL1
B0B5000B5000GYL4
DD
"""
TO = FitRequest(0.01)
RAD = math.radians(3.0)
REACH_MM = 0.1 / math.cos(RAD)


def drawing(folder: Path, name: str, half_mm: float, round_mm: float = 0.0, shift_mm: float = 0.0) -> Drawing:
    """A square about (0, 15) mm, its sides that far off, its corners rounded."""
    document = ezdxf.new(units=4)
    inner, bulge = half_mm - round_mm, math.tan(math.pi / 8.0)
    ends = [(-inner, -half_mm), (inner, -half_mm), (half_mm, -inner), (half_mm, inner)]
    ends += [(inner, half_mm), (-inner, half_mm), (-half_mm, inner), (-half_mm, -inner)]
    points = [(x + shift_mm, 15.0 + y, bulge * (at % 2 if round_mm else 0)) for at, (x, y) in enumerate(ends)]
    document.modelspace().add_lwpolyline(points if round_mm else points[1::2], format="xyb", close=True)
    document.saveas(folder / name)
    return read_drawing(folder / name)


def leaning(side: str = "right", **settings: object) -> tuple[Program, Scenario]:
    taper = TaperSettings(RAD, SIDES[side], **settings)  # type: ignore[arg-type]
    return parse_program(PUNCH), replace(plain_scenario(), taper=taper, thickness_mm=40.0)


@pytest.mark.parametrize(("plane_mm", "side"), [(0.0, "right"), (0.0, "left"), (15.0, "right")])
def test_faces_of_a_punch_are_squares(tmp_path: Path, plane_mm: float, side: str) -> None:
    program, scenario = leaning(side, program_plane_um=1000.0 * plane_mm)
    by_mm = (40.0 - plane_mm) * math.tan(RAD) * (1.0 if side == "right" else -1.0)
    drawings = (drawing(tmp_path, "a.dxf", 10.0 - REACH_MM), drawing(tmp_path, "b.dxf", 10.0 + by_mm - REACH_MM))
    found = compared_faces(program, scenario, CutOffset(100.0), drawings, TO)
    assert found.top is not None
    assert (found.plane.passes, found.top.passes) == (True, True)  # within 0.01 µm


def test_an_offset_of_the_program_plane_is_not_widened_again(tmp_path: Path) -> None:
    program, scenario = leaning()
    drawings = (drawing(tmp_path, "a.dxf", 10.0 - REACH_MM), None)
    assert compared_faces(program, scenario, CutOffset(1000.0 * REACH_MM, in_plane=True), drawings, TO).plane.passes
    assert not compared_faces(program, scenario, CutOffset(1000.0 * REACH_MM), drawings, TO).plane.passes


def test_cones_round_the_corners_of_the_top(tmp_path: Path) -> None:
    program, scenario = leaning(corner="cone")
    by_mm = 40.0 * math.tan(RAD)
    rounded = drawing(tmp_path, "b.dxf", 10.0 + by_mm - REACH_MM, by_mm - REACH_MM)
    found = compared_faces(
        program, scenario, CutOffset(100.0), (drawing(tmp_path, "a.dxf", 10.0 - REACH_MM), rounded), TO
    )
    assert found.top is not None
    assert found.top.max_um < 0.05


def test_a_shift_between_the_faces_counts(tmp_path: Path) -> None:
    program, scenario = leaning()
    top = drawing(tmp_path, "b.dxf", 10.0 + 40.0 * math.tan(RAD) - REACH_MM, shift_mm=0.02)
    found = compared_faces(program, scenario, CutOffset(100.0), (drawing(tmp_path, "a.dxf", 10.0 - REACH_MM), top), TO)
    assert found.top is not None
    assert found.top.max_um == pytest.approx(20.0, abs=0.1)


def test_what_has_no_one_offset_or_no_lean_is_refused(tmp_path: Path) -> None:
    square = drawing(tmp_path, "a.dxf", 9.9)
    program, scenario = leaning()
    with pytest.raises(SettingsError, match="the wire is upright"):
        compared_faces(program, replace(scenario, taper=None), CutOffset(100.0), (square, square), TO)
    wider = PUNCH.replace("B0B20000B20000GYL2", "B0B24000B24000GYL2").replace(
        "B0B20000B20000GYL4", "B0B24000B24000GYL4"
    )
    two = replace(scenario, taper=TaperSettings(upper=UpperProgram("upper.3b", wider.encode())))
    with pytest.raises(SettingsError, match="different angles across its walls"):
        compared_faces(program, two, CutOffset(100.0), (square, square), TO)
    assert compared_faces(program, two, CutOffset(100.0), (square, None), TO).top is None
