"""What the picture of a cut says, held against the cut: sizes, pieces, findings, pauses, travel, and their places."""

import math
import time
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from types import MappingProxyType

import numpy as np
import pytest
import shapely
from golden_pictures import assert_golden
from paths import Pen
from recorder import Recorder, recording_sheet
from runs import scenario_run
from traced import F, kerf_along, pieces_along, square, trace_of

from parser.findings.codes import CODES
from parser.findings.findings import Finding
from parser.toolpath import Stop, Toolpath
from sim.cut.sizes import sizes_of
from sim.run.recording import pieces_of_run
from sim.show.draw import style
from sim.show.draw.flatten import flatten
from sim.show.draw.layout import Box, Page
from sim.show.draw.sheet import drawing, pixels
from sim.show.draw.style import DARK, Paint
from sim.show.pictures.cut.marks import flag_reach, flags_of, places_um
from sim.show.pictures.cut.of_run import draw_cut_of_run
from sim.show.pictures.cut.picture import draw_cut, layout_of
from sim.show.pictures.cut.sizes import length_text, sizes_of_cut
from sim.show.pictures.cut.subject import Cut

OF_BLOCKS = sorted(code for code in CODES if code.startswith("3B2"))


def punch(side: float = 10_000.0, lead: float = 3000.0) -> Toolpath:
    """A square, led in from the left of its lower left corner, and out the same way."""
    return square(Pen(-lead, 0).to(0, 0), side).to(-lead, 0).path()


def die(side: float = 10_000.0) -> Toolpath:
    """The same square cut from its middle."""
    half = side / 2
    pen = Pen().to(half, 0).to(half, half).to(-half, half).to(-half, -half).to(half, -half).to(half, 0)
    return pen.to(0, 0).path()


def rounded(radius: float = 2000.0) -> Toolpath:
    """A square of 10 mm led in from below, three of its corners round."""
    far, near = 10_000.0, 10_000.0 - radius
    pen = Pen(5000, -2000).to(5000, 0).to(near, 0).arc(near, radius, math.pi / 2).to(far, near)
    pen = pen.arc(near, near, math.pi / 2).to(radius, far).arc(radius, near, math.pi / 2)
    return pen.to(0, 0).to(5000, 0).to(5000, -2000).path()


def hole(radius: float = 4000.0) -> Toolpath:
    return Pen().to(radius, 0).arc(0, 0, 2 * math.pi).to(0, 0).path()


def spiral(blocks: int) -> Toolpath:
    """Twenty turns of short lines, out from the middle."""
    pen = Pen()
    for at in range(1, blocks + 1):
        angle = 40 * math.pi * at / blocks
        pen.to(round(800 * angle * math.cos(angle)), round(800 * angle * math.sin(angle)))
    return pen.path()


BARE = square(Pen(), 1e4).path()


def cut_of(path: Toolpath, **more: object) -> Cut:
    return Cut(path, 2 * F, **{"title": "x", **more})


def recorded(cut: Cut, width_px: int = 1600, language: str = "en") -> Recorder:
    return draw_cut(recording_sheet(width_px, language), cut)


def page_of(cut: Cut, width_px: int = 1600) -> Page:
    return layout_of(recording_sheet(width_px), cut).page


def finding(block: int, code: str = "3B203", **values: float) -> Finding:
    return Finding(code, MappingProxyType(values), block=block)


def sized(canvas: Recorder) -> list[str]:
    """Texts of sizes: width, height, then radii."""
    return [one.more[0] for one in canvas.of("text", Paint.SIZE)]


# Sizes


@pytest.mark.parametrize(
    ("cut", "texts"),
    [
        pytest.param(cut_of(punch()), ["9.8", "9.8"], id="punch: the path less the offset on both sides"),
        pytest.param(cut_of(die()), ["10.2", "10.2"], id="die: the path and the offset on both sides"),
        pytest.param(cut_of(BARE), ["path 10", "path 10"], id="no lead-in: that of the path"),
        pytest.param(cut_of(BARE, pieces=pieces_along(BARE)), ["9.8", "9.8"], id="no lead-in: of the piece"),
        pytest.param(cut_of(punch(), contour=punch(9_800)), ["9.8", "9.8"], id="offset: what the program draws"),
        pytest.param(cut_of(rounded()), ["9.8", "9.8", "3× R 1.9"], id="round corners"),
        pytest.param(cut_of(hole()), ["8.2", "8.2", "Ø 8.2"], id="hole"),
        pytest.param(cut_of(Pen().to(5000, 0).path()), [], id="parting cut"),
        pytest.param(cut_of(Pen().to(0, 0).to(5000, 0).to(5000, 0).path()), [], id="blocks of no length"),
        pytest.param(cut_of(square(Pen(-500, 0).to(0, 0), 150).path()), [], id="all of it goes into the kerf"),
    ],
)
def test_sizes_are_those_of_what_is_kept(cut: Cut, texts: list[str]) -> None:
    assert sized(recorded(cut)) == texts


@pytest.mark.parametrize("path", [punch(7123.4), die(6543.0), rounded(1500.0), hole(2345.0)])
def test_sizes_of_the_path_are_those_worked_out_from_the_kerf(path: Toolpath) -> None:
    kerf = kerf_along(path)
    measured = sizes_of_cut(
        cut_of(path, sizes=sizes_of(path, kerf, pieces_along(path), None, np.zeros((len(path), 2))))
    )
    plain = sizes_of_cut(cut_of(path))
    assert measured.box_um == pytest.approx(plain.box_um, abs=0.1)
    say = recording_sheet().say
    assert [each.text(say) for each in measured.rounds] == [each.text(say) for each in plain.rounds]


@pytest.mark.parametrize("path", [punch(), die(7000.0), rounded()])
def test_lines_of_sizes_are_as_long_as_the_part(path: Toolpath) -> None:
    cut = cut_of(path)
    canvas, box = recorded(cut), sizes_of_cut(cut).box_um
    left, right, bottom, top = (one.at for one in canvas.of("arrow", Paint.SIZE)[:4])
    scale = page_of(cut).view.px_per_um
    assert right - left == pytest.approx([scale * (box[1, 0] - box[0, 0]), 0.0], abs=0.01)
    assert top - bottom == pytest.approx([0.0, -scale * (box[1, 1] - box[0, 1])], abs=0.01)
    corners = page_of(cut).view.to_px(box)
    assert (left[0], bottom[1]) == pytest.approx(corners[0], abs=0.01)


def test_lines_of_sizes_stand_outside_of_all_the_path() -> None:
    for path in (punch(), die(), rounded(), hole()):
        cut = cut_of(path)
        ends = np.array([one.at for one in recorded(cut).of("arrow", Paint.SIZE)[:4]])
        low, high = page_of(cut).view.to_px(np.stack([path.start_um.min(axis=0), path.start_um.max(axis=0)]))
        assert not ((low[1] + 20 > ends[:2, 1]) & (ends[:2, 1] > high[1] - 20)).any()
        assert not ((low[0] - 20 < ends[2:, 0]) & (ends[2:, 0] < high[0] + 20)).any()


def test_leaders_touch_the_edge_that_is_meant() -> None:
    cut = cut_of(hole())
    tip = recorded(cut).of("arrow", Paint.SIZE)[4].at
    assert np.hypot(*page_of(cut).view.to_um(tip)) == pytest.approx(4100.0, abs=1e-6)


@pytest.mark.parametrize(
    ("um", "text"), [(12_500.0, "12.5"), (100.0, "0.1"), (20_000.0, "20"), (1234.5678, "1.235"), (99_999.6, "100")]
)
def test_lengths_have_no_more_digits_than_they_need(um: float, text: str) -> None:
    assert length_text(um) == text


def test_the_scale_bar_is_as_long_as_it_says() -> None:
    for path in (punch(), punch(131.0, 40.0), punch(90_000.0)):
        cut = cut_of(path)
        page, canvas = page_of(cut), recorded(cut)
        bars = [one.at for one in canvas.of("polyline", Paint.INK) if one.at[0, 1] == one.at[1, 1] > page.plot.bottom]
        (bar,) = bars
        says = next(text for text in canvas.texts if text.endswith(" mm") and text[0].isdigit())
        assert (bar[1, 0] - bar[0, 0]) / page.view.px_per_um == pytest.approx(1000 * float(says[:-3]), abs=1e-6)


# Pieces


@pytest.mark.parametrize(("path", "paint"), [(punch(), Paint.PART), (die(), Paint.SLUG)])
def test_pieces_are_shaded_where_they_are(path: Toolpath, paint: Paint) -> None:
    pieces = pieces_along(path)
    cut = cut_of(path, pieces=pieces)
    (area, _) = recorded(cut).of("region", paint)  # the other one is in the legend
    drawn = shapely.Polygon(page_of(cut).view.to_um(area.at[0]))
    (piece,) = pieces.freed
    assert drawn.symmetric_difference(piece.outline_um).area < 1e-3 * piece.outline_um.area


def test_pieces_say_what_they_are_and_what_frees_them() -> None:
    canvas = recorded(cut_of(punch(), pieces=pieces_along(punch())))
    at = canvas.texts.index("part")
    assert canvas.texts[at : at + 3] == ["part", "96.04 mm²", "free in block 5"]  # 9.8 × 9.8 mm
    assert "废料" in recorded(cut_of(die(), pieces=pieces_along(die())), language="zh").texts


def test_without_pieces_nothing_is_shaded() -> None:
    canvas = recorded(cut_of(punch()))
    assert not canvas.of("region", Paint.PART)
    assert "part" not in canvas.texts


# Findings


def flag_places(canvas: Recorder, paint: Paint, page: Page) -> np.ndarray:
    """Middles (n, 2) px of the flags of a paint in the plot, the last drawn first: corners lie evenly about them."""
    flags = [one.at[0].mean(axis=0) for one in canvas.of("region", paint)]
    return np.array([place for place in flags if place[1] < page.plot.bottom]).reshape(-1, 2)


@pytest.mark.parametrize("seed", range(6))
def test_flags_lie_on_their_blocks(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = (punch(), die(), rounded(), hole(), spiral(400), spiral(20))[seed]
    blocks = rng.integers(1, len(path) + 1, 12)
    cut = cut_of(path, findings=[finding(int(block)) for block in blocks])
    page = page_of(cut)
    way = shapely.LineString(page.view.to_px(flatten(path, 1.0)[0]))
    places = flag_places(recorded(cut), Paint.WARNING, page)
    assert 0 < len(places) <= 12
    assert shapely.distance(shapely.points(places), way).max() < 1.0


def test_a_flag_lies_where_its_finding_says() -> None:
    cut = cut_of(punch(), findings=[finding(3, "3B404", x_mm=4.0, y_mm=5.0)])
    page = page_of(cut)
    assert flag_places(recorded(cut), Paint.ERROR, page)[0] == pytest.approx(page.view.to_px(np.array([4e3, 5e3])))


def test_sizes_of_the_travel_are_no_place() -> None:
    out = finding(3, "3B401", x_mm=400.0, y_mm=500.0)
    assert places_um(punch(), [out], 0.0)[0] == pytest.approx((10_000.0, 5000.0))


def test_findings_of_one_place_are_counted() -> None:
    cut = cut_of(punch(), findings=[finding(3)] * 4 + [finding(3, "3B301"), finding(5), finding(0, "3B107")])
    texts = recorded(cut).texts
    assert "3B301, 3B203 ×4" in texts
    assert "3B203" in texts
    legend = [text for text in texts if ":" in text]
    assert [text.split(":")[0] for text in legend] == ["3B301", "3B107", "3B203 ×5"]
    assert "3B301: open contour" in legend


def test_many_codes_are_summed_up() -> None:
    findings = [finding(1 + at % 6, code) for at, code in enumerate(OF_BLOCKS)]
    texts = recorded(cut_of(punch(), findings=findings)).texts
    errors = sum(CODES[code].severity == "error" for code in OF_BLOCKS)
    assert f"{errors} errors, {len(OF_BLOCKS) - errors} warnings, 0 notes" in texts


@pytest.mark.parametrize("seed", range(5))
def test_flags_keep_apart_and_lose_no_finding(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = spiral(300)
    findings = [finding(int(block), str(rng.choice(OF_BLOCKS))) for block in rng.integers(1, 301, 500)]
    flags = flags_of(path, findings, 900.0)
    places = [flag.place_um for flag in flags]
    assert min(math.dist(a, b) for a, b in combinations(places, 2)) >= 900.0
    assert sum(count for flag in flags for _, _, count in flag.counts) == 500
    apart = np.hypot(*np.moveaxis(places_um(path, findings, 900.0)[:, None] - np.array(places), -1, 0))
    assert apart.min(axis=1).max() < (1 + math.sqrt(2)) * 900.0  # across a cell, and from there to the next flag


@pytest.mark.deeper
def test_100_000_findings_in_time() -> None:
    path = spiral(20_000)
    begin = time.perf_counter()
    draw_cut(recording_sheet(), cut_of(path, findings=[finding(1 + at % 20_000) for at in range(100_000)]))
    assert time.perf_counter() - begin < 30.0  # two seconds on a desk computer


# Pauses, jumps, travel, contour


def stopped(path: Toolpath, after: Sequence[int]) -> Toolpath:
    return replace(path, stops=tuple(Stop("pause", row, row) for row in after))


def test_pauses_stand_at_the_ends_of_their_blocks() -> None:
    cut = cut_of(stopped(punch(), [2, 4]))
    canvas, page = recorded(cut), page_of(cut)
    dots = np.array([one.at for one in canvas.of("disc", Paint.PAUSE)])
    assert dots == pytest.approx(page.view.to_px(cut.toolpath.end_um[[1, 3]]))
    assert [one.more[0] for one in canvas.of("text", Paint.PAUSE)] == ["2", "4", ""]  # the last one in the legend
    assert "pause after a block" in canvas.texts


def test_pauses_that_have_no_mark_are_counted_in_the_legend() -> None:
    path = spiral(200)
    canvas = recorded(cut_of(stopped(path, range(1, 101))))
    drawn = len(canvas.of("disc", Paint.PAUSE))
    assert 0 < drawn <= 60
    assert f"pause after a block, {drawn} of 100 shown" in canvas.texts


def test_jumps_are_dashed() -> None:
    path = square(square(Pen(), 2000).jump(5000, 0), 2000).path()
    dashed = recorded(cut_of(path)).of("dashed", Paint.JUMP)
    page = page_of(cut_of(path))
    assert page.view.to_um(dashed[0].at) == pytest.approx(np.array([[0.0, 0.0], [5000.0, 0.0]]))


def test_the_border_of_the_travel_shows_where_it_is_near() -> None:
    near = cut_of(punch(), travel_um=np.array([[-9e4, -9e4], [9_000.0, 1e4 + 500.0]]))
    (line, _) = recorded(near).of("dashed", Paint.TRAVEL)
    page = page_of(near)
    corner = page.view.to_px(np.array([9_000.0, 10_500.0]))
    assert np.abs(line.at - corner).sum(axis=1).min() < 1e-6
    assert "travel 99 × 100.5 mm" in recorded(near).texts
    far = cut_of(punch(), travel_um=np.array([[-9e4, -9e4], [9e4, 9e4]]))
    assert not recorded(far).of("dashed", Paint.TRAVEL)
    assert "travel 180 × 180 mm" in recorded(far).texts


def test_the_contour_of_an_offset_run_is_drawn_beside_its_path() -> None:
    cut = cut_of(punch(), contour=punch(9_800))
    canvas, page = recorded(cut), page_of(cut)
    contour = canvas.of("polyline", Paint.CONTOUR)[0].at
    assert page.view.to_um(contour).max(axis=0) == pytest.approx((9_800.0, 9_800.0), abs=0.1)
    assert {"offset path", "programmed contour"} <= set(canvas.texts)
    assert "programmed path" not in canvas.texts


def test_the_wire_is_drawn_where_it_was() -> None:
    trace = trace_of(punch(), stray=lambda place, row: place + np.array([50.0, -30.0]))
    cut = cut_of(punch(), trace=trace)
    actual = page_of(cut).view.to_um(recorded(cut).of("polyline", Paint.ACTUAL)[0].at)
    assert actual.max(axis=0) == pytest.approx((10_050.0, 9_970.0), abs=1.0)


def test_numbers_are_those_of_the_program() -> None:
    path = punch()
    source = replace(path.source, block=np.array([1, 3, 3, 3, 7, 9]))
    canvas = recorded(cut_of(replace(path, source=source)))
    plot = page_of(cut_of(path)).plot
    numbers = [one.more[0] for one in canvas.of("text", Paint.INK) if one.at[1] < plot.bottom and one.at[1] > plot.top]
    assert sorted(numbers) == ["1", "3", "7", "9"]


# Who stands where


def labels(canvas: Recorder, plot: Box) -> list[Box]:
    """Boxes of numbers, codes and pauses in the plot, and those of sizes."""
    edges = (Paint.FRAME, Paint.ERROR, Paint.WARNING, Paint.GREY, Paint.PAUSE)
    framed = [one.at for one in canvas.of("box") if one.more[0] in edges]
    inside = [box for box in framed if box != plot and plot.holds(box)]
    return inside + [one.at for one in canvas.of("box") if one.more[0] is Paint.PAGE]


@pytest.mark.alike(4)
@pytest.mark.parametrize("width_px", [600, 1600])
@pytest.mark.parametrize("seed", range(8))
def test_no_label_covers_another(seed: int, width_px: int) -> None:
    rng = np.random.default_rng(seed)
    path = (punch(), die(), rounded(), hole(), spiral(400), spiral(60), punch(800.0), rounded(300.0))[seed]
    pieces = pieces_along(path) if len(path) < 20 else None
    findings = [finding(int(block), str(rng.choice(OF_BLOCKS))) for block in rng.integers(1, len(path) + 1, 9)]
    cut = cut_of(stopped(path, [2]), findings=findings, pieces=pieces)
    canvas, page = recorded(cut, width_px), page_of(cut, width_px)
    boxes = labels(canvas, page.plot)
    assert len(boxes) > 4
    assert not any(one.meets(other) for one, other in combinations(boxes, 2))
    texts = [box for box in canvas.text_boxes() if page.plot.holds(box)]
    assert not any(one.meets(other) for one, other in combinations(texts, 2))


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("width_px", [600, 1600, 4961])
def test_all_texts_stay_on_the_page(width_px: int, language: str) -> None:
    findings = [finding(1 + at, code) for at, code in enumerate(OF_BLOCKS[:6])]
    cut = cut_of(
        stopped(with_jump(), [1]),
        findings=findings,
        title="冲裁凹模 " * 40,
        note="note " * 80,
        travel_um=np.array([[-1e4, -1e4], [6e3, 6e3]]),
        trace=trace_of(with_jump()),
        pieces=pieces_along(with_jump()),
    )
    canvas = recorded(cut, width_px, language)
    page = Box(0, 0, canvas.width_px, canvas.height_px)
    boxes = canvas.text_boxes()
    assert all(page.holds(box) for box in boxes)
    assert not any(one.meets(other) for one, other in combinations(boxes, 2))


def with_jump() -> Toolpath:
    return square(square(Pen(), 2000).jump(5000, 0), 2000).path()


def test_a_thumbnail_has_neither_numbers_nor_sizes_nor_legend() -> None:
    cut = cut_of(stopped(punch(), [2]), findings=[finding(3)], pieces=pieces_along(punch()), trace=trace_of(punch()))
    canvas = recorded(cut, 320)
    assert set(canvas.texts) <= {"!", ""}
    assert {one.paint for one in canvas.drawn} >= {Paint.KERF, Paint.IDEAL, Paint.PART, Paint.WARNING, Paint.PAUSE}
    assert not canvas.of("polyline", Paint.GRID)
    run = shapely.LineString(canvas.of("polyline", Paint.IDEAL)[0].at)
    assert Box(*run.bounds).right > 0.85 * 320


# As pictures


def test_golden_with_clamps_pieces_and_findings() -> None:
    run = scenario_run("clamp-hit")
    assert_golden(draw_cut_of_run(pixels(800), run, pieces_of_run(run)).image(), "cut-findings.png")


def test_golden_of_an_offset_run_dark_in_chinese() -> None:
    run = scenario_run("narrow-neck")
    assert_golden(draw_cut_of_run(pixels(800, DARK, "zh"), run, pieces_of_run(run)).image(), "cut-dark-zh.png")


def test_golden_thumbnail() -> None:
    run = scenario_run("narrow-neck")
    assert_golden(draw_cut_of_run(pixels(320), run, pieces_of_run(run)).image(), "cut-thumbnail.png")


@pytest.mark.deeper
def test_an_a3_page_in_time() -> None:
    path = rounded(4000.0)
    cut = cut_of(path, pieces=pieces_along(path), trace=trace_of(path))
    begin = time.perf_counter()
    picture = draw_cut(pixels(4961), cut).image()
    assert time.perf_counter() - begin < 20.0  # two seconds on a desk computer
    assert picture.width == 4961


def test_5000_blocks_in_time() -> None:
    path = spiral(5000)
    begin = time.perf_counter()
    draw_cut(drawing(), cut_of(path, findings=[finding(block) for block in range(1, 5000, 7)])).fragment("x")
    draw_cut(pixels(), cut_of(path)).image()
    assert time.perf_counter() - begin < 10.0  # a second on a desk computer


def test_flags_of_a_page_do_not_touch() -> None:
    assert flag_reach(1.0) >= 2 * style.FLAG
