"""What a replay's document says of what lies still: travel, work, clamps, and the pieces that come free."""

from typing import Any

import numpy as np
import shapely

from sim.cut.pieces.pieces import Piece
from sim.rounded import rounded
from sim.run.course import Happening
from sim.run.dryrun import DryRun
from sim.run.outlines import simpler
from sim.setup.obstacles import Outline
from sim.table.follow import Setup
from sim.table.trace import origin_um

_OUTLINE_UM = 1.0
"""Outlines of pieces are simplified by a step, and drawn in whole µm."""


def scene(run: DryRun) -> dict[str, Any]:
    """Machine, wire, work and clamps; outlines are lists of corners [x, y], µm of the program."""
    scenario = run.scenario
    setup = Setup(scenario.machine.table, scenario.start_um, origin_um(run.toolpath))
    return {
        "machine": scenario.machine.name,
        "interpolator": scenario.machine.controller.interpolation,
        "wire_diameter_um": rounded(scenario.wire.diameter_um),
        "offset_um": rounded(scenario.wire.reach_um),
        "thickness_mm": scenario.thickness_mm,
        "travel_um": np.round(setup.room_um, 6).tolist(),
        "work_um": None if scenario.work_um is None else _corners(scenario.work_um),
        "clamps": [{"name": clamp.name, "outline_um": _corners(clamp.outline_um)} for clamp in scenario.clamps],
    }


def piece_entry(happening: Happening[Piece]) -> dict[str, Any]:
    """A piece that comes free; `outline_um` is its outer ring, `holes_um` are those in it."""
    piece = happening.what
    return {
        "kind": piece.kind,
        "row": happening.row,
        "t_s": rounded(happening.t_s),
        "area_mm2": rounded(piece.area_mm2),
        "mass_g": rounded(piece.mass_g),
        "center_um": [rounded(piece.center_um.x), rounded(piece.center_um.y)],
        "outline_um": _ring(piece.outline_um.exterior),
        "holes_um": [_ring(hole) for hole in piece.outline_um.interiors],
    }


def _ring(ring: shapely.LinearRing) -> list[list[int]]:
    """Corners of a closed outline, the first one once."""
    corners = np.asarray(simpler(ring, _OUTLINE_UM).coords)[:-1, :2]
    whole: list[list[int]] = np.rint(corners).astype(np.int64).tolist()
    return whole


def _corners(outline: Outline) -> list[list[float]]:
    return [[rounded(corner.x), rounded(corner.y)] for corner in outline]
