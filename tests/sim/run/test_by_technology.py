"""A run by a technology: each pass cuts as wide, as fast and with as much lag as its figures say, within their ±."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from drawings_dxf import drawn
from report_schema import complaints
from runs import plain_scenario, run_text

from controller.offset.shifted import Side
from parser.geometry.along import outline
from parser.shape.passes import find_passes, pass_numbers
from sim.run.dryrun import DryRun
from sim.run.report import build_report
from sim.setup.part import DrawingTarget, Offset, OffsetPass
from sim.setup.technology import Cut, Technology
from sim.show.draw.layout import Box, View
from sim.show.film.cut_map import discs_of
from sim.show.replay.document import block_columns

SQUARE = """B0B2000B2000GYL2 B2000B0B2000GXL1 B0B4000B4000GYL2 B4000B0B4000GXL3 B0B4000B4000GYL4 B2000B0B2000GXL1
B0B2000B2000GYL4 DD"""
WIDTH_UM = 4000.0
OFFSETS_UM = (160.0, 120.0, 100.0)
GAPS_UM, WITHIN_UM = (16.0, 11.0, 7.0), (3.0, 2.0, 1.0)
FEEDS_MM_MIN, RATES = (2.0, 4.0, 6.0), (0.3, 0.2, 0.1)
WIRE_UM, RADIUS_UM = 180.0, 90.0


def technology(lags_um: tuple[float | None, ...] = (None, None, None)) -> Technology:
    columns = zip(GAPS_UM, WITHIN_UM, FEEDS_MM_MIN, RATES, lags_um, strict=True)
    cuts = tuple(
        Cut("steel", WIRE_UM, 40.0, number, gap, within, feed, None, rate, lag, None, None, None, None, None)
        for number, (gap, within, feed, rate, lag) in enumerate(columns, start=1)
    )
    return Technology("test", "measured", "here", cuts)


def trimmed(**changes: object) -> DryRun:
    """A punch of 4 mm, roughed and trimmed twice, there and back."""
    passes = tuple(OffsetPass(by, "back" if at else "same") for at, by in enumerate(OFFSETS_UM))
    of = {"technology": technology(), "offset": Offset(passes, Side.RIGHT), "kerf": True}
    return run_text(SQUARE, **(of | changes))


@pytest.fixture(scope="module", name="run")
def run_of_square() -> DryRun:
    return trimmed()


def test_a_tab_is_cut_as_by_a_first_pass_and_a_lead_belongs_to_the_pass_behind_it(run: DryRun) -> None:
    path = run.toolpath
    passes = find_passes(path)
    number = pass_numbers(path, passes)
    assert [number[pass_.first] for pass_ in passes.passes] == [1, 2, 3]
    assert [*number] == sorted(number)
    tabbed = passes._replace(passes=(passes.passes[0], passes.passes[1], passes.passes[2]._replace(is_tab=True)))
    assert pass_numbers(path, tabbed)[passes.passes[2].first] == 1


def test_the_kerf_is_that_of_each_pass_with_its_own_gap(run: DryRun) -> None:
    """Held to shapely: the path of each row with a disc of its pass's reach, buffers of 64 chords a quarter."""
    assert run.remains is not None
    path = run.toolpath
    number = pass_numbers(path, find_passes(path))
    discs = []
    for row, of in enumerate(number.tolist()):
        curve = path.picked(slice(row, row + 1))
        places = np.concatenate([outline(curve), curve.end_um])
        discs.append(shapely.LineString(places).buffer(RADIUS_UM + GAPS_UM[of - 1], quad_segs=64))
    wanted, found = shapely.union_all(discs), run.remains.kerf.region_um
    apart = wanted.symmetric_difference(found)
    assert apart.area / wanted.length < 1.25  # µm: the run steps in whole µm, and the table lags
    narrow = shapely.union_all([disc.buffer(min(GAPS_UM) - max(GAPS_UM)) for disc in discs])
    assert found.symmetric_difference(narrow).area > 5.0 * apart.area  # what one gap for all would leave


def test_replay_and_film_cut_as_wide_as_the_pass(run: DryRun) -> None:
    """Each row of the replay's blocks, and each disc of the film."""
    number = pass_numbers(run.toolpath, run.passes)
    wanted = RADIUS_UM + np.array(GAPS_UM)[number - 1]
    assert block_columns(run)["reach_um"] == pytest.approx(wanted.tolist())
    plot, view = Box(0.0, 0.0, 4000.0, 4000.0), View(0.1, 2000.0, 2000.0)
    discs = discs_of(run.trace, run.toolpath.is_jump, view, plot, wanted * view.px_per_um)
    assert set(np.round(discs.radius, 6).tolist()) == {round(0.1 * (RADIUS_UM + gap), 6) for gap in GAPS_UM}
    assert block_columns(run_text(SQUARE))["reach_um"] is None


def test_widths_are_those_of_the_last_pass_with_its_gap_and_lie_within_its_interval(run: DryRun) -> None:
    """On both sides a punch keeps what the kerf does not reach of the offset; the nominal one, too."""
    assert run.remains is not None
    (box,) = run.remains.sizes.boxes
    grown = 2.0 * (OFFSETS_UM[-1] - RADIUS_UM - GAPS_UM[-1])
    assert [box.nominal_um.x, box.nominal_um.y] == pytest.approx([WIDTH_UM + grown] * 2, abs=0.1)
    assert [box.cut_um.x, box.cut_um.y] == pytest.approx([WIDTH_UM + grown] * 2, abs=3.0)
    for least, cut, most in zip(box.least_um, box.cut_um, box.most_um, strict=True):
        assert cut - least == pytest.approx(2.0 * WITHIN_UM[-1], abs=1e-9)
        assert most - cut == pytest.approx(2.0 * WITHIN_UM[-1], abs=1e-9)
    for distance in run.remains.sizes.distances:
        assert distance.most_um - distance.least_um == pytest.approx(4.0 * WITHIN_UM[-1], abs=1e-9)


def test_a_trim_takes_the_difference_of_offsets_less_that_of_gaps(run: DryRun) -> None:
    stocks = [figures.stock for figures in run.pass_figures]
    for (this, after), (gap, next_gap), stock in zip(pairwise(OFFSETS_UM), pairwise(GAPS_UM), stocks[1:], strict=True):
        assert stock is not None
        assert stock.mean_um == pytest.approx(this - after - (gap - next_gap), abs=0.5)


def test_each_pass_has_its_feed_and_the_time_lies_within_that_of_all(run: DryRun) -> None:
    assert run.pass_feed_um_s == pytest.approx([feed * 1000.0 / 60.0 for feed in FEEDS_MM_MIN])
    assert run.time_s is not None
    least, middle, most, level = run.time_s
    number = pass_numbers(run.toolpath, find_passes(run.toolpath))
    shares = [float(run.block_time_s[number == of].sum()) for of in (1, 2, 3)]
    assert level == 0.9
    assert middle == pytest.approx(sum(shares))
    assert most == pytest.approx(sum(share * (1.0 + rate) for share, rate in zip(shares, RATES, strict=True)))
    assert least == pytest.approx(sum(share / (1.0 + rate) for share, rate in zip(shares, RATES, strict=True)))


def test_a_program_that_holds_its_passes_is_fed_as_one_whose_controller_adds_them(run: DryRun) -> None:
    """The path of all three passes, written into the program: the technology finds them in it."""
    number = pass_numbers(run.toolpath, find_passes(run.toolpath))
    feeds = np.broadcast_to(np.asarray(run.feeds and run.feeds.cut_um_s), len(number))
    of_pass = [feed * 1000.0 / 60.0 for feed in FEEDS_MM_MIN]
    main = find_passes(run.toolpath).of_row >= 0
    assert feeds[main].tolist() == pytest.approx([of_pass[of - 1] for of in number[main].tolist()])


def test_the_wire_lags_in_the_passes_that_have_a_lag() -> None:
    """Where the rough cut alone lags by 40 µm, its corners are cut off by 0.482 lag, and no others."""
    run = trimmed(technology=technology((40.0, 0.0, 0.0)), kerf=False)
    worst = [figures.worst for figures in run.pass_figures]
    assert worst[0] is not None
    assert worst[0].deviation_um > 0.4 * 40.0
    for other in worst[1:]:
        assert other is not None
        assert other.deviation_um < 4.0


@pytest.mark.parametrize(
    ("gaps_um", "expected"),
    [
        ((16.0, 12.0, 10.0), []),  # the last reaches 100 µm, as its offset
        ((16.0, 12.0, 10.9), []),  # within ± 1 µm of it
        ((16.0, 12.0, 11.1), ["3B607"]),
        ((16.0, 12.0, 8.9), ["3B607"]),
        ((70.0, 12.0, 10.0), ["3B608", "3B608"]),  # the first reaches past what both trims would take
    ],
)
def test_offsets_and_trims_that_do_not_fit_their_kerfs_are_told(
    gaps_um: tuple[float, float, float], expected: list[str]
) -> None:
    gaps = zip(technology().cuts, gaps_um, strict=True)
    run = trimmed(
        technology=technology()._replace(cuts=tuple(cut._replace(gap_um=gap) for cut, gap in gaps)), kerf=False
    )
    assert [finding.code for finding in run.findings if finding.code[:3] == "3B6"] == expected


@pytest.mark.parametrize(("within_um", "expected"), [(1.0, []), (3.9, ["3B606"])])
def test_a_tolerance_that_holds_at_the_middle_of_the_gap_alone_is_told(
    tmp_path: Path, within_um: float, expected: list[str]
) -> None:
    """Off the drawing by less than 2 µm, and by as much more as the gap may be wider: 5 µm are allowed."""
    knows = technology()
    last = knows.cuts[2]._replace(gap_um=10.0, gap_within_um=within_um)
    drawing = DrawingTarget(
        drawn(tmp_path, lambda space: space.add_lwpolyline([(-2, 2), (2, 2), (2, 6), (-2, 6)], close=True)), fit=False
    )
    run = trimmed(technology=knows._replace(cuts=(*knows.cuts[:2], last)), drawing=drawing)
    assert run.comparison is not None
    assert [finding.code for finding in run.findings if finding.code[:3] == "3B6"] == expected


def test_the_report_says_the_technology_and_keeps_its_schema(run: DryRun) -> None:
    report = build_report(run)
    assert not complaints(report)
    assert report["technology"]["name"] == "test"
    assert [of_pass["gap_um"]["value"] for of_pass in report["technology"]["passes"]] == [*GAPS_UM]
    plain = build_report(run_text(SQUARE))
    assert not complaints(plain)
    (assumed,) = plain["technology"]["passes"]
    assert (plain["technology"]["name"], assumed["gap_um"]["grade"]) == (None, "assumed")
    assert assumed["gap_um"]["least"] < assumed["gap_um"]["value"] == 10.0 < assumed["gap_um"]["most"]


def test_without_a_technology_nothing_changes() -> None:
    """Kerf, feed and lag of one pass for all, as `[wire]` and the machine file have them."""
    offset = Offset(tuple(OffsetPass(by, "back" if at else "same") for at, by in enumerate(OFFSETS_UM)), Side.RIGHT)
    run = run_text(SQUARE, offset=offset, kerf=True)
    assert run.remains is not None
    assert np.unique(run.remains.kerf.reach_um).tolist() == [100.0]
    feed = plain_scenario().machine.feeds(40.0).cut_um_s
    assert run.pass_feed_um_s == (feed, feed, feed)
