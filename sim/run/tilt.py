"""A program whose wire leans: its contours at two heights, and what they come to.

The lean is what the program tells block by block, what its scenario tells of all contours, or a second contour. The
rest of a run goes by the program plane, with an upright wire: there the wire is where the program says.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from controller.motion.limits import run_starts
from controller.taper.tilted import Lean, TiltedPath, between_contours, figure_lean, tilted, told_lean
from parser.controller_words import Taper
from parser.dialect.reader import at_block
from parser.findings.codes import Check
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.program import Program, paired, read_program
from parser.units import mm
from sim.check.result import CheckState
from sim.check.taper import taper_findings
from sim.cut.solids import TiltedCut, UprightWire, tilted_cut
from sim.cut.wire_rows import WireRows
from sim.run.prepare import Prepared
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings
from sim.table.losses import loss_findings
from sim.table.ticks import Sampling
from sim.table.tilted import follow_tilted

_MOST_OFF_UM: Final = 1.0


def with_upper(program: Program, scenario: Scenario) -> Program:
    """The program with the upper contour that its scenario names; as it is where that names none.

    FileUnreadableError or ProgramError where there is no such program, ProgramError (3B705) where its blocks do not
    match, SettingsError where the program leans by itself.
    """
    taper = scenario.taper
    if taper is None or taper.upper is None:
        return program
    upper = read_program(taper.upper, scenario.choices)
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


def cut_tilted(ready: Prepared, path: TiltedPath | None, scenario: Scenario, wire: WireRows) -> TiltedCut | None:
    """What the cut of a wire that leans comes to, by the motion of its four axes; None of an upright one.

    `wire` is an upright one in each row of the toolpath.
    """
    if path is None:
        return None
    source, feeds = path.source_row, ready.feeds
    cut = np.broadcast_to(feeds.cut_um_s, (len(ready.program.toolpath),))[source]
    rests = np.searchsorted(source, run_starts(ready.program.toolpath))
    guides, sampling = scenario.known_guides, Sampling(scenario.trace_spacing_um, scenario.wire_lag_um)
    axes = follow_tilted(
        path, feeds._replace(cut_um_s=cut), scenario.machine, guides, scenario.start_um, rests, sampling
    )
    kerf = scenario.kerf or scenario.drawing is not None
    return tilted_cut(ready.program, axes, scenario, UprightWire(wire.reach_um, wire.lag_um), kerf=kerf)


def tilt_findings(ready: Prepared, cut: TiltedCut | None, scenario: Scenario) -> Iterator[Finding]:
    """Findings 3B701 to 3B710 on a wire that leans, and those of what its drives lose; none on an upright one."""
    if cut is None:
        return
    program, axes = ready.program, cut.axes
    yield from taper_findings(program, cut.path, scenario.known_guides, scenario.machine.table, scenario.start_um)
    yield from _not_widened(ready, scenario)
    for lost, names in ((axes.lost_xy, "XY"), (axes.lost_uv, "UV")):
        of_rows = tuple(each._replace(row=int(cut.path.source_row[each.row])) for each in lost)
        for found in loss_findings(program, of_rows, scenario.machine.table.motor):
            axis = str(found.values["axis"])
            yield found._replace(values={**found.values, "axis": names["XY".index(axis)]})


def _not_widened(ready: Prepared, scenario: Scenario) -> Iterator[Finding]:
    """3B708: the path has an offset in it that nobody widened for the lean."""
    program, angle_rad = ready.program, scenario.taper.angle_rad if scenario.taper is not None else None
    header_um = program.header.get("offset_um")
    if not angle_rad or ready.offset is not None or not isinstance(header_um, float) or header_um <= 0.0:
        return
    off_um = header_um * (1.0 / float(np.cos(angle_rad)) - 1.0)
    if off_um > _MOST_OFF_UM:
        needed_mm = mm(header_um + off_um)
        values = {"offset_mm": mm(header_um), "off": off_um, "needed_mm": needed_mm}
        yield at_block(program.toolpath, program.lines, "3B708", 0, **values)


def with_tilt(states: tuple[CheckState, ...], path: TiltedPath | None) -> tuple[CheckState, ...]:
    """How far checks came, the one of the lean among them where the wire is not upright: that is complete."""
    return states if path is None else (*states, CheckState(Check.TAPER))
