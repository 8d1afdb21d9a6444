"""Plans as drafts, and what is written of them: jumps and stops, whole µm near what was planned, forms and codes."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from drawings_dxf import drawn
from made_programs import plan_of, plate_file, with_cuts

from parser.geometry.curves import CurveKind, Curves, Floats
from parser.program import load_program, parse_program
from sim.make.cam.compensated_draft import draft_of_plan
from sim.make.conversion_proof import proof
from sim.make.wanted import Wanted, encoded, written
from sim.setup.making import Making

_HALF_UM = 20_000.0, 10_000.0


@pytest.fixture(name="path", scope="module")
def plate_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return plate_file(tmp_path_factory.mktemp("plate"))


def test_figures_are_parted_by_pauses_and_jumps_between_their_thread_points(path: Path) -> None:
    plan = plan_of(path)
    draft = draft_of_plan(plan)
    jumps = np.flatnonzero(draft.curves.kind == CurveKind.JUMP)
    places = np.array([cut.thread.place_um for cut in plan.cuts])
    np.testing.assert_allclose(draft.curves.start_um[jumps], places[:-1])
    np.testing.assert_allclose(draft.curves.end_um[jumps], places[1:])
    assert [stop for stop in draft.stops if stop.kind == "pause"] == [
        stop for stop in draft.stops if stop.after in jumps.tolist()
    ]
    assert draft.stops[-1][:2] == ("end", len(draft))


def test_before_a_tab_is_cut_off_the_program_pauses(path: Path) -> None:
    plan = plan_of(path, Making(tab_um=3000.0))
    outline = next(cut for cut in plan.cuts if cut.cut_off)
    draft = draft_of_plan(with_cuts(plan, [outline]))
    rows = sum(len(way) for one in outline.passes for way in (one.into, one.along, one.out))
    assert [stop[:2] for stop in draft.stops] == [("pause", rows), ("end", len(draft))]


@pytest.mark.parametrize("tolerance_um", [2.0, 5.0])
def test_an_ellipse_is_written_near_its_fit_and_closes(tmp_path: Path, tolerance_um: float) -> None:
    path = drawn(tmp_path, lambda space: space.add_ellipse((0, 0), (20, 0), 0.5))
    making = Making(tolerance_um=tolerance_um, passes_um=(0.0,), direction="ccw")
    draft = draft_of_plan(plan_of(path, making))
    made = written(draft, Wanted("3b"))
    toolpath = parse_program(made.text).toolpath
    assert np.hypot(*(toolpath.end_um[-1] - toolpath.start_um[0])) <= 0.3
    assert proof(draft, made, toolpath).off_um <= 1.0
    arcs = toolpath.picked(toolpath.is_arc)
    assert max(from_ellipse(place).max() for place in places_on(arcs)) <= tolerance_um + 0.5


def places_on(arcs: Curves) -> Iterator[Floats]:
    for share in np.linspace(0.0, 1.0, 41):
        angle = arcs.start_angle_rad + share * arcs.sweep_rad
        yield arcs.center_um + arcs.radius_um[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def from_ellipse(place: Floats) -> Floats:
    """Distances (n,) from the ellipse, by Newton's method on the angle of the nearest place."""
    (a, b), (x, y) = _HALF_UM, np.abs(place.T)
    at = np.arctan2(a * y, b * x)
    for _ in range(20):
        cos, sin = np.cos(at), np.sin(at)
        slope = (a * cos - x) * -a * sin + (b * sin - y) * b * cos
        bend = (a * sin) ** 2 + (b * cos) ** 2 - (a * cos - x) * a * cos - (b * sin - y) * b * sin
        at = at - slope / bend
    return np.hypot(x - a * np.cos(at), y - b * np.sin(at))


@pytest.mark.parametrize("form", ["compact", "aligned", "detailed"])
def test_codes_and_encodings_go_into_the_file_alone(path: Path, form: str) -> None:
    draft = draft_of_plan(plan_of(path))
    usual = Wanted("3b", form=form, name="\u51f8\u6a21 \u2603", newline="\r\n")  # type: ignore[arg-type]
    text = written(draft, usual).text
    data = encoded(text, usual._replace(end_code="MJ", pause_code="A1", encoding="gbk"))
    lines = data.decode("gbk").split("\r\n")
    codes = [line.split(": ")[-1] for line in lines]
    assert codes.count("A1") == len(draft.stops) + 1  # lines in the air stand between two pauses
    assert codes[-2:] == ["MJ", ""]
    assert [line for line in lines if line.split(": ")[-1] not in {"A1", "MJ"}] == [
        line.replace("\u2603", "?") for line in text.split("\r\n") if line.split(": ")[-1] not in {"D", "DD"}
    ]
    assert load_program(encoded(text, usual), "usual.3b").text == text


def test_the_header_of_the_detailed_form_has_offset_and_length(path: Path) -> None:
    draft = draft_of_plan(plan_of(path))
    text = written(draft, Wanted("3b", form="detailed", name="plate", offset_um=100.0)).text
    cut_mm = draft.curves.length_um[draft.curves.kind != CurveKind.JUMP].sum() / 1000.0
    assert f"Conner R= 0.00000 , Offset F= 0.10000 ,Length= {cut_mm:.3f} mm" in text
    assert not [one for one in parse_program(text).findings if one.severity.name == "ERROR"]
