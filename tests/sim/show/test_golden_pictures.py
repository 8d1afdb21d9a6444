"""The comparison with golden pictures: it fails where it must, leaves what to look at, and renews what it must."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import golden_pictures
import pytest
from browser import Browsers, Pages
from golden_pictures import SCREEN, assert_golden, compare, screen
from PIL import Image, ImageDraw

if TYPE_CHECKING:
    from playwright.sync_api import Page

PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>page</title>
<style>
body {{ font: {size} sans-serif; transform: translateX({shift}); background: {paper}; color: #222 }}
hr {{ width: 60%; height: 4px; border: 0; background: #0072b2; {line} }}
</style>
<h1>Block 5 of 6</h1><p>{text}</p><hr><p>零件 {number} mm², 废料, 切缝 0.2 mm</p><button>Play</button>"""
PLAIN = {
    "size": "16px",
    "shift": "0px",
    "paper": "#fff",
    "line": "",
    "text": "The wire moves, the kerf opens behind it, freed pieces turn grey and drop. " * 4,
    "number": "11,348.41",
}


@pytest.fixture
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Golden pictures and failures in a folder of this test."""
    monkeypatch.setattr(golden_pictures, "GOLDEN", tmp_path)
    monkeypatch.setattr(golden_pictures, "FAILURES", tmp_path / "failures")
    return tmp_path


def plain(grey: int = 100) -> Image.Image:
    return Image.new("RGB", (30, 30), (grey,) * 3)


def left(folder: Path) -> set[str]:
    return {path.stem for path in folder.iterdir()}


def test_a_line_that_is_one_pixel_off_is_seen_and_left_to_look_at(elsewhere: Path) -> None:
    first, moved = plain(), plain()
    ImageDraw.Draw(first).line((0, 10, 29, 10), (255, 0, 0))
    ImageDraw.Draw(moved).line((0, 11, 29, 11), (255, 0, 0))
    first.save(elsewhere / "line.png")
    assert compare(first, "line.png", elsewhere / "failures") == ""
    assert "155 at most" in compare(moved, "line.png", elsewhere / "failures")
    assert left(elsewhere / "failures") == {"line-actual", "line-expected", "line-difference"}


def test_a_colour_that_is_as_bright_is_another_colour(elsewhere: Path) -> None:
    plain(76).save(elsewhere / "grey.png")
    assert compare(Image.new("RGB", (30, 30), (255, 0, 0)), "grey.png", elsewhere / "failures") != ""


def test_another_size_has_no_difference_to_look_at(elsewhere: Path) -> None:
    plain().save(elsewhere / "plain.png")
    assert "size (31, 30)" in compare(plain().resize((31, 30)), "plain.png", elsewhere / "failures")
    assert left(elsewhere / "failures") == {"plain-actual", "plain-expected"}


def test_without_a_golden_picture_the_new_one_is_left_to_look_at(elsewhere: Path) -> None:
    with pytest.raises(pytest.fail.Exception, match=r"plain\.png has no golden picture.*make golden"):
        assert_golden(plain(), "plain.png")
    assert left(elsewhere / "failures") == {"plain-actual"}


def test_a_golden_picture_is_renewed_only_where_it_no_longer_fits(
    elsewhere: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(golden_pictures, "RENEW", True)
    near = plain(101)
    near.paste(plain(), (0, 2))  # two rows are one level off, 0.07 in the mean
    for image, kept in ((plain(), plain()), (near, plain()), (plain(140), plain(140))):
        assert_golden(image, "plain.png")
        assert Image.open(elsewhere / "plain.png").tobytes() == kept.tobytes()


@pytest.fixture(scope="module")
def sheet(browsers: Browsers, tmp_path_factory: pytest.TempPathFactory) -> Iterator["Page"]:
    """One page for one text after another."""
    pages = Pages(browsers.of, tmp_path_factory.mktemp("sheet"))
    yield pages.open(PAGE.format(**PLAIN), 500, 400, shipped_font=True).page
    pages.close()


@pytest.mark.alike(4)
@pytest.mark.parametrize(
    ("changed", "same"),
    [
        pytest.param({}, True, id="nothing"),
        pytest.param({"shift": "0.4px"}, True, id="where in a pixel text begins"),
        pytest.param({"paper": "#fefefe"}, True, id="a hair of colour"),
        pytest.param({"paper": "#f8f8f8"}, False, id="colour of the page"),
        pytest.param({"line": "background: #d55e00"}, False, id="colour of a line"),
        pytest.param({"line": "margin-left: 30px"}, False, id="place of a line"),
        pytest.param({"text": PLAIN["text"] * 2}, False, id="more text"),
        pytest.param({"size": "17px"}, False, id="size of text"),
        pytest.param({"number": "11,348.47"}, True, id="one digit is for tests that read it"),
    ],
)
def test_a_screen_may_be_smoothed_otherwise_but_not_laid_out_otherwise(
    sheet: "Page", elsewhere: Path, changed: dict[str, str], same: bool
) -> None:
    shots = []
    for change in ({}, changed):
        sheet.set_content(PAGE.format(**{**PLAIN, **change}))
        shots.append(screen(sheet))
    shots[0].save(elsewhere / "page.png")
    assert (compare(shots[1], "page.png", elsewhere / "failures", SCREEN) == "") == same
