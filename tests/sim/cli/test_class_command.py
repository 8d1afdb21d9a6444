"""``drycut class``: lessons written, a class marked, in both languages, and wrong input."""

import json
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import pytest
from command import run_inside, without_progress
from jsonschema import Draft202012Validator
from places import ROOT
from sittings import hand_in_of, ready, text_of

NAMES = ["1-first-blocks", "2-circle-and-quadrant", "3-a-whole-die"]


def lesson(folder: Path, name: str = NAMES[0]) -> Path:
    done = run_inside("class", "example", name, "-o", folder / "lesson")
    assert done.returncode == 0, done.stderr
    return folder / "lesson" / "lesson.toml"


def valid(name: str, document: object) -> None:
    schema = json.loads((ROOT / "docs" / f"{name}.schema.json").read_text("utf-8"))
    Draft202012Validator(schema).validate(document)


@pytest.mark.parametrize(("lang", "title"), [("en", "Circle and quadrant"), ("zh", "第二课：圆弧和象限")])
def test_lessons_are_listed(lang: str, title: str) -> None:
    done = run_inside("class", "example", "--lang", lang)

    assert [line.split()[0] for line in done.stdout.decode().splitlines()] == NAMES
    assert title in done.stdout.decode()


@pytest.mark.parametrize("name", NAMES)
def test_a_lesson_that_comes_with_drycut_is_written_and_made(tmp_path: Path, name: str) -> None:
    file = lesson(tmp_path, name)
    page, package = tmp_path / "lesson.html", tmp_path / "lesson.zip"

    done = run_inside("class", "make", file, "-o", page, "--scorm", package)

    assert (done.returncode, without_progress(done.stderr)) == (0, b"")
    text = page.read_text("utf-8")
    assert "<script src" not in text
    assert "://" not in text.replace("http://www.w3.org/2000/svg", "")
    with zipfile.ZipFile(package) as files:
        assert files.namelist() == ["imsmanifest.xml", "lesson.html"]
        assert files.read("lesson.html").decode() == text
        manifest = ElementTree.fromstring(files.read("imsmanifest.xml"))  # noqa: S314 - our own
    spaces = {"c": "http://www.imsproject.org/xsd/imscp_rootv1p1p2", "a": "http://www.adlnet.org/xsd/adlcp_rootv1p2"}
    (unit,) = manifest.findall("c:resources/c:resource", spaces)
    (item,) = manifest.findall("c:organizations/c:organization/c:item", spaces)
    assert manifest.findtext("c:metadata/c:schemaversion", None, spaces) == "1.2"
    assert (unit.get(f"{{{spaces['a']}}}scormtype"), unit.get("href")) == ("sco", "lesson.html")
    assert item.get("identifierref") == unit.get("identifier")
    again = tmp_path / "again.zip"
    assert run_inside("class", "make", file, "-o", page, "--scorm", again).returncode == 0
    assert again.read_bytes() == package.read_bytes()


@pytest.mark.parametrize(("lang", "says"), [("en", "mean"), ("zh", "平均")])
def test_a_class_is_marked(tmp_path: Path, lang: str, says: str) -> None:
    file, handed_in = lesson(tmp_path), tmp_path / "handed-in"
    handed_in.mkdir()
    for number in range(4):
        hand_in = hand_in_of(ready(NAMES[0]), f"学生{number}", 0.8)
        valid("hand-in", hand_in)
        (handed_in / f"{number}.drycut.json").write_bytes(text_of(hand_in))
    (handed_in / "x.drycut.json").write_text("{", "utf-8")

    done = run_inside("class", "mark", file, handed_in, "-o", tmp_path / "marks", "--lang", lang)

    assert done.returncode == 0
    assert says in done.stdout.decode()
    assert "x.drycut.json" in done.stderr.decode()
    assert "学生0" in done.stderr.decode()  # its file claims no points at all
    names = sorted(path.name for path in (tmp_path / "marks").iterdir())
    assert names == ["index.html", "marks.csv", "marks.xlsx", *(f"pupil-000{number}.html" for number in range(1, 5))]

    done = run_inside("class", "mark", file, handed_in, "--json")
    document = json.loads(done.stdout)
    valid("marks", document)
    assert len(document["pupils"]) == 4


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (("make", "lesson.toml", "-o", "a.txt"), 2, ".html"),
        (("make", "lesson.toml", "-o", "a.html", "--scorm", "a.html"), 2, ".zip"),
        (("make", "nowhere.toml", "-o", "a.html"), 2, "nowhere.toml"),
        (("make", "lesson.toml"), 2, "-o"),
        (("mark", "lesson.toml", "nowhere", "-o", "m"), 2, "nowhere"),
        (("mark", "lesson.toml", "."), 2, "--json"),
        (("mark", "lesson.toml", ".", "-o", "m"), 1, "no hand-in"),
        (("example", "first"), 2, "no lesson first"),
        (("example", "1-first-blocks", "-o", "."), 2, "is there"),
        (("marks",), 2, "marks"),
    ],
)
def test_wrong_use_is_told(tmp_path: Path, arguments: tuple[str, ...], code: int, says: str) -> None:
    folder = lesson(tmp_path).parent

    done = run_inside("class", *arguments, cwd=folder)

    assert (done.returncode, says in done.stderr.decode()) == (code, True), done.stderr.decode()
    assert sorted(path.name for path in folder.iterdir()) == ["lesson.toml", "opening.dxf"]
