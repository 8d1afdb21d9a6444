"""The picture of a cut, against a golden picture, against its own geometry, and at the edges."""

import os
import subprocess
import sys
import time
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pygame
import pytest
from golden_pictures import assert_golden, compare
from PIL import Image

from parser.geometry.curves import CurveKind
from parser.program import parse_program
from parser.toolpath import Toolpath
from sim.show.draw import style
from sim.show.draw.flatten import along, bounds_um, flatten, simplify
from sim.show.draw.layout import (
    Anchors,
    Box,
    Ink,
    Room,
    mm_text,
    nice_below,
    number_stride,
    page_for,
    place_numbers,
    ticks,
)
from sim.show.draw.legend import elide
from sim.show.draw.letters import text_width
from sim.show.draw.raster import Raster
from sim.show.draw.sheet import pixels
from sim.show.draw.style import LIGHT, Paint
from sim.show.pictures.cut.picture import draw_cut
from sim.show.pictures.cut.subject import Cut
from sim.table.trace import Trace

PART = """
B0 B5000 B5000 GY L2
B10000 B0 B10000 GX L1
B0 B8000 B16000 GX NR4
B30000 B0 B30000 GX L3
B0 B16000 B16000 GY L4
B20000 B0 B20000 GX L1
B0 B5000 B5000 GY L4
B0 B30000 B30000 GY L4
B0 B4000 B16000 GX SR1
DD
"""


def read(text: str) -> Toolpath:
    return parse_program(text).toolpath


def with_jump(toolpath: Toolpath, row: int) -> Toolpath:
    kind = toolpath.kind.copy()
    kind[row] = CurveKind.JUMP
    return replace(toolpath, kind=kind)


def lines(steps: np.ndarray) -> Toolpath:
    """Program of lines by these steps, (n, 2) int64 µm."""
    return read("\n".join(line(int(x), int(y)) for x, y in steps))


def line(x: int, y: int) -> str:
    quadrant = {(True, True): 1, (False, True): 2, (False, False): 3, (True, False): 4}[x >= 0, y >= 0]
    axis = "X" if abs(x) >= abs(y) else "Y"
    return f"B{abs(x)} B{abs(y)} B{max(abs(x), abs(y))} G{axis} L{quadrant}"


def spiral(blocks: int) -> Toolpath:
    angle = np.linspace(0, 40 * np.pi, blocks + 1)
    points = np.stack([np.cos(angle), np.sin(angle)], axis=1) * angle[:, None] * 800
    return lines(np.diff(np.rint(points).astype(np.int64), axis=0))


def drawn(toolpath: Toolpath, kerf_um: float = 200.0, *, width_px: int = 1600, **more: object) -> Image.Image:
    return draw_cut(pixels(width_px), Cut(toolpath, kerf_um, **{"title": "x", **more})).image()


def part_picture(text: str = PART, kerf_um: float = 200.0) -> Image.Image:
    return drawn(with_jump(read(text), 7), kerf_um, width_px=600, title="零件 1.3B", note="9 blocks")


def test_golden() -> None:
    assert_golden(part_picture(), "cut.png")


@pytest.mark.parametrize(
    "changed",
    [
        pytest.param(lambda: part_picture(PART.replace("B0 B5000 B5000 GY L2", "B100 B5000 B5000 GY L2")), id="0.1 mm"),
        pytest.param(lambda: part_picture(PART.replace("SR1", "NR2")), id="other way round"),
        pytest.param(lambda: part_picture(kerf_um=300.0), id="kerf"),
    ],
)
def test_comparison_can_fail(changed, tmp_path: Path) -> None:
    assert compare(changed(), "cut.png", tmp_path) != ""
    assert {p.stem for p in tmp_path.iterdir()} == {"cut-actual", "cut-expected", "cut-difference"}


def test_same_input_same_pixels() -> None:
    assert part_picture().tobytes() == part_picture().tobytes()


def test_needs_no_display_and_prints_nothing() -> None:
    code = (
        "from parser.program import parse_program as p; from sim.show.pictures.cut.picture import draw_cut;"
        "from sim.show.draw.sheet import pixels; from sim.show.pictures.cut.subject import Cut;"
        "draw_cut(pixels(600), Cut(p('B1000B0B1000GXL1').toolpath, 200.0, 'x')).image();"
        "import pygame; assert not pygame.display.get_init()"
    )
    env = {**os.environ, "SDL_VIDEODRIVER": "none such"}
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], env=env, capture_output=True, text=True, check=False
    )
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")


def near(picture: Image.Image, colour: Paint, most: int = 40) -> np.ndarray:
    """(height, width) True where a pixel has about this colour."""
    return (np.abs(np.asarray(picture).astype(int) - colour).max(axis=2) <= most)[
        : -int(style.FOOT * picture.width / 1600)
    ]


def extent(mask: np.ndarray, axis: int) -> tuple[int, int]:
    """First and one past the last row (0) or column (1) with a mark."""
    hit = np.flatnonzero(mask.any(axis=1 - axis))
    return int(hit[0]), int(hit[-1]) + 1


@pytest.mark.alike(1)
@pytest.mark.parametrize(("direction", "along_axis"), [((20000, 0), 1), ((0, 20000), 0)])
def test_kerf_is_to_scale(direction: tuple[int, int], along_axis: int) -> None:
    picture = drawn(lines(np.array([direction])), 1500.0)
    band = near(picture, LIGHT[Paint.KERF])
    first, last = extent(band, along_axis)
    at = first + (last - first) // 4  # a cut through the band away from marks and the number
    across = np.flatnonzero(band[:, at] if along_axis == 1 else band[at])
    # The band is one kerf longer than the line, for its round ends.
    assert across[-1] + 1 - across[0] == pytest.approx((last - first) * 1.5 / 21.5, abs=1.2)


@pytest.mark.parametrize("width", [1.0, 2.0, 4.0, 6.0, 25.0])
def test_strokes_are_as_wide_in_every_direction(width: float) -> None:
    y, x = np.mgrid[0:200, 0:200] - 100.0
    for angle in np.radians(np.arange(0, 360, 7)):
        ahead = np.array([np.cos(angle), np.sin(angle)])
        canvas = Raster(200, 200, {**LIGHT, Paint.INK: (0, 0, 0)})
        canvas.polyline(np.array([100 - 60 * ahead, 100 + 60 * ahead]), Paint.INK, width)
        dark = 1 - np.asarray(canvas.image().convert("L")) / 255.0
        middle = np.abs(x * ahead[0] + y * ahead[1]) < 40
        assert dark[middle].sum() / 80 == pytest.approx(width, abs=0.4)


def test_kerf_follows_the_wire() -> None:
    toolpath = lines(np.array([(20000, 0)]))
    x = np.arange(0.0, 20001.0, 5.0)
    where = np.stack([x, np.full_like(x, 4000.0)], axis=1)
    trace = Trace(x / 100, where, where, where, np.zeros(len(x), dtype=np.int64))
    picture = drawn(toolpath, 1000.0, trace=trace)
    band, ideal = extent(near(picture, LIGHT[Paint.KERF]), 0), extent(near(picture, LIGHT[Paint.IDEAL])[150:], 0)
    assert band[1] < ideal[0] + 150


def test_no_kerf_along_a_jump() -> None:
    steps = np.array([(10000, 0), (30000, 0), (10000, 0)])
    picture = drawn(with_jump(lines(steps), 1), 1000.0)
    columns = near(picture, LIGHT[Paint.KERF]).any(axis=0)
    first, last = extent(columns[None], 1)
    middle = slice(first + (last - first) // 3, first + 2 * (last - first) // 3)
    assert not columns[middle].any()
    assert near(picture, LIGHT[Paint.JUMP])[:, middle].any()


def test_start_and_end_show_in_one_place() -> None:
    picture = drawn(read("B5000B0B20000GYNR1"))
    start, end = near(picture, LIGHT[Paint.START], 12), near(picture, LIGHT[Paint.END], 12)
    assert start.sum() > 100
    assert end.sum() > 100
    assert extent(end, 0)[0] < extent(start, 0)[0]


@pytest.mark.alike(4)
@pytest.mark.parametrize("seed", range(20))
def test_block_numbers_never_overlap(seed: int) -> None:
    rng = np.random.default_rng(seed)
    blocks = int(rng.integers(1, 300))
    area = Box(50, 50, 900, 700)
    heading = rng.uniform(0, 2 * np.pi, blocks)
    normals = np.stack([np.cos(heading), np.sin(heading)], axis=1)
    anchors = [Anchors(rng.uniform(60, 600, (blocks, 2)), normals) for _ in range(3)]
    sizes = rng.uniform(10, 60, (blocks, 2))
    taken = [Box(300, 300, 340, 340), Box(100, 100, 600, 120)]
    ink = Ink([rng.uniform(60, 600, (50, 2))], 950, 750)
    places = place_numbers(
        anchors,
        sizes,
        5.0,
        Room(area, ink, taken),
    )
    boxes = [box for box in places if box]
    assert boxes
    assert all(area.holds(box) for box in boxes)
    assert not any(a.meets(b) for a, b in combinations([*boxes, *taken], 2))


def test_numbers_keep_off_the_path_where_they_can() -> None:
    run = np.array([[100.0, 100.0], [500.0, 100.0], [500.0, 108.0], [100.0, 108.0]])
    ink = Ink([run], 600, 300)
    anchor = [Anchors(np.array([[300.0, 100.0]]), np.array([[0.0, 1.0]]))]
    (place,) = place_numbers(anchor, np.array([[20.0, 20.0]]), 5.0, Room(Box(0, 0, 600, 300), ink, []))
    assert place is not None
    assert ink.within(place) == 0
    assert place.bottom <= 96


@pytest.mark.parametrize(("blocks", "stride"), [(1, 1), (80, 1), (81, 2), (5000, 100), (100_000, 2000)])
def test_number_stride(blocks: int, stride: int) -> None:
    assert number_stride(blocks) == stride


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("B0B0B0GXL1", id="no length"),
        pytest.param("B50000B0B50000GXL1", id="horizontal"),
        pytest.param("B0B50000B50000GYL2", id="vertical"),
        pytest.param("B2B0B2GXL1", id="2 µm"),
        pytest.param("B1000000B0B1000000GXL1", id="1 m"),
        pytest.param("B2000B0B2000000000GYNR1", id="millions of turns"),
    ],
)
@pytest.mark.parametrize("kerf_um", [0.0, 200.0])
def test_odd_programs_draw(text: str, kerf_um: float) -> None:
    picture = drawn(read(text), kerf_um, width_px=700)
    assert picture.size[0] == 700
    assert 350 <= picture.size[1] <= 700
    assert near(picture, LIGHT[Paint.START], 60).any()


def test_long_chinese_title_and_full_legend_stay_inside() -> None:
    title, note = "冲裁凹模固定板" * 40 + ".3B", "超差 " * 90
    picture = drawn(spiral(5000), width_px=600, title=title, note=note)
    border = np.asarray(picture.convert("L")).copy()
    assert border[5:60].min() < 100
    border[10:-5, 10:-10] = 255
    assert border.min() == 255


def test_elided_title_keeps_both_ends_and_fits() -> None:
    short = elide("零件" * 100 + ".3B", 30.0, 300.0)
    assert short.startswith("零件")
    assert short.endswith(".3B")
    assert "…" in short
    assert 250 < text_width(short, 30.0) <= 300
    assert elide("a\tb\0c.3b", 30.0, 300.0) == "a b c.3b"


def test_font_has_the_trade_s_characters() -> None:
    pygame.font.init()
    font = pygame.font.Font(style.FONT, 30)
    text = "零件 1.3B Block 12 — 0.2 mm µμ±×°−≤≥→←ΔØ·…凹模線切割圓弧，：（）"
    assert None not in font.metrics(text)
    assert font.size("零件")[0] == 60


def test_20_000_blocks_in_time() -> None:
    toolpath = spiral(20_000)
    start = time.perf_counter()
    draw_cut(pixels(), Cut(toolpath, 200.0, "x"))
    assert time.perf_counter() - start < 10.0  # a third of a second on a desk computer


@pytest.mark.parametrize(
    ("width_px", "kerf_um", "message"),
    [
        (159, 200.0, "160 px"),
        (600, -1.0, "kerf width"),
        (600, float("nan"), "kerf width"),
    ],
)
def test_wrong_use_is_named(width_px: int, kerf_um: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        drawn(read("B1B0B1GXL1"), kerf_um, width_px=width_px)


def test_chords_stay_close_to_their_arcs() -> None:
    toolpath = read("B3000B4000B30000GYNR1 B700B0B700GYSR4")
    points, row = flatten(toolpath, 0.5)
    assert points[0] == pytest.approx(toolpath.start_um[0])
    for i in (0, 1):
        mine = points[1:][row[1:] == i]
        middle = (mine[1:] + mine[:-1]) / 2
        off = toolpath.radius_um[i] - np.hypot(*(middle - toolpath.center_um[i]).T)
        assert off.max() <= 0.5
        assert mine[-1] == pytest.approx(toolpath.end_um[i])


def test_bounds_are_those_of_a_dense_walk() -> None:
    toolpath = read(PART)
    row = np.repeat(np.arange(len(toolpath)), 2001)
    points, heading = along(toolpath, row, np.tile(np.linspace(0, 1, 2001), len(toolpath)))
    low, high = bounds_um(toolpath)
    assert low == pytest.approx(points.min(axis=0), abs=0.01)
    assert high == pytest.approx(points.max(axis=0), abs=0.01)
    assert np.hypot(*heading.T) == pytest.approx(1.0)


@pytest.mark.parametrize("seed", range(5))
def test_simplified_line_stays_close(seed: int) -> None:
    walk = np.cumsum(np.random.default_rng(seed).normal(size=(3000, 2)) * 0.05, axis=0)
    few = simplify(walk, 0.3)
    assert len(few) < len(walk) / 3
    assert (few[0] == walk[0]).all()
    assert (few[-1] == walk[-1]).all()
    first, chord = few[:-1], np.diff(few, axis=0)
    share = np.clip(((walk[:, None] - first) * chord).sum(axis=2) / (chord**2).sum(axis=1), 0, 1)
    gap = walk[:, None] - first - share[..., None] * chord
    assert np.hypot(gap[..., 0], gap[..., 1]).min(axis=1).max() <= 0.3


def test_equal_scale_and_bounded_height() -> None:
    for size in ((1e5, 1.0), (1.0, 1e5), (1e5, 7e4)):
        page = page_for(np.array([[0.0, 0.0], size]), 1600)
        corners = page.view.to_px(np.array([[0.0, 0.0], size]))
        assert 800 <= page.height_px <= 1600
        assert page.plot.holds(Box(corners[0, 0], corners[1, 1], corners[1, 0], corners[0, 1]))
        assert page.view.range_um(page.plot)[0] == pytest.approx(
            (np.array([page.plot.left, -page.plot.bottom]) - (page.view.x_px, -page.view.y_px)) / page.view.px_per_um
        )


def test_ticks_are_round() -> None:
    assert [nice_below(v) for v in (999.0, 1000.0, 4999.0, 0.3)] == [500.0, 1000.0, 2000.0, pytest.approx(0.2)]
    assert ticks(-2500.0, 4100.0, 2000.0).tolist() == [-2000.0, 0.0, 2000.0, 4000.0]
    assert [mm_text(v, 500.0) for v in (-500.0, -0.0, 12500.0)] == ["−0.5", "0.0", "12.5"]
    assert mm_text(20000.0, 10000.0) == "20"
