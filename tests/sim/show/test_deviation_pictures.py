"""Pictures of deviation, against independent numbers, golden pictures, and at the edges."""

import math
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from golden_pictures import assert_golden
from paths import Pen
from plain import PlainBlock, plain_steps
from plain_deviation import plain_deviation
from recorder import Recorder, recording_sheet
from runs import plain_scenario, run_text, scenario_run

from parser.program import parse_program
from sim.base.progress import silent
from sim.run.dryrun import DryRun
from sim.run.recording import Recording, recorded
from sim.setup.part import DrawingTarget
from sim.show.draw.chart import NOMINAL, RING, RINGS
from sim.show.draw.layout import Box
from sim.show.draw.sheet import drawing, pixels
from sim.show.draw.style import DARK, LIGHT, Paint
from sim.show.pictures.deviation import insets
from sim.show.pictures.deviation.along import (
    bins_of,
    draw_along,
    draw_histogram,
    path_of_each,
    shares,
)
from sim.show.pictures.deviation.frame import Samples, samples_of
from sim.show.pictures.deviation.insets import STEPS, draw_inset, inset_of
from sim.show.pictures.deviation.polar import circles_of, draw_polar
from sim.show.pictures.deviation.whiskers import APART, draw_whiskers
from sim.show.pictures.deviation.worst import APART_UM, draw_worst, worst_of, worst_places
from sim.table.trace import Trace

SQUARE = "B900 B0 B900 GX L1 B0 B700 B700 GY L2 B900 B0 B900 GX L3 B0 B700 B700 GY L4 DD"
SLOT = """
B0 B300 B300 GY L2
B1200 B300 B1200 GX L1
B0 B400 B800 GX SR1
B1200 B173 B1200 GX L3
B0 B640 B640 GY L2
B300 B0 B1200 GY NR1
DD
"""
RING_TEXT = "B500 B0 B500 GX L1 B500 B0 B2000 GY NR1 B500 B0 B500 GX L3 DD"


@cache
def recording(text: str) -> Recording:
    """A run and its steps, kept in memory."""
    with recorded(parse_program(text), plain_scenario(), silent) as found:
        return found._replace(steps=type(found.steps)(*(np.array(column) for column in found.steps)))


@cache
def samples(text: str) -> Samples:
    return samples_of(recording(text).run)


@cache
def of_scenario(name: str) -> Samples:
    return samples_of(scenario_run(name))


def moved(text: str, place_um: Callable[[np.ndarray], np.ndarray]) -> DryRun:
    """A run whose table stood at `place_um` of each place commanded."""
    run = run_text(text)
    trace = run.trace
    where = place_um(trace.commanded_um)
    return replace(run, trace=Trace(trace.t_s, trace.commanded_um, where, where, trace.row))


def lifted(by_um: float) -> Callable[[np.ndarray], np.ndarray]:
    """Places so much higher."""
    return lambda at: at + np.array([0.0, by_um])


def grown(times: float) -> Callable[[np.ndarray], np.ndarray]:
    """Places so many times as far from the centre of a circle of R 500 µm that starts at the origin toward +X."""
    center = np.array([-500.0, 0.0])
    return lambda at: times * (at - center) + center


ALL: dict[str, Callable[..., Any]] = {
    "along": draw_along,
    "whiskers": draw_whiskers,
    "polar": draw_polar,
    "histogram": draw_histogram,
    "worst": lambda sheet, of: draw_worst(sheet, of, recording(SLOT).steps),
}


@pytest.mark.parametrize("name", ALL)
def test_lines_are_as_wide_as_the_sheet_asks_for(name: str) -> None:
    """At twice the width every line is twice as wide."""
    texts = RING_TEXT if name == "polar" else SLOT
    small, large = (
        {
            (one.what, one.paint, round(one.more[0] / factor, 6))
            for what in ("polyline", "dashed")
            for one in ALL[name](recording_sheet(1600 * factor), samples(texts)).of(what)
        }
        for factor in (1, 2)
    )
    assert small == large


# --- numbers


@pytest.mark.parametrize("text", [SQUARE, SLOT, RING_TEXT])
def test_deviation_is_as_large_as_the_report_s(text: str) -> None:
    of = samples(text)
    x, y = of.trace.commanded_um.T
    assert np.abs(of.steps_um) == pytest.approx(plain_deviation(of.run.toolpath, of.trace.row, x, y), abs=1e-9)
    assert of.max_um == of.run.deviations.wire.max_um
    assert of.p95_um == of.run.deviations.wire.p95_um
    assert np.abs(of.table_um).max() == of.run.deviations.table.max_um
    assert of.where(of.worst) == of.run.deviations.wire.where


@pytest.mark.parametrize(
    ("text", "place_um", "off_um"),
    [
        pytest.param("B900 B0 B900 GX L1 DD", lifted(3.0), 3.0, id="left of +X"),
        pytest.param("B900 B0 B900 GX L3 DD", lifted(3.0), -3.0, id="right of −X"),
        pytest.param("B500 B0 B2000 GY NR1 DD", grown(0.99), 5.0, id="inside, ccw"),
        pytest.param("B500 B0 B2000 GY SR4 DD", grown(0.99), -5.0, id="inside, cw"),
    ],
)
def test_left_of_travel_is_positive(text: str, place_um: Callable[[np.ndarray], np.ndarray], off_um: float) -> None:
    of = samples_of(moved(text, place_um))
    assert of.wire_um == pytest.approx(np.full(len(of), off_um), abs=1.1)  # steps leave a circle by 1 µm


def test_wire_that_bows_is_told_from_its_table() -> None:
    of = of_scenario("wire-lag-corner")
    assert np.abs(of.table_um).max() < 0.21  # µm: a step of 1 µm overshoots by less, seen where samples are close
    assert of.max_um == pytest.approx(9.629, abs=0.001)


def test_nothing_is_measured_past_a_trip_or_on_a_jump() -> None:
    of = of_scenario("servo-trip")
    trip = of.run.ended
    assert trip is not None
    assert of.trace.t_s[-1] <= trip.t_s < of.run.trace.t_s[-1]
    jumps = of.run.toolpath.is_jump[of.trace.row]
    assert jumps.any()
    assert (of.cutting == ~jumps).all()
    assert of.max_um < 0.01 < np.abs(samples_of(replace(of.run, ended=None)).wire_um).max()


@pytest.mark.parametrize("name", ["wire-lag-corner", "backlash"])
def test_feet_lie_on_the_path_as_far_away_as_the_deviation(name: str) -> None:
    of = of_scenario(name)
    toolpath, row = of.run.toolpath, of.trace.row
    foot = of.foot_um
    assert np.hypot(*(of.trace.wire_um - foot).T) == pytest.approx(np.abs(of.wire_um), abs=1e-6)
    on = np.min([plain_deviation(toolpath, np.full(len(row), at), *foot.T) for at in range(len(toolpath))], axis=0)
    assert on.max() < 1e-6


def test_half_a_million_samples_in_time() -> None:
    run = run_text("B500 B0 B2000 GY NR1 DD")
    t_s = np.linspace(0.0, run.plan.duration_s, 500_000)
    share = run.plan.at(t_s).along_um / 500.0
    where = 500.0 * np.stack([np.cos(share) - 1.0, np.sin(share)], axis=1)
    of = replace(run, trace=Trace(t_s, where, where + 1.0, where + 1.0, np.zeros(len(t_s), dtype=np.int64)))
    start = time.perf_counter()
    assert len(samples_of(of)) == 500_000
    assert time.perf_counter() - start < 3.0  # 0.3 s on a desk computer


# --- along the path


def number(text: str) -> float:
    return float(text.split(maxsplit=1)[0].replace("−", "-").replace(",", ""))


def is_number(text: str) -> bool:
    return text.replace("−", "").replace(".", "").replace(",", "").isdigit()


def scale(canvas: Recorder, frame: Box, axis: int) -> Callable[[float], float]:
    """Where a value of an axis lies, px, by the values written left of the frame (1) or below it (0)."""
    written = [one for one in canvas.of("text", Paint.GREY) if is_number(one.more[0])]
    beside = [
        (number(one.more[0]), one.at[axis])
        for one in written
        if (one.at[0] < frame.left if axis else one.at[1] > frame.bottom)
    ]
    (low, first), *_, (high, last) = sorted(beside)
    return lambda value: first + (value - low) / (high - low) * (last - first)


def frame_of(canvas: Recorder) -> Box:
    return canvas.of("box", Paint.PAGE)[0].at


def test_worst_place_is_marked_where_it_lies() -> None:
    of = samples(SLOT)
    canvas = draw_along(recording_sheet(), of)
    frame = frame_of(canvas)
    (mark,) = canvas.of("ring", Paint.ERROR)
    at = int(np.argmax(np.abs(of.wire_um)))
    assert mark.at[1] == pytest.approx(scale(canvas, frame, 1)(float(of.wire_um[at])), abs=0.01)
    assert mark.at[0] == pytest.approx(scale(canvas, frame, 0)(float(of.along_um[at]) / 1000.0), abs=0.01)
    assert any(f"{abs(of.wire_um[at]):.2f} µm" in text and "block" in text for text in canvas.texts)


def test_band_reaches_from_the_lowest_to_the_highest_of_each_column() -> None:
    of = samples(SLOT)
    canvas = draw_along(recording_sheet(600), of)
    frame = frame_of(canvas)
    x_of, y_of = scale(canvas, frame, 0), scale(canvas, frame, 1)
    (band,) = (one.at[0] for one in canvas.of("region", Paint.ACTUAL_PALE))
    turns = int(np.argmax(np.diff(band[:, 0]) <= 0.0)) + 1
    lowest, highest = band[:turns], band[turns:][::-1]
    x = np.array([x_of(value) for value in (of.along_um / 1000.0).tolist()])
    y = np.array([y_of(value) for value in of.wire_um.tolist()])
    for edge, most in ((lowest, np.max), (highest, np.min)):
        for left, at in edge[1:-1].tolist():  # corners of an edge are those of its columns
            here = np.floor(x + 1e-6) == math.floor(left + 1e-6)
            assert at == pytest.approx(most(y[here]), abs=0.02)
        columns = np.unique(np.floor(x + 1e-6))[1:-1]
        middle = columns + (edge[1, 0] - math.floor(edge[1, 0]))
        exact = [most(y[np.floor(x + 1e-6) == column]) for column in columns]
        left_out = shapely.distance(shapely.points(middle, exact), shapely.LineString(edge))
        assert left_out.max() < 0.2  # px


def test_borders_stand_where_blocks_end() -> None:
    of = samples(SLOT)
    canvas = draw_along(recording_sheet(), of)
    frame = frame_of(canvas)
    upright = {round(one.at[0, 0], 3) for one in canvas.of("polyline", Paint.FRAME) if one.at[0, 0] == one.at[1, 0]}
    ends = np.cumsum(of.run.toolpath.length_um)[:-1] / 1000.0
    wanted = [round(scale(canvas, frame, 0)(float(end)), 3) for end in ends]
    assert all(min(abs(at - drawn) for drawn in upright) < 0.01 for at in wanted)


def zigzags(blocks: int) -> str:
    lengths = np.random.default_rng(7).integers(20, 400, blocks)
    return "\n".join(f"B{n} B0 B{n} GX L{1 if at % 2 else 3}" for at, n in enumerate(lengths.tolist())) + "\nDD"


def test_numbers_of_200_blocks_never_overlap() -> None:
    of = samples_of(run_text(zigzags(200)))
    canvas = draw_along(recording_sheet(600), of)
    boxes = [
        box
        for box, one in zip(canvas.text_boxes(), canvas.of("text"), strict=True)
        if one.paint is Paint.INK and is_number(one.more[0])
    ]
    assert len(boxes) > 5
    assert not any(one.meets(other) for one, other in combinations(boxes, 2))


def test_tolerance_is_the_drawing_s_where_there_is_one() -> None:
    of = samples(SLOT)
    asked = replace(of.run.scenario, drawing=DrawingTarget(Path("part.dxf"), tolerance_um=1.5))
    given = replace(of, run=replace(of.run, scenario=asked))
    for drawn, text, tolerance_um in ((of, "±5 µm (default)", 5.0), (given, "±1.5 µm, of the drawing", 1.5)):
        canvas = draw_along(recording_sheet(), drawn)
        y_of = scale(canvas, frame_of(canvas), 1)
        assert any(text in written for written in canvas.texts)
        (band,) = (one.at[0] for one in canvas.of("region", Paint.BAND))
        edges = sorted({round(float(y), 2) for y in band[:, 1]})
        assert edges == pytest.approx([y_of(tolerance_um), y_of(-tolerance_um)], abs=0.02)


def test_jump_breaks_the_line_and_is_named() -> None:
    of = of_scenario("servo-trip")
    whole = samples_of(replace(of.run, ended=None))
    canvas = draw_along(recording_sheet(), whole)
    assert len(canvas.of("region", Paint.ACTUAL_PALE)) == 2
    assert "jump, no cutting" in canvas.texts


# --- on the path


def test_whiskers_are_deviations_magnified_as_the_legend_says() -> None:
    of = samples_of(moved(SQUARE, lifted(4.0)))
    canvas = draw_whiskers(recording_sheet(), of)
    frame = frame_of(canvas)
    times = next(number(text.split("×")[1]) for text in canvas.texts if "×" in text)
    x_of, y_of = scale(canvas, frame, 0), scale(canvas, frame, 1)
    whiskers = np.array([one.at for one in canvas.of("polyline", Paint.ACTUAL) if len(one.at) == 2])
    inner = whiskers[whiskers[:, 0, 0] > frame.left]
    along_x = inner[np.abs(inner[:, 0, 1] - y_of(0.0)) < 0.01]
    assert len(along_x) > 20
    assert along_x[:, 1, 1] == pytest.approx(np.full(len(along_x), y_of(0.004 * times)), abs=0.05)
    assert along_x[:, 1, 0] == pytest.approx(along_x[:, 0, 0], abs=0.05)
    assert x_of(0.9) - x_of(0.0) == pytest.approx(y_of(0.0) - y_of(0.9), abs=0.1)


def test_whiskers_stand_apart_and_the_worst_of_each_long_block_stays() -> None:
    of = of_scenario("wire-lag-corner")
    canvas = draw_whiskers(recording_sheet(), of)
    lengths = [
        float(np.hypot(*np.diff(one.at, axis=0)[0]))
        for paint in (Paint.ACTUAL, Paint.ERROR)
        for one in canvas.of("polyline", paint)
        if len(one.at) == 2 and one.at[:, 1].max() < frame_of(canvas).bottom  # no stroke of the legend
    ]
    worst = [float(np.abs(of.wire_um[of.trace.row == row]).max()) for row in range(4)]
    longest = sorted(lengths)[-1]
    for off in worst[1:]:  # px: at a corner one whisker stands for the worst of both blocks
        assert min(abs(length - longest * off / max(worst)) for length in lengths) < 0.02
    frame = frame_of(canvas)
    path_px = 4000.0 / 1000.0 * abs(scale(canvas, frame, 0)(1.0) - scale(canvas, frame, 0)(0.0))
    assert len(lengths) < path_px / APART + 12


def test_the_worst_of_each_group_is_the_first_of_its_worst_and_the_worst_group_leads() -> None:
    of = samples(SLOT)
    off = np.array([1.0, -3.0, 3.0, 0.5, 2.0, -2.0, 9.0, 3.0])
    of = replace(of, wire_um=off)
    chosen, group = np.array([0, 1, 2, 3, 4, 5, 7]), np.array([0, 0, 0, 2, 3, 3, 7])
    assert worst_of(of, chosen, group).tolist() == [1, 7, 4, 3]
    assert worst_of(of, chosen[:0], group[:0]).tolist() == []


def test_whiskers_that_cover_each_other_are_drawn_once() -> None:
    def drawn(rounds: int) -> int:
        of = samples_of(moved("B99B7B99GXL1 B99B7B99GXL3 " * rounds + "DD", lifted(2.0)))
        return len(draw_whiskers(recording_sheet(), of).of("polyline", Paint.ACTUAL))

    assert 20 < drawn(2) <= drawn(40) < 4 * drawn(2)


def test_whiskers_outside_the_tolerance_have_their_own_colour() -> None:
    def lengths(by_um: float, paint: Paint) -> int:
        of = samples_of(moved(SQUARE, lifted(by_um)))
        return len(draw_whiskers(recording_sheet(), of).of("polyline", paint))

    assert lengths(4.9, Paint.ERROR) == 1  # the sample of the legend
    assert lengths(5.1, Paint.ERROR) > 50


# --- around circles


def test_circles_are_found_whole_and_in_parts() -> None:
    pen = Pen().to(500.0, 0.0)
    for _ in range(4):
        pen.arc(0.0, 0.0, math.pi / 2.0)
    pen.to(800.0, 0.0).arc(700.0, 0.0, -2.0 * math.pi).arc(700.0, 0.0, 2.0 * math.pi)
    pen.to(900.0, 0.0).arc(700.0, 0.0, 1.4 * math.pi).to(0.0, 0.0).arc(10.0, 0.0, 2.0 * math.pi)
    found = circles_of(pen.path())
    assert [(one.first, one.last, one.turn) for one in found] == [(1, 4, 1), (6, 6, -1), (7, 7, 1)]
    assert [one.radius_um for one in found] == pytest.approx([500.0, 100.0, 100.0])


@pytest.mark.parametrize("text", ["B500 B0 B2000 GY NR1 DD", "B500 B0 B2000 GY SR4 DD"])
def test_dial_shows_outward_deviation_where_it_lies(text: str) -> None:
    of = samples_of(moved(text, grown(1.02)))
    canvas = draw_polar(recording_sheet(), of)
    assert canvas is not None
    center = canvas.of("ring", Paint.INK)[0].at
    nominal = canvas.of("ring", Paint.INK)[0].more[0]
    outer = max(one.more[0] for one in canvas.of("ring", Paint.FRAME))
    most = max(number(text.replace("+", "")) for text in canvas.texts if text.endswith("µm") and text.startswith("+"))
    edges = [one.at for one in canvas.of("polyline", Paint.ACTUAL) if len(one.at) > 10]
    radius = np.concatenate([np.hypot(*(edge - center).T) for edge in edges])
    off = (radius - nominal) / (outer - nominal) * most
    assert off == pytest.approx(np.full(len(off), 10.0), abs=1.3)  # steps leave a circle by 1 µm
    assert outer / nominal == pytest.approx((NOMINAL + RINGS * RING) / NOMINAL)


def test_no_circle_no_picture() -> None:
    assert draw_polar(recording_sheet(), samples(SQUARE)) is None


def test_of_many_circles_the_worst_four_show() -> None:
    ring = "B100 B0 B400 GY NR1 B300 B0 B300 GX L1 "
    canvas = draw_polar(recording_sheet(), samples_of(run_text(ring * 6 + "DD")))
    assert canvas is not None
    assert len(canvas.of("ring", Paint.INK)) == 4
    assert "the 4 worst of 6 circles" in canvas.texts
    captions = [text for text in canvas.texts if "R 0.100 mm" in text]
    assert len(captions) == 4


# --- shares


@pytest.mark.parametrize("name", ["wire-lag-corner", "backlash", "servo-trip"])
def test_shares_are_those_of_the_path_and_add_up_to_the_whole(name: str) -> None:
    of = of_scenario(name)
    bins = bins_of(of)
    for off in (of.wire_um, of.steps_um):
        found = shares(of, off, bins)
        assert found.sum() == pytest.approx(1.0)
        plain = np.zeros(len(bins) - 1)
        for one, other in pairwise(range(len(of))):
            if of.cutting[one] and of.cutting[other]:
                for at in (one, other):
                    cell = int(np.searchsorted(bins, off[at], side="right")) - 1
                    plain[cell] += (of.along_um[other] - of.along_um[one]) / 2.0
        assert found == pytest.approx(plain / plain.sum(), abs=1e-12)
    cut = of.run.toolpath.length_um[~of.run.toolpath.is_jump].sum()
    assert path_of_each(of.along_um, of.cutting).sum() <= cut


def test_bars_are_as_high_as_their_share() -> None:
    of = samples(SLOT)
    canvas = draw_histogram(recording_sheet(), of)
    percents = {one.more[0]: one.at[1] for one in canvas.of("text", Paint.GREY) if one.more[0].endswith(" %")}
    one, ten = percents["1 %"], percents["10 %"]
    outline = canvas.of("region", Paint.ACTUAL_PALE)[0].at[0]
    tops = outline[1:-1:2, 1]
    share = 0.01 * 10.0 ** ((tops - one) / (ten - one))
    found = shares(of, of.wire_um, bins_of(of))
    seen = found > 1e-3
    assert seen.sum() > 5
    assert share[seen] == pytest.approx(found[seen], rel=1e-6)


# --- close up

BLOCKS = [
    PlainBlock(700, 300, 700, "X", "L", 1),
    PlainBlock(0, 400, 800, "X", "SR", 1),
    PlainBlock(1200, 173, 1200, "X", "L", 3),
]


def plain_places(blocks: list[PlainBlock]) -> list[tuple[int, int]]:
    x = y = 0
    places = [(0, 0)]
    for block in blocks:
        own = plain_steps(block)
        places += [(x + dx, y + dy) for dx, dy in own]
        x, y = places[-1]
    return places


@pytest.mark.parametrize("most", [insets.STEPS, 8])
def test_staircase_is_that_of_the_plain_interpolator(monkeypatch: pytest.MonkeyPatch, most: int) -> None:
    monkeypatch.setattr(insets, "STEPS", most)
    text = "\n".join(block.text() for block in BLOCKS) + "\nDD"
    of, steps = samples(text), recording(text).steps
    plain = plain_places(BLOCKS)
    chosen = worst_places(of)
    assert len(chosen) > 2
    for at in chosen.tolist():
        shown = inset_of(of, steps, at)
        assert shown.steps_um
        for run in shown.steps_um:
            drawn = [(int(x), int(y)) for x, y in run]
            first = [index for index in range(len(plain)) if plain[index : index + len(drawn)] == drawn]
            assert len(first) == 1
            past = [run[at] for at in (0, -1) if tuple(run[at]) not in {plain[0], plain[-1]}]
            if most == STEPS:  # the lines go on to the border of the view
                assert all(np.abs(place - shown.center_um).max() > shown.side_um / 2.0 for place in past)
        seen = {place for run in shown.steps_um for place in map(tuple, run.astype(int).tolist())}
        low, high = shown.center_um - shown.side_um / 2.0, shown.center_um + shown.side_um / 2.0
        if most == STEPS:
            assert {place for place in plain if (low <= place).all() and (place <= high).all()} <= seen


def test_inset_shows_its_deviation_to_scale() -> None:
    of, steps = samples(SLOT), recording(SLOT).steps
    canvas = draw_worst(recording_sheet(), of, steps)
    chosen = worst_places(of)
    written = [text for text in canvas.texts if text.endswith("µm") and is_number(text.removesuffix(" µm"))]
    assert written == [f"{abs(of.wire_um[at]):.2f} µm" for at in chosen.tolist()]
    for at in chosen.tolist():
        shown = inset_of(of, steps, at)
        assert np.hypot(*(shown.place_um - shown.foot_um)) == pytest.approx(abs(of.wire_um[at]), abs=1e-6)
        gap = np.hypot(*(shown.ideal_um - shown.foot_um).T).min()
        assert gap <= 0.06  # the path is drawn in chords of 0.1 µm


def test_a_single_sample_of_the_wire_is_a_dot() -> None:
    of, steps = samples(SLOT), recording(SLOT).steps
    at = int(worst_places(of)[0])
    alone = inset_of(of, steps, at)._replace(
        wire_um=of.trace.wire_um[at : at + 1], table_um=of.trace.wire_um[at : at + 1]
    )
    canvas = Recorder(300, 300)
    draw_inset(canvas, Box(0.0, 0.0, 300.0, 300.0), alone, 1.0)
    assert len(canvas.of("disc", Paint.ACTUAL)) == 1


def test_table_shows_beside_a_wire_that_bows() -> None:
    bowed, straight = of_scenario("wire-lag-corner"), samples(SLOT)
    steps = recording(SLOT).steps
    assert "table" in draw_worst(recording_sheet(), bowed, steps).texts
    canvas = draw_worst(recording_sheet(), straight, steps)
    assert "table" not in canvas.texts
    assert not canvas.of("polyline", Paint.GREY)


def test_grid_of_an_inset_is_one_of_single_steps() -> None:
    of, steps = of_scenario("wire-lag-corner"), recording(SQUARE).steps
    canvas = draw_worst(recording_sheet(), of, steps)
    assert sum("grid 1 µm" in text for text in canvas.texts) == len(worst_places(of))
    shown = inset_of(of, steps, int(worst_places(of)[0]))
    box = next(one.at for one in canvas.of("box", Paint.PAGE) if one.more[0] is Paint.FRAME)
    lines = np.array([one.at for one in canvas.of("polyline", Paint.GRID)])
    upright = (lines[:, 0, 0] == lines[:, 1, 0]) & (lines[:, 0, 1] == box.top)
    here = upright & (lines[:, 0, 0] < box.right)
    gaps = np.diff(np.unique(lines[here][:, 0, 0]))
    assert gaps.min() == pytest.approx((box.right - box.left) / shown.side_um, abs=1e-6)


@pytest.mark.parametrize("name", ["backlash", "wire-lag-corner"])
def test_worst_places_are_the_worst_and_stand_apart(name: str) -> None:
    of = of_scenario(name)
    chosen = worst_places(of)
    off = np.abs(of.wire_um[chosen])
    assert off[0] == of.max_um
    assert (np.diff(off) <= 0.0).all()
    assert off.min() > 0.05
    where = of.trace.wire_um[chosen]
    assert min(math.dist(one, other) for one, other in combinations(where.tolist(), 2)) >= APART_UM
    off_rows = {row for row in range(4) if np.abs(of.wire_um[of.trace.row == row]).max() > 0.05}
    assert set(of.trace.row[chosen].tolist()) == off_rows  # no block twice while others are left


# --- everywhere


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("width_px", [600, 1600])
def test_every_text_lies_on_the_page_and_none_over_another(name: str, language: str, width_px: int) -> None:
    canvas = ALL[name](recording_sheet(width_px, language), samples(SLOT))
    page = Box(0.0, 0.0, canvas.width_px, canvas.height_px)
    boxes = canvas.text_boxes()
    assert len(boxes) > 5
    assert all(page.holds(box) for box in boxes)
    tall = [box._replace(top=box.top + 0.15 * (box.bottom - box.top)) for box in boxes]
    assert not [pair for pair in combinations(range(len(tall)), 2) if tall[pair[0]].meets(tall[pair[1]])]


@pytest.mark.parametrize("name", ALL)
def test_draws_as_svg_too(name: str) -> None:
    document = ALL[name](drawing(800, DARK, "zh"), samples(SLOT)).document(name, 800)
    root = ET.fromstring(document)  # noqa: S314 - our own
    assert len(list(root.iter())) > 30


@pytest.mark.parametrize("name", ALL)
def test_golden(name: str) -> None:
    picture = ALL[name](pixels(600, LIGHT), samples(SLOT)).image()
    assert_golden(picture, f"{name}.png")


@pytest.mark.alike(5)
@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize(
    "text",
    [
        pytest.param("B0 B0 B0 GX L1 DD", id="no length"),
        pytest.param("B2 B0 B2 GX L1 DD", id="2 µm"),
        pytest.param("B0 B50000 B50000 GY L2 DD", id="upright"),
        pytest.param("B30 B0 B120 GY NR1 DD", id="small circle"),
    ],
)
def test_odd_programs_draw(name: str, text: str) -> None:
    of = samples_of(run_text(text))
    canvas = ALL[name](recording_sheet(600), of)
    assert canvas is None or canvas.height_px >= 250


@pytest.mark.parametrize("name", ALL)
def test_a_run_that_cut_nothing_says_so(name: str) -> None:
    of = samples(SLOT)
    nothing = replace(of, cutting=np.zeros(len(of), dtype=np.bool_))
    canvas = ALL[name](recording_sheet(), nothing)
    assert canvas is None or "nothing was cut" in canvas.texts


@pytest.mark.parametrize("name", ALL)
def test_too_narrow_a_page_is_named(name: str) -> None:
    with pytest.raises(ValueError, match="600 px"):
        ALL[name](recording_sheet(599), samples(SLOT))
