"""In rounds over all figures, nothing falls with work in it that is still to be done, and the program is proved."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from made_programs import plan_of
from runs import plain_scenario

from parser.write.iso import iso_choices
from sim.make.cam.document import figure_sums
from sim.make.cam.maker import MadeProgram, made_program
from sim.make.cam.model import CutPlan
from sim.make.wanted import Wanted
from sim.measure.compare.rings import polygon
from sim.run.report import build_report
from sim.run.times.predicted import predicted
from sim.setup.making import DirectionWish, LayerWish, Making
from sim.setup.shop import Shop
from sim.show.report_page.figures import key_figures
from sim.show.terminal.run import print_summary

TRIMMED = (130.0, 100.0)
TO_3B = Wanted("3b")
TO_ISO = Wanted("iso", iso_choices("fast-wire"))
WAYS = {
    "rough first": Making(passes_um=TRIMMED, rough_first=True, tab_um=3000.0),
    "slugs by tabs": Making(slug_tab_um=1500.0),
    "both": Making(passes_um=TRIMMED, rough_first=True, slug_tab_um=1500.0, tab_um=3000.0),
    "three passes": Making(passes_um=(140.0, 120.0, 100.0), slug_tab_um=1500.0, tab_um=2500.0),
    "no tab": Making(rough_first=True, passes_um=TRIMMED),
}


def nested(space: Modelspace) -> None:
    """A part with a round and a square hole; in the round one stands a part with a hole of its own."""
    space.add_lwpolyline([(0, 0), (60, 0), (60, 30), (0, 30)], close=True)
    space.add_circle((16, 15), 12)
    space.add_lwpolyline([(36, 8), (52, 8), (52, 22), (36, 22)], close=True)
    space.add_lwpolyline([(10, 10), (22, 10), (22, 20), (10, 20)], close=True)
    space.add_circle((16, 15), 2.5)


def plate(space: Modelspace) -> None:
    space.add_lwpolyline([(0, 0), (40, 0), (40, 24), (0, 24)], close=True)
    space.add_circle((10, 12), 5)
    space.add_lwpolyline([(24, 7), (34, 7), (34, 17), (24, 17)], close=True)


def made(folder: Path, making: Making, wanted: Wanted = TO_3B) -> MadeProgram:
    done = made_program(drawn(folder, plate), making, wanted, plain_scenario())
    assert isinstance(done, MadeProgram)
    return done


def within(plan: CutPlan) -> dict[int, set[int]]:
    """Indices of the cuts that lie within each one, by polygons."""
    rings = [polygon(cut.figure.contour) for cut in plan.cuts]
    return {
        at: {other for other, inner in enumerate(rings) if other != at and ring.contains(inner)}
        for at, ring in enumerate(rings)
    }


def freed_by(plan: CutPlan) -> Iterator[tuple[int, int]]:
    """Of each cut the visit that lets its slug or its part fall: that of its tab, else of its first pass."""
    for at, cut in enumerate(plan.cuts):
        wanted = len(cut.passes) if cut.cut_off else 0
        yield at, next(n for n, v in enumerate(plan.visits) if v.cut == at and v.first <= wanted < v.past)


@pytest.mark.parametrize("name", WAYS)
def test_nothing_falls_with_work_in_it_that_is_still_to_be_done(tmp_path: Path, name: str) -> None:
    plan = plan_of(drawn(tmp_path, nested), WAYS[name])
    assert len(plan.cuts) == 5
    done = [(visit.cut, number) for visit in plan.visits for number in range(visit.first, visit.past)]
    assert sorted(done) == [(at, n) for at, cut in enumerate(plan.cuts) for n in range(len(cut.all_passes))]
    inner = within(plan)
    for at, when in freed_by(plan):
        assert all(number < when for number, visit in enumerate(plan.visits) if visit.cut in inner[at])
    for at, cut in enumerate(plan.cuts):
        own = [number for number, visit in enumerate(plan.visits) if visit.cut == at]
        passes = [n for number in own for n in range(plan.visits[number].first, plan.visits[number].past)]
        is_slug = bool(cut.cut_off) and cut.figure.runs_inside
        assert passes == ([0, len(cut.passes), *range(1, len(cut.passes))] if is_slug else sorted(passes))


def test_first_passes_come_before_the_others_and_slugs_fall_behind_all_of_them(tmp_path: Path) -> None:
    plan = plan_of(drawn(tmp_path, plate), WAYS["both"])
    kinds = [
        "rough" if visit.first == 0 else "trim" if visit.past <= len(plan.cuts[visit.cut].passes) else "off"
        for visit in plan.visits
        if plan.cuts[visit.cut].figure.kind == "hole"
    ]
    assert kinds == ["rough"] * 2 + ["off"] * 2 + ["trim"] * 2
    assert [visit.has_stop for visit in plan.visits] == [False] + [True] * (len(plan.visits) - 1)


def test_figure_after_figure_is_as_it_was(tmp_path: Path) -> None:
    plan = plan_of(drawn(tmp_path, plate), Making(passes_um=TRIMMED, tab_um=3000.0))
    assert [tuple(visit) for visit in plan.visits] == [
        (0, 0, 2, True, False),
        (1, 0, 2, True, True),
        (2, 0, 2, True, True),
        (2, 2, 3, False, True),
    ]


@pytest.mark.alike(5)
@pytest.mark.parametrize("wanted", [TO_3B, Wanted("4b"), TO_ISO], ids=["3b", "4b", "iso"])
@pytest.mark.parametrize("name", ["rough first", "slugs by tabs", "both", "three passes"])
def test_programs_in_rounds_are_proved(tmp_path: Path, name: str, wanted: Wanted) -> None:
    making = WAYS[name]._replace(tab_um=WAYS[name].tab_um or 2500.0)
    done = made(tmp_path, making, wanted)
    assert done.proof is not None
    assert done.is_proved, [*done.proof.counting, *done.proof.faults]
    run = done.proof.run
    assert run is not None
    assert run.remains is not None
    freed = sorted((piece.freed.contour, piece.kind) for piece in run.remains.pieces.freed)
    assert [kind for _, kind in freed] == ["slug", "slug", "part"]
    if making.slug_tab_um:  # behind both first passes: the second hole is cut off on from its own
        assert freed[0][0] >= 2
    sums = figure_sums(done)
    assert sum(one.blocks for one in sums) == int(np.count_nonzero(~done.program.toolpath.is_jump))
    assert all(len(one.spans) > 1 for one in sums[:2])
    _are_timed(done)


def _are_timed(done: MadeProgram) -> None:
    """Each pass takes as long as its length does at the feed of the cuts, with what rounding and corners add.

    Guides of a wire that lags run past the ends of passes, there and back by up to four lags: a run counts that to one
    pass, the plan to the other.
    """
    assert done.proof is not None
    run = done.proof.run
    assert run is not None
    feed_um_s = run.scenario.machine.feeds(run.scenario.thickness_mm).cut_um_s
    past_s = 8.0 * done.plan.making.lag_um / feed_um_s
    for cut, of in zip(done.plan.cuts, figure_sums(done), strict=True):
        lengths = [float(each.along.length_um.sum()) for each in cut.all_passes]
        assert [length / feed_um_s for length in lengths] == pytest.approx(of.pass_s, rel=0.02, abs=past_s), (
            cut.figure.number
        )


@pytest.mark.alike(7)
@pytest.mark.parametrize("wanted", [TO_3B, TO_ISO], ids=["3b", "iso"])
@pytest.mark.parametrize("passes_um", [(), (130.0, 100.0), (140.0, 120.0, 100.0)], ids=["one", "two", "three"])
@pytest.mark.parametrize(("slug_tab_um", "lag_um"), [(0.0, 0.0), (1500.0, 0.0), (1500.0, 20.0)])
def test_each_pass_and_each_cut_off_has_its_time(
    tmp_path: Path, passes_um: tuple[float, ...], slug_tab_um: float, lag_um: float, wanted: Wanted
) -> None:
    """By an odd number of passes the tab is cut on from their end, by an even one there and back."""
    making = Making(passes_um=passes_um, slug_tab_um=slug_tab_um, tab_um=2500.0, lag_um=lag_um)
    done = made(tmp_path, making, wanted)
    _are_timed(done)
    assert predicted(done.program, plain_scenario(), Shop()).passes == max(len(passes_um), 1), "a tab is no pass"


@pytest.mark.parametrize("making", [WAYS["three passes"], WAYS["both"]])
def test_what_a_tab_leaves_open_is_no_closure(
    tmp_path: Path, making: Making, capsys: pytest.CaptureFixture[str]
) -> None:
    """The first pass of a hole ends 1.5 mm from its start, as planned: no one is to look for a fault there."""
    done = made(tmp_path, making)
    assert done.proof is not None
    run = done.proof.run
    assert run is not None
    assert any(contour.closure_stepped_um > 1400.0 for contour in run.whole_contours)
    print_summary(run, None)
    printed = re.findall(r"closure.*│ (\S+) (\S+) exact", capsys.readouterr().out)
    assert printed
    assert all(unit == "µm" and float(exact) < 10.0 for exact, unit in printed)
    shown = next(each for each in key_figures(run, build_report(run)) if each.entry.endswith("closure_stepped_um"))
    assert shown.unit == "µm"


def test_a_hole_alone_is_cut_off_without_being_threaded_again(tmp_path: Path) -> None:
    path = drawn(tmp_path, lambda space: space.add_circle((0, 0), 5))
    making = Making(slug_tab_um=1500.0, passes_um=TRIMMED, side="inside")
    done = made_program(path, making, TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved
    assert [visit.is_threaded for visit in done.plan.visits] == [True, False, False]


def test_the_first_pass_leaves_a_slug_a_tab_as_long_as_asked_for(tmp_path: Path) -> None:
    plan = plan_of(drawn(tmp_path, plate), Making(slug_tab_um=1500.0))
    for cut in (cut for cut in plan.cuts if cut.cut_off):
        way = cut.passes[0].along
        gap = np.hypot(*(way.end_um[-1] - way.start_um[0]))
        assert gap == pytest.approx(1500.0, rel=0.05)


def test_holes_too_small_for_a_tab_are_cut_all_round_and_so_are_those_without_a_core(tmp_path: Path) -> None:
    path = drawn(tmp_path, plate)
    small = plan_of(path, Making(slug_tab_um=7_000.0))
    assert [bool(cut.cut_off) for cut in small.cuts] == [False, True, False]
    coreless = plan_of(path, Making(slug_tab_um=1500.0, no_core=True))
    holes = [cut for cut in coreless.cuts if cut.figure.runs_inside]
    assert [(cut.is_coreless, bool(cut.cut_off)) for cut in holes] == [(True, False)] * 2


def test_an_order_that_is_asked_for_holds_in_each_round(tmp_path: Path) -> None:
    path = drawn(tmp_path, plate)
    plan = plan_of(path, Making(passes_um=TRIMMED, rough_first=True, tab_um=3000.0, order=(2, 1, 3)))
    assert [plan.cuts[visit.cut].figure.number for visit in plan.visits] == [2, 1, 2, 1, 3, 3]


def test_ranks_keep_their_order_within_a_round(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        for number in range(4):
            space.add_circle((12 * number, 0), 4, dxfattribs={"layer": f"L{number}"})

    layers = tuple(LayerWish(f"L{number}", rank=3 - number) for number in range(4))
    making = Making(passes_um=TRIMMED, rough_first=True, side="inside", layers=layers)
    plan = plan_of(drawn(tmp_path, draw), making)
    order = [plan.cuts[visit.cut].figure.layer for visit in plan.visits]
    assert order == ["L3", "L2", "L1", "L0"] * 2


def hexagons(space: Modelspace) -> None:
    """Punches beside each other, of which a tab of 1.5 or 2.5 mm, and an overcut behind it, go round a corner."""
    for at, (radius, turn) in enumerate([(6.0, 0.17), (4.5, 0.4), (3.0, 0.9)]):
        angle = turn + np.arange(6) * np.pi / 3.0
        places = np.column_stack([14.0 * at + radius * np.cos(angle), radius * np.sin(angle)])
        space.add_lwpolyline(places.tolist(), close=True)


def plate_with_square_holes(space: Modelspace) -> None:
    """An overcut of 300 µm behind a tab of 1.5 mm goes round a corner of each hole, which is on no axis."""
    space.add_lwpolyline([(-10, -10), (10, -10), (10, 10), (-10, 10)], close=True)
    for x in (-5.0, 5.0):
        angle = 0.79 + np.arange(4) * np.pi / 2.0
        places = np.column_stack([x + 2.3 * np.cos(angle), 2.3 * np.sin(angle)])
        space.add_lwpolyline(places.tolist(), close=True)


@pytest.mark.parametrize(
    ("shapes", "passes_um", "direction"), [(hexagons, TRIMMED, "cw"), (plate_with_square_holes, (), "ccw")]
)
def test_a_wire_that_lags_comes_back_from_a_tab_round_corners_without_crossing_its_way(
    tmp_path: Path, shapes: Callable[[Modelspace], None], passes_um: tuple[float, ...], direction: DirectionWish
) -> None:
    """Its guides ran past each corner on the other side as they came back: 3B307, and 3B321 by up to 19 µm."""
    making = Making(
        passes_um=passes_um,
        direction=direction,
        rough_first=True,
        tab_um=2500.0,
        slug_tab_um=1500.0,
        overcut_um=300.0,
        lag_um=20.0,
    )
    done = made_program(drawn(tmp_path, shapes), making, TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.proof is not None
    assert [finding.code for finding in done.proof.counting] == []
    assert done.is_proved
