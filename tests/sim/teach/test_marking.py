"""Marks of a class: changed files, other people's numbers, copies, and hand-ins made to do harm."""

import csv
import io
import json
import re
import zipfile
from pathlib import Path
from typing import Any

import pytest
from sittings import PROGRAMS, hand_in_of, ready, text_of

from sim.jobs.class_marks import FIXED, class_result, marking_of, marks_into
from sim.show.lesson_page.page import lesson_entry
from sim.teach.handins import MOST_BYTES, HandInError, read_hand_in
from sim.teach.marking import marked
from sim.teach.marks_document import marks_text

NAME = "1-first-blocks"
EVIL = '</script><img src=x onerror=alert(1)>=HYPERLINK("http://x")'


def tasks() -> tuple[int, ...]:
    return tuple(exercise.rules.tasks for exercise in ready(NAME).exercises)


def honest(name: str, skill: float = 0.7, group: str = "1 班") -> dict[str, Any]:
    """A hand-in whose points are those that its answers earn."""
    hand_in = hand_in_of(ready(NAME), name, skill, group)
    read = read_hand_in(text_of(hand_in), hand_in["lesson"], tasks())
    return hand_in | {"points": list(marked(marking_of(ready(NAME)), read).points)}


def put(folder: Path, name: str, hand_in: dict[str, Any]) -> None:
    (folder / f"{name}.drycut.json").write_bytes(text_of(hand_in))


def test_an_honest_class_is_marked_and_nothing_is_told_of_it(tmp_path: Path) -> None:
    for number in range(30):
        put(tmp_path, f"{number}", honest(f"学生{number}", number / 30))

    result = class_result(ready(NAME), tmp_path)

    assert len(result.marks) == 30
    assert not any(mark.is_changed or mark.is_of_other for mark in result.marks)
    assert (result.alike, result.unread) == ((), ())
    by_name = {mark.name: mark.sum for mark in result.marks}
    assert by_name["学生29"] > by_name["学生0"]
    assert [count for _, count in result.common] == sorted((count for _, count in result.common), reverse=True)


def test_a_changed_mark_is_found_and_does_not_count(tmp_path: Path) -> None:
    for number in range(100):
        hand_in = honest(f"学生{number}", 0.4)
        hand_in["points"][number % 5] += 0.5 + number % 7
        put(tmp_path, f"{number}", hand_in)

    result = class_result(ready(NAME), tmp_path)

    assert all(mark.is_changed for mark in result.marks)
    assert [mark.points for mark in result.marks] == [
        marked(marking_of(ready(NAME)), hand_in).points for hand_in in result.hand_ins
    ]


def test_a_file_handed_on_under_another_name_is_told(tmp_path: Path) -> None:
    hand_in = honest("李雷", 1.0)
    put(tmp_path, "a", hand_in)
    put(tmp_path, "b", hand_in | {"name": "韩梅梅"})
    put(tmp_path, "c", hand_in | {"name": "韩梅", "seed": marking_of(ready(NAME)).seed_of("韩梅 1 班")})

    by_name = {mark.name: mark for mark in class_result(ready(NAME), tmp_path).marks}

    assert not by_name["李雷"].is_of_other
    assert by_name["韩梅梅"].is_of_other
    assert by_name["韩梅"].is_changed  # its numbers are its own now, and the answers are not theirs
    assert by_name["韩梅"].sum < by_name["李雷"].sum


def test_wrong_answers_in_the_same_letters_are_told(tmp_path: Path) -> None:
    wrong = [f"{PROGRAMS['opening'].replace('9800', '9850')}\n; {number}" for number in range(2)]
    for number in range(12):
        hand_in = honest(f"学生{number}")
        if number < 2:
            hand_in["answers"][4] = [wrong]
            hand_in["answers"][2] = [["1, 2"], ["3, 4"], []]
        put(tmp_path, f"{number:02}", hand_in)

    result = class_result(ready(NAME), tmp_path)

    (pair,) = result.alike
    assert {result.marks[pair.this].name, result.marks[pair.other].name} == {"学生0", "学生1"}
    assert pair.answers == 4


def test_of_one_name_the_best_counts(tmp_path: Path) -> None:
    put(tmp_path, "a", honest("李雷", 0.0))
    put(tmp_path, "b", honest("李雷", 1.0) | {"answers": honest("李雷", 1.0)["answers"]})

    result = class_result(ready(NAME), tmp_path)

    assert len(result.marks) == 1
    assert result.marks[0].sum > 50
    assert [each.why for each in result.unread] == ["twice"]


DAMAGES: list[tuple[str, Any]] = [
    ("no-hand-in", []),
    ("schema", {"schema": "drycut.hand-in/2"}),
    ("other-lesson", {"lesson": "0" * 16}),
    ("no-name", {"name": ""}),
    ("no-name", {"name": "x" * 41}),
    ("no-name", {"group": 7}),
    ("no-hand-in", {"seed": True}),
    ("no-hand-in", {"seed": "1"}),
    ("no-hand-in", {"answers": []}),
    ("no-hand-in", {"answers": [[["a", "b", "c"]]] * 5}),
    ("no-hand-in", {"answers": None}),
    ("no-hand-in", {"points": [1e9] * 5}),
    ("no-hand-in", {"points": [-1.0] * 5}),
    ("no-hand-in", {"seconds": [None] * 5}),
]


@pytest.mark.parametrize(("why", "damage"), DAMAGES)
def test_what_is_no_hand_in_is_told_why(why: str, damage: Any) -> None:
    whole = honest("李雷")
    content = whole | damage if isinstance(damage, dict) else damage

    with pytest.raises(HandInError) as refused:
        read_hand_in(json.dumps(content).encode(), whole["lesson"], tasks())

    assert refused.value.why == why


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\xff\xfe",
        b"{",
        b"[" * 100_000,
        b'{"schema": NaN}',
        b'{"schema": "drycut.hand-in/1", "points": [Infinity]}',
        b"9" * 5000,
        b"x" * (MOST_BYTES + 1),
    ],
)
def test_damaged_files_are_refused(data: bytes) -> None:
    with pytest.raises(HandInError):
        read_hand_in(data, "0" * 16, tasks())


def test_what_a_hand_in_says_does_nothing(tmp_path: Path) -> None:
    handed_in, marks = tmp_path / "in", tmp_path / "marks"
    handed_in.mkdir()
    for at, name in enumerate(("=1+1", EVIL[:40], "../../up", "a\nb\x1b[2J", "@x")):
        hand_in = honest("李雷") | {"name": name}
        hand_in["answers"][0][0] = [EVIL, "\x00\x1b]0;x\x07"]
        hand_in["answers"][4] = [["B" * 199_999]]
        put(handed_in, f"{at}", hand_in)
    (handed_in / "<b>.drycut.json").write_text("{}", "utf-8")

    result = class_result(ready(NAME), handed_in)
    names = marks_into(result, marks)

    assert sorted(path.name for path in marks.iterdir()) == sorted(names)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in", "marks"]
    for name in names:
        if name.endswith(".html"):
            text = (marks / name).read_text("utf-8")
            assert "<img" not in text
            assert not re.search(r"[\x00-\x08\x0b-\x1f]", text)
    rows = list(csv.reader(io.StringIO((marks / FIXED[1]).read_text("utf-8-sig"))))
    assert not any(cell.startswith(("=", "+", "-", "@")) for row in rows for cell in row)
    with zipfile.ZipFile(marks / FIXED[2]) as book:
        sheets = b"".join(book.read(name) for name in book.namelist() if "sheet" in name)
    assert b"<f>" not in sheets
    assert b"hyperlink" not in sheets.lower()
    assert "\x1b" not in marks_text(result)


def test_the_same_class_gives_the_same_bytes(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    for number in range(5):
        put(tmp_path / "in", f"{number}", honest(f"学生{number}"))
    for name in ("one", "two"):
        result = class_result(ready(NAME), tmp_path / "in")
        marks_into(result, tmp_path / name)

    for path in (tmp_path / "one").iterdir():
        assert path.read_bytes() == (tmp_path / "two" / path.name).read_bytes(), path.name


def test_programs_in_folders_by_pupil_are_marked(tmp_path: Path) -> None:
    for name, files in {
        "王小明": {"part.3b": PROGRAMS["opening"]},
        "李雷": {"a.3b": PROGRAMS["opening"].replace("DD", ""), "b.txt": "no program"},
        "韩梅梅": {"5.iso": "hello"},
        "赵六": {"2-x.3b": PROGRAMS["opening"]},
    }.items():
        (tmp_path / name).mkdir()
        for file, text in files.items():
            (tmp_path / name / file).write_text(text, "utf-8")

    result = class_result(ready(NAME), tmp_path)

    points = {mark.name: mark.points for mark in result.marks}
    assert points["王小明"] == (0.0, 0.0, 0.0, 0.0, 25.0)
    assert points["李雷"][4] == pytest.approx(25.0 * 14 / 15)
    assert points["赵六"][4] == 25.0  # there is but one program to write
    assert [(each.name, each.why) for each in result.unread] == [("韩梅梅/5.iso", "no-program")]


OPENING_ISO = "G91 G92 X0 Y0\nG01 X4900\nG01 Y2900\nG01 X-9800\nG01 Y-5800\nG01 X9800\nG01 Y2900\nG01 X-4900\nM02\n"


def test_the_page_of_a_pupil_shows_what_his_program_earned_in_any_dialect(tmp_path: Path) -> None:
    (tmp_path / "in" / "王小明").mkdir(parents=True)
    (tmp_path / "in" / "王小明" / "5.iso").write_text(OPENING_ISO, "utf-8")

    result = class_result(ready(NAME), tmp_path / "in")
    marks_into(result, tmp_path / "marks")

    (mark,) = result.marks
    assert mark.points[4] == 25.0
    text = (tmp_path / "marks" / "pupil-0001.html").read_text("utf-8")
    assert re.findall(r'<td class="number (?:right|wrong)">([^<]*)</td>', text)[-1] == "100 %"


def test_links_out_of_the_folder_are_not_followed(tmp_path: Path) -> None:
    outside, handed_in = tmp_path / "outside", tmp_path / "in"
    outside.mkdir()
    handed_in.mkdir()
    put(outside, "a", honest("李雷"))
    (handed_in / "b.drycut.json").symlink_to(outside / "a.drycut.json")
    (handed_in / "c").symlink_to(outside, target_is_directory=True)

    assert class_result(ready(NAME), handed_in).marks == ()


def test_a_lesson_that_was_changed_does_not_take_the_hand_ins_of_before() -> None:
    lesson = ready(NAME)
    other = lesson._replace(lesson=lesson.lesson._replace(seed=99))

    assert lesson_entry(lesson)["lesson"] != lesson_entry(other)["lesson"]
