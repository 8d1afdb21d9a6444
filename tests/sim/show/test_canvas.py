"""What pictures are drawn on: areas, SVG that any reader takes, paints in both themes, and texts in both languages."""

import math
import re
import xml.etree.ElementTree as ET
from itertools import combinations, pairwise

import numpy as np
import pytest
import shapely
from everything import everything, square
from recorder import Recorder

from sim.show.draw.canvas import dashes_along
from sim.show.draw.chart import AxisRange, Chart, draw_band, draw_chart, draw_level, draw_line, range_of, tick_texts
from sim.show.draw.layout import Box
from sim.show.draw.raster import Raster
from sim.show.draw.sheet import drawing, pixels
from sim.show.draw.style import (
    DARK,
    LIGHT,
    THEMES,
    Paint,
    Theme,
)
from sim.show.draw.svg import MOST_PLACES, Svg

SVG = "{http://www.w3.org/2000/svg}"
STAR = [np.array([[50 + 45 * np.sin(turn), 50 - 45 * np.cos(turn)] for turn in np.arange(5) * 4 * np.pi / 5])]


@pytest.mark.parametrize(
    "rings",
    [
        pytest.param([square(10, 90), square(30, 70)], id="hole"),
        pytest.param([square(10, 90), square(30, 70), square(45, 55)], id="island"),
        pytest.param([square(5, 40), square(5, 40, 50)], id="two"),
        pytest.param([square(60, 140)], id="over the edge"),
        pytest.param(STAR, id="star"),
    ],
)
def test_a_region_leaves_out_its_holes(rings: list[np.ndarray]) -> None:
    canvas = Raster(100, 100)
    canvas.region(rings, Paint.PART)
    filled = (np.asarray(canvas.image()) == LIGHT[Paint.PART]).all(axis=2)
    y, x = np.mgrid[0:100, 0:100] + 0.5
    lines = shapely.union_all([shapely.LinearRing(ring) for ring in rings])
    inside = np.zeros((100, 100), dtype=int)
    for ring in rings:  # each ray to the right crosses the sides of a ring so often
        for (ax, ay), (bx, by) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            crosses = (ay > y) != (by > y)
            with np.errstate(divide="ignore", invalid="ignore"):
                inside += crosses & (x < ax + (y - ay) * (bx - ax) / (by - ay))
    clear = shapely.distance(shapely.points(x, y), lines) > 1.0  # on an edge, pixels are mixed
    assert (filled == (inside % 2 == 1))[clear].all()
    assert filled.any()


def test_a_region_outside_of_the_page_draws_nothing() -> None:
    canvas = Raster(50, 50)
    canvas.region([square(60, 90)], Paint.PART)
    assert np.asarray(canvas.image()).min() == 255


def test_svg_is_well_formed_whatever_is_written_and_names_every_paint() -> None:
    svg, recorder = Svg(160, 120), Recorder(160, 120)
    everything(svg)
    everything(recorder)
    root = ET.fromstring(svg.document('</svg><script>alert("1")', 320))  # noqa: S314 - our own
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("320", "240", "0 0 160 120")
    assert root.get("aria-label") == '</svg><script>alert("1")'
    assert [text.text for text in root.iter(f"{SVG}text")] == ['N1 <script>"&零件']
    classes = {name for element in root.iter() for name in (element.get("class") or "").split()}
    assert classes >= {f"f-{one.paint}" for one in recorder.drawn if one.what in ("disc", "region", "text", "box")}
    assert classes >= {f"s-{one.paint}" for one in recorder.drawn if one.what in ("polyline", "dashed", "ring")}
    assert not list(root.iter(f"{SVG}script"))


def test_svg_writes_figures_that_a_picture_needs_and_no_longer() -> None:
    svg = Svg(10, 10)
    svg.polyline(np.array([[1.0 / 3.0, -0.001], [1e3, 2.5]]), Paint.INK, 1.0)
    assert 'd="M0.33,0L1000,2.5"' in svg.fragment("x")


def test_large_pages_stay_within_memory() -> None:
    canvas = Raster(4961, 100)
    canvas.polyline(np.array([[0.0, 50.0], [4961.0, 50.0]]), Paint.INK, 10.0)
    image = canvas.image()
    assert image.size == (4961, 100)
    assert image.getpixel((2000, 50)) == LIGHT[Paint.INK]
    assert canvas._surface.get_size() == (9922, 200)  # twice as large, not three times


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES.keys())
def test_what_is_written_can_be_read(theme: Theme) -> None:
    assert set(theme) == set(Paint)
    written = (
        *(Paint.INK, Paint.GREY, Paint.JUMP, Paint.START, Paint.END, Paint.PAUSE, Paint.SIZE, Paint.ERROR),
        *(Paint.WARNING, Paint.CONTOUR, Paint.PART_EDGE, Paint.ACTUAL),
    )
    low = {paint: round(contrast(theme[paint], theme[Paint.PAGE]), 2) for paint in written}
    assert {paint: ratio for paint, ratio in low.items() if ratio < 3.5} == {}
    small = (Paint.INK, Paint.GREY, Paint.ERROR, Paint.WARNING, Paint.SIZE, Paint.PAUSE)
    assert {paint: low[paint] for paint in small if low[paint] < 4.5} == {}


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES.keys())
@pytest.mark.parametrize("eye", ["all", "protan", "deutan", "tritan"])
def test_areas_that_touch_can_be_told_apart_by_every_eye(theme: Theme, eye: str) -> None:
    touching = [Paint.PAGE, Paint.WORK, Paint.KERF, Paint.PART, Paint.SLUG]
    seen = {paint: lab(EYES[eye] @ linear(theme[paint])) for paint in touching}
    pairs = {pair: float(np.linalg.norm(seen[pair[0]] - seen[pair[1]])) for pair in combinations(touching, 2)}
    assert {pair: apart for pair, apart in pairs.items() if apart < 4.0} == {}, "difference of 2.3 is just seen"


EYES = {
    "all": np.eye(3),
    # G. Machado, M. Oliveira, L. Fernandes, IEEE Trans. Vis. Comput. Graph. 15 (2009) 1291, severity 1.0
    "protan": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deutan": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritan": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}


def linear(colour: tuple[int, int, int]) -> np.ndarray:
    share = np.array(colour) / 255.0
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)


def contrast(one: tuple[int, int, int], other: tuple[int, int, int]) -> float:
    """Of the Web Content Accessibility Guidelines 2.1."""
    light = sorted(float(linear(colour) @ [0.2126, 0.7152, 0.0722]) for colour in (one, other))
    return (light[1] + 0.05) / (light[0] + 0.05)


def lab(rgb: np.ndarray) -> np.ndarray:
    """CIE 1976 L*a*b* of linear sRGB under D65."""
    to_xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    share = to_xyz @ np.clip(rgb, 0.0, 1.0) / [0.9505, 1.0, 1.089]
    x, y, z = np.where(share > (6 / 29) ** 3, np.cbrt(share), share / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def test_a_chart_puts_values_where_its_scale_says() -> None:
    chart = Chart(Box(100.0, 50.0, 500.0, 250.0), AxisRange(-10.0, 10.0), AxisRange(0.0, 4.0), 1.0)
    canvas = Recorder(600, 300)
    draw_line(canvas, chart, np.array([[-10.0, 0.0], [0.0, 1.0], [np.nan, 2.0], [5.0, 4.0], [10.0, 2.0]]), Paint.X, 2.0)
    before, after = canvas.of("polyline", Paint.X)
    assert before.at.tolist() == [[100.0, 250.0], [300.0, 200.0]]
    assert after.at.tolist() == [[400.0, 50.0], [500.0, 150.0]]
    draw_band(canvas, chart, np.array([-10.0, 10.0]), np.array([[0.0, 1.0], [1.0, 2.0]]), Paint.BAND)
    assert canvas.of("region")[0].at[0].tolist() == [[100, 250], [500, 200], [500, 150], [100, 200]]
    draw_level(canvas, chart, 3.0, Paint.ERROR, 1.0)
    draw_level(canvas, chart, 5.0, Paint.ERROR, 1.0)
    assert [one.at[:, 1].tolist() for one in canvas.of("dashed")] == [[100.0, 100.0]]


def test_a_chart_writes_values_that_do_not_touch() -> None:
    canvas = Recorder(900, 400)
    draw_chart(canvas, Chart(Box(120.0, 20.0, 880.0, 360.0), AxisRange(0.0, 12345.6), AxisRange(-3e-3, 9e-3), 0.56))
    boxes = canvas.text_boxes()
    assert len(boxes) > 6
    assert not any(one.meets(other) for one, other in combinations(boxes, 2))


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-2.5e-4, 7e-4), (1e6, 3e6), (-7.0, -6.999)])
def test_values_of_a_scale_are_round_and_no_more_than_asked(low: float, high: float) -> None:
    for most in (2, 5, 9):
        values = tick_texts(AxisRange(low, high), most)
        assert 1 <= len(values) <= most + 1
        assert all(low <= value <= high for value, _ in values)
        assert len({text for _, text in values}) == len(values)


def test_a_range_holds_all_finite_values() -> None:
    assert range_of(np.array([1.0, np.nan, -2.0]), np.array([5.0])) == AxisRange(-2.0, 5.0)
    assert range_of(np.array([3.0, 3.0]), least=2.0) == AxisRange(2.0, 4.0)
    assert range_of(np.zeros(0), least=1.0) == AxisRange(-0.5, 0.5)


def test_both_kinds_of_sheet_speak_the_language_and_wear_the_theme() -> None:
    for sheet in (pixels(800, DARK, "zh"), drawing(800, DARK, "zh")):
        assert (sheet.page(300).width_px, sheet.page(300).height_px, sheet.unit) == (800, 300, 0.5)
        assert sheet.say("common.block", number=3) == "第 3 段"
    assert pixels(10, DARK).page(10).image().getpixel((5, 5)) == DARK[Paint.PAGE]
    assert 'fill="#16181c"' in drawing(10, DARK).page(10).fragment("x")


def test_strokes_alike_in_turn_are_one_path_below_what_comes_later() -> None:
    svg = Svg(10, 10)
    for x, paint in ((1.0, Paint.INK), (2.0, Paint.INK), (3.0, Paint.ERROR)):
        svg.polyline(np.array([[x, 0.0], [x, 9.0]]), paint, 1.0)
    svg.disc(np.array([5.0, 5.0]), 1.0, Paint.INK)
    svg.polyline(np.array([[4.0, 0.0], [4.0, 9.0]]), Paint.ERROR, 1.0)
    drawn = re.findall(r'<(?:path d="([^"]*)"|(circle))', svg.fragment("x"))
    assert drawn == [("M1,0L1,9M2,0L2,9", ""), ("M3,0L3,9", ""), ("", "circle"), ("M4,0L4,9", "")]


@pytest.mark.deeper
def test_a_line_of_very_many_places_is_drawn_by_fewer_near_it() -> None:
    x = np.linspace(0.0, 1500.0, 200_000)
    line = np.column_stack([x, 400.0 + 300.0 * np.sin(x / 90.0) + np.where(np.arange(len(x)) % 2, 0.12, -0.12)])
    svg = Svg(1600, 800)
    svg.polyline(line, Paint.INK, 1.0)
    text = svg.fragment("x")
    (data,) = re.findall(r'<path d="M([^"]*)"', text)
    drawn = np.array([place.split(",") for place in data.split("L")], dtype=float)
    assert 100 < len(drawn) <= MOST_PLACES
    assert len(text) < 100_000  # characters; 3 MB with all places
    apart = shapely.LineString(drawn).distance(shapely.points(line[::50]))
    assert apart.max() < 1.7  # px, with rounded figures


@pytest.mark.deeper
def test_a_line_that_needs_very_many_places_keeps_them() -> None:
    at = np.arange(9000)
    hatch = np.column_stack([at / 6.0, np.where(at % 2, 700.0, 100.0)])
    svg = Svg(1600, 800)
    svg.polyline(hatch, Paint.INK, 1.0)
    (data,) = re.findall(r'<path d="M([^"]*)"', svg.fragment("x"))
    drawn = np.array([place.split(",") for place in data.split("L")], dtype=float)
    assert shapely.hausdorff_distance(shapely.LineString(drawn), shapely.LineString(hatch)) < 1.1  # px
    assert len(drawn) > MOST_PLACES


def test_dashes_along_a_curve_do_not_begin_anew_at_its_corners() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    ring = 100.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    made = [*dashes_along(ring, 9.0, 5.0)]
    lengths = [float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in made]
    assert len(made) == math.ceil(200.0 * math.pi / 14.0)
    assert lengths[:-1] == pytest.approx([9.0] * (len(made) - 1), abs=0.01)
    between = [float(np.hypot(*(after[0] - this[-1]))) for this, after in pairwise(made)]
    assert between == pytest.approx([5.0] * (len(made) - 1), abs=0.01)
    assert not [*dashes_along(ring[:1], 9.0, 5.0)]
