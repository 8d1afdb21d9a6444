"""Closed loops without width are no contours: they are left out, named, beside what is one."""

import math
import random

import numpy as np
import pytest
import shapely
from drawings_dxf import drawn
from drawn_loops import Piece, circle, drawing_of, polygon, square
from ezdxf.layouts import Modelspace

from parser.drawing.read import read_drawing
from parser.findings.catalogue import remark_text

EIGHT = polygon([(0, 0), (20, 10), (20, 0), (0, 10)])


@pytest.mark.parametrize(
    ("entity", "why"),
    [
        (polygon([(0, 0), (20, 0.0004), (40, 0), (20, -0.0004)]), "no-width"),
        (polygon([(0, 0), (20, 20.0004), (40, 40), (20, 19.9996)]), "no-width"),
        (polygon([(0, 0), (20, 0.002), (40, 0), (20, -0.002)]), None),
        (circle(10, 10, 0.004), "dot"),
        (circle(10, 10, 0.006), None),
        (EIGHT, None),  # encloses as much on the left as on the right
        ([Piece((0, 0), (5, 0)), Piece((5, 0), (0, 0), (2.5, 0), math.pi)], None),
    ],
)
def test_what_has_no_width_is_left_out(entity: list[Piece], why: str | None) -> None:
    drawing = drawing_of([square(-50, -50, 200), entity])
    assert [one.why for one in drawing.left_out] == ([why] if why else [])
    assert len(drawing.loops) == 2 - bool(why)
    assert sorted(np.concatenate([loop.row for loop in drawing.loops])) == list(range(len(drawing.curves)))
    assert len(drawing.entity) == len(drawing.curves)
    assert {int(at) for at in drawing.entity} == set(range(len(drawing.entities)))


def test_a_drawing_of_nothing_else_keeps_it() -> None:
    drawing = drawing_of([circle(10, 10, 0.004)])
    assert (len(drawing.loops), drawing.left_out) == (1, ())


@pytest.mark.deeper
def test_widths_are_those_of_the_narrowest_rectangle_that_shapely_finds() -> None:
    rng = random.Random(5)
    for _ in range(300):
        width, turn = 10.0 ** rng.uniform(-5.0, -1.0), rng.uniform(0.0, 2.0 * math.pi)
        corners = sorted(rng.uniform(0.0, 30.0) for _ in range(rng.randint(3, 6)))
        chain = [(x, rng.uniform(0.0, width)) for x in corners]
        chain += [(x, y + width * rng.random()) for x, y in reversed(chain[1:-1])]
        turned = [(x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)) for x, y in chain]
        box = shapely.minimum_rotated_rectangle(shapely.MultiPoint(turned))
        x, y = np.diff(shapely.get_coordinates(box), axis=0).T
        narrow_um = 1e3 * min(np.hypot(x, y)) if len(x) > 1 else 0.0
        if 0.7 < narrow_um < 1.3:  # the direction is that of least squares
            continue
        left = drawing_of([square(-90, -90, 400), polygon(turned)]).left_out
        assert [one.why for one in left if one.why == "no-width"] == ["no-width"] * int(narrow_um <= 1.0), chain


def test_an_ellipse_without_width_changes_nothing_else_of_a_drawing(tmp_path) -> None:
    def plain(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (20, 0), (20, 10), (0, 10)], close=True)

    def with_ellipses(space: Modelspace) -> None:
        space.add_ellipse((10, 5), major_axis=(5, 0), ratio=1e-6)
        plain(space)
        space.add_ellipse((10, 5), major_axis=(0.004, 0), ratio=0.5)

    (tmp_path / "a").mkdir()
    one, other = read_drawing(drawn(tmp_path / "a", plain)), read_drawing(drawn(tmp_path, with_ellipses))
    np.testing.assert_array_equal(one.curves.start_um, other.curves.start_um)
    assert [loop.row.tolist() for loop in one.loops] == [loop.row.tolist() for loop in other.loops]
    assert [(left.entity.kind, left.why) for left in other.left_out] == [("ELLIPSE", "no-width"), ("ELLIPSE", "dot")]
    assert [remark_text(note) for note in other.notes] == [
        "1 of the contours left out: lines there and back, without width",
        "1 of the contours left out: no wider than 0.01 mm",
    ]
