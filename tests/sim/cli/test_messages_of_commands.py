"""What commands say is wrong, in Chinese; and that names which users gave stand in it as they gave them."""

import re
from pathlib import Path

import pytest
from command import run_inside
from places import ROOT

NAMES = ("part", "slug", "wire")
"""Words of the glossary: 零件, 废料, 钼丝."""
TRANSLATED = re.compile("零件：|废料：|钼丝：|'零件'|'废料'|'钼丝'")
OTHERS = {
    "draw": ["-o", "a.png"],
    "program": ["-o", "a.3b"],
    "compare": ["drawing.dxf"],
    "convert": ["-o", "a.iso"],
    "replay": ["-o", "a.gif"],
    "drill": ["-o", "out"],
    "card replay": [],
    "card run": [],
}
"""What commands need beside the name of what is not there."""


def said(*arguments: str, code: int = 2) -> str:
    done = run_inside("--lang", "zh", *arguments)
    assert done.returncode == code, done.stderr.decode()
    return done.stdout.decode() + done.stderr.decode()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["run", "gone.3b"], "gone.3b：无法读取：没有这个文件或文件夹"),
        (["check", "gone.3b"], "没有这个文件或文件夹"),
        (["run", "part.3b", "--thickness", "60"], "'60' 不是长度；请写数字和单位，如"),
        (["run", "part.3b", "--machine", "none"], "没有自带的机床 'none'；现有："),
        (["check", "--fix", "-"], "--fix 会改文件；不能改标准输入"),
        (["check", "--fix", "gone.3b"], "没有这个文件或文件夹"),
        (["run", "part.3b", "--offset", "0.1mm"], "--offset 要与 --side left 或 --side right 同给"),
        (["draw", "part.3b", "-o", "a.pdf"], "a.pdf 既不是文件夹，也不是 .png 或 .svg"),
        (["replay", "part.3b", "--fps", "99"], "--fps：99 不在范围 1<=x<=60 内。"),
        (["replay", "part.3b", "--fps", "fast"], "--fps：'fast' 不是整数。"),
        (["replay", "part.3b", "--seconds", "long"], "--seconds：'long' 不是数字。"),
        (["decode", "part.3b", "more"], "多了参数（more）"),
        (["decode", "part.3b", "more", "yet"], "多了参数（more yet）"),
        (["decode", "part.3b"], "part.3b 是 3B 程序，不按字逐个译码"),
        (["check", "part.3b", "--dialect"], "选项 '--dialect' 要有值。"),
        (["check", "part.3b", "--quiet=yes"], "选项 '--quiet' 不带值。"),
        (["run", "part.3b", "--card-log", "."], "'.' 应为文件，却是文件夹。"),
        (["drill", "part.3b", "-o", "part.3b"], "'part.3b' 应为文件夹，却是文件。"),
    ],
)
def test_commands_tell_what_is_wrong_in_chinese(arguments: list[str], told: str, folder: Path) -> None:
    (folder / "part.3b").write_text("B1000B0B1000GXL1\nDD\n", "utf-8")
    found = said(*arguments)
    assert told in found, found


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    "command", ["check", "run", "draw", "program", "compare", "convert", "replay", "decode", "drill", "card replay"]
)
def test_commands_name_what_is_not_there_as_it_is_named(command: str, name: str, folder: Path) -> None:
    found = said(*command.split(), name, *OTHERS.get(command, []))
    assert re.search(rf"(?<!\w){name}(?!\w)", found), found
    assert not TRANSLATED.search(found)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("command", ["draw", "program", "convert", "replay"])
def test_a_folder_without_a_scenario_is_named_as_it_is(command: str, name: str, folder: Path) -> None:
    (folder / name).mkdir()
    found = said(command, name, *OTHERS.get(command, []))
    assert re.search(rf"(?<!\w){name}(?!\w)", found), found
    assert not TRANSLATED.search(found)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("command", ["program", "compare"])
def test_a_layer_is_named_as_it_is(command: str, name: str, folder: Path) -> None:
    drawing = str(ROOT / "scenarios" / "keyhole" / "drawing.dxf")
    (folder / "part.3b").write_text("B1000B0B1000GXL1\nDD\n", "utf-8")
    files = [drawing, "-o", "a.3b"] if command == "program" else ["part.3b", drawing]
    found = said(command, *files, "--layer", name)
    assert f"没有图层 {name}；应为其中之一：" in found, found


def test_a_refusal_is_in_chinese_from_each_command_that_makes_the_program(folder: Path) -> None:
    scenario = folder / "wire"
    scenario.mkdir()
    (scenario / "wire.dxf").write_bytes((ROOT / "scenarios" / "keyhole" / "drawing.dxf").read_bytes())
    text = '[program]\nfile = "a.3b"\nthread_layer = "wire"\n[drawing]\nfile = "wire.dxf"\n'
    (scenario / "scenario.toml").write_text(text, "utf-8")
    whys = set()
    for command in (["program", "wire"], ["run", "wire"], ["draw", "wire", "-o", "a.png"]):
        found = said(*command, code=1 if command[0] == "program" else 2)
        whys.add(found.split("未生成程序：")[1].split("\n")[0])
    assert len(whys) == 1, whys
    assert "图层 wire " in whys.pop()
