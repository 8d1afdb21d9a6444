"""Programs for a wire that leans: walls as drawn at all heights, and the angle in the text."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from runs import plain_scenario

from parser.write.iso import iso_choices
from sim.make.cam.lean.walls import wall_faults, walls_off
from sim.make.cam.maker import MadeProgram, NotMade, made_program, unproved
from sim.make.cam.of_scenario import wanted_of
from sim.make.cam.proof_run import as_run
from sim.make.cam.target import target_of
from sim.make.wanted import Wanted
from sim.setup.making import Making, ToMake, Writing
from sim.setup.part import SIDES
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings
from sim.setup.technology import Cut, Technology

ISO, SKD, TO_3B, TO_4B = (
    Wanted("iso", iso_choices("fast-wire")),
    Wanted("iso", iso_choices("skd2")),
    Wanted("3b"),
    Wanted("4b"),
)
USUAL = Making()
REACH_MM = 0.1
OFF_UM = 4.0
"""What steps, table and head let walls be off."""


def leaning(degrees: float, side: str = "right", **settings: object) -> Scenario:
    taper = TaperSettings(math.radians(degrees), SIDES[side], **settings)  # type: ignore[arg-type]
    return replace(plain_scenario(), taper=taper, thickness_mm=20.0)


def made(path: Path, scenario: Scenario, making: Making = USUAL, wanted: Wanted = ISO) -> MadeProgram:
    done = made_program(path, making, wanted, scenario)
    assert isinstance(done, MadeProgram)
    assert done.proof is not None
    return done


@pytest.fixture(name="plate", scope="module")
def plate_with_hole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A plate of 30 × 20 mm with a hole of 8 mm."""

    def draw(space: Modelspace) -> None:
        space.add_circle((15.0, 10.0), 4.0)
        space.add_lwpolyline([(0, 0), (30, 0), (30, 20), (0, 20)], close=True)

    return drawn(tmp_path_factory.mktemp("leaning"), draw)


@pytest.mark.parametrize("wanted", [ISO, SKD, TO_3B, TO_4B], ids=["fast-wire", "skd2", "3B", "4B"])
@pytest.mark.parametrize("side", ["left", "right"])
def test_walls_are_as_drawn_at_all_heights(plate: Path, wanted: Wanted, side: str) -> None:
    done = made(plate, leaning(3.0, side), wanted=wanted)
    assert done.proof is not None
    assert done.verdict == "pass"
    assert len({wall.z_um for wall in done.proof.walls}) == 4
    assert max(wall.off_um for wall in done.proof.walls) < OFF_UM
    notes = [note.name for note in done.plan.notes if note.name == "taper-beside"]
    assert len(notes) == (wanted.iso is None)


@pytest.mark.parametrize(("plane_mm", "corner"), [(0.0, "sharp"), (8.0, "cone"), (20.0, "cone")])
@pytest.mark.parametrize("side", ["left", "right"])
def test_a_hole_has_at_each_height_the_area_that_its_radius_says(
    tmp_path: Path, side: str, plane_mm: float, corner: str
) -> None:
    path = drawn(tmp_path, lambda space: space.add_circle((15.0, 10.0), 4.0))
    scenario = leaning(2.0, side, corner=corner, program_plane_um=1000.0 * plane_mm)
    done = made(path, scenario, Making(side="inside"))
    assert done.verdict == "pass"
    assert done.proof is not None
    assert done.proof.run is not None
    assert done.proof.run.tilted is not None
    tangent, cosine = math.tan(math.radians(2.0)), math.cos(math.radians(2.0))
    ccw = done.plan.cuts[0].passes[0].along.sweep_rad[0] > 0.0
    outwards = 1.0 if ccw == (side == "right") else -1.0
    for section in done.proof.run.tilted.sections:
        radius_mm = 4.0 - REACH_MM / cosine + outwards * (1e-3 * section.z_um - plane_mm) * tangent
        assert section.programmed_um2 == pytest.approx(1e6 * math.pi * radius_mm**2, rel=2e-4)


def test_the_text_says_the_angle_and_takes_it_back_and_passes_back_lean_to_the_other_side(plate: Path) -> None:
    passes = Making(passes_um=(200.0, 150.0, 100.0), picks=(), side="inside")
    done = made(plate, leaning(3.0), passes)
    lines = [line for line in done.data.decode().splitlines() if line.startswith(("G50", "G51", "G52"))]
    words = [line.split()[0] for line in lines]
    assert words[:6] == ["G52", "G50", "G51", "G50", "G52", "G50"]
    assert done.program.toolpath.taper is not None
    assert set(np.degrees(done.program.toolpath.taper.angle_rad).round(9).tolist()) <= {0.0, 3.0}


def test_the_header_has_the_offset_as_it_is_in_the_program_plane(plate: Path) -> None:
    scenario = leaning(10.0)
    wanted = wanted_of(ToMake(making=Making(), writing=Writing(form="detailed"), file=Path("p.3b")), "3b", scenario)
    assert wanted.offset_um == pytest.approx(100.0 / math.cos(math.radians(10.0)))
    done = made(plate, leaning(10.0), wanted=wanted)
    assert done.proof is not None
    assert "3B708" not in {finding.code for finding in done.proof.findings}


@pytest.mark.parametrize("wrong_deg", [2.9, 3.1])
def test_walls_of_another_angle_are_found(plate: Path, wrong_deg: float) -> None:
    done = made(plate, leaning(3.0))
    assert done.proof is not None
    assert done.proof.run is not None
    assert done.proof.run.tilted is not None
    assert done.drawn is not None
    plan = done.plan._replace(taper=TaperSettings(math.radians(wrong_deg), SIDES["right"]))
    target, _ = target_of(done.drawn, plan)
    assert target is not None
    walls = list(walls_off(done.proof.run.tilted, plan, target))
    by_mm = 20.0 * abs(math.tan(math.radians(wrong_deg)) - math.tan(math.radians(3.0)))
    top = [wall.off_um for wall in walls if wall.z_um == 20_000.0]
    assert top == pytest.approx([1000.0 * by_mm] * 2, abs=OFF_UM + 1.0)
    assert {fault.figure for fault in wall_faults(walls, 10.0)} == {1, 2}


def test_walls_that_lean_to_the_other_side_are_found(plate: Path) -> None:
    done = made(plate, leaning(3.0))
    assert done.proof is not None
    assert done.proof.run is not None
    assert done.proof.run.tilted is not None
    assert done.drawn is not None
    plan = done.plan._replace(taper=leaning(3.0, "left").taper)
    target, _ = target_of(done.drawn, plan)
    assert target is not None
    walls = list(walls_off(done.proof.run.tilted, plan, target))
    assert min(wall.off_um for wall in walls) > 500.0


@pytest.mark.parametrize(
    ("making", "wanted", "why"),
    [
        (Making(lag_um=20.0), ISO, "taper-lag"),
        (Making(common_edges=True), ISO, "taper-common"),
        (Making(no_core=True), ISO, "taper-coreless"),
        (Making(passes_um=(0.0,)), ISO, "taper-kept"),
        (Making(), ISO._replace(keeps=True), "taper-kept"),
    ],
)
def test_what_is_known_of_upright_wires_alone_is_refused_by_name(
    plate: Path, making: Making, wanted: Wanted, why: str
) -> None:
    done = made_program(plate, making, wanted, leaning(3.0))
    assert isinstance(done, NotMade)
    assert done.refusal.why == why


def test_a_radius_that_turns_over_is_no_proved_program(tmp_path: Path) -> None:
    """A hole of 1 mm closes 9.6 mm over its plane at 3°."""
    path = drawn(tmp_path, lambda space: space.add_circle((15.0, 10.0), 0.6))
    done = made(path, leaning(3.0, "left"), Making(side="inside"))
    assert done.proof is not None
    assert not done.is_proved
    assert "3B701" in {finding.code for finding in done.proof.counting}


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.alike(6)
def test_random_convex_parts_are_proved(tmp_path: Path, seed: int) -> None:
    """Convex parts at any angle and side, with cone corners about a face: all can be cut, and all are proved."""
    rng = np.random.default_rng(seed)
    number = int(rng.integers(5, 9))  # turns below 90°: an offset goes round sharper ones by arcs, which turn over
    turn = 2.0 * np.pi * (np.arange(number) + rng.uniform(0.2, 0.5, number)) / number
    corners = [(30.0 + 12.0 * math.cos(t), 30.0 + 10.0 * math.sin(t)) for t in turn.tolist()]
    path = drawn(tmp_path, lambda space: space.add_lwpolyline(corners, close=True))
    corner = "cone" if seed % 3 == 0 else "sharp"
    scenario = leaning(
        float(rng.uniform(0.5, 6.0)),
        "left" if seed % 2 else "right",
        corner=corner,
        # About a plane within the work a cone stands on another corner than that of the drawing.
        program_plane_um=float(rng.choice([0.0, 20_000.0] if corner == "cone" else [0.0, 8000.0, 20_000.0])),
    )
    done = made(path, scenario, wanted=TO_3B if seed % 4 == 0 else ISO)
    assert done.proof is not None
    assert [fault.name for fault in done.proof.faults] == []
    assert [finding.code for finding in done.proof.counting] == []
    assert max(wall.off_um for wall in done.proof.walls) < OFF_UM


@pytest.mark.parametrize(("offset_um", "fits"), [(100.0, True), (125.0, False)])
def test_the_gap_of_a_technology_is_that_of_an_upright_wire(plate: Path, offset_um: float, fits: bool) -> None:
    """At 20° an offset of 100 µm is 106.4 µm in the program plane: a gap of 10 µm fits it all the same."""
    row = Cut("steel", 180.0, 40.0, 1, 10.0, None, 2.0, None, None, None, None, None, None, None, None)
    scenario = replace(leaning(20.0), thickness_mm=40.0, technology=Technology("test", "measured", "here", (row,)))
    done = unproved(plate, Making(passes_um=(offset_um,)), ISO, scenario)
    assert isinstance(done, MadeProgram)
    names = [note.name for note in as_run(scenario, done.plan, done.program.toolpath).notes]
    assert ("technology" not in names) is fits
