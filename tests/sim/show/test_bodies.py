"""Workpiece and clamps in the picture of a cut: where they lie, what of them shows, and that they hide nothing."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image, ImageChops

from parser.geometry.curves import Floats
from parser.program import parse_program
from sim.setup.obstacles import Outline, read_outline
from sim.show.draw import style
from sim.show.draw.layout import Box
from sim.show.draw.sheet import pixels
from sim.show.draw.style import LIGHT, Paint
from sim.show.pictures.cut.picture import draw_cut, layout_of
from sim.show.pictures.cut.subject import NOTHING, Bodies, Cut, _hatching, _within

SQUARE = "B10000B0B10000GXL1 B0B10000B10000GYL2 B10000B0B10000GXL3 B0B10000B10000GYL4 DD"
TOOLPATH = parse_program(SQUARE).toolpath
KERF_UM = 200.0


def box(left: float, bottom: float, right: float, top: float) -> Outline:
    corners = ((left, bottom), (right, bottom), (right, top), (left, top))
    return read_outline({"outline_mm": [[x, y] for x, y in corners]}, "test")


def cut(bodies: Bodies) -> Cut:
    return Cut(TOOLPATH, KERF_UM, "x", bodies=bodies)


def picture(bodies: Bodies = NOTHING) -> Image.Image:
    return draw_cut(pixels(800), cut(bodies)).image()


def colour_at(drawn: Image.Image, bodies: Bodies, x_mm: float, y_mm: float) -> tuple[int, int, int]:
    """The usual colour round a place, hatching and grid aside."""
    x, y = layout_of(pixels(800), cut(bodies)).page.view.to_px(np.array([x_mm, y_mm]) * 1000.0)
    about = np.asarray(drawn)[round(y) - 8 : round(y) + 8, round(x) - 8 : round(x) + 8].reshape(-1, 3)
    colours, counts = np.unique(about, axis=0, return_counts=True)
    return tuple(colours[counts.argmax()].tolist())


def test_work_and_clamps_lie_where_they_are() -> None:
    bodies = Bodies(box(-1, -1, 9, 9), (box(5, 3, 7, 5),))
    drawn = picture(bodies)
    assert colour_at(drawn, bodies, 3, 4) == LIGHT[Paint.WORK]
    assert colour_at(drawn, bodies, 6, 4) == LIGHT[Paint.CLAMP]
    assert colour_at(drawn, bodies, 9.5, 9.5) == LIGHT[Paint.PAGE]


def test_the_kerf_is_drawn_over_a_clamp() -> None:
    over = picture(Bodies(None, (box(-0.1, -0.1, 10.1, 10.1),)))  # as large as the path, so drawn to the same scale
    kerf, alone = ((np.asarray(drawn) == LIGHT[Paint.KERF]).all(axis=2).sum() for drawn in (over, picture()))
    assert alone > 10_000
    assert kerf == alone


def test_the_frame_takes_in_what_is_near_and_nothing_far() -> None:
    path = np.array([[0.0, 0.0], [10_000.0, 10_000.0]])
    reach = style.BODIES_NEAR * 10_000.0
    assert Bodies(None, (box(10.5, 2, 11, 3),)).around(path).tolist() == [[0, 0], [11_000, 10_000]]
    assert Bodies(None, (box(10.5, 2, 900, 3),)).around(path).tolist() == [[0, 0], [10_000 + reach, 10_000]]
    assert Bodies(box(-900, -900, 900, 900)).around(path).tolist() == [[-reach, -reach], [10_000 + reach] * 2]
    assert Bodies(None, (box(50, 2, 60, 3),)).around(path).tolist() == path.tolist()


def test_what_is_far_changes_no_pixel() -> None:
    far = Bodies(None, (box(1000, 1000, 1100, 1100),))
    assert ImageChops.difference(picture(), picture(far)).getbbox() is None


def test_bodies_stay_inside_the_frame_and_leave_it_whole() -> None:
    bodies = Bodies(box(-1e5, -1e5, 1e5, 1e5), (box(-1e5, 4, 1e5, 6),))
    drawn = np.asarray(picture(bodies))
    plot = layout_of(pixels(800), cut(bodies)).page.plot
    top, left = round(plot.top), round(plot.left)
    assert not (drawn[: top - 1] == LIGHT[Paint.WORK]).all(axis=2).any()
    assert not (drawn[:, : left - 1] == LIGHT[Paint.WORK]).all(axis=2)[: round(plot.bottom)].any()
    assert (drawn[top : round(plot.bottom), left, :] < 220).all()  # the frame's left side, from end to end


@pytest.mark.parametrize(
    ("bodies", "colours"),
    [
        (Bodies(), set()),
        (Bodies(box(-1, -1, 11, 11)), {LIGHT[Paint.WORK]}),
        (Bodies(None, (box(1, 1, 2, 2),)), {LIGHT[Paint.CLAMP]}),
        (Bodies(box(-1, -1, 11, 11), (box(1, 1, 2, 2),)), {LIGHT[Paint.WORK], LIGHT[Paint.CLAMP]}),
    ],
)
def test_the_legend_has_a_sample_of_what_shows(bodies: Bodies, colours: set[Paint]) -> None:
    below = np.asarray(picture(bodies))[-70:].reshape(-1, 3)
    assert {
        colour for colour in (LIGHT[Paint.WORK], LIGHT[Paint.CLAMP]) if (below == colour).all(axis=1).sum() > 100
    } == colours


# Geometry


@st.composite
def polygons(draw: st.DrawFn) -> Floats:
    """Stars round the middle of a plot of 400 × 300 px."""
    corners = draw(st.integers(3, 12))
    radii = np.array(draw(st.lists(st.integers(20, 600), min_size=corners, max_size=corners)))
    angle = math.radians(draw(st.integers(0, 360))) + 2.0 * np.pi * np.arange(corners) / corners
    middle = np.array([draw(st.integers(0, 400)), draw(st.integers(0, 300))])
    return middle + radii[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def inside(polygon: Floats, places: Floats) -> np.ndarray:
    """Whether places (m, 2) lie in a polygon (n, 2): by a ray to the right, side by side."""
    odd = np.zeros(len(places), dtype=np.bool_)
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        between = (start[1] > places[:, 1]) != (end[1] > places[:, 1])
        rise = end[1] - start[1] or 1.0
        odd ^= between & (places[:, 0] < start[0] + (places[:, 1] - start[1]) / rise * (end[0] - start[0]))
    return odd


@given(polygons())
def test_hatching_fills_its_polygon_and_no_more(polygon: Floats) -> None:
    lines = _hatching(polygon, 10.0)
    assert np.allclose(np.diff(lines.sum(axis=2), axis=1), 0.0, atol=1e-6)  # at 45°
    long = np.hypot(*(lines[:, 1] - lines[:, 0]).T) > 1e-3
    assert inside(polygon, lines[long].mean(axis=1)).all()
    # Lines 10 px apart, so their length is a tenth of the area, but for a line's worth at every turn of the outline.
    x, y = polygon.T
    area = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0
    length = np.hypot(*(lines[:, 1] - lines[:, 0]).T).sum()
    assert length == pytest.approx(area / 10.0, abs=len(polygon) * 600.0 * 2.0)


@given(polygons())
def test_cutting_to_the_plot_keeps_what_is_in_it(polygon: Floats) -> None:
    cut = _within(polygon, Box(0.0, 0.0, 400.0, 300.0))
    grid = np.stack(np.meshgrid(np.arange(0.37, 400.0, 13.0), np.arange(0.41, 300.0, 11.0)), axis=-1).reshape(-1, 2)
    assert (inside(polygon, grid) == (inside(cut, grid) if len(cut) else False)).all()
    assert len(cut) == 0 or (cut.min(axis=0) >= -20.0 - 1e-6).all()
    assert len(cut) == 0 or (cut.max(axis=0) <= np.array([420.0, 320.0]) + 1e-6).all()
