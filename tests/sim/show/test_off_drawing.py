"""What is drawn of a cut that is off its drawing: strips as wide as it is off, or so many times as wide as it says."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from recorder import Recorder, recording_sheet
from runs import scenario_recording, scenario_run

from parser.geometry.curves import Curves
from sim.cut.sizes import Sizes
from sim.measure.compare.result import OffSizes, Strips, off_sizes, strips_of
from sim.run.dryrun import DryRun
from sim.run.recording import pieces_of_run
from sim.show.draw.style import Paint
from sim.show.pictures.cut.lines import times_wider
from sim.show.pictures.cut.of_run import cut_of_run, draw_cut_of_run
from sim.show.pictures.cut.picture import Shapes, layout_of
from sim.show.replay.document import replay_document


@pytest.fixture(name="wrong", scope="module")
def run_on_the_wrong_side() -> DryRun:
    return scenario_run("wrong-side")


def off_of(run: DryRun) -> Strips:
    assert run.comparison is not None
    found = strips_of(run.comparison)
    assert found is not None
    return found


def test_places_lie_on_the_edge_and_their_feet_on_the_drawing(wrong: DryRun) -> None:
    off = off_of(wrong)
    # The scenario is an opening of 10 mm by 6 mm with corners of 1 mm, about the origin: in closed form.
    outline = shapely.box(-4000, -2000, 4000, 2000).buffer(1000.0, quad_segs=2048).exterior
    assert shapely.distance(outline, shapely.points(off.foot_um)).max() < 0.2
    away = np.hypot(*(off.edge_um - off.foot_um).T)
    assert away == pytest.approx(shapely.distance(outline, shapely.points(off.edge_um)), abs=0.3)
    assert wrong.comparison is not None
    assert off.widest_um == pytest.approx(wrong.comparison.edge_max_um, abs=0.3)
    assert set(off.side.tolist()) == {-1}, "the wire cut into the plate all round"


def test_a_cut_that_is_as_drawn_has_none() -> None:
    comparison = scenario_run("die").comparison
    assert comparison is not None
    assert strips_of(comparison) is None


def test_strips_are_filled_to_scale_where_that_is_seen(wrong: DryRun) -> None:
    canvas = drawn(wrong)
    assert "cut too deep" in canvas.texts
    sheet = recording_sheet()
    px_per_um = layout_of(sheet, cut_of_run(wrong, pieces_of_run(wrong), sheet.say, Shapes())).page.view.px_per_um
    area_px = sum(shapely.Polygon(call.at[0]).area for call in canvas.of("region", Paint.OVERCUT))
    # 0.2 mm all round an opening of 10 mm by 6 mm with corners of 1 mm: 2 (8 + 4) + 2 π 1.1 along its middle.
    assert area_px / px_per_um**2 == pytest.approx(200.0 * (24_000.0 + 2 * np.pi * 1100.0), rel=0.02)


def test_strips_side_by_side_have_no_seams_between_them(wrong: DryRun) -> None:
    """A viewer that smooths the borders of two regions leaves a seam of the ground: a line lies over each of them."""
    calls = [call for call in drawn(wrong).drawn if call.paint is Paint.OVERCUT]
    strips = [call.at[0] for call in calls if call.what == "region"]
    above = calls[len(strips) : 2 * len(strips)]
    assert len(strips) > 8
    assert [call.what for call in calls[: len(strips)]] == ["region"] * len(strips)
    assert [call.what for call in above] == ["polyline"] * len(strips)
    assert all(np.array_equal(call.at, ring[[0, -1]]) for ring, call in zip(strips, above, strict=True))


def test_what_is_too_thin_to_be_seen_is_drawn_wider_and_says_so(wrong: DryRun) -> None:
    off = off_of(wrong)
    thin = off._replace(edge_um=off.foot_um + 0.02 * (off.edge_um - off.foot_um))
    sheet = recording_sheet()
    page = layout_of(sheet, cut_of_run(wrong, None, sheet.say, Shapes())).page
    assert (times_wider(off, page), times_wider(thin, page)) == (1, 20)
    assert thin.widest_um * page.view.px_per_um * 20 >= 7.0 * page.unit


def test_sizes_that_are_off_stand_beside_those_that_are_drawn(wrong: DryRun) -> None:
    """The wire runs 0.1 mm outside of the opening of 10 mm by 6 mm with R 1, and cuts 0.1 mm farther: 0.2 mm a side."""
    texts = drawn(wrong).texts
    assert {"10.397, drawn 10", "6.398", "drawn 6", "4× R 1.199, drawn 1"} <= set(texts)
    assert "10.4" not in texts, "what the program means is no size of the drawing"


def test_sizes_within_the_tolerance_are_those_that_are_meant(wrong: DryRun) -> None:
    assert wrong.remains is not None
    off, sizes = off_of(wrong), wrong.remains.sizes
    loose = off_sizes(off._replace(tolerance_um=400.0), sizes)
    assert loose == OffSizes(((None, None),), (None,) * 4)
    strict = off_sizes(off._replace(tolerance_um=397.6), sizes)
    assert [each is None for each in strict.widths[0]] == [True, False], "397.5 and 398.0 µm off"
    assert not [text for text in drawn(scenario_run("die")).texts if "drawn" in text]


def test_a_drawing_far_from_a_size_says_nothing_of_it(wrong: DryRun) -> None:
    assert wrong.remains is not None
    off, sizes = off_of(wrong), wrong.remains.sizes
    for elsewhere in (tuple(moved(loop, 5000.0) for loop in off.drawn), ()):
        assert off_sizes(off._replace(drawn=elsewhere), sizes) == OffSizes(((None, None),), (None,) * 4)
    assert off_sizes(off, Sizes((), (), ())) == OffSizes((), ())


def test_of_many_that_are_drawn_the_nearest_counts(wrong: DryRun) -> None:
    """A second opening lies 0.3 mm beside the one that is meant, which is 397.5 and 398.0 µm narrower than the cut."""
    assert wrong.remains is not None
    off, sizes = off_of(wrong), wrong.remains.sizes
    beside = tuple(moved(loop, 300.0) for loop in off.drawn)
    for loops in ((*off.drawn, *beside), (*beside, *off.drawn)):
        (widths,) = off_sizes(off._replace(drawn=loops), sizes).widths
        assert widths == off_sizes(off, sizes).widths[0]
        assert widths[0] == pytest.approx((10_397.468534, 10_000.0), abs=0.5)  # µm


def moved(curves: Curves, by_um: float) -> Curves:
    return replace(
        curves,
        start_um=curves.start_um + by_um,
        end_um=curves.end_um + by_um,
        center_um=curves.center_um + by_um,
    )


def test_a_replay_has_the_drawing_where_there_is_one() -> None:
    found = replay_document(scenario_recording("wrong-side"))["drawing"]
    assert found is not None
    assert set(found["kind"]) == {"line", "arc"}, "one loop, no jump"
    outline = shapely.box(-4000, -2000, 4000, 2000).buffer(1000.0, quad_segs=2048).exterior
    place = np.stack([found["place_x_um"], found["place_y_um"]], axis=1)
    assert shapely.distance(outline, shapely.points(place)).max() < 0.5
    assert replay_document(scenario_recording("backlash"))["drawing"] is None


def drawn(run: DryRun) -> Recorder:
    return draw_cut_of_run(recording_sheet(), run, pieces_of_run(run))
