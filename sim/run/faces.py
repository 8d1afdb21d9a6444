"""Both faces of a leaning cut beside their drawings, by the exact path and without a run."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.taper.tilted import TiltedPath, section_toolpath
from parser.drawing.model import Drawing
from parser.findings.errors import SettingsError
from parser.program import Program
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import Comparison, FitRequest
from sim.measure.compare.starts import placed
from sim.run.prepare import Prepared, as_run_in, prepare
from sim.setup.scenario import Scenario

_ALIKE_RAD = 1e-6
"""Walls whose angles differ by less have one offset: of 0.1 mm it is 1e-5 µm."""


class Faces(NamedTuple):
    """The edge in the program plane, and that at the top of the work where it has a drawing, each beside its own."""

    plane: Comparison
    top: Comparison | None


class CutOffset(NamedTuple):
    """How far the wire cuts past its path: where it is upright, or, `in_plane`, as it leans; µm."""

    by_um: float
    in_plane: bool = False


def compared_faces(
    program: Program, scenario: Scenario, offset: CutOffset, drawings: tuple[Drawing, Drawing | None], to: FitRequest
) -> Faces:
    """The edges of a program beside their drawings.

    The drawing of the top lies on the sheet as that of the program plane does. Raises what `compare_program` and
    `prepare` do, and SettingsError for a drawing of the top where the wire is upright, or leans by different angles
    across its walls: then no one offset makes the edge, and a run shows it.
    """
    below, above = drawings
    if above is None and not _leans(program, scenario):
        return Faces(compare_program(as_run_in(program, scenario).toolpath, offset.by_um, below, to), None)
    ready = prepare(program, scenario)
    if ready.tilt is None:
        raise SettingsError("upper-drawing-upright")
    wall_rad = _wall_rad(ready.tilt)
    if wall_rad is None and above is not None:
        raise SettingsError("lean-varies")
    reach_um = offset.by_um / (1.0 if offset.in_plane else float(np.cos(wall_rad or 0.0)))
    plane = compare_program(ready.program.toolpath, reach_um, below, to)
    if above is None:
        return Faces(plane, None)
    laid = replace(above, curves=placed(above.curves, plane.placement))
    top = compare_program(_at_top(ready, ready.tilt).toolpath, reach_um, laid, to._replace(fitted=False))
    return Faces(plane, top)


def _leans(program: Program, scenario: Scenario) -> bool:
    taper = scenario.taper
    return program.toolpath.leans or (taper is not None and (bool(taper.angle_rad) or taper.upper is not None))


def _wall_rad(tilt: TiltedPath) -> float | None:
    """The angle of all walls; None where they differ."""
    walls = tilt.across_rad()[np.concatenate([np.zeros(0, dtype=np.int64), *tilt.loops])]
    if not len(walls):
        return 0.0
    return float(walls[0]) if float(np.ptp(walls)) <= _ALIKE_RAD else None


def _at_top(ready: Prepared, tilt: TiltedPath) -> Program:
    curves, row = tilt.ruled.section(tilt.heights.work_um)
    return replace(ready.program, toolpath=section_toolpath(ready.program.toolpath, curves, tilt.source_row[row]))
