"""``drycut panel`` as people type it."""

from pathlib import Path

import pytest
from command import run_inside
from places import SCENARIOS


def test_it_writes_one_page_and_says_what_it_cuts(tmp_path: Path) -> None:
    output = tmp_path / "panel.html"
    done = run_inside("panel", SCENARIOS / "sparks-chip", "-o", output, "--seed", "7")
    assert done.returncode == 0
    assert "23.0 mm, some 6 min" in done.stdout.decode()
    assert output.read_text("utf-8").startswith("<!doctype html>")
    again = tmp_path / "again.html"
    run_inside("panel", SCENARIOS / "sparks-chip", "-o", again, "--seed", "7")
    assert again.read_bytes() == output.read_bytes()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["panel", SCENARIOS / "sparks-chip", "-o", "panel.txt"], "is an .html file"),
        (["panel", SCENARIOS / "nothing-here", "-o", "panel.html"], "nothing-here"),
        (["run", SCENARIOS / "sparks-chip", "--seed", "-1"], "--seed"),
    ],
)
def test_bad_use_is_told_and_nothing_is_written(arguments: list[object], says: str, tmp_path: Path) -> None:
    done = run_inside(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert says in done.stderr.decode()
    assert list(tmp_path.iterdir()) == []


def test_an_event_in_no_block_is_told_by_its_number(tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_text("B100B0B100GXL1 DD", "utf-8")
    (tmp_path / "scenario.toml").write_text('[[event]]\nkind = "break"\nblock = 5', "utf-8")
    done = run_inside("run", tmp_path)
    assert done.returncode in {1, 2}
    assert "[[event]] 1: block 5 is none that this program cuts" in done.stderr.decode()


def test_a_run_under_sparks_writes_its_panel_and_one_without_writes_none(tmp_path: Path) -> None:
    for options, has_panel in ((["--sparks"], True), ([], False)):
        program = SCENARIOS / "sparks-chip" / "program.3b"
        done = run_inside("run", program, "-o", tmp_path / "out", *options)
        assert done.returncode == 0
        assert (tmp_path / "out" / "panel.html").exists() == has_panel
        assert ("panel.html" in done.stdout.decode()) == has_panel
        assert ('href="panel.html"' in (tmp_path / "out" / "report.html").read_text("utf-8")) == has_panel


def test_a_program_that_only_jumps_has_no_panel(tmp_path: Path) -> None:
    (tmp_path / "jumps.iso").write_text("G90\nG00 X5. Y0.\nG00 X5. Y5.\nM02\n", "utf-8")
    done = run_inside("run", "jumps.iso", "-o", "out", "--sparks", cwd=tmp_path)
    assert done.returncode in {0, 1}
    assert not (tmp_path / "out" / "panel.html").exists()
    done = run_inside("panel", "jumps.iso", "-o", "panel.html", cwd=tmp_path)
    assert done.returncode in {1, 2}
    assert "a block that makes steps and is no jump" in done.stderr.decode()
    done = run_inside("drill", "jumps.iso", "--kind", "operation", "-o", "drills", cwd=tmp_path)
    assert done.returncode in {1, 2}
    assert not (tmp_path / "drills").exists()
