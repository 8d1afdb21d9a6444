"""How a program is to lean, before anything moves: by its own words, by its scenario, or along a second contour."""

from dataclasses import replace

import numpy as np

from controller.taper.tilted import Lean, TiltedPath, between_contours, figure_lean, tilted, told_lean
from parser.controller_words import Taper
from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from parser.program import Program, load_program, paired
from sim.run.prepare import Prepared
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings


def with_upper(program: Program, scenario: Scenario) -> Program:
    """The program with the upper contour that its scenario names; as it is where that names none.

    ProgramError where the upper one is no program, ProgramError (3B705) where their blocks do not match, SettingsError
    where one of them leans by itself.
    """
    taper = scenario.taper
    if taper is None or taper.upper is None:
        return program
    upper = load_program(taper.upper.data, taper.upper.name, scenario.choices)
    for each in (program, upper):
        if each.toolpath.leans:
            raise SettingsError("taper-twice", name=each.name)
    return paired(program, upper)


def tilted_path(ready: Prepared, drawn: Program, scenario: Scenario) -> TiltedPath | None:
    """The way of the wire of a program that is ready, and was `drawn` so; None where it is upright.

    SettingsError where program and scenario both tell of the lean, where the program plane is outside of the work, and
    where two contours are to be offset.
    """
    toolpath, taper, contour = ready.program.toolpath, scenario.taper or TaperSettings(), drawn.toolpath
    angle_rad = taper.angle_rad or 0.0
    if contour.leans and angle_rad:
        raise SettingsError("taper-twice", name=drawn.name)
    if not contour.leans and not angle_rad:
        return None
    heights = scenario.heights
    if contour.upper is not None:
        if ready.offset is not None:
            raise SettingsError("contours-not-offset", name=drawn.name)
        planes = (taper.program_plane_um, heights.work_um)
        return between_contours(contour, contour.upper, heights, planes)
    if contour.taper is not None:
        lean = told_lean(_as_run(contour.taper, ready), toolpath)
    else:
        side = int(taper.side) * _directions(ready)
        lean = figure_lean(toolpath, angle_rad, 1)
        lean = Lean(lean.tangent * side, lean.tilts)
    return tilted(toolpath, lean, heights, taper.corner)


def _directions(ready: Prepared) -> Floats:
    """(n,) +1 on rows that run as they were drawn, −1 on those of passes that run back."""
    if ready.offset is None:
        return np.ones(len(ready.program.toolpath))
    return np.where(ready.offset.passed.is_back[ready.offset.path.source_row], -1.0, 1.0)


def _as_run(taper: Taper, ready: Prepared) -> Taper:
    """The lean of a program along the rows of the path that runs."""
    if ready.offset is None:
        return taper
    source = ready.offset.path.source_row
    row, back = ready.offset.passed.row[source], ready.offset.passed.is_back[source]
    return Taper(np.where(back, -taper.side[row], taper.side[row]), taper.angle_rad[row])


def leaning_offset(scenario: Scenario) -> Scenario:
    """The scenario with the offset as it is in the program plane, where all contours lean by T: D / cos T."""
    angle_rad = scenario.taper.angle_rad if scenario.taper is not None else None
    if not angle_rad or scenario.offset is None:
        return scenario
    cos = float(np.cos(angle_rad))
    passes = tuple(each._replace(by_um=each.by_um / cos) for each in scenario.offset.passes)
    return replace(scenario, offset=scenario.offset._replace(passes=passes))
