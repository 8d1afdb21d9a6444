"""A run held against its drawing: the edge as cut, what is past the tolerance, and what is wrong as a whole."""

import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from command import run_command
from runs import codes, machine, plain_scenario

from parser.findings.errors import DrawingError
from parser.program import parse_program
from parser.toolpath import Point
from sim.base.progress import silent
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import FitRequest
from sim.measure.compare.rings import edge_as_cut
from sim.run.dryrun import DryRun
from sim.run.running import dry_run
from sim.setup.part import DrawingTarget

LED_SQUARE = """B0B2000B2000GYL2
B2000B0B2000GXL1 B0B4000B4000GYL2 B4000B0B4000GXL3 B0B4000B4000GYL4 B2000B0B2000GXL1
B0B2000B2000GYL4 DD"""
STEADY = machine(backlash_um=(0.0, 0.0), friction_n=(0.0, 0.0))


def drawn(path: Path, *corners: tuple[float, float]) -> Path:
    """A closed polyline in mm."""
    document = ezdxf.new(units=4)
    document.modelspace().add_lwpolyline(corners, close=True)
    document.saveas(path)
    return path


def square(path: Path, half: float = 1.9, low: float = 2.1, high: float = 5.9) -> Path:
    """What the wire leaves of the square inside the path, less the offset of 0.1 mm all round."""
    return drawn(path, (-half, low), (half, low), (half, high), (-half, high))


def run_held(text: str, target: DrawingTarget, **changes: object) -> DryRun:
    changes = {"machine": STEADY, "drawing": target, **changes}
    return dry_run(parse_program(text), plain_scenario(**changes), silent)


def test_a_part_as_drawn_passes_within_what_the_steps_leave(tmp_path: Path) -> None:
    run = run_held(LED_SQUARE, DrawingTarget(square(tmp_path / "part.dxf")))
    assert codes(run) == []
    assert run.comparison is not None
    assert run.comparison.max_um < 1.0
    assert [piece.kind for piece in run.remains.pieces.freed] == ["part"]


def test_the_edge_as_cut_agrees_with_the_exact_one(tmp_path: Path) -> None:
    """Table and steps of the shipped machine are off by at most the deviation of the run, at a corner on both sides."""
    target = DrawingTarget(square(tmp_path / "part.dxf"), fit=False)
    run = run_held(LED_SQUARE, target, machine=machine())
    exact = compare_program(run.toolpath, 100.0, run.comparison.drawing, FitRequest(5.0, fitted=False))
    assert exact.max_um < 1e-6
    assert 0.5 < run.comparison.max_um <= math.sqrt(2.0) * run.deviations.wire.max_um + 0.1


def test_an_edge_that_is_drawn_elsewhere_is_found_both_ways(tmp_path: Path) -> None:
    """The drawing is 12 µm higher than what is cut: left as it lies, its upper side is that far off."""
    run = run_held(LED_SQUARE, DrawingTarget(square(tmp_path / "part.dxf", high=5.912), fit=False))
    assert codes(run) == ["3B601", "3B601"]
    for finding in run.findings:
        assert finding.block == 4
        assert finding.values["off"] == pytest.approx(12.0, abs=0.6)
    assert {finding.values["what"] for finding in run.findings} == {"edge-off", "drawing-off"}
    assert (
        codes(run_held(LED_SQUARE, DrawingTarget(square(tmp_path / "part.dxf", high=5.912), tolerance_um=13.0))) == []
    )


@pytest.mark.deeper
def test_a_missing_offset_a_wrong_side_and_a_slip_of_units_are_named(tmp_path: Path) -> None:
    named = {
        "offset-missing": square(tmp_path / "missing.dxf", 2.0, 2.0, 6.0),
        "wrong-side": square(tmp_path / "wrong.dxf", 2.1, 1.9, 6.1),
        "unit-slip": square(tmp_path / "unit.dxf", 1.9 * 25.4, 2.1 * 25.4, 5.9 * 25.4),
    }
    for name, file in named.items():
        run = run_held(LED_SQUARE, DrawingTarget(file))
        assert [f.values["what"] for f in run.findings if f.code == "3B602"] == [name]
        assert "3B601" in codes(run)


def test_a_lead_in_into_the_part_counts_and_one_in_the_waste_does_not(tmp_path: Path) -> None:
    """The same square cut out as an opening: led in from below, its lead-in lies in what is kept."""
    opening = square(tmp_path / "opening.dxf", 2.1, 1.9, 6.1)
    from_inside = LED_SQUARE.replace("B0B2000B2000GYL2", "B0B2000B2000GYL4").replace(
        "B0B2000B2000GYL4 DD", "B0B2000B2000GYL2 DD"
    )
    moved = drawn(tmp_path / "moved.dxf", (-2.1, -2.1), (2.1, -2.1), (2.1, 2.1), (-2.1, 2.1))
    run = run_held(from_inside, DrawingTarget(moved))
    assert codes(run) == ["3B603"]  # corners keep 41.4 µm
    assert [piece.kind for piece in run.remains.pieces.freed] == ["slug"]
    into_part = run_held(LED_SQUARE, DrawingTarget(opening, tolerance_um=45.0))
    assert "3B601" in codes(into_part)


def test_without_a_piece_there_is_no_edge(tmp_path: Path) -> None:
    run = run_held("B3000B0B3000GXL1 DD", DrawingTarget(square(tmp_path / "part.dxf")))
    assert [(f.code, f.values["what"]) for f in run.findings] == [("3B602", "no-edge")]
    assert run.comparison is None


def test_outlines_become_edges_with_their_blocks_and_the_side_of_the_part(tmp_path: Path) -> None:
    run = run_held(LED_SQUARE, DrawingTarget(square(tmp_path / "part.dxf")))
    edge = edge_as_cut(run.toolpath, run.remains.kerf, run.remains.pieces)
    assert set(edge.part_side.tolist()) == {1}
    assert set(edge.block.tolist()) == {2, 3, 4, 5, 6}
    length = edge.curves.length_um
    assert float(length.sum()) == pytest.approx(4 * 3800.0, abs=15.0)
    middle = 0.5 * (edge.curves.start_um + edge.curves.end_um)
    right = middle[:, 0] > 1850.0
    upright = np.abs(middle[:, 1] - 4000.0) < 1800.0
    assert set(edge.block[right & upright].tolist()) == {3}
    assert Point(*middle[right & upright].mean(axis=0)).x == pytest.approx(1900.0, abs=0.6)


@pytest.mark.deeper
def test_a_drawing_that_cannot_be_read_ends_the_run_before_it_begins(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(LED_SQUARE, "utf-8")
    (tmp_path / "part.dxf").write_text("no drawing", "utf-8")
    with pytest.raises(DrawingError):
        run_held(LED_SQUARE, DrawingTarget(tmp_path / "part.dxf"))
    done = run_command("run", tmp_path / "part.3b", "--drawing", tmp_path / "part.dxf", "-o", tmp_path / "out")
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"is no DXF" in done.stderr
    assert not (tmp_path / "out").exists()


def test_sizes_of_a_run_are_those_of_the_drawing_on_a_steady_table(tmp_path: Path) -> None:
    run = run_held(LED_SQUARE, DrawingTarget(square(tmp_path / "part.dxf")))
    (box,) = run.remains.sizes.boxes
    assert box.nominal_um == pytest.approx((3800.0, 3800.0), abs=1e-6)
    assert box.cut_um == pytest.approx((3800.0, 3800.0), abs=1.2)
    (piece,) = run.remains.pieces.freed
    assert piece.area_mm2 == pytest.approx(3.8 * 3.8, abs=2e-3)
    assert piece.mass_g == pytest.approx(3.8 * 3.8 * 40.0 * 7.85e-3, rel=1e-3)
    assert math.hypot(piece.center_um.x, piece.center_um.y - 4000.0) < 1.0


def test_a_mirrored_part_passes_within_the_tolerance_and_is_named_past_it(tmp_path: Path) -> None:
    """An angle, and its drawing seen from the back; its inside corner keeps 41.4 µm."""
    angle = """B0B2000B2000GYL2 B2000B0B2000GXL1 B0B2000B2000GYL2 B1500B0B1500GXL3 B0B2000B2000GYL2
        B2500B0B2500GXL3 B0B4000B4000GYL4 B2000B0B2000GXL1 B0B2000B2000GYL4 DD"""
    corners = [(-1.9, 2.1), (1.9, 2.1), (1.9, 3.9), (0.4, 3.9), (0.4, 5.9), (-1.9, 5.9)]
    seen_from_behind = drawn(tmp_path / "part.dxf", *((-x, y) for x, y in corners))
    passed = run_held(angle, DrawingTarget(seen_from_behind))
    assert codes(passed) == ["3B603"]
    assert [named.name for named in passed.comparison.names] == ["mirrored"]
    failed = run_held(angle, DrawingTarget(seen_from_behind, tolerance_um=0.1))
    assert [f.values["what"] for f in failed.findings if f.code == "3B602"] == ["mirrored"]
