"""What a proof finds: nothing in a sound program, and each fault that is sown into a plan or into a text."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from made_programs import moved, plan_of, plate_file, proof_of, with_cut, with_cuts
from runs import machine, plain_scenario

from parser.geometry.curves import curves_between
from parser.toolpath import Point
from parser.write.iso import iso_choices
from sim.make.cam.model import CutPlan, FigureCut
from sim.make.cam.passes import figure_cut
from sim.make.cam.proof_model import Proof
from sim.make.wanted import Wanted
from sim.setup.making import Making

REACH = 100.0
INTO_THE_PART_UM = 600.0
WANTED = Wanted("3b"), Wanted("3b", form="detailed"), Wanted("4b"), Wanted("iso", iso_choices("fast-wire"))


@pytest.fixture(name="path", scope="module")
def plate_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return plate_file(tmp_path_factory.mktemp("plate"))


@pytest.fixture(name="sound", scope="module", params=WANTED)
def sound_program(path: Path, request: pytest.FixtureRequest) -> tuple[Wanted, Proof]:
    """What a sound program is written as, and its proof."""
    return request.param, proof_of(plan_of(path), path, request.param)


def told(proof: Proof) -> set[str]:
    """Names of faults, and codes of findings that count."""
    return {fault.name for fault in proof.faults} | {finding.code for finding in proof.counting}


def numbers(plan: CutPlan, kind: str) -> list[int]:
    return [cut.figure.number for cut in plan.cuts if cut.figure.kind == kind]


def round_hole(plan: CutPlan) -> int:
    return next(cut.figure.number for cut in plan.cuts if cut.figure.kind == "hole" and cut.figure.contour.is_arc.all())


def test_beyond_the_travel_nothing_else_speaks_against_a_program(path: Path) -> None:
    """The cut ends early: that the part does not come free, and differs from its drawing, comes of that alone."""
    proof = proof_of(plan_of(path), path, scenario=plain_scenario(machine=machine(travel_x_mm=4.0)))
    assert [finding.code for finding in proof.counting] == ["3B401"]
    assert proof.faults == ()
    assert proof.verdict == "fail"


@pytest.mark.alike(1)
def test_a_sound_program_is_proved_and_nothing_speaks_against_it(sound: tuple[Wanted, Proof]) -> None:
    wanted, proof = sound
    assert proof.verdict == "pass"
    assert told(proof) == set()
    assert "3B603" in {finding.code for finding in proof.findings}  # the corners of the square hole
    assert proof.path_um is not None
    assert proof.path_um < 0.1
    assert proof.comparison is not None
    assert proof.comparison.max_um < 5.0
    assert proof.run is not None
    assert [piece.kind for piece in proof.run.remains.pieces.freed] == ["slug", "slug", "part"]
    assert [note.name for note in proof.notes] == (["worked-in"] if wanted.language == "4b" else [])


def test_a_part_that_falls_before_its_trims_is_told(path: Path) -> None:
    assert told(proof_of(plan_of(path, Making(passes_um=(130.0, 100.0))), path)) == {"3B406"}


def test_three_passes_with_a_tab_are_proved(path: Path) -> None:
    proof = proof_of(plan_of(path, Making(passes_um=(180.0, 120.0, 100.0), tab_um=3000.0)), path)
    assert told(proof) == set()
    assert proof.verdict == "pass"


def test_another_offset_is_cut_with_the_wire_that_makes_it(path: Path) -> None:
    proof = proof_of(plan_of(path, Making(passes_um=(130.0,))), path)
    assert proof.verdict == "pass"
    assert [(note.name, note.values["gap"]) for note in proof.notes] == [("wire", 40.0)]
    assert proof.wire.reach_um == 130.0


def test_what_no_wire_of_the_machine_cuts_is_not_proved(path: Path) -> None:
    proof = proof_of(plan_of(path, Making(passes_um=(300.0,))), path)
    assert (proof.verdict, [one.name for one in proof.unproved]) == ("incomplete", ["no-wire"])
    assert proof.path_um is not None
    assert proof.path_um < 0.1


def test_a_program_on_the_contour_is_proved_by_its_path_and_that_is_said(path: Path) -> None:
    proof = proof_of(plan_of(path, Making(passes_um=(0.0,))), path)
    assert (proof.verdict, [one.name for one in proof.notes]) == ("pass", ["contour"])
    assert proof.path_um is not None
    assert proof.path_um < 0.1
    assert proof.comparison is None


@pytest.mark.alike(2)
def test_the_path_is_laid_in_the_middle_of_the_travel(sound: tuple[Wanted, Proof]) -> None:
    scenario = plain_scenario()
    assert scenario.start_mm is None
    run = sound[1].run
    assert run is not None
    low, high = (find(run.toolpath.start_um, axis=0) for find in (np.min, np.max))
    start = np.array(run.scenario.start_um) - run.toolpath.start_um[0]
    table = scenario.machine.table
    middle = start + 0.5 * (low + high)
    assert np.allclose(middle, [500.0 * table.travel_x_mm, 500.0 * table.travel_y_mm], atol=200.0)


def lead_through_the_part(cut: FigureCut) -> FigureCut:
    """Led out to the other side of the contour, `INTO_THE_PART_UM` past it, and back to the thread point."""
    entry, place = cut.thread.entry.place_um, cut.thread.place_um
    by = INTO_THE_PART_UM / math.dist(entry, place)
    other = (entry.x + by * (entry.x - place.x), entry.y + by * (entry.y - place.y))
    one = cut.passes[0]
    corners = np.array([one.along.end_um[-1], other, place])
    out = curves_between(corners[:-1], corners[1:], np.full((2, 2), np.nan), np.zeros(2))
    return cut._replace(passes=(one._replace(out=out),))


def on_the_other_side(cut: FigureCut, making: Making) -> FigureCut:
    figure = cut.figure._replace(runs_inside=not cut.figure.runs_inside)
    thread = cut.thread
    entry, place = thread.entry.place_um, thread.place_um
    other = Point(2.0 * entry.x - place.x, 2.0 * entry.y - place.y)
    return figure_cut(figure, thread._replace(place_um=other), (REACH,), making)


def test_a_lead_into_the_part_is_found(path: Path) -> None:
    plan = plan_of(path)
    number = round_hole(plan)
    proof = proof_of(with_cut(plan, number, lead_through_the_part), path)
    assert proof.verdict == "fail"
    assert "lead" in told(proof)
    lead = next(fault for fault in proof.faults if fault.name == "lead")
    assert lead.figure == number
    assert float(lead.values["depth"]) == pytest.approx(INTO_THE_PART_UM + REACH, abs=0.6)


def test_a_wire_on_the_wrong_side_is_found(path: Path) -> None:
    plan = plan_of(path)
    number = round_hole(plan)
    proof = proof_of(with_cut(plan, number, lambda cut: on_the_other_side(cut, plan.making)), path)
    assert {"side", "not-slug"} <= told(proof)
    assert {fault.figure for fault in proof.faults} == {number}


@pytest.mark.alike(1)
@pytest.mark.parametrize("by_um", [70.0, 97.0, 103.0, 130.0])
def test_a_path_at_another_offset_is_found(path: Path, by_um: float) -> None:
    plan = plan_of(path)
    number = round_hole(plan)
    proof = proof_of(
        with_cut(plan, number, lambda cut: figure_cut(cut.figure, cut.thread, (by_um,), plan.making)), path
    )
    off = [fault for fault in proof.faults if fault.name in {"path", "uncut"}]
    assert {fault.figure for fault in off} == {number}
    assert max(float(fault.values["off"]) for fault in off) == pytest.approx(abs(by_um - REACH), abs=0.6)


def test_a_fit_that_is_too_coarse_is_found(path: Path) -> None:
    """A circle of R 1.5 mm as 42 chords: 1.5 (1 − cos(π / 42)) mm = 4.20 µm off, where 2 µm are asked."""
    plan = plan_of(path)
    number = round_hole(plan)

    def coarse(cut: FigureCut) -> FigureCut:
        angle = np.linspace(0.0, 2.0 * np.pi, 43)
        corner = np.array([3000.0, 3000.0]) + 1500.0 * np.column_stack([np.cos(angle), np.sin(angle)])
        corner[-1] = corner[0]
        chords = curves_between(corner[:-1], corner[1:], np.full((42, 2), np.nan), np.zeros(42))
        figure = cut.figure._replace(contour=chords, entity=np.repeat(cut.figure.entity[:1], 42))
        return figure_cut(figure, cut.thread, (REACH,), plan.making)

    proof = proof_of(with_cut(plan, number, coarse), path)
    off = [fault for fault in proof.faults if fault.name in {"path", "uncut"}]
    assert {fault.figure for fault in off} == {number}
    assert max(float(fault.values["off"]) for fault in off) == pytest.approx(4.20, abs=0.8)
    coarse_is_asked = plan._replace(making=plan.making._replace(tolerance_um=5.0))
    assert proof_of(with_cut(coarse_is_asked, number, coarse), path).verdict == "pass"


@pytest.mark.alike(1)
@pytest.mark.parametrize("kind", ["hole", "outline"])
def test_a_figure_that_is_not_cut_is_missing(path: Path, kind: str) -> None:
    plan = plan_of(path)
    number = numbers(plan, kind)[0]
    proof = proof_of(with_cuts(plan, [cut for cut in plan.cuts if cut.figure.number != number]), path)
    assert "missing" in told(proof)


def test_a_figure_that_is_cut_twice_is_told(path: Path) -> None:
    plan = plan_of(path)
    proof = proof_of(with_cuts(plan, [plan.cuts[0], *plan.cuts]), path)
    assert "twice" in told(proof)


def test_a_figure_that_is_not_drawn_is_told(path: Path) -> None:
    plan = plan_of(path)

    def elsewhere(cut: FigureCut) -> FigureCut:
        away = moved(cut.figure.contour, 40_000.0, 0.0)
        thread = cut.thread
        place, entry = thread.place_um, thread.entry
        at = entry._replace(place_um=Point(entry.place_um.x + 40_000.0, entry.place_um.y))
        thread = thread._replace(place_um=Point(place.x + 40_000.0, place.y), entry=at)
        return figure_cut(cut.figure._replace(contour=away), thread, (REACH,), plan.making)

    number = round_hole(plan)
    assert {"stray", "missing"} <= told(proof_of(with_cut(plan, number, elsewhere), path))


@pytest.mark.alike(1)
@pytest.mark.parametrize("passes_um", [(180.0, 120.0, 100.0), (130.0, 100.0)])
def test_passes_in_the_wrong_order_are_found(path: Path, passes_um: tuple[float, ...]) -> None:
    plan = plan_of(path, Making(passes_um=passes_um, returning="one-way"))
    number = round_hole(plan)
    turned = with_cut(plan, number, lambda cut: cut._replace(passes=cut.passes[::-1]))
    assert "3B312" in told(proof_of(turned, path))


@pytest.mark.alike(1)
@pytest.mark.parametrize(
    "mend",
    [
        lambda text: text.replace("DD\n", "B7B0B7GXL1\nDD\n"),
        lambda text: text.replace("B1400B0B1400", "B1390B0B1390", 1),
        lambda text: text.replace("D\n", "", 1),
    ],
)
def test_a_text_that_is_not_what_was_planned_is_found(path: Path, mend: Callable[[str], str]) -> None:
    plan = plan_of(path)
    proof = proof_of(plan, path, mend=mend)
    assert proof.verdict == "fail"
    assert told(proof) & {"differs", "written"}
