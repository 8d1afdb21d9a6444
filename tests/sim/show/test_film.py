"""Frames of films: what they show against the run itself; and the keys of the replay."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from runs import plain_scenario, scenario_recording

from parser.program import parse_program
from sim.base.progress import silent
from sim.run.course import Course, course_of
from sim.run.recording import recorded
from sim.run.report import build_report
from sim.show.draw.layout import Box, View, centred
from sim.show.draw.style import LIGHT, Paint
from sim.show.film.cut_map import FULL, CutMap, Discs, Span, discs_of
from sim.show.film.readout import bar_of, last_event, read_out
from sim.show.film.scene import layout_for, near_runs, outlines_um
from sim.show.film.screen import THE_WIRE, WIRE, Look, Screen
from sim.show.film.writers import FilmClock
from sim.show.keys import OF_PAGE
from sim.show.texts import Words
from sim.show.texts.texts import texts
from sim.table.trace import Trace

PART = """
B300 B0 B300 GX L1
B0 B300 B300 GY L2
B600 B0 B600 GX L3
B0 B600 B600 GY L4
B600 B0 B600 GX L1
B0 B300 B300 GY L2
B300 B0 B300 GX L3
D
B1200 B0 B1200 GX L1
D
B400 B0 B400 GX L1
DD
"""
"""A square that a slug comes free of, a pause, a jump, a pause, and a slot."""

LOOK = Look(640, 400, "light", "en")
SPEED = 20.0


@pytest.fixture(scope="module")
def course() -> Iterator[Course]:
    with recorded(parse_program(PART), plain_scenario(), silent) as recording:
        yield course_of(recording)


@pytest.fixture(scope="module")
def tripped() -> Course:
    return course_of(scenario_recording("servo-trip"))


@pytest.fixture
def screen(course: Course) -> Screen:
    return Screen(course, LOOK)


def shown(screen: Screen, t_s: float) -> np.ndarray:
    return screen.frame(t_s, screen.whole, SPEED)


def like(frame: np.ndarray, paint: Paint, most: int = 3) -> np.ndarray:
    """(h, w) True where a pixel has about this colour."""
    return np.abs(frame.astype(int) - LIGHT[paint]).max(axis=2) <= most


def inside(frame: np.ndarray, screen: Screen) -> np.ndarray:
    left, top, right, bottom = (round(side) for side in screen.layout.plot)
    return frame[top:bottom, left:right]


def swept(course: Course, until_s: float) -> shapely.Geometry:
    """What the wire has cut by a time: its way as lines with half a kerf on all sides, jumps left out."""
    trace = course.trace.until(until_s)
    way, cuts = trace.wire_um, ~course.run.toolpath.is_jump[trace.row[1:]]
    lines = shapely.line_merge(shapely.union_all(shapely.linestrings(np.stack([way[:-1], way[1:]], axis=1)[cuts])))
    return shapely.buffer(shapely.simplify(lines, 0.5), course.run.scenario.wire.reach_um, quad_segs=16)


def depth_px(region: shapely.Geometry, screen: Screen) -> np.ndarray:
    """(h, w) px from the middle of every third pixel of the plot to the border of a region, above 0 inside of it."""
    plot, view = screen.layout.plot, screen.whole
    x, y = np.meshgrid(np.arange(plot.left, plot.right, 3.0) + 0.5, np.arange(plot.top, plot.bottom, 3.0) + 0.5)
    places = shapely.points((x - view.x_px) / view.px_per_um, (view.y_px - y) / view.px_per_um)
    shapely.prepare(region)
    away = shapely.distance(shapely.boundary(region), places) * view.px_per_um
    return np.where(shapely.contains(region, places), away, -away)


@pytest.mark.parametrize(("seconds", "fps"), [(10.0, 25), (0.5, 1), (3.3, 30), (600.0, 60)])
def test_a_film_lasts_as_long_as_asked_and_holds_its_end(seconds: float, fps: int) -> None:
    clock = FilmClock(seconds, fps, 1234.5)
    times = clock.times_s
    assert clock.frames == max(round(seconds * fps), 2)
    assert times[0] == 0.0
    assert np.diff(times) == pytest.approx(clock.speed / fps)
    held = min(1.0, seconds / 10.0)
    assert clock.speed * (seconds - held) == pytest.approx(1234.5)
    assert abs((times >= 1234.5).sum() / fps - held) <= 1.0 / fps + 1e-9


@given(st.integers(1, 60), st.floats(0.5, 60.0), st.sampled_from([1, 10]))
def test_delays_add_up_to_the_film(fps: int, seconds: float, grain_ms: int) -> None:
    clock = FilmClock(seconds, fps, 10.0)
    delays = clock.delays_ms(grain_ms)
    assert len(delays) == clock.frames
    assert all(delay % grain_ms == 0 and abs(delay - 1000 / fps) < grain_ms for delay in delays)
    assert sum(delays) == pytest.approx(1000 * clock.frames / fps, abs=grain_ms)


def test_a_moment_is_what_trace_and_steps_say(course: Course) -> None:
    trace, steps = course.trace, course.steps
    for sample in range(0, len(trace), 97):
        moment = course.at(float(trace.t_s[sample]))
        assert moment.wire_um == pytest.approx(trace.wire_um[sample])
        done = int((steps.t_s <= moment.t_s).sum())
        place = (steps.x_um[done - 1], steps.y_um[done - 1]) if done else (0, 0)
        assert tuple(moment.commanded_um) == place
        if course.border_s[moment.row] + 0.1 < moment.t_s:
            assert moment.row == trace.row[sample]
        assert moment.cuts == (moment.row != 7)
    x, y = course.at(course.border_s[1] / 2.0).wire_um  # on its way along +X from the origin
    assert course.at(course.border_s[1] / 2.0).deviation_um == pytest.approx(abs(y), abs=1e-9)
    assert 100.0 < x < 200.0


def test_times_past_the_ends_are_the_ends(course: Course) -> None:
    assert course.at(-5.0).t_s == 0.0
    assert course.at(1e9).t_s == course.duration_s
    assert course.at(1e9).row == len(course.run.toolpath) - 1


@pytest.mark.parametrize("share", [0.0, 0.2, 0.55, 0.8, 0.95, 1.0])
def test_kerf_shows_where_the_wire_was_and_nowhere_else(course: Course, screen: Screen, share: float) -> None:
    t_s = share * course.duration_s
    plot = inside(shown(screen, t_s), screen)
    kerf, deep = like(plot, Paint.KERF)[::3, ::3], depth_px(swept(course, t_s), screen)
    wire = screen.whole.to_px(course.at(t_s).wire_um) - screen.layout.plot[:2]
    y, x = 3.0 * np.mgrid[: kerf.shape[0], : kerf.shape[1]] + 0.5
    clear = np.hypot(x - wire[0], y - wire[1]) > 30.0  # of the marks
    assert not kerf[(deep < -1.0) & clear].any()
    if share:
        covered = (deep > 1.0) & clear
        assert kerf[covered].mean() > 0.9  # but for the lines of the path


def test_the_last_frame_shows_the_whole_kerf_and_no_slug(course: Course, screen: Screen) -> None:
    plot = inside(shown(screen, course.duration_s + SPEED), screen)
    deep = depth_px(swept(course, course.duration_s), screen)
    x, y = screen.whole.to_px(np.array([-100.0, 150.0])) - screen.layout.plot[:2]
    assert not like(plot, Paint.KERF)[::3, ::3][deep < -1.0].any()
    assert (plot[round(y), round(x)] == LIGHT[Paint.PAGE]).all()


def test_a_piece_turns_grey_and_is_gone(course: Course, screen: Screen) -> None:
    (piece,) = course.pieces
    x, y = (round(at) for at in screen.whole.to_px(np.array([-100.0, 150.0])).tolist())
    seen = [tuple(shown(screen, piece.t_s + after)[y, x]) for after in (-0.01, 0.01, 0.69 * SPEED, 0.71 * SPEED)]
    assert seen == [LIGHT[paint] for paint in (Paint.WORK, Paint.SLUG, Paint.SLUG, Paint.PAGE)]


@pytest.mark.parametrize(
    "order",
    [
        (0.9, 0.1),
        (0.1, 0.9),
        (0.99, 0.0),
        (0.4, 0.41),
    ],
)
def test_a_frame_does_not_depend_on_those_before(course: Course, screen: Screen, order: tuple[float, float]) -> None:
    for share in order:
        last = shown(screen, share * course.duration_s)
    assert (last == shown(Screen(course, LOOK), order[-1] * course.duration_s)).all()


def test_a_wire_that_goes_back_leaves_no_kerf_ahead(course: Course, screen: Screen) -> None:
    begin_s = 0.5 * course.duration_s
    view = centred(course.at(begin_s).wire_um, 1.0, screen.layout.plot)
    for back_s in (0.0, 0.15, 0.3, 0.45):
        last = screen.frame(begin_s - back_s, view, SPEED)
        assert (last == Screen(course, LOOK).frame(begin_s - back_s, view, SPEED)).all()


@pytest.mark.parametrize("share", [0.1, 0.33, 0.7, 0.9])
def test_the_wire_is_marked_where_it_is(course: Course, screen: Screen, share: float) -> None:
    moment = course.at(share * course.duration_s)
    marked = np.argwhere(like(inside(shown(screen, moment.t_s), screen), THE_WIRE))
    place = screen.whole.to_px(moment.wire_um) - screen.layout.plot[:2]
    near = marked[np.hypot(*(marked[:, ::-1] - place).T) < WIRE]  # jumps have this colour, too
    assert near.mean(axis=0)[::-1] + 0.5 == pytest.approx(place, abs=1.5)


def test_the_commanded_place_is_marked_apart(course: Course, screen: Screen) -> None:
    view = View(20.0, 0.0, 0.0)
    moment = course.at(0.1 * course.duration_s)
    plot = screen.layout.plot
    middle = np.array([(plot.left + plot.right) / 2, (plot.top + plot.bottom) / 2])
    x, y = (middle - view.to_px(moment.commanded_um)).tolist()
    frame = screen.frame(moment.t_s, View(20.0, x, y), SPEED)
    dark = np.argwhere(like(frame, Paint.INK, most=40)[round(plot.top) : round(plot.bottom), : round(plot.right)])
    near = dark[(np.abs(dark[:, ::-1] - (middle - (0, round(plot.top)))) < 12).all(axis=1)]
    assert near.mean(axis=0)[::-1] + 0.5 + (0, round(plot.top)) == pytest.approx(middle, abs=1.0)


def test_the_strip_is_filled_up_to_the_moment(course: Course, screen: Screen) -> None:
    bar = bar_of(screen.layout.strip, screen.layout.unit)
    for share in (0.0, 0.25, 0.75, 1.0):
        line = shown(screen, share * course.duration_s)[round((bar.top + bar.bottom) / 2)]
        done = (np.abs(line.astype(int) - LIGHT[Paint.KERF]).max(axis=1) <= 3).sum()
        assert done == pytest.approx(share * (bar.right - bar.left), abs=25)  # borders of blocks, and the cursor


def test_read_outs_tell_block_place_and_times(course: Course) -> None:
    moment = course.at(0.2 * course.duration_s)
    en, zh = ([line.value for line in read_out(course, moment, SPEED, Words(lang))] for lang in ("en", "zh"))
    assert en[:2] == [f"block {moment.row + 1} of 9", "B600 B0 B600 GX L3"]
    assert zh[0] == f"程序段 {moment.row + 1} / 9"
    assert en[2] == f"{moment.wire_um[0] / 1000:.3f} mm".replace("-", "−")
    assert len(en) == len(zh) == len(read_out(course, course.at(0.0), SPEED, Words("en")))


def test_what_happens_is_told_when_it_does(course: Course) -> None:
    say = Words("en")
    (piece,) = course.pieces
    assert last_event(course, piece.t_s + 0.01, 0.1, say).value == "a slug comes free"
    pause_s = float(course.border_s[7])
    assert last_event(course, pause_s + 0.01, 0.001, say).value == ""
    assert last_event(course, pause_s + 0.001, 0.001, say).value == "paused (D) behind block 7"
    assert last_event(course, course.duration_s, SPEED, say).value == "end of the program"


def test_of_what_falls_together_the_finding_is_told() -> None:
    course = course_of(scenario_recording("drops-early"))
    (piece,) = course.pieces
    assert last_event(course, piece.t_s + 1e-6, 1.0, Words("en")).value.startswith("3B406")


def test_a_trip_ends_the_run_and_says_so(tripped: Course) -> None:
    trip = tripped.run.ended
    assert trip is not None
    assert tripped.duration_s == trip.t_s < tripped.run.plan.duration_s
    assert tripped.steps.t_s[-1] <= trip.t_s
    assert last_event(tripped, tripped.duration_s, 1.0, Words("en")).value == "the X servo tripped: the run ends here"
    assert "X 轴" in last_event(tripped, tripped.duration_s, 1.0, Words("zh")).value


@pytest.mark.alike(2)
@pytest.mark.parametrize("name", ["wire-lag-corner", "wire-lag-arc", "backlash", "friction", "servo-trip"])
def test_no_frame_shows_more_deviation_than_the_report(name: str) -> None:
    course, say = course_of(scenario_recording(name)), Words("en")
    most_um = build_report(course.run)["deviation"]["wire"]["max_um"]
    clock = FilmClock(20.0, 50, course.duration_s)
    shown = []
    for moment in map(course.at, clock.times_s.tolist()):
        assert moment.deviation_um <= most_um + 5e-7, moment  # µm: half of the report's last digit
        (line,) = (one for one in read_out(course, moment, clock.speed, say) if one.name == say("film.deviation"))
        shown.append(0.0 if line.value == "–" else float(line.value.removesuffix(" µm")))
    assert max(shown) <= round(most_um, 2)
    if most_um > 1.0:  # where the servo trips it is 0.07 µm, for a moment
        assert max(shown) > 0.5 * most_um


def brute(discs: Discs, plot: Box) -> np.ndarray:
    """(h, w, k) px from the middle of each pixel to the middle of each disc."""
    x, y = np.meshgrid(np.arange(plot.left, plot.right) + 0.5, np.arange(plot.top, plot.bottom) + 0.5)
    return np.hypot(x[..., None] - discs.centers[:, 0], y[..., None] - discs.centers[:, 1])


@given(st.integers(0, 2**32 - 1), st.floats(1.0, 9.0))
def test_a_pixel_is_cut_once_the_first_disc_covers_it(seed: int, radius: float) -> None:
    rng = np.random.default_rng(seed)
    plot = Box(10.0, 20.0, 50.0, 45.0)
    radii = radius * rng.choice([1.0, 0.8], 12)  # passes reach farther and less far
    discs = Discs(np.sort(rng.uniform(0, 9, 12)), rng.uniform((0, 10), (60, 55), (12, 2)), radii)
    cut_map, away = CutMap(discs, plot), brute(discs, plot) - radii
    for front in (0, 1, 5, 12):
        levels = cut_map.levels(front, cut_map.whole)
        assert (levels[(away[..., :front] < -1.4).any(axis=2)] == FULL).all()
        assert (levels[(away[..., :front] > 1.4).all(axis=2)] == 0).all()
    box = cut_map.changed(3, 7)
    differ = cut_map.levels(3, cut_map.whole) != cut_map.levels(7, cut_map.whole)
    differ[box.of] = False
    assert not differ.any()
    assert cut_map.changed(4, 4) == Span(0, 0, 0, 0)


@pytest.mark.parametrize("radius", [2.0, 30.0, 400.0])
def test_discs_lie_on_the_way_and_leave_nothing_between_them(radius: float) -> None:
    way = np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 80.0], [20.0, 80.0]])
    trace = Trace(np.array([0.0, 10.0, 20.0, 30.0]), way, way, way, np.array([0, 0, 1, 2]))
    radii = np.array([radius, radius, 1.1 * radius])
    discs = discs_of(trace, np.array([False, True, False]), View(1.0, 0.0, 100.0), Box(0.0, 0.0, 120.0, 120.0), radii)
    x, y = discs.centers.T
    assert discs.radius == pytest.approx(np.where(y == 100.0, radius, 1.1 * radius))
    assert (((y == 100.0) & (x <= 100.0)) | (y == 20.0)).all()  # and none on the jump
    assert discs.t_s == pytest.approx(np.where(y == 100.0, x / 10.0, 20.0 + (100.0 - x) / 8.0))
    gaps = np.diff(x[y == 100.0])
    assert (gaps**2 / (8.0 * radius)).max() <= max(0.1, 1.0 / (8.0 * radius)) + 1e-9


@given(st.integers(320, 3840), st.integers(240, 2160))
def test_boxes_of_a_frame_lie_in_it_and_apart(width: int, height: int) -> None:
    layout = layout_for(width, height)
    boxes = [layout.head, layout.plot, layout.panel, layout.strip]
    assert all(Box(0.0, 0.0, width, height).holds(box) for box in boxes)
    assert all(box.right - box.left > 30 and box.bottom - box.top > 15 for box in boxes)
    assert not any(one.meets(other) for one in boxes for other in boxes if one is not other)


@given(st.lists(st.tuples(st.integers(-50, 150), st.integers(-50, 150)), min_size=2, max_size=12))
def test_chords_that_may_show_are_kept_in_order(points: list[tuple[int, int]]) -> None:
    box = Box(0.0, 0.0, 100.0, 100.0)
    line = np.array(points, dtype=np.float64)
    kept = [tuple(map(tuple, chord)) for run in near_runs(line, box) for chord in pairwise(run)]
    near = [c for c in pairwise(line) if (np.maximum(*c) >= 0).all() and (np.minimum(*c) <= 100).all()]
    assert kept == [(tuple(first), tuple(last)) for first, last in near]


def test_pieces_are_drawn_up_into_their_kerf_and_no_further() -> None:
    course = course_of(scenario_recording("drops-early"))
    (piece,), (drawn,) = course.pieces, outlines_um(course)
    kerf = swept(course, course.duration_s)
    assert drawn.buffer(1e-6).contains(piece.what.outline_um)
    assert drawn.difference(piece.what.outline_um.buffer(1.0)).difference(kerf.buffer(1.0)).area < 1.0
    assert drawn.contains(shapely.Point(0.0, 5000.0))  # of the slot that is cut when the piece is free


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_line_that_is_followed_has_the_name_that_it_has_in_the_replay(language: str) -> None:
    """It is the path that runs: beside a contour none that is programmed."""
    say = Words(language)
    assert say("film.ideal") == say("replay.ideal_path")


def test_each_key_does_one_thing_and_has_its_text() -> None:
    pressed = [name for key in OF_PAGE for names in key.actions.values() for name in names]
    assert len(pressed) == len(set(pressed))
    assert {key.does for key in OF_PAGE} == {
        name.removeprefix("does_") for name in texts("keys") if name.startswith("does_")
    }


def test_the_drawing_that_a_cut_is_held_against_lies_in_the_plot_and_in_the_legend() -> None:
    """Of an opening of 10 mm by 6 mm about the origin, which is cut too wide: all else is as without it."""
    recording = scenario_recording("wrong-side")
    alone = recording._replace(run=replace(recording.run, comparison=None))
    held, other = (Screen(course_of(each), Look(1280, 720, "light", "en")) for each in (recording, alone))
    differs = (held.frame(0.0, held.whole, SPEED) != other.frame(0.0, other.whole, SPEED)).any(axis=2)
    y, x = np.nonzero(inside(differs, held))
    place = np.stack([x + held.layout.plot.left, y + held.layout.plot.top], axis=1)
    corners = held.whole.to_px(np.array([[-5000.0, 3000.0], [5000.0, -3000.0]]))
    assert np.stack([place.min(axis=0), place.max(axis=0) + 1]) == pytest.approx(corners, abs=2.0)  # px
    assert differs[:, round(held.layout.panel.left) :].any(), "the legend has it"


@pytest.mark.parametrize(("name", "leans"), [("taper-round-on-square", True), ("keyhole", False)])
def test_both_contours_of_a_leaning_wire_are_shown(name: str, leans: bool) -> None:
    course = course_of(scenario_recording(name))
    first = inside(shown(Screen(course, LOOK), 0.0), Screen(course, LOOK))
    assert like(first, Paint.TOP).any() == leans
