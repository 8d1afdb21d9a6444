"""``drycut example``: what it lists, what it writes, and that what it wrote runs."""

from pathlib import Path

from command import run_inside
from places import SCENARIOS

from sim.jobs.examples import example_names


def test_all_scenarios_are_listed_with_their_titles() -> None:
    lines = run_inside("example").stdout.decode().splitlines()
    assert [line.split()[0] for line in lines if not line.startswith(" ")] == list(example_names())
    assert set(example_names()) == {folder.parent.name for folder in SCENARIOS.glob("*/scenario.toml")}
    (keyhole,) = (line.split() for line in lines if line.startswith("keyhole"))
    assert keyhole == ["keyhole", "Keyhole:", "half", "circle", "R", "24.9", "and", "major", "arc", "R", "49.9"]


def test_an_example_is_written_as_it_comes_and_runs(tmp_path: Path) -> None:
    done = run_inside("example", "round-hole", cwd=tmp_path)
    assert done.returncode == 0
    assert done.stdout.decode().splitlines()[-1] == "try it: drycut run round-hole"
    own = {file.name: file.read_bytes() for file in (SCENARIOS / "round-hole").iterdir()}
    assert {file.name: file.read_bytes() for file in (tmp_path / "round-hole").iterdir()} == own
    assert run_inside("run", "round-hole", cwd=tmp_path).returncode == 0


def test_nothing_that_is_there_is_written_over(tmp_path: Path) -> None:
    (tmp_path / "keyhole").mkdir()
    done = run_inside("example", "keyhole", cwd=tmp_path)
    assert done.returncode == 2
    assert "keyhole is there already; name another folder" in done.stderr.decode()
    assert list((tmp_path / "keyhole").iterdir()) == []
    assert run_inside("example", "keyhole", "-o", "new/try", cwd=tmp_path).returncode == 0
    assert (tmp_path / "new" / "try" / "scenario.toml").exists()


def test_a_name_that_is_none_is_told_with_the_nearest_one() -> None:
    assert "there is no example 'keyhle'; did you mean keyhole?" in run_inside("example", "keyhle").stderr.decode()
    chinese = run_inside("--lang", "zh", "example", "../keyhole").stderr.decode()
    assert "没有示例 '../keyhole'" in chinese
