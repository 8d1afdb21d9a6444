"""Edges that parts have in common are cut once: each part falls as large as it is drawn, and by its own cut.

What is left of the sheet is worked out here by shapely: the path of the written program, as wide as the kerf, taken out
of a plate. Layouts are made by cutting a rectangle in two again and again, so that the size of each part is known.
"""

import math
import random
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import shapely
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from made_programs import plan_of
from runs import plain_scenario

from parser.geometry.along import outline
from parser.program import Program, load_program
from parser.shape.contours import runs
from sim.make.cam.maker import MadeProgram, NotMade, made_program
from sim.make.cam.model import CannotCutError
from sim.make.wanted import Wanted
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import FitRequest
from sim.run.dryrun import DryRun
from sim.run.running import dry_run
from sim.setup.making import Making
from sim.setup.part import DrawingTarget

REACH_UM, KERF_MM = 100.0, 0.2
TO_3B = Wanted("3b")
COMMON = Making(common_edges=True)


class Box(NamedTuple):
    """A rectangular part, mm."""

    x: float
    y: float
    wide: float
    high: float

    def draw(self, space: Modelspace) -> None:
        space.add_lwpolyline(self.corners(), close=True)

    def corners(self) -> list[tuple[float, float]]:
        right, above = self.x + self.wide, self.y + self.high
        return [(self.x, self.y), (right, self.y), (right, above), (self.x, above)]


def grid(columns: int, rows: int, wide: float = 8.0, high: float = 5.0, apart: float = 0.0) -> list[Box]:
    return [Box(at * (wide + apart), of * (high + apart), wide, high) for of in range(rows) for at in range(columns)]


def cut_in_two(box: Box, least_mm: float, draws: random.Random) -> list[Box]:
    """Parts of a rectangle that is cut in two until its parts are small."""
    splits = [axis for axis, size in enumerate((box.wide, box.high)) if size >= 2.0 * least_mm]
    if not splits or (max(box.wide, box.high) < 4.0 * least_mm and draws.random() < 0.3):
        return [box]
    axis = draws.choice(splits)
    by = round(draws.uniform(least_mm, (box.wide, box.high)[axis] - least_mm), 3)
    halves = (
        (Box(box.x, box.y, by, box.high), Box(box.x + by, box.y, box.wide - by, box.high))
        if axis == 0
        else (Box(box.x, box.y, box.wide, by), Box(box.x, box.y + by, box.wide, box.high - by))
    )
    return [part for half in halves for part in cut_in_two(half, least_mm, draws)]


def made(folder: Path, boxes: Sequence[Box], making: Making = COMMON, wanted: Wanted = TO_3B) -> MadeProgram:
    def draw(space: Modelspace) -> None:
        for box in boxes:
            box.draw(space)

    return proved(drawn(folder, draw), making, wanted)


def proved(path: Path, making: Making = COMMON, wanted: Wanted = TO_3B) -> MadeProgram:
    done = made_program(path, making, wanted, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved, done.proof
    assert not done.plan.to_check
    return done


def left_of(program: Program) -> list[shapely.Polygon]:
    """What comes loose of a plate."""
    path = program.toolpath
    ways = [path.picked(np.arange(first, past)) for first, past in runs(path).tolist()]
    lines = [shapely.LineString(np.concatenate([outline(way), way.end_um[-1:]])) for way in ways]
    kerf = shapely.union_all([line.buffer(REACH_UM, quad_segs=64) for line in lines])
    low_x, low_y, high_x, high_y = kerf.bounds
    plate = shapely.box(low_x - 5e3, low_y - 5e3, high_x + 5e3, high_y + 5e3)
    pieces = shapely.get_parts(shapely.difference(plate, kerf))
    return sorted(pieces, key=lambda piece: piece.area)[:-1]


def are_as_drawn(program: Program, boxes: Sequence[Box], within_um: float = 2.0) -> None:
    """Each piece is one of the parts, all round, and each part is one of the pieces."""
    sizes = sorted((box.wide, box.high) for box in boxes)
    pieces = [piece for piece in left_of(program) if piece.area > 1e3]
    assert len(pieces) == len(boxes)
    found = []
    for piece in pieces:
        low_x, low_y, high_x, high_y = piece.bounds
        assert piece.hausdorff_distance(shapely.box(*piece.bounds)) <= within_um
        found.append(((high_x - low_x) / 1e3, (high_y - low_y) / 1e3))
    assert np.abs(np.array(sorted(found)) - np.array(sizes)).max() <= 2e-3 * within_um


def cut_mm(program: Program) -> float:
    path = program.toolpath
    return float(path.length_um[~path.is_jump].sum()) / 1e3


@pytest.mark.parametrize("apart", [0.0, KERF_MM])
@pytest.mark.parametrize("direction", ["ccw", "cw"])
def test_two_parts_share_an_edge_and_keep_their_size(tmp_path: Path, apart: float, direction: str) -> None:
    boxes = grid(2, 1, apart=apart)
    making = COMMON._replace(direction=direction)  # type: ignore[arg-type]  # one of its words
    done = made(tmp_path, boxes, making)
    are_as_drawn(done.program, boxes)
    # Round both by their offsets, a lead-in and a lead-out of 1.9 mm; of the edge of 5.2 mm 1 mm at either end again.
    wide, high = (side + 2.0 * REACH_UM / 1e3 for side in (8.0, 5.0))
    assert cut_mm(done.program) == pytest.approx(4.0 * (wide + high) + 3.8 - (high - 2.0), abs=0.01)
    assert any(note.name == "moved-apart" for note in done.plan.drawing.notes) is (apart == 0.0)


@pytest.mark.parametrize("corners", ["sharp", pytest.param("round", marks=pytest.mark.deeper)])
def test_a_part_amid_others_is_cut_before_they_set_it_free(tmp_path: Path, corners: str) -> None:
    boxes = grid(3, 3)
    done = made(tmp_path, boxes, COMMON._replace(corners=corners))  # type: ignore[arg-type]
    are_as_drawn(done.program, boxes)
    order = [cut.figure.number for cut in done.plan.cuts]
    assert sorted(order) == list(range(1, 10))
    threads = [cut.thread.by for cut in done.plan.cuts]
    assert threads == ["chosen"] + ["kerf"] * 8
    assert done.proof is not None
    assert done.proof.run is not None
    assert done.proof.run.remains is not None
    freed = [piece.freed.contour for piece in done.proof.run.remains.pieces.freed]
    assert sorted(freed) == list(range(1, 10))  # each by its own cut


@pytest.mark.alike(4)
@pytest.mark.parametrize("seed", range(100))
def test_parts_of_a_rectangle_cut_in_two_again_and_again_are_as_they_are_drawn(tmp_path: Path, seed: int) -> None:
    draws = random.Random(f"layout:{seed}")
    boxes = cut_in_two(Box(0.0, 0.0, draws.uniform(9.0, 16.0), draws.uniform(7.0, 12.0)), 3.0, draws)
    boxes = [Box(*(round(value, 3) for value in box)) for box in boxes]
    done = made(tmp_path, boxes)
    are_as_drawn(done.program, boxes)
    whole = sum(2.0 * (box.wide + box.high) + 0.8 for box in boxes)
    assert len(boxes) == 1 or cut_mm(done.program) < whole + 8.0


def test_lines_across_an_outline_part_it_in_cells(tmp_path: Path) -> None:
    """Drawn as CADs explode it: long lines, each edge once."""

    def lines(space: Modelspace) -> None:
        for x in (0, 6, 12, 18):
            space.add_line((x, 0), (x, 10))
        for y in (0, 5, 10):
            space.add_line((0, y), (18, y))
        space.add_circle((9, 2.5), 1)

    done = proved(drawn(tmp_path, lines))
    assert len(done.plan.cuts) == 7
    pieces = [piece for piece in left_of(done.program) if piece.area > 1e6]
    # The core of the hole falls too: a disc of R 0.8 mm with a notch from its lead.
    assert [round(piece.area / 1e6) for piece in pieces] == [2, 27, 30, 30, 30, 30, 30]


def test_a_hole_moves_with_its_part_and_a_thread_point_too(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        for box in grid(3, 1):
            box.draw(space)
        space.add_circle((20, 2.5), 1.5)
        space.add_point((20, 2.5))

    done = proved(drawn(tmp_path, draw))
    hole = done.plan.cuts[0]
    assert hole.figure.kind == "hole"
    assert hole.thread.by == "marked"
    assert tuple(hole.thread.place_um) == (20_400.0, 2_500.0)


def test_hexagons_are_moved_apart_across_slanting_edges(tmp_path: Path) -> None:
    def comb(space: Modelspace) -> None:
        for row in range(2):
            for column in range(2):
                x, y = math.sqrt(3.0) * 4.0 * (column + 0.5 * row), 6.0 * row
                turns = [math.pi / 6.0 + at * math.pi / 3.0 for at in range(6)]
                space.add_lwpolyline([(x + 4 * math.cos(turn), y + 4 * math.sin(turn)) for turn in turns], close=True)

    done = proved(drawn(tmp_path, comb))
    assert [cut.thread.by for cut in done.plan.cuts] == ["chosen", "kerf", "kerf", "kerf"]
    pieces = [piece for piece in left_of(done.program) if piece.area > 1e3]
    assert len(pieces) == 4
    assert all(piece.area / 1e6 == pytest.approx(1.5 * math.sqrt(3.0) * 16.0, abs=0.05) for piece in pieces)


def rounded(space: Modelspace, x: float, y: float) -> None:
    """A part of 10 × 8 mm with corners of R 2 mm."""
    corners = [(2, 0, 0), (8, 0, 0.41421356), (10, 2, 0), (10, 6, 0.41421356), (8, 8, 0), (2, 8, 0.41421356)]
    corners += [(0, 6, 0), (0, 2, 0.41421356)]
    space.add_lwpolyline([(x + at, y + of, bulge) for at, of, bulge in corners], format="xyb", close=True)


def test_parts_with_round_corners_that_fail_in_the_kerf_are_cut_all_round(tmp_path: Path) -> None:
    """The wire runs tangent into the kerf of the other one: the part would fall before the last of its edge is cut."""

    path = drawn(tmp_path, lambda space: [rounded(space, x, 0.0) for x in (0.0, 10.2)])
    done = proved(path)
    assert {cut.thread.by for cut in done.plan.cuts} == {"chosen"}
    assert [note.name for note in done.plan.notes] == ["cut-round"]


def held_against(path: Path, program: Program) -> DryRun:
    """A run whose cut is held against a drawing."""
    return dry_run(program, plain_scenario(kerf=True, drawing=DrawingTarget(path, fit=False)), measured=False)


@pytest.mark.parametrize("making", [Making(), COMMON])
def test_waste_between_round_corners_is_no_part(tmp_path: Path, making: Making) -> None:
    path = drawn(tmp_path, lambda space: [rounded(space, x, y) for x in (0.0, 10.2) for y in (0.0, 8.2)])
    done = proved(path, making)
    assert len(done.plan.cuts) == 4
    waste = [piece for piece in left_of(done.program) if 1e3 < piece.area < 10e6]
    assert len(waste) == 1  # the star amid them
    assert not [finding for finding in held_against(path, done.program).findings if finding.code.startswith("3B6")]


def test_waste_in_a_pinwheel_is_no_part(tmp_path: Path) -> None:
    boxes = [Box(0, 0, 8, 4), Box(8, 0, 4, 8), Box(4, 8, 8, 4), Box(0, 4, 4, 8)]
    done = made(tmp_path, boxes)
    are_as_drawn(done.program, [*boxes, Box(4, 4, 3.8, 3.8)])


def test_a_part_that_the_drawing_does_not_have_is_no_waste(tmp_path: Path) -> None:
    for apart in (KERF_MM, 1.0):
        boxes = grid(2, 1, apart=apart)
        (tmp_path / "both").mkdir(exist_ok=True)
        done = made(tmp_path / "both", boxes, Making())
        path = drawn(tmp_path, boxes[0].draw)
        assert "3B601" in {finding.code for finding in held_against(path, done.program).findings}


def test_parts_without_an_edge_in_common_are_cut_as_ever(tmp_path: Path) -> None:
    done = made(tmp_path, grid(2, 1, apart=3.0))
    assert [note.name for note in done.plan.notes] == ["no-common-edges"]
    assert {cut.thread.by for cut in done.plan.cuts} == {"chosen"}


def test_a_comparison_closes_a_contour_by_the_kerf_of_the_one_before_it(tmp_path: Path) -> None:
    done = made(tmp_path, grid(2, 1, apart=KERF_MM))
    drawing = done.drawn
    assert drawing is not None
    held = compare_program(done.program.toolpath, REACH_UM, drawing, FitRequest(2.0, fitted=False))
    assert held.max_um <= 0.01
    # The side that the second part has to itself lies 30 µm farther out, by what both of its other sides are longer.
    longer = done.program.text
    for way in ("GXL1", "GXL3"):
        longer = f"B8230B0B8230{way}".join(longer.rsplit(f"B8200B0B8200{way}", 1))
    wrong = load_program(longer.encode(), "wrong.3b").toolpath
    assert compare_program(wrong, REACH_UM, drawing, FitRequest(2.0, fitted=False)).max_um == pytest.approx(
        30.0, abs=0.1
    )


@pytest.mark.parametrize(
    ("making", "option"),
    [
        (COMMON._replace(passes_um=(150.0, 100.0)), "--pass"),
        (COMMON._replace(passes_um=(0.0,)), "--pass"),
        (COMMON._replace(tab_um=1000.0), "--tab"),
        (COMMON._replace(lag_um=20.0), "--lag"),
    ],
)
def test_what_does_not_go_with_one_kerf_is_refused(tmp_path: Path, making: Making, option: str) -> None:
    path = drawn(tmp_path, lambda space: [box.draw(space) for box in grid(2, 1, apart=KERF_MM)])
    with pytest.raises(CannotCutError) as raised:
        plan_of(path, making)
    assert raised.value.refusal.why == "common-with"
    assert dict(raised.value.refusal.values) == {"option": option}


def test_an_order_that_would_set_a_part_free_uncut_is_refused(tmp_path: Path) -> None:
    path = drawn(tmp_path, lambda space: [box.draw(space) for box in grid(3, 3)])
    amid = next(
        cut.figure.number
        for cut in plan_of(path, COMMON).cuts
        if cut.figure.contour.start_um.min() > 4e3 and cut.figure.contour.start_um.max() < 17e3
    )
    order = (*(number for number in range(1, 10) if number != amid), amid)
    with pytest.raises(CannotCutError) as raised:
        plan_of(path, COMMON._replace(order=order))
    assert raised.value.refusal.why == "common-falls"


def test_a_controller_that_adds_offsets_needs_leads(tmp_path: Path) -> None:
    path = drawn(tmp_path, lambda space: [box.draw(space) for box in grid(2, 1)])
    done = made_program(path, COMMON, Wanted("4b", keeps=True), plain_scenario())
    assert isinstance(done, NotMade)
    assert done.refusal.why == "kept-common"
