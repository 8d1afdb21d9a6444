"""The tolerance of a path covers both the fit of arcs and their whole µm."""

from pathlib import Path

import numpy as np
import pytest
from ezdxf.layouts import Modelspace

from parser.write.draft import draft_of
from sim.cam.maker import Made, unproved
from sim.cam.tolerances import fit_share_um
from sim.convert.wanted import Wanted
from sim.setup.machine.machine import load_machine
from sim.setup.making import Making
from sim.setup.scenario import Scenario
from tests.tools.drawings_dxf import drawn, farthest_um, polylines

PLACES = 10_000


def _ellipse(space: Modelspace) -> None:
    space.add_ellipse((0, 0), (20, 0), 0.5)


@pytest.mark.parametrize("tolerance_um", [1.0, 2.0, 5.0])
def test_the_written_path_of_an_ellipse_is_within_the_tolerance(tolerance_um: float, tmp_path: Path) -> None:
    scenario = Scenario("ellipse", Path("ellipse.3b"), load_machine("dk7740"))
    making = Making(tolerance_um=tolerance_um, passes_um=(0.0,))
    made = unproved(drawn(tmp_path, _ellipse), making, Wanted("3b"), scenario)
    assert isinstance(made, Made)
    curves = draft_of(made.program.toolpath).curves
    angle = np.linspace(0.0, 2.0 * np.pi, PLACES)
    places = np.column_stack([20_000.0 * np.cos(angle), 10_000.0 * np.sin(angle)])
    assert farthest_um(places, polylines(curves.picked(curves.is_arc))) <= tolerance_um


@pytest.mark.parametrize("tolerance_um", [0.1, 0.5, 1.0, 2.0, 50.0])
def test_some_of_any_tolerance_is_left_for_whole_um(tolerance_um: float) -> None:
    assert 0.0 < fit_share_um(tolerance_um) < tolerance_um
