"""The work of a comparison is counted before it is done, and ends in one line where it is too much."""

from pathlib import Path

import numpy as np
import pytest
from command import run_inside
from places import ROOT

from parser.findings.errors import DrawingError
from sim.measure.compare import effort
from sim.measure.compare.effort import Effort


def test_no_chord_within_reach_of_a_place_goes_uncounted() -> None:
    rng = np.random.default_rng(17)
    middle = rng.normal(0.0, 3000.0, (5000, 2))
    place, within = rng.normal(0.0, 9000.0, (300, 2)), 10.0 ** rng.uniform(0.0, 4.0, 300)
    counted = Effort(middle).spend(place, within)
    near = (np.abs(place[:, None] - middle) <= within[:, None, None]).all(axis=2).sum(axis=1)
    assert (counted >= near).all()
    assert counted.sum() < 2 * near.sum()


def test_chords_in_one_place_or_on_one_line_are_counted() -> None:
    assert Effort(np.zeros((7, 2))).spend(np.zeros((2, 2)), np.array([0.0, 1.0])).tolist() == [7, 7]
    on_line = np.column_stack([np.arange(100.0), np.zeros(100)])
    assert Effort(on_line).spend(np.array([[50.0, 1e9]]), np.array([2e9])).tolist() == [100]


def test_more_than_a_comparison_may_take_is_refused() -> None:
    crowd = Effort(np.zeros((100_000, 2)))
    one = np.zeros((1, 2)), np.zeros(1)
    for _ in range(effort.MOST_HELD // 100_000):
        crowd.spend(*one)
    with pytest.raises(DrawingError, match="cannot be compared: more than 300,000,000 pairs"):
        crowd.spend(*one)


def test_the_commands_say_so_and_end_with_2(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(effort, "MOST_HELD", 1000)
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


def test_a_program_of_too_many_passes_is_compared_with_nothing(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text("B100B0B400GYNR1\n" * 10_001 + "DD\n", "ascii")
    done = run_inside("compare", tmp_path / "part.3b", ROOT / "scenarios" / "punch" / "drawing.dxf")
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"the program has 10,001 passes over its contours, and no more than 10,000 are compared" in done.stderr
