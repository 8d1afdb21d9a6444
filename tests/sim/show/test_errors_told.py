"""Errors in Chinese: every sentence that the code raises has one, and comes back with what stood in its places."""

import ast
import re
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from string import Formatter

import pytest
from command import run_inside
from places import ROOT

from parser.findings.catalogue import Said, term
from sim.show.words.told import in_both
from sim.show.words.words import texts

RAISED = {
    "UsageError",
    "BadParameter",
    "SettingsError",
    "FileUnreadableError",
    "ControllerError",
    "DrawingError",
    "ClusterError",
    "OutputError",
}
PLACE = "\0"
PASSED_ON = {
    f"{PLACE}: {PLACE}": "a file before another message, which is told by itself",
    f"{PLACE}: {PLACE}, {PLACE}": "as above",
    f"{PLACE} {PLACE}": "an option and what it cannot do: sim/cli/check/command.py",
}
"""Templates that have no words of their own, and why."""
BY_NAME = {
    "no display: write a film with -o cut.mp4, or open replay.html of drycut run",
    f"{PLACE} does not say its language by its suffix; give --as",
}
"""Templates that are given a name before they are raised."""
CHINESE = re.compile(r"[\u4e00-\u9fff\uff08]")
"""Characters, and the parenthesis that stands round a part."""


def template(node: ast.expr) -> list[str]:
    """The texts that an expression may be, with a mark for each place; none where it is not written out."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    if isinstance(node, ast.JoinedStr):
        return ["".join(part.value if isinstance(part, ast.Constant) else PLACE for part in node.values)]
    if isinstance(node, ast.IfExp):
        return [*template(node.body), *template(node.orelse)]
    return []


def raised() -> Iterator[str]:
    for package in ("parser", "controller", "sim"):
        for path in sorted((ROOT / package).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text("utf-8"))):
                if not isinstance(node, ast.Call) or not node.args:
                    continue
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                if name in RAISED or (name == "fail" and "cli" in path.parts):
                    yield from template(node.args[0])


def templates(known: Iterable[Said]) -> set[str]:
    """English templates as `template` gives them."""
    return {
        "".join(literal + (PLACE if name else "") for literal, name, _, _ in Formatter().parse(said.en))
        for said in known
    }


def test_every_sentence_that_is_raised_has_one_in_chinese() -> None:
    missing = {text.replace("\0\0", "\0") for text in raised()} - templates(texts("errors").values()) - set(PASSED_ON)
    assert missing == set()


def test_no_sentence_is_kept_that_nothing_raises() -> None:
    parts = list(texts("errors")).index("no-such-file-or-directory")
    own = templates(list(texts("errors").values())[:parts])
    assert own - {text.replace("\0\0", "\0") for text in raised()} - BY_NAME == set()


@pytest.mark.parametrize("name", texts("errors"))
def test_what_stood_in_a_place_stands_in_the_chinese_one(name: str) -> None:
    said = texts("errors")[name]
    places = [place for _, place, _, _ in Formatter().parse(said.en) if place]
    values = {place: f"<{place}7>" for place in places}
    found = in_both(said.en.format(**values)).zh
    assert CHINESE.search(found)
    assert all(value in found for value in values.values())


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["run", "gone.3b"], "gone.3b：无法读取：没有这个文件或文件夹"),
        (["run", "part.3b", "--thickness", "60"], "'60' 不是长度；请写数字和单位，如"),
        (["run", "part.3b", "--machine", "none"], "没有自带的机床 'none'；现有："),
        (["check", "--fix", "-"], "--fix 会改文件；不能改标准输入"),
        (["run", "part.3b", "--offset", "0.1mm"], "--offset 要与 --side left 或 --side right 同给"),
        (["draw", "part.3b", "-o", "a.pdf"], "a.pdf 既不是文件夹，也不是 .png 或 .svg"),
    ],
)
def test_commands_tell_what_is_wrong_in_chinese(
    arguments: list[str], told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("part.3b").write_text("B1000B0B1000GXL1\nDD\n", "utf-8")
    done = run_inside(*arguments, "--lang", "zh")
    assert done.returncode == 2
    said = done.stderr.decode()
    assert told in said, said


def test_a_term_of_the_catalogue_within_a_message_is_told_in_chinese() -> None:
    english = term("file-too-large")
    assert in_both(f"big.3b: cannot be read: {english}").zh == f"big.3b：无法读取：{term('file-too-large', 'zh')}"


GLOSSARY = sorted(
    {
        word
        for said in (*tomllib.loads((ROOT / "parser/findings/pages/terms.toml").read_text("utf-8"))["en"].values(),)
        for word in (said, said.lower())
        if word.count(" ") < 2
    }
    | {said.en for said in texts("errors").values() if " " not in said.en}
    | {"part", "slug", "wire", "kerf", "length", "speed"}
)
"""Words of ours that people may name a file, a folder or a layer by."""


@pytest.mark.parametrize("name", GLOSSARY)
def test_no_name_that_people_gave_is_translated(name: str) -> None:
    assert in_both(f"{name}: cannot be read: No such file or directory").zh == f"{name}：无法读取：没有这个文件或文件夹"
    assert in_both(f"has no layer {name}; expected one of {name}").zh == f"没有图层 {name}；应为其中之一：{name}"


@pytest.mark.parametrize("command", ["check", "run", "draw", "program", "compare", "convert", "replay", "decode"])
@pytest.mark.parametrize("name", ["part", "wire"])
def test_commands_name_what_is_not_there_as_it_is_named(
    command: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    others = {
        "draw": ["-o", "a.png"],
        "program": ["-o", "a.3b"],
        "compare": ["drawing.dxf"],
        "convert": ["-o", "a.iso"],
        "replay": ["-o", "a.gif"],
    }
    done = run_inside(command, name, *others.get(command, []), "--lang", "zh")
    assert done.returncode == 2
    said = done.stdout.decode() + done.stderr.decode()
    assert re.search(rf"(?<!\w){name}(?!\w)", said), said
    assert "零件：" not in said
    assert "钼丝：" not in said


def test_what_nobody_knows_stays_as_it_is() -> None:
    assert in_both("a sentence of some library").zh == "a sentence of some library"


def test_a_long_message_is_told_as_it_is() -> None:
    assert in_both("x; found " * 100_000 + "no end").zh.startswith("x")
    assert in_both("a: cannot be read: " * 100_000).zh.startswith("a")
    assert in_both("No such file or directory of mine").zh == "No such file or directory of mine"
