"""What people see of passes: their tables, tones and names, and nothing of all that where every edge is cut once."""

import re

import numpy as np
import pytest
from browser import OpenPage
from golden_pictures import assert_golden
from page_checks import complaints
from recorder import recording_sheet
from trimmed import offset_run, trimmed_run, untrimmed_run

from parser.findings.catalogue import LANGUAGES
from parser.geometry.along import headings, places, to_left
from parser.shape.passes import Pass
from sim.run.course import course_of
from sim.run.recording import Recording
from sim.run.report import build_report
from sim.show.draw.sheet import pixels
from sim.show.draw.style import (
    LIGHT,
    PASS_DASHES,
    TONES,
    Paint,
    paint_of_pass,
    tones_of,
)
from sim.show.film.readout import read_out
from sim.show.film.screen import Look, Screen
from sim.show.pictures.cut.of_run import draw_cut_of_run
from sim.show.pictures.motion.picture import draw_motion
from sim.show.replay.document import replay_page
from sim.show.report_page.page import report_page
from sim.show.report_page.results import pass_table
from sim.show.terminal.run import summary_rows
from sim.show.texts import Words

NAMES = ["pass 1 of 4, forward", "pass 2 of 4, back", "pass 3 of 4, tab, back", "pass 4 of 4, tab, forward"]


def test_passes_have_their_tones_and_later_ones_share_the_last() -> None:
    passes = [Pass(0, number, 0, 0, False, True, False, 0.0, 1) for number in range(1, 9)]
    assert paint_of_pass(1) is Paint.KERF
    assert [tone.name.en for tone in tones_of(passes[:2])] == ["pass 1", "pass 2"]
    tones = tones_of(passes)
    assert len({tone.paint for tone in tones}) == len(tones) == 5
    assert tones[-1].name.en == "pass 5 and later"
    assert paint_of_pass(8) is paint_of_pass(5)


def test_the_summary_has_a_row_for_each_pass() -> None:
    rows = [(name, text) for name, text in summary_rows(trimmed_run().run) if name.startswith("pass")]
    assert [name for name, _ in rows] == [f"pass {number} of 4" for number in range(1, 5)]
    assert re.fullmatch(r"forward, offset 120 µm, takes 200 µm, .* s", rows[0][1])
    assert re.fullmatch(r"back, offset 100 µm, takes 20 µm, .* s", rows[1][1])
    assert rows[2][1].startswith("tab, back, offset 120 µm")
    assert not [name for name, _ in summary_rows(untrimmed_run().run) if name.startswith("pass")]


def test_the_table_of_passes_says_what_each_is() -> None:
    columns = {
        column.head.en: column for column in pass_table(trimmed_run().run, build_report(trimmed_run().run)).columns
    }
    kinds = columns["kind"]
    assert [kinds.words[key].en for key in kinds.values] == ["rough cut", "trim", "tab", "tab"]
    assert [kinds.words[key].zh for key in kinds.values] == ["粗切", "修刀", "切支撑段", "切支撑段"]
    assert list(columns["first block"].values) == ["N2", "N6", "N10", "N12"]


@pytest.mark.parametrize(("recording", "has_table"), [(trimmed_run, True), (untrimmed_run, False)])
def test_the_page_has_the_table_where_there_are_trims(recording: object, has_table: bool) -> None:
    run = recording().run  # type: ignore[operator]
    assert ('data-table="passes"' in report_page(run, build_report(run), [])) is has_table


@pytest.mark.parametrize("paint", [Paint.IDEAL, Paint.ACTUAL])
def test_the_lines_of_passes_differ_without_colours(paint: Paint) -> None:
    """A rough cut is one line from end to end, each trim has dashes of its own; of one pass nothing is dashed."""
    trimmed, plain = trimmed_run(), untrimmed_run()
    drawn = draw_cut_of_run(recording_sheet(), trimmed.run, trimmed.pieces)
    lengths = [line_length(each.at) for each in drawn.of("polyline", paint)]
    unit = recording_sheet().unit
    long = PASS_DASHES[1]
    assert long is not None
    assert sum(length == pytest.approx(long[0] * unit, abs=1e-6) for length in lengths) > 10
    assert max(lengths) > 10.0 * long[0] * unit, "a rough cut"
    solid = draw_cut_of_run(recording_sheet(), plain.run, plain.pieces)
    assert len(solid.of("polyline", paint)) < 20


def line_length(points: np.ndarray) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def test_each_tone_has_other_dashes() -> None:
    assert len(set(PASS_DASHES)) == len(PASS_DASHES) == len(TONES)
    assert PASS_DASHES[0] is None


def legend_of(recording: Recording) -> list[str]:
    return draw_cut_of_run(recording_sheet(), recording.run, recording.pieces).texts


def test_the_picture_of_the_cut_has_a_tone_and_an_offset_for_each_pass() -> None:
    texts = legend_of(trimmed_run())
    for number, offset in enumerate(("0.120", "0.100", "0.120", "0.100"), 1):
        assert f"pass {number}, offset {offset} mm" in texts
    assert not [text for text in legend_of(untrimmed_run()) if re.match(r"pass \d", text)]


def test_in_the_picture_a_pass_covers_only_what_no_earlier_one_took() -> None:
    recording = trimmed_run()
    canvas = draw_cut_of_run(recording_sheet(), recording.run, recording.pieces)
    paints = [one.paint for one in canvas.of("polyline") if one.paint in {paint_of_pass(n) for n in range(1, 6)}]
    legend = 5  # samples of kerf and passes
    assert paints[-legend - 1] is Paint.KERF
    assert list(dict.fromkeys(paints[:-legend])) == [Paint.KERF, Paint.TRIM_3, Paint.TRIM_2, Paint.TRIM_1]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_film_names_the_pass_that_runs(language: str) -> None:
    say, course, once = Words(language), course_of(trimmed_run()), course_of(untrimmed_run())
    name, of = say("film.pass"), course.passes[1].pass_
    for row, value in ((of.first, {"en": "2 of 4, back", "zh": "第 2 刀（共 4 刀），反向"}[language]), (0, "–")):
        moment = course.at((course.border_s[row] + course.border_s[row + 1]) / 2.0)
        (line,) = (one for one in read_out(course, moment, 1.0, say) if one.name == name)
        assert line.value == value
    assert not [one for one in read_out(once, once.at(1.0), 1.0, say) if one.name == name]


def test_the_kerf_of_a_film_takes_the_tone_of_the_pass_that_went_over_it_last() -> None:
    course = course_of(trimmed_run())
    path, trim = course.run.toolpath, course.passes[1].pass_
    screen = Screen(course, Look(960, 540, "light", "en"))
    row = np.arange(trim.first, trim.last + 1)
    half = np.full(len(row), 0.5)
    beside = places(path, row, half) + 45.0 * to_left(headings(path, row, half))  # clear of the lines of the paths
    x, y = screen.whole.to_px(beside).astype(int).T
    for done, paint in ((trim.first, Paint.KERF), (trim.last + 1, Paint.TRIM_1)):
        frame = screen.frame(float(course.border_s[done]), screen.whole, 1.0)
        assert np.abs(frame[y, x].astype(int) - LIGHT[paint]).max() <= 3


@pytest.mark.deeper
def test_the_replay_names_and_groups_passes(open_page: OpenPage) -> None:
    page = open_page(replay_page(trimmed_run())).page
    page.wait_for_function("document.getElementById('loading').hidden")
    page.evaluate("drycut.player.seekBlock(5)")
    page.wait_for_function("document.querySelector('[data-out=pass]').textContent !== ''")
    assert page.text_content('[data-out="pass"]') == NAMES[1]
    assert page.locator(".pass-head").all_inner_texts() == NAMES
    tops = page.evaluate("[...document.querySelectorAll('.line')].map((line) => line.getBoundingClientRect().top)")
    heads = page.evaluate("[...document.querySelectorAll('.pass-head')].map((one) => one.getBoundingClientRect().top)")
    assert len({*tops, *heads}) == len(tops) + len(heads)  # no head covers a line
    assert complaints(page) == []


def test_passes_that_the_controller_makes_of_one_contour_have_no_heads_over_its_lines(open_page: OpenPage) -> None:
    page = open_page(replay_page(offset_run())).page
    page.wait_for_function("document.getElementById('loading').hidden")
    assert page.locator(".legend .pass").count() == 1
    assert page.locator(".pass-head").count() == 0
    assert page.locator(".line").count() == 8


def test_the_replay_of_a_contour_cut_once_has_nothing_of_passes(open_page: OpenPage) -> None:
    page = open_page(replay_page(untrimmed_run())).page
    page.wait_for_function("document.getElementById('loading').hidden")
    assert page.locator(".pass-head, [data-out=pass], .legend .pass, #bar.grouped").count() == 0


def test_the_picture_of_the_motion_has_a_band_for_each_pass() -> None:
    bands = {paint_of_pass(number) for number in range(1, 5)}
    drawn = [box for box in draw_motion(recording_sheet(), trimmed_run().run).of("box") if box.paint in bands]
    *passes, sample = drawn
    assert [box.paint for box in passes] == [paint_of_pass(number) for number in range(1, 5)]
    assert sample.paint is Paint.KERF
    assert not [box for box in draw_motion(recording_sheet(), untrimmed_run().run).of("box") if box.paint in bands]


def test_the_picture_of_a_cut_with_passes_is_the_golden_one() -> None:
    assert_golden(draw_cut_of_run(pixels(800), trimmed_run().run, None).image(), "cut-passes.png")
