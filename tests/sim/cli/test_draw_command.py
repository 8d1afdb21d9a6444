"""``drycut draw`` as a user meets it: the files it writes, their sizes, bad use, and the options of a run."""

import re
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from command import run_command, run_inside
from PIL import Image

from sim.show.draw.style import DARK, LIGHT, Paint
from sim.show.pictures import files
from sim.show.pictures.gallery import PICTURES

PART = "B600 B0 B600 GX L1 B0 B600 B600 GY L2 B600 B0 B600 GX L3 B0 B600 B600 GY L4 DD"
CIRCLE = "B400 B0 B1600 GY NR1 DD"
FAULTY = PART.replace("B600 B0 B600 GX L3", "B600 B0 B600 GX L7")
NO_CIRCLE = [name for name in PICTURES if name != "polar"]
SMALL = ("--size", "600")
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "零件.3b"
    path.write_text(PART, "utf-8")
    return path


def said(done: subprocess.CompletedProcess[bytes]) -> str:
    """What stderr says, but for progress, which is told after a second."""
    return re.sub(r"^drycut: .*, +\d+ ?%\n", "", done.stderr.decode(), flags=re.MULTILINE)


def texts_of(svg: Path) -> str:
    return "\n".join(one.text or "" for one in ET.parse(svg).iter(f"{SVG}text"))  # noqa: S314 - a file made here


def test_a_folder_gets_all_pictures_there_are_and_an_old_one_goes(part: Path, tmp_path: Path) -> None:
    folder = tmp_path / "pictures"
    folder.mkdir()
    (folder / "polar.png").write_bytes(b"of an earlier run")
    (folder / "mine.txt").write_text("kept", "utf-8")
    done = run_inside("draw", part, "-o", folder, *SMALL)
    names = [f"{name}.png" for name in NO_CIRCLE]
    assert (done.returncode, said(done)) == (0, "")
    assert done.stdout.decode() == f"written: {', '.join(str(folder / name) for name in names)}\n"
    assert {file.name for file in folder.iterdir()} == {*names, "mine.txt"}


def test_a_circle_has_a_polar_picture(tmp_path: Path) -> None:
    (tmp_path / "round.3b").write_text(CIRCLE, "utf-8")
    done = run_inside("draw", "round.3b", "-o", "p", "--picture", "polar", "--picture", "cut", *SMALL, cwd=tmp_path)
    assert (done.returncode, done.stdout.decode()) == (0, "written: p/polar.png, p/cut.png\n")
    assert {file.name for file in (tmp_path / "p").iterdir()} == {"polar.png", "cut.png"}


def test_a_picture_that_there_is_not_changes_nothing(part: Path) -> None:
    old = part.with_name("old.png")
    old.write_bytes(b"old")
    for output in ("old.png", "new/deep"):
        done = run_inside("draw", part.name, "-o", output, "--picture", "polar", cwd=part.parent)
        assert (done.returncode, done.stdout) == (2, b"")
        assert said(done) == "drycut: error: polar: this program has nothing to show there; nothing written\n"
    assert old.read_bytes() == b"old"
    assert sorted(part.parent.iterdir()) == sorted([old, part])


@pytest.mark.alike(2)
@pytest.mark.parametrize(
    ("size", "width_px"), [("thumbnail", 320), ("screen", 1600), ("A4", 3508), ("a3", 4961), ("777", 777)]
)
def test_pictures_are_as_wide_as_asked(part: Path, tmp_path: Path, size: str, width_px: int) -> None:
    done = run_inside("draw", part, "-o", tmp_path / "cut.png", "--size", size)
    assert done.returncode == 0
    with Image.open(tmp_path / "cut.png") as picture:
        assert picture.width == width_px
        assert picture.info["dpi"] == pytest.approx((300, 300), abs=0.01)


@pytest.mark.parametrize("name", NO_CIRCLE)
def test_thumbnails_of_all_pictures_are_as_wide_as_asked(part: Path, tmp_path: Path, name: str) -> None:
    run_inside("draw", part, "-o", tmp_path / "a.png", "--picture", name, "--size", "thumbnail")
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.width == 320
        assert 0.3 * 320 <= picture.height <= 1.2 * 320


def test_svg_is_well_formed_as_wide_as_asked_and_says_what_it_is(part: Path, tmp_path: Path) -> None:
    done = run_inside("draw", part, "-o", tmp_path / "svg", "--svg", "--size", "thumbnail")
    assert done.returncode == 0
    assert {file.name for file in (tmp_path / "svg").iterdir()} == {f"{name}.svg" for name in NO_CIRCLE}
    for file in (tmp_path / "svg").iterdir():
        root = ET.parse(file).getroot()  # noqa: S314 - a file made here
        assert (root.tag, root.get("width"), root.get("role")) == (f"{SVG}svg", "320", "img")
        assert part.name in root.get("aria-label", "")


@pytest.mark.alike(1)
@pytest.mark.parametrize("name", ["cut.png", "cut.svg"])
def test_the_same_picture_is_the_same_bytes(part: Path, tmp_path: Path, name: str) -> None:
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        assert run_command("draw", part, "-o", tmp_path / folder / name, *SMALL).returncode == 0
    assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()


def test_theme_and_language_are_those_asked(part: Path, tmp_path: Path) -> None:
    run_inside("draw", part, "-o", tmp_path / "en.svg", *SMALL)
    run_inside("draw", part, "-o", tmp_path / "zh.svg", "--lang", "zh", *SMALL)
    assert "start hole" in texts_of(tmp_path / "en.svg")
    assert "穿丝孔" in texts_of(tmp_path / "zh.svg")
    for theme, colours in (("light", LIGHT), ("dark", DARK)):
        run_inside("draw", part, "-o", tmp_path / "a.png", "--theme", theme, *SMALL)
        with Image.open(tmp_path / "a.png") as picture:
            assert picture.convert("RGB").getpixel((1, 1)) == colours[Paint.PAGE]


def test_options_of_a_run_hold(part: Path, tmp_path: Path) -> None:
    told = {}
    for name, options in {"plain": (), "thick": ("--thickness", "60mm"), "offset": ("--offset", "0.1mm")}.items():
        side = ("--side", "right") if name == "offset" else ()
        done = run_inside("draw", part, "-o", tmp_path / f"{name}.svg", "--picture", "cut", *options, *side, *SMALL)
        assert done.returncode in (0, 1), said(done)
        told[name] = texts_of(tmp_path / f"{name}.svg")
    assert len(set(told.values())) == 3
    assert "offset 0.1 mm right" in told["offset"]


def test_a_failed_verdict_exits_1_with_its_picture(tmp_path: Path) -> None:
    (tmp_path / "bad.3b").write_text(FAULTY, "utf-8")
    done = run_inside("draw", "bad.3b", "-o", "bad.svg", *SMALL, cwd=tmp_path)
    assert (done.returncode, done.stdout.decode()) == (1, "written: bad.svg\n")
    assert "fail" in texts_of(tmp_path / "bad.svg")


def test_a_program_in_a_scenario_folder_is_drawn_under_its_title(part: Path, tmp_path: Path) -> None:
    (tmp_path / "s").mkdir()
    part.rename(tmp_path / "s" / "p.3b")
    (tmp_path / "s" / "scenario.toml").write_text(
        'title = "<b>R & D</b>"\nprogram = "p.3b"\nmachine = "dk7740"\n', "utf-8"
    )
    assert run_inside("draw", "s", "-o", "s.svg", *SMALL, cwd=tmp_path).returncode == 0
    assert "<b>R & D</b>" in texts_of(tmp_path / "s.svg")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ((), "Missing option '-o'"),
        (("-o", "cut.jpg"), "cut.jpg is neither a folder nor a .png or .svg"),
        (("-o", "cut.png", "--picture", "pie"), "'pie' is none of path, cut, along"),
        (("-o", "cut.png", "--picture", "cut", "--picture", "along"), "give a folder"),
        (("-o", "cut.png", "--svg"), "--svg is for folders"),
        (("-o", "cut.png", "--size", "0"), "nor a width of 160 to 10000 px"),
        (("-o", "cut.png", "--size", "huge"), "'huge' is none of thumbnail, screen, a4, a3"),
        (("-o", "cut.png", "--theme", "pink"), "pink"),
        (("-o", "cut.png", "--machine", "none"), "none"),
        (("-o", "零件.3b/cut.png"), "is a file"),
        (("-o", "零件.3b"), "is neither a folder"),
        (("-o", "/dev/null"), "/dev/null"),
    ],
)
def test_bad_use_exits_2_with_one_line_and_leaves_nothing(part: Path, options: tuple[str, ...], message: str) -> None:
    done = run_inside("draw", part.name, *options, cwd=part.parent)
    assert (done.returncode, done.stdout) == (2, b"")
    assert message in said(done)
    assert said(done).count("\n") == 1
    assert list(part.parent.iterdir()) == [part]


@pytest.mark.parametrize("content", [None, b"", b"hello", b"\x89PNG\r\n\x1a\n\0\0"])
def test_a_bad_program_exits_2_and_leaves_nothing(tmp_path: Path, content: bytes | None) -> None:
    if content is not None:
        (tmp_path / "bad.3b").write_bytes(content)
    before = list(tmp_path.iterdir())
    done = run_inside("draw", "bad.3b", "-o", "new/pictures", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    assert "bad.3b" in said(done)
    assert list(tmp_path.iterdir()) == before


def test_a_picture_that_fails_on_the_way_leaves_all_old_ones(part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = part.with_name("pictures")
    folder.mkdir()
    for name in NO_CIRCLE:
        (folder / f"{name}.png").write_bytes(b"old")
    drawn = []

    def label_or_stop(name: str, *_: object) -> str:
        drawn.append(name)
        if len(drawn) == 3:
            raise KeyboardInterrupt
        return name

    monkeypatch.setattr(files, "label", label_or_stop)
    done = run_inside("draw", part.name, "-o", "pictures", "--svg", *SMALL, cwd=part.parent)
    assert (done.returncode, done.stdout) == (130, b"")
    assert len(drawn) == 3
    assert {file.name for file in folder.iterdir()} == {f"{name}.png" for name in NO_CIRCLE}
    assert {file.read_bytes() for file in folder.iterdir()} == {b"old"}
