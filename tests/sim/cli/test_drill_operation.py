"""``drycut drill --kind operation`` as people type it."""

from pathlib import Path

from command import run_inside
from places import SCENARIOS

PROGRAM = SCENARIOS / "sparks-chip" / "program.3b"


def test_it_writes_the_page_and_the_answers(tmp_path: Path) -> None:
    done = run_inside("drill", PROGRAM, "-o", tmp_path / "drills", "--kind", "operation", "--count", "3")
    assert done.returncode == 0
    assert "3 drills of operation on program.3b, set 1" in done.stdout.decode()
    assert sorted(file.name for file in (tmp_path / "drills").iterdir()) == ["operation-answers.html", "operation.html"]


def test_a_level_or_a_short_path_is_refused_and_nothing_is_written(tmp_path: Path) -> None:
    output = tmp_path / "drills"
    done = run_inside("drill", PROGRAM, "-o", output, "--kind", "operation", "--level", "hard")
    assert done.returncode == 2
    assert "--level is of drills of programs" in done.stderr.decode()
    (tmp_path / "short.3b").write_text("B100B0B100GXL1 DD", "utf-8")
    done = run_inside("drill", tmp_path / "short.3b", "-o", output, "--kind", "operation")
    assert done.returncode in {1, 2}
    assert "too short for drills of operation" in done.stderr.decode()
    assert not output.exists()
