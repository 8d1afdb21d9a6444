"""Holes without a core: nothing is left of the slug, nothing falls, and reading and check know such a program."""

import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from made_programs import plan_of
from runs import plain_scenario

from parser.findings.codes import Severity
from parser.geometry.along import outline
from parser.program import parse_program
from parser.shape.passes import find_passes
from parser.write.iso import iso_choices
from sim.check.path_checks import Demands, run_checks
from sim.make.cam import coreless
from sim.make.cam.maker import MadeProgram, NotMade, made_program, unproved
from sim.make.wanted import Wanted
from sim.setup.making import Making
from sim.setup.picks import pick_of

REACH_UM = 100.0
TO_3B = Wanted("3b")
NO_CORE = Making(no_core=True)
IN_A_DIE = Making(no_core=True, side="inside")
FORMS = ("circle", "rectangle", "slot", "hexagon", "triangle", "L", "turned")


def hole(space: Modelspace, form: str, size_mm: float) -> None:
    """A hole about (20, 20): of `size_mm` across, most of it."""
    half = 0.5 * size_mm
    corners = {
        "rectangle": [(-half, -0.6 * half), (half, -0.6 * half), (half, 0.6 * half), (-half, 0.6 * half)],
        "slot": [(-half, -0.4 * half), (half, -0.4 * half), (half, 0.4 * half), (-half, 0.4 * half)],
        "hexagon": [(half * math.cos(k * math.pi / 3.0), half * math.sin(k * math.pi / 3.0)) for k in range(6)],
        "triangle": [(-half, -0.5 * half), (half, -0.5 * half), (0.0, 0.8 * half)],
        "L": [(-half, -half), (half, -half), (half, 0.0), (0.0, 0.0), (0.0, half), (-half, half)],
        "turned": [(-half, -0.2 * half), (0.8 * half, -half), (half, 0.1 * half), (-0.7 * half, 0.9 * half)],
    }
    if form == "circle":
        space.add_circle((20.0, 20.0), half)
        return
    bulge = [0.0, 1.0] * 2 if form == "slot" else [0.0] * len(corners[form])
    points = [(20.0 + x, 20.0 + y, 0.0, 0.0, b) for (x, y), b in zip(corners[form], bulge, strict=True)]
    space.add_lwpolyline(points, close=True)


def in_a_plate(space: Modelspace, form: str, size_mm: float) -> None:
    hole(space, form, size_mm)
    space.add_lwpolyline([(10, 10), (30, 10), (30, 30), (10, 30)], close=True)


def proved(path: Path, making: Making, wanted: Wanted = TO_3B) -> MadeProgram:
    done = made_program(path, making, wanted, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.proof is not None
    return done


@pytest.mark.alike(8)
@pytest.mark.parametrize("size_mm", [0.8, 1.3, 4.0, 7.7])
@pytest.mark.parametrize("form", FORMS)
def test_the_kerf_leaves_nothing_of_the_slug_and_takes_nothing_of_the_part(
    tmp_path: Path, form: str, size_mm: float
) -> None:
    """Held against shapely's buffers of the plan's way, with discs of 256 sides."""
    (cut,) = plan_of(drawn(tmp_path, lambda space: hole(space, form, size_mm)), IN_A_DIE).cuts
    (only,) = cut.passes
    assert cut.is_coreless
    ways = [shapely.LineString(np.concatenate([outline(each), each.end_um[-1:]])) for each in (only.into, only.along)]
    kerf = shapely.union_all([way.buffer(REACH_UM, quad_segs=64) for way in ways])
    open_ = shapely.Polygon(outline(cut.figure.contour))
    assert len(shapely.get_rings(kerf)) == 1
    assert kerf.difference(open_.buffer(0.5)).area == 0.0
    assert open_.buffer(-REACH_UM).difference(kerf).area == 0.0
    assert np.hypot(*(only.into.start_um[0] - cut.thread.place_um)) == 0.0
    assert np.hypot(*(only.into.end_um[-1] - only.along.start_um[0])) < 1e-6


@pytest.mark.alike(3)
@pytest.mark.parametrize("form", FORMS)
def test_nothing_falls_but_the_part_and_reading_finds_the_passes(tmp_path: Path, form: str) -> None:
    making = NO_CORE._replace(passes_um=(180.0, 120.0, 100.0), tab_um=2000.0)
    done = proved(
        drawn(tmp_path, lambda space: in_a_plate(space, form, 3.0)), making, Wanted("iso", iso_choices("common"))
    )
    assert done.is_proved
    assert [cut.is_coreless for cut in done.plan.cuts] == [True, False]
    assert done.proof is not None
    assert done.proof.run is not None
    assert done.proof.run.remains is not None
    assert [piece.kind for piece in done.proof.run.remains.pieces.freed] == ["part"]
    passes = find_passes(done.program.toolpath).passes
    assert [(each.number, each.is_tab) for each in passes[:3]] == [(1, False), (2, False), (3, False)]
    assert [round(each.shift_um) for each in passes[:3]] == [80, 20, 0]
    found = run_checks(done.program, Demands()).findings
    assert [each.code for each in found if each.severity is not Severity.NOTE] == []


@pytest.mark.parametrize("form", ["circle", "rectangle"])
def test_an_opening_in_the_die_is_measured_though_no_slug_fell(tmp_path: Path, form: str) -> None:
    done = proved(drawn(tmp_path, lambda space: hole(space, form, 3.0)), IN_A_DIE)
    assert done.is_proved
    assert done.proof is not None
    assert done.proof.run is not None
    remains = done.proof.run.remains
    assert remains is not None
    assert remains.pieces.freed == ()
    assert len(remains.pieces.frame.cleared_um) == 1
    rounded_off = (4.0 - math.pi) * REACH_UM**2
    wanted = {"circle": math.pi * 1500.0**2, "rectangle": 3000.0 * 1800.0 - rounded_off}[form]
    assert remains.pieces.frame.cleared_um[0].area == pytest.approx(wanted, rel=3e-3)  # 3 µm all round


def test_a_slit_is_no_opening_that_was_cleared(tmp_path: Path) -> None:
    done = proved(drawn(tmp_path, lambda space: in_a_plate(space, "circle", 3.0)), Making())
    assert done.proof is not None
    assert done.proof.run is not None
    assert done.proof.run.remains is not None
    assert done.proof.run.remains.pieces.frame.cleared_um == ()


def test_turns_too_far_apart_fail_the_proof_and_the_hole_gets_its_core(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Rings of what is left between them fall: the run finds them, whatever the plan says."""
    monkeypatch.setattr(coreless, "_STEPS", (2.6,))
    monkeypatch.setattr(coreless, "_is_all_taken", lambda *_: True)
    path = drawn(tmp_path, lambda space: in_a_plate(space, "rectangle", 4.0))
    (planned, _) = plan_of(path, NO_CORE).cuts
    assert planned.is_coreless
    done = proved(path, NO_CORE)
    assert done.is_proved
    assert not any(cut.is_coreless for cut in done.plan.cuts)
    assert ("core-stays", {"figures": "1"}) in [(note.name, dict(note.values)) for note in done.plan.notes]


def test_wide_holes_and_odd_forms_keep_their_cores_and_it_is_said(tmp_path: Path) -> None:
    def both(space: Modelspace) -> None:
        space.add_circle((10, 10), 5.2)
        space.add_lwpolyline(
            [
                (21, 5),
                (23, 5),
                (23, 7),
                (27, 7),
                (27, 5),
                (29, 5),
                (29, 11),
                (27, 11),
                (27, 7.4),
                (23, 7.4),
                (23, 11),
                (21, 11),
            ],
            close=True,
        )
        space.add_circle((40, 10), 5.0)

    plan = plan_of(drawn(tmp_path, both), IN_A_DIE)
    assert {cut.figure.number: cut.is_coreless for cut in plan.cuts} == {1: False, 2: False, 3: True}
    assert ("core-stays", {"figures": "1, 2"}) in [(note.name, dict(note.values)) for note in plan.notes]


def test_a_hole_with_a_part_in_it_keeps_its_core(tmp_path: Path) -> None:
    """Turns would run over the island: it is a part, cut or not."""

    def island(space: Modelspace) -> None:
        in_a_plate(space, "rectangle", 8.0)
        space.add_circle((20.0, 20.0), 0.8, dxfattribs={"layer": "ISLAND"})

    path = drawn(tmp_path, island)
    for making in (NO_CORE, NO_CORE._replace(picks=(pick_of("layer:0", "pick"),))):
        cuts = plan_of(path, making).cuts
        assert (len(cuts), any(cut.is_coreless for cut in cuts)) == (2 if making.picks else 3, False)


@pytest.mark.parametrize(
    ("making", "wanted", "why"),
    [
        (IN_A_DIE._replace(passes_um=(0.0,)), Wanted("3b"), "no-core-offset"),
        (IN_A_DIE, Wanted("iso", iso_choices("robofil"), keeps=True), "kept-no-core"),
    ],
)
def test_what_no_controller_can_add_is_refused(tmp_path: Path, making: Making, wanted: Wanted, why: str) -> None:
    done = unproved(drawn(tmp_path, lambda space: hole(space, "circle", 3.0)), making, wanted, plain_scenario())
    assert isinstance(done, NotMade)
    assert done.refusal.why == why


def test_a_contour_that_comes_back_within_itself_is_read_as_before() -> None:
    """A small loop on the way round does not hold the way to it: the contour is all of it."""
    text = (
        "B0B5000B5000GYL2\nB5000B0B5000GXL1\nB0B1000B1000GYL4\nB0B500B500GYL4\nB0B500B500GYL4\nB1000B0B1000GXL3\n"
        "B0B1000B1000GYL4\nB1000B0B1000GXL1\nB0B1000B1000GYL2\nB500B0B500GXL1\nB0B3000B3000GYL4\nB5500B0B5500GXL3\nDD"
    )
    (only,) = find_passes(parse_program(text).toolpath).passes
    assert (only.first, only.last) == (0, 11)
