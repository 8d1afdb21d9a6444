"""A scenario's title in Chinese stands wherever a run is shown in Chinese, and its own title elsewhere."""

from pathlib import Path

import pytest
from checking import drycut
from places import ROOT

from sim.setup.scenario import load_scenario

SCENARIOS = sorted(file.parent for file in (ROOT / "scenarios").glob("*/scenario.toml"))


@pytest.mark.parametrize("folder", SCENARIOS, ids=lambda folder: folder.name)
def test_each_example_has_a_title_in_both_languages(folder: Path) -> None:
    scenario = load_scenario(folder)
    assert scenario.title.isascii() or "µ" in scenario.title or "×" in scenario.title
    assert any("\u4e00" <= letter <= "\u9fff" for letter in scenario.title_in("zh"))
    assert scenario.title_in("en") == scenario.title


@pytest.mark.deeper
def test_each_page_and_the_terminal_have_that_of_their_language(tmp_path: Path) -> None:
    (tmp_path / "a.3b").write_text("B3000B0B3000GXL1\nB5000B0B20000GYNR1\nB3000B0B3000GXL3\nDD\n", "ascii")
    (tmp_path / "scenario.toml").write_text('program = "a.3b"\ntitle = "Disc"\ntitle_zh = "圆片"\n', "utf-8")
    for language, title in (("en", "Disc"), ("zh", "圆片")):
        _, out, _ = drycut("run", "--lang", language, tmp_path, "-o", tmp_path / "out")
        assert out.splitlines()[0].strip() == title
    both = '<h1><span lang="en">Disc</span><span lang="zh-CN">圆片</span></h1>'
    assert both in (tmp_path / "out" / "report.html").read_text("utf-8")
    assert both in (tmp_path / "out" / "replay.html").read_text("utf-8")
    drycut("draw", "--lang", "zh", tmp_path, "-o", tmp_path / "a.svg")
    assert "圆片: " in (tmp_path / "a.svg").read_text("utf-8")


def test_a_title_alone_is_that_of_both_languages(tmp_path: Path) -> None:
    (tmp_path / "a.3b").write_text("B10B0B10GXL1\nDD\n", "ascii")
    (tmp_path / "scenario.toml").write_text('program = "a.3b"\ntitle = "Disc"\n', "utf-8")
    assert load_scenario(tmp_path).title_in("zh") == "Disc"
