"""Arcs are fitted as near as the written path needs, whole µm and all, and not nearer."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from ezdxf.layouts import Modelspace

from parser.drawing.read import read_drawing
from parser.write.draft import draft_of
from sim.make.cam.maker import MadeProgram, fits_um, unproved
from sim.make.cam.proof import ToProve, proved
from sim.make.wanted import Wanted
from sim.setup.machine.machine import load_machine
from sim.setup.making import Making
from sim.setup.scenario import Scenario
from tests.tools.drawings_dxf import drawn, farthest_um, polylines

PLACES = 10_000
WANTED = Wanted("3b")
SCENARIO = Scenario("ellipse", Path("ellipse.3b"), load_machine("dk7740"))


def _ellipse(space: Modelspace) -> None:
    space.add_ellipse((0, 0), (20, 0), 0.5)


@pytest.fixture(name="path", scope="module")
def ellipse_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return drawn(tmp_path_factory.mktemp("ellipse"), _ellipse)


@cache
def _of_ellipse(path: Path, tolerance_um: float, offset_um: float) -> MadeProgram:
    making = Making(tolerance_um=tolerance_um, passes_um=(offset_um,))
    done = unproved(path, making, WANTED, SCENARIO)
    assert isinstance(done, MadeProgram)
    return done


@pytest.mark.deeper
@pytest.mark.parametrize(("tolerance_um", "most_blocks"), [(1.0, 33), (2.0, 25), (5.0, 18)])
def test_an_ellipse_takes_as_few_blocks_as_nodes_on_it_within_the_tolerance(
    tolerance_um: float, most_blocks: int, path: Path
) -> None:
    """The counts are those of a greedy fit through nodes on the ellipse, written in whole µm. The path is
    held against lines within 1 % of the tolerance of what is drawn."""
    done = _of_ellipse(path, tolerance_um, 0.0)
    curves = draft_of(done.program.toolpath).curves
    angle = np.linspace(0.0, 2.0 * np.pi, PLACES)
    places = np.column_stack([20_000.0 * np.cos(angle), 10_000.0 * np.sin(angle)])
    assert farthest_um(places, polylines(curves.picked(curves.is_arc))) <= 1.01 * tolerance_um
    assert len(curves) <= most_blocks


@pytest.mark.deeper
def test_a_path_beside_an_ellipse_takes_a_block_for_each_arc_and_two_for_its_leads(path: Path) -> None:
    done = _of_ellipse(path, 2.0, 100.0)
    assert done.plan.drawing.fit is not None
    assert len(done.program.toolpath) == done.plan.drawing.fit.arcs + 2 == 26


@pytest.mark.deeper
def test_a_fitted_contour_without_offset_or_leads_proves_its_path(path: Path) -> None:
    """It begins on an arc, at no whole µm: there is no lead on which a controller could begin to add an offset."""
    done = _of_ellipse(path, 2.0, 0.0)
    proof = proved(ToProve(done.program, done.plan, read_drawing(path), done.written, WANTED.bound_um), SCENARIO)
    assert (proof.verdict, [note.name for note in proof.notes]) == ("pass", ["contour"])
    assert proof.path_um is not None
    assert proof.path_um <= 2.0


@pytest.mark.parametrize("tolerance_um", [0.1, 0.5, 1.0, 2.0, 50.0])
@pytest.mark.parametrize("curves", [0, 30, 200, 10**6])
def test_fits_come_nearer_until_some_of_any_tolerance_is_left_for_whole_um(tolerance_um: float, curves: int) -> None:
    fits = fits_um(tolerance_um, curves)
    assert fits[0] == tolerance_um
    assert list(fits) == sorted(set(fits), reverse=True)
    assert 0.0 < fits[-1] <= max(tolerance_um - 0.5, 0.5 * tolerance_um)
    assert len(fits) * min(curves, 500) <= 3 * 500
