"""Lesson files, what they refuse, and what programs of a drawing earn, part by part."""

from pathlib import Path

import pytest
from sittings import LESSONS, PROGRAMS, ready

from parser.findings.errors import DrycutError
from sim.jobs.lessons import lesson_of
from sim.make.lessons import without_remarks
from sim.show.texts import Words
from sim.teach.lesson import load_lesson
from sim.teach.plain.program import PARTS, Target, parts_of, program_mark, written_of
from sim.teach.programs import program_marked

HEAD = 'title = "T"\n[[exercise]]\nkind = "block"\ntitle = "B"\n'
PROGRAM = """title = "T"
[[exercise]]
kind = "program"
title = "P"
drawing = "opening.dxf"
side = "inside"
offset_mm = 0.1
thread_mm = [0, 0]
"""


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('title = "T"\n', "1 to 40 tables [[exercise]]"),
        (HEAD + 'shapes = ["round"]\n', "shapes is one of axis"),
        (HEAD + "shapes = []\n", "shapes is a list"),
        (HEAD + "count = 0\n", "count"),
        (HEAD + "points = -1\n", "points"),
        (HEAD + "colour = 1\n", "colour"),
        (HEAD.replace("block", "dance"), "kind is one of block, program, fault, predict"),
        (PROGRAM.replace("0.1", "9"), "offset_mm"),
        (PROGRAM.replace("[0, 0]", "[0]"), "thread_mm"),
        (PROGRAM + "[exercise.parts]\nlooks = 1\n", "looks"),
        (PROGRAM + "[exercise.parts]\n" + "".join(f"{part} = 0\n" for part in PARTS), "parts"),
        (PROGRAM.replace("opening", "missing"), "missing.dxf"),
        (PROGRAM.replace("0.1", "3.5"), "does not fit"),
        ('title = "T"\n[[exercise]]\nkind = "predict"\ntitle = "P"\nask = "falls"\n', "program"),
        ('title = "T"\n[[exercise]]\nkind = "predict"\ntitle = "P"\nask = "end"\nprogram = "a.3b"\n', "program"),
        ('title = "T"\n[[exercise]]\nkind = "fault"\ntitle = "P"\nprogram = "bad.3b"\n', "bad.3b"),
    ],
)
def test_a_wrong_lesson_is_refused_by_its_place(tmp_path: Path, text: str, says: str) -> None:
    (tmp_path / "lesson.toml").write_text(text, "utf-8")
    (tmp_path / "opening.dxf").write_bytes((LESSONS / "1-first-blocks" / "opening.dxf").read_bytes())
    (tmp_path / "bad.3b").write_text("hello\n", "utf-8")

    with pytest.raises(DrycutError) as refused:
        lesson_of(tmp_path / "lesson.toml")

    message = Words("en")("commands.error", message=refused.value.message)
    assert says in message
    assert "lesson.toml" in message or ".3b" in message or ".dxf" in message


def test_a_drawing_of_two_contours_is_refused(tmp_path: Path) -> None:
    (tmp_path / "lesson.toml").write_text(PROGRAM.replace("opening.dxf", "two.csv"), "utf-8")
    rows = ["circle,0,0,5", "circle,30,0,5"]
    (tmp_path / "two.csv").write_text("\n".join(rows) + "\n", "utf-8")

    with pytest.raises(DrycutError):
        lesson_of(tmp_path / "lesson.toml")


@pytest.mark.parametrize("name", ["1-first-blocks", "2-circle-and-quadrant", "3-a-whole-die"])
def test_lessons_that_come_with_drycut_are_whole(name: str) -> None:
    lesson = load_lesson(LESSONS / name / "lesson.toml")

    assert (lesson.minutes, lesson.points) == (45, 100.0)
    for text in (lesson.title, lesson.notes, *(exercise.title for exercise in lesson.exercises)):
        assert text.en
        assert text.zh != text.en
    assert lesson.notes.zh.count("分钟：") >= 4
    assert len(ready(name).exercises) == len(lesson.exercises)


def hole() -> Target:
    return ready("2-circle-and-quadrant").exercises[3].rules.target


RIGHT = PROGRAMS["hole"]


def parts(text: str, target: Target | None = None) -> set[str]:
    """Parts of a program that are wrong."""
    target = target or hole()
    found = parts_of(program_mark(target, written_of(text, target.thread)))
    return {part for part, right in zip(PARTS, found, strict=True) if right == 0}


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        (RIGHT, set()),
        (RIGHT.lower().replace("\n", "\r\n"), set()),
        (RIGHT.replace("NR1", "SR4"), set()),
        (RIGHT.replace("DD", ""), {"end"}),
        (RIGHT + "\nB1B0B1GXL1", {"end"}),
        (RIGHT.replace("B31600", "B15800"), {"closes", "shape", "offset", "thread", "direction"}),
        (RIGHT.replace("GY NR1", "GX NR1"), {"count"}),
        (RIGHT.replace("7900", "8000").replace("31600", "32000"), {"offset"}),
        (RIGHT.replace("7900", "8100").replace("31600", "32400"), {"offset"}),
        (RIGHT.replace("7900", "7800").replace("31600", "31200"), {"shape", "offset", "thread"}),
        (RIGHT.replace("B7900 B0 B7900 GX L1\n", "", 1), {"thread"}),
        (RIGHT.replace("B7900 B0 B7900 GX L3\n", "", 1), {"thread"}),
        (RIGHT.replace("GX L1", "GZ L1"), {"reads", "thread"}),
        ("", {"reads", "closes", "shape", "offset", "thread", "direction", "end"}),
    ],
)
def test_each_slip_costs_its_own_part(text: str, wrong: set[str]) -> None:
    assert parts(text) == wrong


def test_the_wrong_way_round_costs_the_direction() -> None:
    target = hole()._replace(turn=1)

    assert parts(RIGHT, target) == set()
    assert parts(RIGHT.replace("NR1", "SR4"), target) == {"direction"}


def test_programs_in_other_languages_are_marked_by_the_same_parts() -> None:
    target = hole()
    iso = "%\nG92 X0 Y0\nG90 G01 X7.9 Y0\nG03 X7.9 Y0 I-7.9 J0\nG01 X0 Y0\nM02\n"
    own = "%\nG92 X0 Y0\nG41 D1 G90 G01 X8.0 Y0\nG03 X8.0 Y0 I-8.0 J0\nG40 G01 X0 Y0\nM02\n"
    four = "B8000B0B8000B0GXL1\nB8000B0B32000B8000GYDDNR1\nB8000B0B8000B0GXL3\nDD\n"
    for text, name in ((iso, "a.iso"), (own, "b.iso"), (four, "c.4b"), (RIGHT, "d.3b")):
        found = parts_of(program_marked(text, name, target, 100.0))
        assert 0 not in found, name
    wrong = parts_of(program_marked(iso.replace("7.9", "8.1"), "a.iso", target, 100.0))
    assert [part for part, right in zip(PARTS, wrong, strict=True) if right == 0] == ["offset"]


def test_what_gives_a_fault_away_is_left_out() -> None:
    from parser.program import parse_program

    text = "****\nN1: B1000 B0 B1000 GX L1;1.000,0.000//to the right\nN2: B1000B0B1000GXL3 (back)\nN3: DD//end\n"

    bare = without_remarks(parse_program(text, "part.3b"))

    assert bare == "N1: B1000 B0 B1000 GX L1\nN2: B1000B0B1000GXL3\nDD\n"
