"""Axes out of square, of another scale, with pitch errors: the slides stand where a ruler would find them."""

from pathlib import Path

import numpy as np
import pytest
from runs import plain_scenario, run_text

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from sim.base.progress import silent
from sim.measure.fit.circle import CircleFit, fit_circle
from sim.run.ballbar.circle import circle_test, run_test
from sim.run.ballbar.fitted import fitted_machine
from sim.setup.machine.machine import Machine, load_machine, machine_sections
from sim.setup.machine.table import Geometry
from sim.setup.toml.keys import toml_text

SQUARE = "B10000B0B10000GXL1 B0B10000B10000GYL2 B10000B0B10000GXL3 B0B10000B10000GYL4 DD"


def with_geometry(**of: object) -> Machine:
    machine = load_machine("dk7740")
    return machine._replace(table=machine.table._replace(geometry=Geometry(**of)))


def corners(**of: object) -> Floats:
    """By how much the slides stand off at the corners (3, 2) of a square of 10 mm, beside a true machine, µm."""
    machines = (load_machine("dk7740"), with_geometry(**of))
    true, other = (run_text(SQUARE, machine=machine, start_mm=(150.0, 200.0)).trace for machine in machines)
    last = [int(np.flatnonzero(true.row == row)[-1]) for row in range(3)]
    off: Floats = other.table_um[last] - true.table_um[last]
    return off


def circle_of(machine: Machine) -> CircleFit:
    turns = run_test(circle_test(machine, 5e3, None), silent).turns
    return fit_circle(np.concatenate([turn.points_um for turn in turns]), by_points=True)


def test_y_leans_and_axes_are_longer_by_their_part_of_the_way() -> None:
    """At 10 mm a scale of 50 ppm is 0.5 µm, a lean of 100 µrad 1 µm."""
    off = corners(squareness_urad=100.0, scale_ppm=(50.0, -20.0))
    np.testing.assert_allclose(off, [[0.5, 0.0], [0.5 - 1.0, -0.2], [-1.0, -0.2]], atol=1e-3)


def test_pitch_errors_count_from_the_program_start_at_places_of_the_travel() -> None:
    """From 150 to 160 mm the error of X rises from 2 to 3 µm, of Y from 200 on by 5 µm in 5 mm, and no more."""
    off = corners(pitch_error=(((100.0, -3.0), (200.0, 7.0)), ((200.0, 1.0), (205.0, 6.0))))
    np.testing.assert_allclose(off, [[1.0, 0.0], [1.0, 5.0], [0.0, 5.0]], atol=1e-3)


def test_a_true_machine_stands_where_it_stood() -> None:
    place = np.array([[1.0, 2.0]])
    assert Geometry().placed(place, np.zeros(2)) is place


def test_a_circle_on_a_machine_out_of_square_tells_its_squareness_and_scales() -> None:
    found = circle_of(with_geometry(squareness_urad=60.0, scale_ppm=(30.0, -10.0)))
    without = circle_of(load_machine("dk7740"))
    for name, wanted in (("squareness", 60.0), ("scale_difference", 40.0)):
        value, before = found.value(name), without.value(name)
        assert value is not None
        assert before is not None
        assert value - before == pytest.approx(wanted, abs=4.0)  # of 5 mm: 0.02 µm


def test_a_fitted_machine_is_as_far_out_of_square_as_was_measured() -> None:
    measured = circle_of(with_geometry(squareness_urad=80.0, scale_ppm=(25.0, -25.0)))
    fitted = fitted_machine(load_machine("dk7740"), measured, None)
    geometry = fitted.machine.table.geometry
    assert geometry.squareness_urad == pytest.approx(80.0, abs=15.0)
    assert geometry.scale_ppm == pytest.approx((25.0, -25.0), abs=10.0)
    assert {"squareness_urad", "scale_x_ppm", "scale_y_ppm"} <= {*fitted.keys}


def test_a_machine_file_holds_it(tmp_path: Path) -> None:
    machine = with_geometry(squareness_urad=-12.5, scale_ppm=(3.0, 4.0), pitch_error=(((0.0, 0.0), (50.0, 2.5)), ()))
    path = tmp_path / "mine.toml"
    path.write_text(toml_text(machine_sections(machine)), "utf-8")
    assert load_machine(str(path)).table.geometry == machine.table.geometry
    path.write_text(path.read_text("utf-8").replace("[50.0, 2.5]", "[0.0, 2.5]"), "utf-8")
    with pytest.raises(SettingsError, match="pitch_error_x"):
        load_machine(str(path))
    assert "squareness_urad = 0" in toml_text(machine_sections(plain_scenario().machine))
