"""Programs with a tab, run on a machine: the part hangs on it to the last, and then falls."""

from pathlib import Path

import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace

from sim.cam.maker import Made, made
from sim.convert.wanted import Wanted
from sim.setup.machine.machine import load_machine
from sim.setup.making import Making
from sim.setup.scenario import Scenario

PASSES = (180.0, 120.0, 100.0)


def run(path: Path, making: Making) -> Made:
    found = made(path, making, Wanted("3b"), Scenario("part", path.with_suffix(".3b"), load_machine("dk7740")))
    assert isinstance(found, Made)
    return found


@pytest.mark.parametrize(
    "making",
    [
        Making(passes_um=PASSES, tab_um=2000.0),
        Making(passes_um=PASSES[1:], tab_um=1500.0, overcut_um=200.0, direction="cw"),
        Making(passes_um=PASSES[2:], tab_um=1000.0, corners="round"),
    ],
)
def test_slug_and_part_fall_when_they_should(tmp_path: Path, making: Making) -> None:
    def plate(space: Modelspace) -> None:
        space.add_circle((0, 0), 2)
        space.add_lwpolyline([(-5, -4), (5, -4), (5, 4), (-5, 4)], close=True)

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
