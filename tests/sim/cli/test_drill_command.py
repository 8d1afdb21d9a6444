"""``drycut drill`` as a user meets it: its files, sets by number, levels, and what it refuses."""

from pathlib import Path

import pytest
from command import run_inside, without_progress
from places import ROOT

DIE = ROOT / "scenarios" / "die" / "program.3b"


def test_it_writes_the_pages_and_the_damaged_programs(tmp_path: Path) -> None:
    done = run_inside("drill", DIE, "-o", tmp_path / "out", "--count", "4")
    assert (done.returncode, without_progress(done.stderr)) == (0, b"")
    assert done.stdout.decode().splitlines()[0] == "4 drills of program.3b, set 1: 2 easy, 1 medium, 1 hard"
    names = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert names == ["answers.html", *(f"drill-0{at}.3b" for at in range(1, 5)), "drill.html"]
    texts = {(tmp_path / "out" / name).read_bytes() for name in names if name.endswith(".3b")}
    assert len(texts | {DIE.read_bytes()}) == 5


def test_the_same_set_is_the_same_for_all(tmp_path: Path) -> None:
    for name, number in (("a", "17"), ("b", "17"), ("c", "18")):
        assert run_inside("drill", DIE, "-o", tmp_path / name, "--set", number, "--count", "3").returncode == 0
    page = {name: (tmp_path / name / "drill.html").read_bytes() for name in "abc"}
    assert page["a"] == page["b"]
    assert page["a"] != page["c"]


def test_one_level_can_be_asked_for_in_chinese(tmp_path: Path) -> None:
    done = run_inside("drill", DIE, "-o", tmp_path, "--level", "hard", "--count", "2", "--lang", "zh")
    assert done.stdout.decode().splitlines()[0] == "program.3b：2 题，第 1 套：2 较难"


def test_a_program_with_few_places_says_how_few_drills_it_has(tmp_path: Path) -> None:
    (tmp_path / "one.3b").write_text("B1000B0B1000GXL1\nDD\n")
    done = run_inside("drill", tmp_path / "one.3b", "-o", tmp_path / "out", "--count", "30", "--level", "hard")
    assert done.returncode in {0, 1}
    assert b"one.3b" in done.stderr


@pytest.mark.parametrize(
    ("text", "code", "told"),
    [
        ("B1000B0B1000GXL1\nB0B500\nDD\n", 1, "one.3b has findings that fail it: 3B106"),
        ("B1000B0B1000GXL1\n" * 501 + "DD\n", 1, "one.3b has 501 blocks; nobody looks through more than 500"),
        ("nothing\n", 2, "3B100"),
    ],
)
def test_programs_that_make_no_drills_are_refused_and_nothing_is_written(
    tmp_path: Path, text: str, code: int, told: str
) -> None:
    (tmp_path / "one.3b").write_text(text)
    done = run_inside("drill", tmp_path / "one.3b", "-o", tmp_path / "out")
    assert done.returncode == code
    assert told in done.stderr.decode()
    assert not (tmp_path / "out").exists()


def test_a_program_is_not_overwritten_by_its_own_drills(tmp_path: Path) -> None:
    (tmp_path / "drill-01.3b").write_bytes(DIE.read_bytes())
    done = run_inside("drill", tmp_path / "drill-01.3b", "-o", tmp_path)
    assert done.returncode == 2
    assert "is what the drills are made of" in done.stderr.decode()
    assert (tmp_path / "drill-01.3b").read_bytes() == DIE.read_bytes()
