"""IGES files are read as the standard has them: lines, arcs and circles exactly, others as the curves that they are."""

import math
import random
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from iges_files import Entity, iges, line, number_of
from runs import plain_scenario

from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from parser.findings.errors import DrawingError
from parser.geometry.along import places
from sim.make.cam.maker import MadeProgram, made_program
from sim.make.wanted import Wanted
from sim.setup.making import Making

HALF = math.sqrt(0.5)
SQUARE = [
    Entity(110, line(0.0, 0.0, 40.0, 0.0)),
    Entity(110, line(40.0, 0.0, 40.0, 20.0)),
    Entity(106, (1, 3, 0.0, 40.0, 20.0, 0.0, 20.0, 0.0, 0.0), form=11),
]
QUARTERS = (4, 2, 0, 1, 0, 0, 0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0)


def read(folder: Path, data: bytes) -> Drawing:
    path = folder / "part.igs"
    path.write_bytes(data)
    return read_drawing(path)


def lengths_mm(drawing: Drawing) -> list[float]:
    """Lengths of closed loops, mm, the shortest first."""
    return sorted(float(drawing.curves.length_um[loop.row].sum()) / 1000.0 for loop in drawing.loops if loop.closed)


@pytest.mark.parametrize("delimiters", [(",", ";"), ("|", "$")])
@pytest.mark.parametrize(
    ("unit", "um"), [("2,2HMM", 1000.0), ("1,4HINCH", 25400.0), ("3,2HCM", 10000.0), ("8,3HMIL", 25.4)]
)
def test_lines_and_circles_are_where_the_file_has_them(
    tmp_path: Path, unit: str, um: float, delimiters: tuple[str, str]
) -> None:
    circle = Entity(100, (0.0, 10.0, 8.0, 15.0, 8.0, 15.0, 8.0), level=3, color=2)
    drawing = read(tmp_path, iges([*SQUARE, circle], unit, delimiters))
    row = int(np.flatnonzero(drawing.curves.is_arc)[0])
    np.testing.assert_allclose(drawing.curves.center_um[row], [10.0 * um, 8.0 * um], rtol=1e-9)
    assert drawing.curves.radius_um[row] == pytest.approx(5.0 * um, rel=1e-9)
    assert lengths_mm(drawing) == pytest.approx([10.0 * math.pi * um / 1000.0, 120.0 * um / 1000.0], rel=1e-9)
    assert {entity.layer for entity in drawing.entities} == {"LEVEL 1", "LEVEL 3"}
    assert [entity.color for entity in drawing.entities if entity.kind == "CIRCLE"] == [1]
    assert drawing.version == "IGES"


@pytest.mark.parametrize("is_mirrored", [False, True])
def test_arcs_lie_in_their_frames_and_these_in_others(tmp_path: Path, is_mirrored: bool) -> None:
    """The left half of a circle, turned by 90° and moved, in a frame that is moved, or turned over, too."""
    over = -1.0 if is_mirrored else 1.0
    entities = [
        Entity(100, (0.0, 0.0, 0.0, 0.0, 5.0, 0.0, -5.0), transform=number_of(1)),
        Entity(124, (0.0, -1.0, 0.0, 20.0, 1.0, 0.0, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0), transform=number_of(2)),
        Entity(124, (1.0, 0.0, 0.0, 1.0, 0.0, over, 0.0, 2.0, 0.0, 0.0, over, 0.0)),
        Entity(110, line(16.0, 2.0 + 10.0 * over, 26.0, 2.0 + 10.0 * over)),
    ]
    drawing = read(tmp_path, iges(entities))
    assert lengths_mm(drawing) == pytest.approx([10.0 + 5.0 * math.pi], rel=1e-9)
    row = np.flatnonzero(drawing.curves.is_arc)
    middle = places(drawing.curves, row[:1], np.full(1, 0.5 if len(row) == 1 else 1.0))[0]
    np.testing.assert_allclose(middle, [21_000.0, 1000.0 * (2.0 + 5.0 * over)], atol=1e-6)


def test_a_rational_spline_is_the_half_circle_that_it_stands_for(tmp_path: Path) -> None:
    """A half circle of R 10 in two quarters, as every handbook of NURBS has it, closed by a line."""
    weights = (1.0, HALF, 1.0, HALF, 1.0)
    places = (10.0, 0.0, 0.0, 10.0, 10.0, 0.0, 0.0, 10.0, 0.0, -10.0, 10.0, 0.0, -10.0, 0.0, 0.0)
    spline = Entity(126, (*QUARTERS, *weights, *places, 0.0, 1.0, 0.0, 0.0, 1.0))
    drawing = read(tmp_path, iges([spline, Entity(110, line(-10.0, 0.0, 10.0, 0.0))]))
    assert lengths_mm(drawing) == pytest.approx([20.0 + 10.0 * math.pi], abs=1e-3)
    ends = drawing.curves.end_um[drawing.curves.end_um[:, 1] > 1.0]
    assert np.abs(np.hypot(*ends.T) - 10_000.0).max() < 0.2  # lines lie 0.1 µm off the spline at most


def test_cubics_and_ellipses_are_the_curves_that_they_say(tmp_path: Path) -> None:
    """A parabola y = x² / 10 up to 10 mm, and a quarter of an ellipse of 8 and 4 mm, each closed by lines."""
    cubic = (3, 1, 2, 1, 0.0, 10.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0)
    ellipse = (1 / 64.0, 0.0, 1 / 16.0, 0.0, 0.0, -1.0, 0.0, 8.0, 0.0, 0.0, 4.0)
    entities = [
        Entity(112, cubic),
        Entity(106, (1, 3, 0.0, 10.0, 10.0, 0.0, 10.0, 0.0, 0.0), form=11),
        Entity(104, ellipse, form=1, transform=number_of(4)),
        Entity(106, (2, 3, 28.0, 0.0, 0.0, 20.0, 0.0, 0.0, 20.0, 4.0, 0.0), form=12),
        Entity(124, (1.0, 0.0, 0.0, 20.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)),
    ]
    drawing = read(tmp_path, iges(entities))
    parabola = 0.5 * (10.0 * math.sqrt(5.0) + 5.0 * math.asinh(2.0))
    quarter = 9.68844822  # its perimeter is 38.7537929 mm (Gauss–Kummer)
    assert lengths_mm(drawing) == pytest.approx(sorted([20.0 + parabola, 12.0 + quarter]), abs=1e-3)


def test_composites_and_subfigures_are_drawn_where_they_are_placed(tmp_path: Path) -> None:
    dependent = "00010000"
    entities = [
        Entity(102, (2, number_of(1), number_of(2))),
        Entity(110, line(0.0, 0.0, 9.0, 0.0), status=dependent),
        Entity(106, (1, 3, 0.0, 9.0, 0.0, 0.0, 9.0, 0.0, 0.0), form=11, status=dependent),
        Entity(308, (0, "4HHOLE", 1, number_of(4))),
        Entity(100, (0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0), status=dependent),
        Entity(408, (number_of(3), 20.0, 0.0, 0.0, 1.0)),
        Entity(408, (number_of(3), 30.0, 5.0, 0.0, 2.0)),
    ]
    drawing = read(tmp_path, iges(entities))
    expected = [2.0 * math.pi, 4.0 * math.pi, 18.0 + 9.0 * math.sqrt(2.0)]
    assert lengths_mm(drawing) == pytest.approx(expected, rel=1e-9)
    circles = drawing.curves.is_arc
    assert sorted(map(tuple, drawing.curves.center_um[circles].round(6).tolist())) == [
        (20000.0, 0.0),
        (30000.0, 5000.0),
    ]


def test_what_is_hidden_noted_tilted_or_unknown_is_told_and_not_read(tmp_path: Path) -> None:
    tilted = (1.0, 0.0, 0.0, 0.0, 0.0, HALF, -HALF, 0.0, 0.0, HALF, HALF, 0.0)
    entities = [
        *SQUARE,
        Entity(110, line(1.0, 1.0, 2.0, 1.0), status="01000000"),
        Entity(212, (1, 4, 3.0, 1.0, 1, 1.5, 0.0, 0, 0, 1.0, 1.0, 0.0, "4HTEXT")),
        Entity(110, (0.0, 0.0, 0.0, 5.0, 5.0, 5.0)),
        Entity(100, (0.0, 5.0, 5.0, 7.0, 5.0, 7.0, 5.0), transform=number_of(7)),
        Entity(124, tilted),
        Entity(128, (1, 1)),
    ]
    drawing = read(tmp_path, iges(entities))
    assert lengths_mm(drawing) == pytest.approx([120.0])
    (note,) = [note for note in drawing.notes if note.name == "iges-passed-over"]
    assert note.values == {"entities": "1 × entity 100, 1 × entity 110, 1 × hidden, 1 × note, 1 × surface"}


def test_heights_that_differ_by_rounding_alone_are_one_plane(tmp_path: Path) -> None:
    """CAD systems write a plane's z as 1E-7 or 0, as their arithmetic has it."""
    corners = [(0.0, 0.0), (30.0, 0.0), (30.0, 30.0), (0.0, 30.0)]
    sides = zip(corners, [*corners[1:], corners[0]], strict=True)
    lines = [Entity(110, (*start, 0.0, *end, 1e-7)) for start, end in sides]
    drawing = read(tmp_path, iges(lines))
    assert lengths_mm(drawing) == pytest.approx([120.0])
    assert not drawing.notes


def test_centre_lines_are_left_out_and_an_unknown_unit_is_told(tmp_path: Path) -> None:
    drawing = read(tmp_path, iges([*SQUARE, Entity(110, line(-5.0, 10.0, 45.0, 10.0), font=4)], "3,4HWIRE"))
    assert [left.why for left in drawing.left_out] == ["broken-line"]
    assert "no-iges-unit" in [note.name for note in drawing.notes]


def test_a_program_is_made_of_an_iges_file(tmp_path: Path) -> None:
    path = tmp_path / "part.igs"
    path.write_bytes(iges([*SQUARE, Entity(100, (0.0, 10.0, 10.0, 15.0, 10.0, 15.0, 10.0))]))
    done = made_program(path, Making(), Wanted("3b"), plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved
    assert [cut.figure.kind for cut in done.plan.cuts] == ["hole", "outline"]


def test_figures_that_place_each_other_without_end_are_refused(tmp_path: Path) -> None:
    entities = [Entity(102, (2, number_of(0), number_of(0)))]
    with pytest.raises(DrawingError):
        read(tmp_path, iges(entities))


def test_damaged_files_are_refused_or_read_and_nothing_else(tmp_path: Path) -> None:
    rng = random.Random("iges")
    whole = iges([*SQUARE, Entity(100, (0.0, 10.0, 10.0, 15.0, 10.0, 15.0, 10.0)), Entity(408, (1, 0.0, 0.0, 0.0))])
    for _ in range(200):
        data = bytearray(whole)
        for _ in range(rng.randrange(1, 8)):
            at = rng.randrange(80, len(data))
            data[at : at + rng.randrange(0, 3)] = bytes(
                rng.choice(b" 0123456789-.,;HDPG\n\xff") for _ in range(rng.randrange(3))
            )
        with suppress(DrawingError):
            read(tmp_path, bytes(data))
