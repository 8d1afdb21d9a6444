"""Cells between the curves of a drawing, against the polygons that shapely makes of the same lines."""

import random
from pathlib import Path

import numpy as np
import pytest
import shapely
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace

from parser.drawing.model import Drawing, running
from parser.drawing.read import read_drawing
from parser.geometry.along import outline
from sim.make.cam.cells import with_cells


def closed_areas_mm2(drawing: Drawing) -> list[float]:
    rings = [running(drawing.curves, loop.row, loop.backwards) for loop in drawing.loops if loop.closed]
    return sorted(shapely.Polygon(outline(ring)).area / 1e6 for ring in rings)


def cells(folder: Path, lines: list[tuple[tuple[float, float], tuple[float, float]]]) -> Drawing:
    def draw(space: Modelspace) -> None:
        for start, end in lines:
            space.add_line(start, end)

    return with_cells(read_drawing(drawn(folder, draw)))


@pytest.mark.alike(3)
@pytest.mark.parametrize("seed", range(8))
def test_lines_across_a_square_part_it_as_shapely_does(tmp_path: Path, seed: int) -> None:
    chance = random.Random(f"cells {seed}")
    sides = [((0, 0), (20, 0)), ((20, 0), (20, 20)), ((20, 20), (0, 20)), ((0, 20), (0, 0))]
    across = [((round(chance.uniform(1, 19), 3), 0), (round(chance.uniform(1, 19), 3), 20)) for _ in range(3)]
    along = [((0, round(chance.uniform(1, 19), 3)), (20, round(chance.uniform(1, 19), 3))) for _ in range(3)]
    lines = [*sides, *across, *along]
    polygons = shapely.polygonize(shapely.get_parts(shapely.node(shapely.MultiLineString(lines))))
    wanted = sorted(polygon.area for polygon in polygons.geoms)
    assert closed_areas_mm2(cells(tmp_path, lines)) == pytest.approx(wanted, abs=1e-3)


def test_what_ends_within_a_cell_bounds_none(tmp_path: Path) -> None:
    lines = [((0, 0), (20, 0)), ((20, 0), (20, 10)), ((20, 10), (0, 10)), ((0, 10), (0, 0))]
    lines += [((8, 0), (8, 10)), ((12, 0), (12, 4)), ((8, 5), (11, 5)), ((30, 0), (40, 0))]
    drawing = cells(tmp_path, lines)
    assert closed_areas_mm2(drawing) == pytest.approx([80.0, 120.0])
    assert sum(not loop.closed for loop in drawing.loops) == 3
    rows = np.sort(np.concatenate([loop.row for loop in drawing.loops]))
    assert rows.tolist() == list(range(len(drawing.curves)))


def test_an_edge_that_is_an_arc_bounds_cells_on_both_sides(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        for start, end in [((0, 0), (20, 0)), ((20, 0), (20, 10)), ((20, 10), (0, 10)), ((0, 10), (0, 0))]:
            space.add_line(start, end)
        space.add_arc((20, 5), 5, 90, 270)

    drawing = with_cells(read_drawing(drawn(tmp_path, draw)))
    half = 0.5 * np.pi * 25.0
    assert closed_areas_mm2(drawing) == pytest.approx(sorted([half, 200.0 - half]), abs=0.01)


def test_a_drawing_without_dividing_lines_stays_as_it_is(tmp_path: Path) -> None:
    lines = [((0, 0), (20, 0)), ((20, 0), (20, 10)), ((20, 10), (0, 10)), ((0, 10), (0, 0)), ((5, 5), (6, 5))]
    drawing = cells(tmp_path, lines)
    assert closed_areas_mm2(drawing) == pytest.approx([200.0])
    assert len(drawing.curves) == 5
