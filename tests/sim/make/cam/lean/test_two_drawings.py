"""Programs of two drawings, one of the bottom of the work and one of its top: proved, and in every form."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import shapely
from depth import cases
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from places import SCENARIOS
from runs import plain_scenario

from parser.drawing.read import read_drawing
from parser.findings.errors import SettingsError
from parser.geometry.along import places
from parser.geometry.curves import Curves
from parser.program import load_program, paired
from parser.write.iso import iso_choices
from sim.jobs.shop import source_of
from sim.make.cam.maker import MadeProgram, NotMade, made_program
from sim.make.wanted import Wanted
from sim.run.report.document import build_report
from sim.setup.making import Making
from sim.setup.scenario import load_scenario
from sim.setup.taper import TaperSettings

ISO, SODICK, UV = (Wanted("iso", iso_choices(dialect)) for dialect in ("fast-wire", "sodick", "mitsubishi"))
TO_3B = Wanted("3b")
OFF_UM = 10.0
Draw = Callable[[Modelspace], object]


def square(half: float, x: float = 0.0, y: float = 0.0) -> Draw:
    corners = [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
    return lambda space: space.add_lwpolyline(corners, close=True)


def circle(radius: float, x: float = 0.0, y: float = 0.0) -> Draw:
    return lambda space: space.add_circle((x, y), radius)


def all_of(*draw: Draw) -> Draw:
    return lambda space: [each(space) for each in draw]


class Sheets:
    """Makes programs of two drawings in a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._number = folder, 0
        self.scenario = plain_scenario(thickness_mm=16.0)

    def file(self, draw: Draw) -> Path:
        self._number += 1
        folder = self._folder / str(self._number)
        folder.mkdir()
        return drawn(folder, draw)

    def tried(self, lower: Draw, upper: Draw, wanted: Wanted = ISO, **asked: object) -> MadeProgram | NotMade:
        making = Making(**asked)._replace(upper=self.file(upper))  # type: ignore[arg-type]
        return made_program(self.file(lower), making, wanted, self.scenario)

    def made(self, lower: Draw, upper: Draw, wanted: Wanted = ISO, **asked: object) -> MadeProgram:
        done = self.tried(lower, upper, wanted, **asked)
        assert isinstance(done, MadeProgram), done
        return done


@pytest.fixture
def sheets(tmp_path: Path) -> Sheets:
    return Sheets(tmp_path)


DIE = all_of(square(8.0), circle(2.0, -3.5), square(2.0, 3.5))
DIE_ABOVE = all_of(square(8.0), circle(2.3, -3.5), square(2.3, 3.5))


@pytest.mark.parametrize("wanted", [ISO, SODICK, UV, TO_3B], ids=["fast-wire", "sodick", "u-v", "3b"])
def test_round_on_square_is_proved_in_every_form(sheets: Sheets, wanted: Wanted) -> None:
    done = sheets.made(square(4.0), circle(3.2), wanted)
    assert done.proof is not None
    assert done.verdict == "pass"
    assert {wall.z_um for wall in done.proof.walls} == {4_000.0, 8_000.0, 12_000.0, 16_000.0}
    assert max(wall.off_um for wall in done.proof.walls) <= OFF_UM
    assert done.proof.run is not None
    taper = build_report(done.proof.run)["taper"]
    assert taper is not None
    # The worked solid at 0.4 of its size. Walls lie some µm off half-way, by the corners of the square.
    assert taper["volume_mm3"]["piece"] == pytest.approx(11_855.509 * 0.4**3, rel=1e-3)
    assert (done.upper_data is not None) == (wanted is TO_3B)
    if done.upper_data is not None:
        both = paired(load_program(done.data, "m.3b"), load_program(done.upper_data, "m-upper.3b"))
        assert both.toolpath.upper is not None
        assert both.toolpath.upper.end_um.tolist() == done.program.toolpath.upper.end_um.tolist()  # type: ignore[union-attr]


def test_each_figure_of_a_die_is_cut_with_its_partner(sheets: Sheets) -> None:
    done = sheets.made(DIE, DIE_ABOVE)
    assert done.verdict == "pass"
    assert [faced.by for faced in done.plan.facings] == ["length", "curves", "curves"]
    assert {note.name for note in done.plan.notes} >= {"facing-length", "facing-curves"}
    assert done.proof is not None
    assert len(done.proof.walls) == 12
    low, high = done.program.toolpath, done.program.toolpath.upper
    assert high is not None
    tall = [float(np.ptp(of.end_um[:, 1])) for of in (low, high)]
    assert tall == pytest.approx([16_200.0, 16_200.0], abs=2.0)
    hole = np.flatnonzero(low.is_arc)
    assert (low.radius_um[hole].tolist(), high.radius_um[hole].tolist()) == ([1900.0] * 2, [2200.0] * 2)


def test_a_controller_adds_the_offset_of_both(sheets: Sheets) -> None:
    done = sheets.made(DIE, DIE_ABOVE, ISO._replace(keeps=True))
    assert done.verdict == "pass"
    assert b"G151 D1" in done.data
    assert b"G150" in done.data


def test_the_lower_drawing_lies_in_the_program_plane(sheets: Sheets) -> None:
    sheets.scenario = plain_scenario(thickness_mm=20.0, taper=TaperSettings(program_plane_um=4000.0))
    done = sheets.made(square(4.0), circle(3.2))
    assert done.verdict == "pass"
    assert done.proof is not None
    assert {wall.z_um for wall in done.proof.walls} == {0.0, 5_000.0, 10_000.0, 15_000.0, 20_000.0}
    sheets.scenario = plain_scenario(thickness_mm=20.0, taper=TaperSettings(program_plane_um=20_000.0))
    with pytest.raises(SettingsError, match="two contours need two heights"):
        sheets.tried(square(4.0), circle(3.2))


def test_a_lead_reaches_over_walls_that_lean_far(sheets: Sheets) -> None:
    done = sheets.made(circle(3.2), square(4.0))
    assert done.verdict == "pass"
    assert np.hypot(*done.program.toolpath.start_um[0]) > 4_100.0


def test_a_top_that_is_not_as_drawn_fails_the_proof(sheets: Sheets, monkeypatch: pytest.MonkeyPatch) -> None:
    other = sheets.file(circle(3.25))
    monkeypatch.setattr("sim.make.cam.maker._drawn_above", lambda request: read_drawing(other))
    done = sheets.made(square(4.0), circle(3.2))
    assert done.proof is not None
    assert [fault.name for fault in done.proof.faults] == ["wall"]
    assert done.proof.faults[0].values["off"] == pytest.approx(50.0, abs=4.0)


@pytest.mark.parametrize(
    ("upper", "wanted", "asked", "why"),
    [
        (all_of(circle(3.2), circle(3.2, 40.0)), ISO, {}, "upper-counts"),
        (circle(3.2, 40.0), ISO, {}, "no-upper"),
        (circle(3.2), Wanted("4b"), {}, "upper-4b"),
        (circle(3.2), ISO, {"tab_um": 3000.0}, "upper-tab"),
        (circle(3.2), ISO, {"lag_um": 20.0}, "taper-lag"),
    ],
)
def test_what_cannot_be_made_of_two_drawings_is_refused_by_name(
    sheets: Sheets, upper: Draw, wanted: Wanted, asked: dict[str, object], why: str
) -> None:
    done = sheets.tried(square(4.0), upper, wanted, **asked)
    assert isinstance(done, NotMade)
    assert done.refusal.why == why


def ring(rng: np.random.Generator, corners: int) -> list[tuple[float, float]]:
    """A convex polygon about the origin."""
    at = np.sort(rng.uniform(0.0, 2.0 * np.pi, corners))
    while np.diff(np.append(at, at[0] + 2.0 * np.pi)).max() > 2.0:
        at = np.sort(rng.uniform(0.0, 2.0 * np.pi, corners))
    radius = rng.uniform(4.0, 6.0)
    return [(float(radius * np.cos(a)), float(radius * np.sin(a))) for a in at]


@pytest.mark.deep
@pytest.mark.parametrize("seed", cases(3, 40))
def test_random_convex_drawings_are_proved_and_their_paths_lie_at_the_offset(seed: int, sheets: Sheets) -> None:
    rng = np.random.default_rng(seed)
    rings = [ring(rng, int(rng.integers(5, 9))) for _ in range(2)]
    done = sheets.made(*(lambda space, of=of: space.add_lwpolyline(of, close=True) for of in rings))  # type: ignore[misc]
    assert done.proof is not None
    low, high = done.program.toolpath, done.program.toolpath.upper
    assert high is not None
    for of, corners in ((low, rings[0]), (high, rings[1])):
        drawing = shapely.Polygon(1000.0 * np.array(corners))
        way = of.picked(slice(1, -1))
        inside = shapely.contains(drawing, shapely.points(_along(way)))
        assert not inside.any()
        off = shapely.distance(shapely.points(_along(way)), drawing.exterior)
        assert off.min() > 98.0  # D / cos of the mean lean, in whole µm
        assert np.median(off) < 103.0
    worst = max(wall.off_um for wall in done.proof.walls)
    # Drawings that are too unlike have no even partners.
    uneven = "3B706" in {finding.code for finding in done.proof.findings}
    assert (worst <= OFF_UM and not uneven) == (done.verdict == "pass")
    assert worst < 60.0


def _along(curves: Curves) -> "np.ndarray[tuple[int, int], np.dtype[np.float64]]":
    row = np.repeat(np.arange(len(curves)), 50)
    return places(curves, row, np.tile(np.linspace(0.0, 1.0, 50), len(curves)))


def test_a_scenario_of_two_drawings_takes_one_file(tmp_path: Path) -> None:
    """Two files of 3B would leave its run without the upper contour."""
    own = SCENARIOS / "taper-two-drawings"
    for file in own.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes().replace(b"program.iso", b"program.3b"))
    with pytest.raises(SettingsError, match="a file for each of two contours"):
        source_of(load_scenario(tmp_path))
    assert b" : " in source_of(load_scenario(own)).data
