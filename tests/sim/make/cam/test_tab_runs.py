"""Programs with a tab, run on a machine: the part hangs on it to the last, and then falls."""

from pathlib import Path
from typing import Literal

import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace

from parser.shape.passes import find_passes
from parser.toolpath import Point
from sim.make.cam.maker import MadeProgram, made_program, unproved
from sim.make.wanted import Wanted
from sim.setup.machine.machine import load_machine
from sim.setup.making import Making
from sim.setup.scenario import Scenario

PASSES = (180.0, 120.0, 100.0)


def run(path: Path, making: Making) -> MadeProgram:
    found = made_program(path, making, Wanted("3b"), Scenario("part", path.with_suffix(".3b"), load_machine("dk7740")))
    assert isinstance(found, MadeProgram)
    return found


@pytest.mark.alike(1)
@pytest.mark.parametrize(
    "making",
    [
        Making(passes_um=PASSES, tab_um=2000.0),
        Making(passes_um=PASSES[1:], tab_um=1500.0, overcut_um=200.0, direction="cw"),
        Making(passes_um=PASSES[2:], tab_um=1000.0, corners="round"),
        Making(passes_um=(100.0, 100.0), tab_um=1500.0),
        Making(passes_um=(101.0, 100.0, 100.0), tab_um=2500.0, overcut_um=200.0),
    ],
)
def test_slug_and_part_fall_when_they_should(tmp_path: Path, making: Making) -> None:
    def plate(space: Modelspace) -> None:
        space.add_circle((0, 0), 1)
        space.add_lwpolyline([(-3, -2.5), (3, -2.5), (3, 2.5), (-3, 2.5)], close=True)

    found = run(drawn(tmp_path, plate), making)
    assert found.proof is not None
    assert found.proof.findings == ()
    assert found.proof.run.remains is not None
    slug, part = found.proof.run.remains.pieces.freed
    assert (slug.kind, part.kind) == ("slug", "part")
    pauses = [stop.after for stop in found.program.toolpath.stops if stop.kind == "pause"]
    assert len(pauses) == 3  # behind the hole, behind the jump, before the tab is cut
    assert part.held_after_block == pauses[-1]
    assert part.freed.block > pauses[-1]
    assert not part.early


def test_passes_are_told_apart_where_the_open_stretch_ends_in_a_short_block(tmp_path: Path) -> None:
    def slot(space: Modelspace) -> None:
        space.add_lwpolyline([(-5, -3, 0), (5, -3, 1), (5, 3, 0), (-5, 3, 1)], format="xyb", close=True)

    # From the middle of the lower edge, 5 mm from where the arc ends: the stretch ends with a line of 30 µm.
    making = Making(passes_um=PASSES, tab_um=4970.0, direction="ccw", starts_um=(Point(0.0, -6000.0),))
    found = run(drawn(tmp_path, slot), making)
    assert found.plan.cuts[0].passes[0].along.length_um[-1] == pytest.approx(30.0, abs=1.0)
    passes = find_passes(found.program.toolpath).passes
    assert [(one.is_back, one.is_tab) for one in passes] == [
        (False, False),
        (True, False),
        (False, False),
        (False, True),
    ]
    assert [one.offset_um(100.0) for one in passes] == pytest.approx([180.0, 120.0, 100.0, 100.0], abs=2.0)
    assert found.proof is not None
    assert found.proof.findings == ()


def test_a_step_to_the_next_pass_behind_a_corner_is_no_turn_of_its_own(tmp_path: Path) -> None:
    def box(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (16, 0), (16, 10), (0, 10)], close=True)

    # The open stretch ends 100 µm behind the corner (0, 10), with a step of 8 µm back beside the side before it.
    making = Making(passes_um=(188.0, 180.0), tab_um=7900.0, corners="round", direction="ccw")
    making = making._replace(starts_um=(Point(8000.0, 12000.0),))
    scenario = Scenario("part", tmp_path / "part.3b", load_machine("dk7740"))
    found = unproved(drawn(tmp_path, box), making, Wanted("3b"), scenario)
    assert isinstance(found, MadeProgram)
    passes = find_passes(found.program.toolpath).passes
    assert [(one.is_back, one.is_tab) for one in passes][:2] == [(False, False), (True, False)]
    assert passes[2].is_tab


@pytest.mark.parametrize("passes_um", [PASSES[:1], PASSES[:2], PASSES, (100.0, 100.0)])
@pytest.mark.parametrize("direction", ["cw", "ccw"])
def test_a_tab_round_corners_is_not_read_as_a_jump(
    tmp_path: Path, passes_um: tuple[float, ...], direction: Literal["cw", "ccw"]
) -> None:
    def triangle(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (7, 0), (3, 6)], close=True)

    making = Making(passes_um=passes_um, tab_um=8000.0, direction=direction)
    scenario = Scenario("part", tmp_path / "part.3b", load_machine("dk7740"))
    found = unproved(drawn(tmp_path, triangle), making, Wanted("3b"), scenario)
    assert isinstance(found, MadeProgram)
    assert found.written.differs == ""
    assert not found.program.toolpath.is_jump.any()


def test_passes_are_told_apart_where_the_open_stretch_ends_beside_a_chamfer(tmp_path: Path) -> None:
    """Blocks of 120 µm, from the chamfer to where the tab begins, were taken for a step to the next pass."""

    def corner(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (5.13, 0), (5.13, 2.562), (0, 2.562)], close=True)

    making = Making(
        passes_um=(140.0, 120.0, 100.0),
        tab_um=2500.0,
        overcut_um=300.0,
        corners="chamfer",
        direction="ccw",
        entries_um=(Point(2560.0, 2562.0),),
    )
    done = run(drawn(tmp_path, corner), making)
    passes = find_passes(done.program.toolpath).passes
    assert [(each.number, each.is_back, each.is_tab) for each in passes][:3] == [
        (1, False, False),
        (2, True, False),
        (3, False, False),
    ]
    assert done.is_proved
