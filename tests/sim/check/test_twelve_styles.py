"""Twelve ways to write rough cuts and trims: check, edge as cut, comparison and shapely say one thing of each."""

import random
from collections import Counter
from dataclasses import replace

import pytest
from compare_cases import drawing_of
from depth import cases
from more_pass_styles import TWELVE, gouge_um, of_style, random_stray
from pass_styles import Written
from traced import STEEL, kerf_along

from parser.program import load_program
from parser.toolpath import Toolpath
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings
from sim.cut.pieces.pieces import pieces_of
from sim.measure.compare.compare import compare, compare_program
from sim.measure.compare.result import FitRequest
from sim.measure.compare.rings import edge_as_cut

WIRE = CheckSettings(wire_diameter_um=180.0, spark_gap_um=10.0)
MEANT = {"offsets_that_rise": {"3B312"}}
"""What the check says of styles that are no fault."""
ROUNDED_UM = 6.0  # a CAM that rounds ends of arcs drifts by some µm over many of them
_ACCUSED = 0.01
GOUGED_UM, WHOLE_UM = 25.0, 3.0  # between them rounding decides


def told(program: Written) -> set[str]:
    settings = replace(WIRE, may_stay_open=program.name == "stepped_edge")
    findings = check_file(Job("program.3b", program.text.encode(), settings)).findings
    return {finding.code for finding in findings} - MEANT.get(program.name, set())


def path_of(program: Written) -> Toolpath:
    return load_program(program.text.encode(), "program.3b").toolpath


def off_drawing_um(program: Written) -> tuple[float, float]:
    """How far the edges lie off the drawing at most: that of the exact path, and that as cut."""
    (reach_um,) = {edge.reach_um for edge in program.edges}
    path, drawing = path_of(program), drawing_of(*(edge.drawn for edge in program.edges))
    exact = compare_program(path, reach_um, drawing, FitRequest(ROUNDED_UM))
    kerf = kerf_along(path, offset_um=reach_um)
    edge = edge_as_cut(path, kerf, pieces_of(kerf, None, STEEL))
    assert edge is not None
    deepest = max((gouge.depth_um for gouge in exact.gouges), default=0.0)
    return max(exact.max_um, deepest), compare(edge, drawing, FitRequest(ROUNDED_UM)).max_um


def is_compared(program: Written) -> bool:
    """An open edge has no contour to be drawn, and a comparison has one offset for all."""
    return program.name != "stepped_edge" and len({edge.reach_um for edge in program.edges}) == 1


@pytest.mark.alike(3)
@pytest.mark.parametrize("style", TWELVE)
def test_of_sound_programs_all_say_that_they_are(style: str) -> None:
    """But for few that a check accuses, of 400 one: where a hole or a tab lies within a kerf of something else."""
    accused = []
    for number in cases(1, 850):
        program = of_style(random.Random(f"sound {style} {number}"), style)
        assert gouge_um(program) < WHOLE_UM, program.text
        accused += [told(program)] * bool(told(program))
        if is_compared(program):
            assert max(off_drawing_um(program)) <= ROUNDED_UM, program.text
    assert len(accused) <= _ACCUSED * len(cases(1, 850)), accused


@pytest.mark.deeper
def test_a_lead_that_strays_is_told_where_it_cuts_into_the_part_and_nowhere_else() -> None:
    """By a comparison always; by a check, which has no drawing, but for slits from the edge into the part and back.

    So it takes a step that strays between two passes.
    """
    said: Counter[str] = Counter()
    for number in cases(9, 4800):
        rng, style = random.Random(f"stray {number}"), TWELVE[number % len(TWELVE)]
        program = of_style(rng, style, random_stray(rng))
        depth_um = gouge_um(program)
        if WHOLE_UM < depth_um < GOUGED_UM or style == "stepped_edge":  # of an open edge no side is known
            continue
        is_bad = depth_um >= GOUGED_UM
        said["bad" if is_bad else "fine"] += 1
        said["missed"] += is_bad and not told(program)
        said["false"] += not is_bad and "3B321" in told(program)
        if is_compared(program):
            said["compared otherwise"] += (max(off_drawing_um(program)) > ROUNDED_UM) != is_bad

    assert said["compared otherwise"] <= 0.01 * said.total(), said
    assert said["false"] <= 0.02 * said["fine"], said
    assert said["missed"] <= 0.25 * said["bad"], said
