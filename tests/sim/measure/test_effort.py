"""The work of a comparison is counted while it is done, and ends in one line where it is too much."""

from pathlib import Path

import numpy as np
import pytest
from command import run_inside
from places import ROOT

from parser.findings.errors import DrawingError
from parser.geometry.curves import Curves, curves_between
from sim.measure.compare import nearest as near
from sim.measure.compare.directed import directed
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.starts import Placement, placed


def test_a_crowd_at_one_distance_is_counted_and_what_lies_apart_is_not() -> None:
    number = np.arange(1000)
    turn = 2.0 * np.pi * number / len(number)
    around = 1000.0 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    spokes = indexed(curves_between(around, 2.0 * around, np.full_like(around, np.nan), np.zeros(len(number))))
    nearest(spokes, np.zeros((7, 2)))
    assert spokes.effort.looked_at >= 7 * 900  # from their middle all are equally far
    apart = indexed(_row_of_lines(1000))
    nearest(apart, np.column_stack([number + 0.3, np.ones(len(number))]))
    assert apart.effort.looked_at < 10 * len(number)


def test_more_than_a_comparison_may_take_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(near, "MOST_HELD", 100)
    lines, places = indexed(_row_of_lines(1000)), np.tile([[0.3, 1.0], [900.0, 1.0]], (20, 1))
    nearest(lines, places[:2])
    with pytest.raises(DrawingError, match="cannot be compared: more than 100 pairs"):
        nearest(lines, places)


def test_ten_times_as_many_curves_are_ten_times_the_work() -> None:
    held = []
    for number in (600, 6000):
        turn = np.arange(number) * (2.0 * np.pi / number)
        corner = (50_000.0 + 2000.0 * np.sin(40.0 * turn))[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        none = np.full_like(corner, np.nan)
        ring = curves_between(corner, np.roll(corner, -1, axis=0), none, np.zeros(number))
        index = indexed(ring)
        directed(placed(ring, Placement(0.0, (3.0, 2.0), mirror=False)), index)
        held.append(index.effort.looked_at)
    assert held[1] < 12 * held[0]


def _row_of_lines(number: int) -> Curves:
    start = np.column_stack([np.arange(float(number)), np.zeros(number)])
    return curves_between(start, start + np.array([0.5, 0.0]), np.full_like(start, np.nan), np.zeros(number))


def test_the_commands_say_so_and_end_with_2(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(near, "MOST_HELD", 1000)
    done = run_inside("compare", ROOT / "scenarios" / "punch")
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"drycut: error: drawing.dxf: cannot be compared: more than 1,000 pairs" in done.stderr


@pytest.mark.parametrize("text", ["B100B0B999999999GYNR1\n", "B100B0B9999999999GYNR1\n"])
def test_a_program_that_no_table_can_run_is_compared_with_nothing(tmp_path: Path, text: str) -> None:
    (tmp_path / "part.3b").write_text(text + "DD\n", "ascii")
    done = run_inside("compare", tmp_path / "part.3b", ROOT / "scenarios" / "punch" / "drawing.dxf")
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"error[3B206]" in done.stderr


def test_a_program_of_too_many_contours_is_compared_with_nothing(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text("B100B0B400GYNR1\nD\nB300B0B300GXL1\nD\n" * 2001 + "DD\n", "ascii")
    done = run_inside("compare", tmp_path / "part.3b", ROOT / "scenarios" / "punch" / "drawing.dxf")
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"the program has 2,001 closed contours, and no more than 2,000 are compared" in done.stderr


@pytest.mark.deeper
def test_a_program_of_too_many_passes_is_compared_with_nothing(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text("B100B0B400GYNR1\n" * 10_001 + "DD\n", "ascii")
    done = run_inside("compare", tmp_path / "part.3b", ROOT / "scenarios" / "punch" / "drawing.dxf")
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"the program has 10,001 passes over its contours, and no more than 10,000 are compared" in done.stderr
