"""Offsets left to the controller: what it makes of G41 and G42 is the path that the plan has with its offsets."""

from pathlib import Path

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from made_programs import plate_file
from runs import plain_scenario

from parser.geometry.curves import CurveKind
from parser.write.iso import iso_choices
from sim.check.path_checks import Demands, run_checks
from sim.make.cam.compensated_draft import draft_of_plan
from sim.make.cam.maker import MadeProgram, NotMade, unproved
from sim.make.cam.proof import ToProve, proved
from sim.make.wanted import Wanted
from sim.setup.making import Making

_NEAR_UM = 2.0  # both are rounded to whole µm, and meet at corners


@pytest.fixture(name="path", scope="module")
def plate_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return plate_file(tmp_path_factory.mktemp("plate"))


def made(path: Path, making: Making, dialect: str = "skd2") -> MadeProgram | NotMade:
    return unproved(path, making, Wanted("iso", iso_choices(dialect), keeps=True), plain_scenario())


@pytest.mark.alike(4)
@pytest.mark.parametrize("dialect", ["fast-wire", "skd2", "robofil", "sodick", "mitsubishi", "fanuc"])
@pytest.mark.parametrize("passes_um", [(100.0,), (150.0, 120.0, 100.0)])
def test_the_controller_makes_the_path_of_the_plan(path: Path, dialect: str, passes_um: tuple[float, ...]) -> None:
    done = made(path, Making(passes_um=passes_um), dialect)
    assert isinstance(done, MadeProgram)
    assert done.written.differs == ""
    compensated = run_checks(done.program, Demands()).compensation
    assert compensated is not None
    ran, meant = compensated.program.toolpath, draft_of_plan(done.plan).curves
    cut = [way.picked(way.kind != CurveKind.JUMP) for way in (ran, meant)]
    assert len(cut[0]) == len(cut[1])
    assert np.hypot(*(cut[0].end_um - cut[1].end_um).T).max() <= _NEAR_UM


def test_each_pass_has_its_side_and_its_register(path: Path) -> None:
    done = made(path, Making(passes_um=(150.0, 120.0, 100.0)))
    assert isinstance(done, MadeProgram)
    told = done.draft.compensation
    assert told is not None
    first = len(done.draft.stops) and done.draft.stops[0].after
    runs = [
        (int(side), name, by_um)
        for side, name, by_um, before in zip(
            told.side[:first], told.register, told.by_um, [0, *told.side[: first - 1].tolist()], strict=False
        )
        if side and not before
    ]
    assert runs == [(1, "D1", 150.0), (-1, "D2", 120.0), (1, "D3", 100.0)]
    assert "H001=150\nG41 H001\n" in done.program.text
    assert "H002=120\nG42 H002\n" in done.program.text


def test_4b_has_the_contour_whose_radii_the_controller_changes(tmp_path: Path) -> None:
    path = drawn(tmp_path, rounded)
    wanted = Wanted("4b", keeps=True)
    done = unproved(path, Making(passes_um=(100.0,)), wanted, plain_scenario())
    assert isinstance(done, MadeProgram)
    words = done.program.toolpath.words
    assert words is not None
    assert words.radius_um[words.turn != 0].tolist() == [5000] * 4
    assert words.curve[words.turn != 0].tolist() == [1] * 4
    proof = proved(ToProve(done.program, done.plan, done.plan.drawing, done.written, wanted.bound_um), plain_scenario())
    assert proof.verdict == "pass"
    assert "added" in {note.name for note in proof.notes}


def rounded(space: Modelspace) -> None:
    quarter = np.tan(np.pi / 8.0)
    ends = [(5, 0, 0), (35, 0, quarter), (40, 5, 0), (40, 15, quarter)]
    ends += [(35, 20, 0), (5, 20, quarter), (0, 15, 0), (0, 5, quarter)]
    space.add_lwpolyline(ends, format="xyb", close=True)


@pytest.mark.parametrize(
    ("figures", "passes_um", "why"), [(None, (120.0, 100.0), "kept-several"), ("plate", (100.0,), "kept-several")]
)
def test_what_a_4b_controller_cannot_add_is_refused(
    path: Path, tmp_path: Path, figures: str | None, passes_um: tuple[float, ...], why: str
) -> None:
    file = path if figures else drawn(tmp_path, rounded)
    done = unproved(file, Making(passes_um=passes_um, direction="ccw"), Wanted("4b", keeps=True), plain_scenario())
    assert isinstance(done, NotMade)
    assert done.refusal.why == why


def test_corners_are_refused_in_4b_with_their_places(tmp_path: Path) -> None:
    corners = [(0, 0), (20, 0), (20, 10), (0, 10)]
    path = drawn(tmp_path, lambda space: space.add_lwpolyline(corners, close=True))
    done = unproved(path, Making(passes_um=(100.0,)), Wanted("4b", keeps=True), plain_scenario())
    assert isinstance(done, NotMade)
    assert done.refusal.why == "kept-corner"
    assert sorted(place.x for place in done.refusal.places_um) == [0.0, 0.0, 20_000.0, 20_000.0]
    assert dict(done.refusal.values)["degrees"] == "90.0"


def test_a_tab_is_refused(path: Path) -> None:
    done = made(path, Making(passes_um=(100.0,), tab_um=3000.0))
    assert isinstance(done, NotMade)
    assert done.refusal.why == "kept-tab"
