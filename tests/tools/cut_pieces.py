"""The standard piece as a table cuts it, and measured on its edges: what `drycut fit` is given, without a machine."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import shapely
from command import run_command

from parser.geometry.curves import Floats
from parser.program import parse_program
from sim.make.piece import piece_dxf, piece_limits
from sim.measure.accept.judge import Places
from sim.run.recording import pieces_of_run
from sim.run.running import dry_run
from sim.setup.machine.machine import Machine
from sim.setup.scenario import load_scenario

AREAS_MM2 = {"octagon": 331.4, "square": 100.0, "plate": 840.0, "rhomb": 72.0, "disc": 314.2}
HOLES_MM2 = {"slot-1": 8.0, "slot-2": 16.0, "slot-5": 40.0, "rhomb-hole": 50.0}
HALF_UM = {"octagon": 2000.0, "square": 2500.0, "plate": 3500.0, "rhomb": 300.0, "slot": 1700.0, "rhomb-hole": 300.0}
"""To either side of the middle of a face that is measured."""


def cut_and_measured(folder: Path, machine: Machine) -> dict[str, Places]:
    """Places on the faces and round the disc of a piece that a machine cuts."""
    (folder / "piece.dxf").write_text(piece_dxf(), "utf-8")
    program = folder / "piece.3b"
    assert run_command("program", folder / "piece.dxf", "-o", program).returncode == 0
    scenario = replace(load_scenario(program), machine=machine)
    run = dry_run(parse_program(program.read_text("utf-8"), program.name), scenario)
    parts = [shapely.Polygon(piece.outline_um.exterior) for piece in pieces_of_run(run).freed]
    holes = [shapely.Polygon(ring) for piece in pieces_of_run(run).freed for ring in piece.outline_um.interiors]
    rings = {name: _nearest(parts, area) for name, area in AREAS_MM2.items()}
    rings |= {name: _nearest(holes, area) for name, area in HOLES_MM2.items()}
    found = {}
    for feature in piece_limits().features:
        ring = rings[feature.name if feature.name in rings else feature.name.rsplit("-", 1)[0]]
        if feature.kind == "circle":
            found[feature.name] = _round(ring)
            continue
        half_um = HALF_UM[feature.name.rsplit("-", 1)[0]]
        found[feature.name] = _faces(ring, math.radians(feature.across_deg), 1000.0 * feature.nominal_mm, half_um)
    return found


def _nearest(rings: list[shapely.Polygon], area_mm2: float) -> shapely.Polygon:
    return min(rings, key=lambda ring: abs(ring.area * 1e-6 - area_mm2))


def _faces(ring: shapely.Polygon, across: float, size_um: float, half_um: float) -> Places:
    """Twelve places on each of two faces, where rays across meet the edge."""
    normal, middle = np.array([math.cos(across), math.sin(across)]), np.array(ring.centroid.coords[0])
    along = np.array([-normal[1], normal[0]])
    rows = [
        middle + by * along + sign * normal * (0.5 * size_um + np.array([[-200.0], [200.0]]))
        for sign in (-1.0, 1.0)
        for by in np.linspace(-half_um, half_um, 12)
    ]
    return _met(ring, rows)


def _round(ring: shapely.Polygon) -> Places:
    middle, angles = np.array(ring.centroid.coords[0]), np.linspace(0.03, 2.0 * np.pi, 60, endpoint=False)
    rows = [middle + np.array([[9500.0], [10500.0]]) * [math.cos(angle), math.sin(angle)] for angle in angles]
    return _met(ring, rows)


def _met(ring: shapely.Polygon, rays: list[Floats]) -> Places:
    """Where rays meet the edge; each meets it once."""
    met = [shapely.get_coordinates(ring.exterior.intersection(shapely.LineString(ray))) for ray in rays]
    assert all(len(each) for each in met)
    place = np.array([each.mean(axis=0) for each in met])
    return Places(place, np.full(len(place), np.nan))
