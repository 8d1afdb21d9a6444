"""The picture of the motion shows the history where it belongs, with limits, blocks, pauses and losses, in any size."""

from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from golden_pictures import assert_golden
from recorder import Drawn, Recorder, recording_sheet
from runs import run_text, scenario_run

from parser.geometry.curves import Floats
from sim.base.units import in_figures
from sim.run.dryrun import DryRun
from sim.show.draw.layout import MOST_NUMBERS, Box
from sim.show.draw.sheet import SIZES_PX, drawing, pixels
from sim.show.draw.style import DARK, Paint
from sim.show.pictures.motion.panels import PAUSE
from sim.show.pictures.motion.picture import draw_motion
from sim.table.history import Envelope, History

TEXT = "B800B0B800GXL1 D B0B500B500GYL2 B300B0B300GXL3 DD"


@cache
def plain() -> DryRun:
    return run_text(TEXT)


def drawn(run: DryRun, width_px: int = 1600, language: str = "en") -> Recorder:
    return draw_motion(recording_sheet(width_px, language), run)


def frames_of(canvas: Recorder) -> list[Box]:
    """Frames of the four panels, from above: those over the whole width."""
    boxes = [one.at for one in canvas.of("box", Paint.PAGE)]
    assert len(boxes) == 4
    return boxes


def within(frame: Box, lines: list[Drawn]) -> list[Floats]:
    """Points of lines that lie in a frame."""
    points = [np.asarray(line.at) for line in lines]
    return [at for at in points if (at[:, 1] >= frame.top - 1e-6).all() and (at[:, 1] <= frame.bottom + 1e-6).all()]


def values_beside(canvas: Recorder, frame: Box) -> tuple[Floats, Floats]:
    """Heights, px, and values of the scale beside a frame."""
    beside = [one for one in canvas.of("text", Paint.GREY) if one.at[0] < frame.left and one.more[2] == 1.0]
    of = [one for one in beside if frame.top - 1.0 <= one.at[1] <= frame.bottom + 1.0]
    return np.array([one.at[1] for one in of]), np.array(
        [float(one.more[0].replace(",", "").replace("−", "-")) for one in of]
    )


def times_below(canvas: Recorder, frame: Box) -> tuple[Floats, Floats]:
    """Places, px, and values of the time axis below the last frame."""
    of = [one for one in canvas.of("text", Paint.GREY) if 0.0 < one.at[1] - frame.bottom < 30.0 and one.more[2] == 0.5]
    return np.array([one.at[0] for one in of]), np.array([float(one.more[0]) for one in of])


def test_the_lines_are_the_means_of_the_history_on_the_scales_beside_them() -> None:
    run, canvas = plain(), drawn(plain())
    frames = frames_of(canvas)
    middle_s = (run.history.t_s[:-1] + run.history.t_s[1:]) / 2.0
    means = (
        run.history.velocity_um_s.mean / 1e3,
        run.history.acceleration_um_s2.mean / 1e3,
        run.history.following_error_um.mean,
        run.history.force_n.mean,
    )
    at_px, at_s = times_below(canvas, frames[-1])
    for frame, mean in zip(frames, means, strict=True):
        scale = np.polyfit(*values_beside(canvas, frame), 1)
        (line,) = within(frame, canvas.of("polyline", Paint.X))
        t_s, shown = np.polyval(np.polyfit(at_px, at_s, 1), line[:, 0]), np.polyval(scale, line[:, 1])
        px = abs(scale[0])
        # Where bins are pooled, a step between them is drawn over the width of some.
        off = np.abs(np.interp(middle_s, t_s, shown) - mean[:, 0])
        assert np.quantile(off, 0.9) < 0.5 * px
        assert shown.max() == pytest.approx(mean[:, 0].max(), abs=max(1.0 * px, 0.1 * np.ptp(mean[:, 0])))


def edges(canvas: Recorder) -> list[Drawn]:
    """The lower and the upper edge of Y in each panel, and in the sample of the legend: solid lines, beside dashes."""
    return [
        one for one in canvas.of("polyline", Paint.Y) if np.ptp(np.asarray(one.at)[:, 0]) > 12.0
    ]  # longer than a dash


def test_areas_and_edges_reach_from_the_lowest_to_the_highest() -> None:
    run, canvas = plain(), drawn(plain())
    envelope = run.history.force_n
    frame = frames_of(canvas)[3]
    scale = np.polyfit(*values_beside(canvas, frame), 1)
    areas = [ring for one in canvas.of("region", Paint.X_PALE) for ring in one.at]
    (area,) = [ring for ring in areas if ring[:, 1].min() >= frame.top and ring[:, 1].max() <= frame.bottom]
    low, high = within(frame, edges(canvas))
    for axis, points in enumerate((area, np.concatenate([low, high]))):
        shown = np.polyval(scale, points[:, 1])
        span = (shown.min(), shown.max())
        assert span == pytest.approx((envelope.low[:, axis].min(), envelope.high[:, axis].max()), abs=abs(scale[0]))


@pytest.mark.parametrize("width_px", [600, 1600])
def test_what_lasts_for_one_bin_of_thousands_shows_in_any_size(width_px: int) -> None:
    low, high = np.full((2000, 2), -1.0), np.full((2000, 2), 1.0)
    high[777, 0], low[1231, 1] = 40.0, -30.0
    force = Envelope(low, high, np.zeros((2000, 2)))
    flat = Envelope._make(np.zeros((2000, 2)) for _ in range(3))
    history = History(np.linspace(0.0, 27.0, 2001), flat, flat, flat, flat, force)
    canvas = drawn(replace(plain(), history=history), width_px)
    frame = frames_of(canvas)[3]
    scale = np.polyfit(*values_beside(canvas, frame), 1)
    tops = np.concatenate([ring for one in canvas.of("region", Paint.X_PALE) for ring in one.at])
    tops = tops[(tops[:, 1] > frame.top) & (tops[:, 1] < frame.bottom)]
    low_edge, _ = within(frame, edges(canvas))
    assert np.polyval(scale, tops[:, 1]).max() == pytest.approx(40.0, abs=0.1)  # N
    assert np.polyval(scale, low_edge[:, 1]).min() == pytest.approx(-30.0, abs=0.1)


def test_x_and_y_differ_in_grey_too() -> None:
    canvas = drawn(plain())
    lines = [one for one in canvas.of("polyline", Paint.X) if len(one.at) > 3]
    solid = {id(one) for one in edges(canvas)}
    dashes = [one for one in canvas.of("polyline", Paint.Y) if id(one) not in solid]
    assert len(solid) == 2 * 4 + 2
    assert len(lines) == 4
    assert len(dashes) > 100
    assert max(np.ptp(np.asarray(one.at)[:, 0]) for one in dashes) <= 11.0 + 1e-6  # px, of a dash
    assert not canvas.of("region", Paint.Y_PALE)


def test_limits_show_as_levels_where_they_are_near_and_are_told_where_they_are_not() -> None:
    near, far = drawn(scenario_run("lost-steps")), drawn(plain())
    assert {"limit X, Y 150 N", "pull-out X, Y 6 µm", "feed 0.0437 mm/s", "jump feed 10 mm/s"} <= set(near.texts)
    force = frames_of(near)[3]
    scale = np.polyfit(*values_beside(near, force), 1)
    levels = [one.at for one in near.of("dashed", Paint.ERROR) if np.ptp(one.at[:, 0]) == force.right - force.left]
    heights = [np.polyval(scale, at[0, 1]) for at in levels if force.top < at[0, 1] < force.bottom]
    assert sorted(heights) == pytest.approx([-150.0, 150.0], abs=0.5)  # N
    assert any(text.startswith("limit X") and text.endswith(", outside") for text in far.texts)
    assert not any(np.ptp(one.at[:, 0]) > 1000.0 for one in far.of("dashed", Paint.ERROR))


def test_blocks_stand_where_they_run() -> None:
    run, canvas = plain(), drawn(plain())
    frame = frames_of(canvas)[0]
    px, s = times_below(canvas, frames_of(canvas)[-1])
    numbers = {one.more[0]: one.at[0] for one in canvas.of("text", Paint.GREY) if -45.0 < one.at[1] - frame.top < 0.0}
    ends_s = np.cumsum(run.block_time_s)
    middle_px = np.polyval(np.polyfit(s, px, 1), ends_s - run.block_time_s / 2.0)
    assert [numbers[str(block)] for block in (1, 2, 3)] == pytest.approx(middle_px.tolist(), abs=0.1)
    ticks = [one.at[0, 0] for one in canvas.of("polyline", Paint.GREY) if one.at[1, 1] == frame.top]
    assert ticks == pytest.approx(np.polyval(np.polyfit(s, px, 1), [0.0, *ends_s]).tolist(), abs=0.1)


def test_pauses_and_losses_are_marked_through_all_panels_and_named_in_the_legend() -> None:
    canvas, run = drawn(scenario_run("lost-steps")), scenario_run("lost-steps")
    frames = frames_of(canvas)
    px, s = times_below(canvas, frames[-1])
    upright = [one for one in canvas.of("dashed", Paint.ERROR) if one.at[0, 0] == one.at[1, 0]]
    assert [(one.at[0, 1], one.at[1, 1]) for one in upright] == [(frame.top, frame.bottom) for frame in frames]
    assert upright[0].at[0, 0] == pytest.approx(np.polyval(np.polyfit(s, px, 1), run.losses[0].t_s), abs=0.6)
    assert canvas.texts.count("3B402 X") == 2
    assert {"steps lost", "pause"} <= set(canvas.texts)
    paused = drawn(plain())
    assert paused.texts.count(PAUSE) == 2
    assert "steps lost" not in paused.texts


def test_after_a_trip_the_machine_stands() -> None:
    run, canvas = scenario_run("servo-trip"), drawn(scenario_run("servo-trip"))
    frames = frames_of(canvas)
    shaded = [one.at for one in canvas.of("box", Paint.GRID)]
    assert [(box.top, box.right, box.bottom) for box in shaded] == [(f.top, f.right, f.bottom) for f in frames]
    assert canvas.texts.count("the machine stands") == 4
    lines = [np.asarray(one.at) for one in canvas.of("polyline", Paint.X) if len(one.at) > 3]
    assert max(line[:, 0].max() for line in lines) == pytest.approx(shaded[0].left, abs=0.5)
    assert "3B403 X" in canvas.texts
    assert not drawn(plain()).of("box", Paint.GRID)
    assert run.ended


@pytest.mark.parametrize("width_px", [SIZES_PX["thumbnail"], 600, 1600, SIZES_PX["a3"]])
@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("name", ["servo-trip", "lost-steps"])
def test_no_text_overlaps_another_or_leaves_the_page(name: str, language: str, width_px: int) -> None:
    canvas = drawn(scenario_run(name), width_px, language)
    boxes = canvas.text_boxes()
    page = Box(0.0, 0.0, canvas.width_px, canvas.height_px)
    assert all(page.holds(box) for box in boxes)
    shrunk = [Box(box.left + 1.0, box.top + 1.0, box.right - 1.0, box.bottom - 1.0) for box in boxes]
    assert [(a, b) for a, b in combinations(shrunk, 2) if a.meets(b)] == []


def test_english_and_chinese_both_say_everything() -> None:
    english, chinese = drawn(scenario_run("servo-trip")), drawn(scenario_run("servo-trip"), language="zh")
    assert len(english.drawn) == len(chinese.drawn)
    title = scenario_run("servo-trip").scenario.title
    said = [(a, b) for a, b in zip(english.texts, chinese.texts, strict=True) if a == b and a != title]
    assert not any(any(char.isalpha() for char in a) for a, _ in said if a != "3B403 X")


def test_it_is_drawn_as_pixels_in_the_dark_and_as_svg() -> None:
    dark = draw_motion(pixels(600, DARK, "zh"), plain()).image()
    assert dark.size[0] == 600
    assert dark.getpixel((2, 2)) == DARK[Paint.PAGE]
    svg = draw_motion(drawing(), plain()).document("motion", 1600)
    assert svg.startswith("<?xml")
    assert len(svg) < 400_000  # bytes: a page holds it in both languages


def test_golden() -> None:
    assert_golden(draw_motion(pixels(600), scenario_run("lost-steps")).image(), "motion.png")


@pytest.mark.deeper
def test_a_program_of_thousands_of_blocks_shows_round_numbers_that_do_not_overlap() -> None:
    text = " ".join(f"B{20 + block % 3}B0B{20 + block % 3}GXL{1 + 2 * (block % 2)}" for block in range(2000)) + " DD"
    canvas = drawn(run_text(text))
    frame = frames_of(canvas)[0]
    numbers = [one for one in canvas.of("text", Paint.GREY) if -45.0 < one.at[1] - frame.top < 0.0]
    shown = [int(one.more[0]) for one in numbers]
    assert {500, 1000, 1500, 2000} <= set(shown)
    assert all(number % 50 == 0 for number in shown)
    assert len(canvas.of("polyline", Paint.GREY)) <= MOST_NUMBERS + 1
    assert "every 50th block number" in canvas.texts


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.04374, "0.0437"),
        (15_750.0, "15,750"),
        (6.0, "6"),
        (1e6, "1,000,000"),
        (1234.56, "1,234.6"),
        (999_999.96, "1,000,000"),
        (1e17, "100,000,000,000,000,000"),
    ],
)
def test_values_are_in_figures_that_people_write(value: float, text: str) -> None:
    assert in_figures(value) == text
