"""Documents in two languages: each says what its twin says, section by section."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from places import ROOT

CHINESE = sorted([*ROOT.glob("*.zh.md"), *(ROOT / "docs").glob("*.zh.md")])
WRITTEN = [page for page in CHINESE if page.stem != "findings.zh"]
"""Those written by people; docs/findings.zh.md is made from the pages of the catalogue."""

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PROGRAM = re.compile(r"(?:[BDGMN][\w .;-]*\n)+")
CODE = re.compile(r"`([^`]+)`|\b((?:3B|GEC|ISO|PMAC)\d{3})\b")
NUMBER = re.compile(r"\d[\d,.]*\d")


class Section(NamedTuple):
    """What must be alike in a section of both languages, and the pages in which it says that there is more."""

    heading: str
    more_in: set[str]
    commands: list[str]
    codes: set[str]
    rows: list[str]
    numbers: set[str]


def twin(page: Path) -> Path:
    return page.with_name(page.name.replace(".zh.md", ".md"))


def sections(text: str) -> list[Section]:
    """The sections of a page, one for each heading, with level and number of the heading."""
    fences: list[list[str]] = []

    def put_aside(fence: re.Match[str]) -> str:
        fences.append(commands(fence[1], fence[2]))
        return f"\0{len(fences) - 1}\0"

    parts = re.split(r"^(#+ (?:\d+\. )?).*\n", FENCE.sub(put_aside, text), flags=re.MULTILINE)[1:]
    return [section(mark, body, fences) for mark, body in zip(parts[::2], parts[1::2], strict=True)]


def section(mark: str, body: str, fences: list[list[str]]) -> Section:
    told = [line for number in re.findall(r"\0(\d+)\0", body) for line in fences[int(number)]]
    prose = re.sub(r"\]\([^)]*\)|\0\d+\0", "]", body)
    cells = [row.split("|")[1].strip() for row in re.findall(r"^\|.*\|$", prose, flags=re.MULTILINE)]
    return Section(
        heading=mark.strip(),
        more_in=set(re.findall(r"\]\(([\w.-]+\.md)#", body)),
        commands=told,
        codes={(spoken(quoted) or code) for quoted, code in CODE.findall(prose)},
        rows=[code for cell in cells for code in CODE.findall(cell)[:1] for code in code if code],
        numbers=set(NUMBER.findall(CODE.sub("", prose))),
    )


def commands(kind: str, body: str) -> list[str]:
    """What one types of a fenced block: commands without their remarks, programs and files whole, of output none."""
    if kind in {"sh", "bat"}:
        return [re.sub(r"\s+# .*", "", line) for line in body.splitlines()]
    if body.startswith("$ "):
        return [spoken(body.splitlines()[0])]
    return body.splitlines() if kind or PROGRAM.fullmatch(body) or body.startswith("drycut ") else ["output"]


def spoken(command: str) -> str:
    """The command in any language."""
    return " ".join(command.replace(" --lang zh", "").split())


def differences(chinese: str, english: str, name: str) -> list[str]:
    """What the sections of two texts do not have alike, by name of what it is.

    A section that leads to the English one, of the page of that name, may have less, and nothing else.
    """
    here, there = sections(chinese), sections(english)
    if [one.heading for one in here] != [one.heading for one in there]:
        return ["headings"]
    return [found for one, other in zip(here, there, strict=True) for found in _apart(one, other, name in one.more_in)]


def _apart(one: Section, other: Section, is_shortened: bool) -> list[str]:
    told = {
        "commands": one.commands == other.commands,
        "codes": one.codes <= other.codes if is_shortened else one.codes == other.codes,
        "numbers": one.numbers <= other.numbers if is_shortened else one.numbers == other.numbers,
        "rows": is_shortened or one.rows == other.rows,
    }
    apart = sorted(one.codes ^ other.codes | one.numbers ^ other.numbers)
    return [f"{what} near {sorted(other.codes)[:3]}: {apart}" for what, is_alike in told.items() if not is_alike]


def test_there_are_documents_in_chinese() -> None:
    names = {page.name for page in CHINESE}
    assert {"README.zh.md", "start.zh.md", "findings.zh.md"} <= names


@pytest.mark.parametrize("page", CHINESE, ids=lambda page: page.name)
def test_twins_lead_to_each_other_in_their_first_lines(page: Path) -> None:
    for here, there in ((page, twin(page)), (twin(page), page)):
        assert f"]({there.name})" in "\n".join(here.read_text("utf-8").splitlines()[:6]), here.name


@pytest.mark.parametrize("page", WRITTEN, ids=lambda page: page.name)
def test_twins_have_the_same_headings_commands_options_codes_and_figures(page: Path) -> None:
    assert differences(page.read_text("utf-8"), twin(page).read_text("utf-8"), twin(page).name) == []


@pytest.mark.parametrize(
    ("said", "changed", "what"),
    [
        ("## Settings", "### Settings", "headings"),
        ("--write-baseline known.json", "--write-baseline old.json", "commands"),
        ("`--quiet`", "`--silent`", "codes"),
        ("| 0.01 to 1 |", "| 0.02 to 1 |", "numbers"),
        ("| `root` | true", "| `top` | true", "rows"),
    ],
)
def test_a_change_of_one_twin_is_noticed(said: str, changed: str, what: str) -> None:
    chinese, english = ((ROOT / "docs" / name).read_text("utf-8") for name in ("check.zh.md", "check.md"))
    found = differences(chinese, english.replace(said, changed), "check.md")
    assert any(difference.startswith(what) for difference in found)


NAMES_OF_SYSTEMS = {"Open with", "Send to", "允许启动", "打开方式", "发送到"}
"""Names on desktops, which no page of drycut has."""


def texts(words: Any, language: str) -> Iterator[str]:
    """All texts of a file of words, in one language."""
    for name, value in words.items():
        if isinstance(value, str) and name == language:
            yield value
        elif isinstance(value, dict):
            yield from texts(value, language)


@pytest.mark.parametrize("page", ["open.md", "open.zh.md", "replay.md", "replay.zh.md"])
def test_names_in_quotes_are_those_on_the_pages(page: str) -> None:
    language = "zh" if ".zh." in page else "en"
    prose = re.sub(r"```.*?```|`[^`]*`", "", (ROOT / "docs" / page).read_text("utf-8"), flags=re.DOTALL)
    quoted = {" ".join(name.split()) for name in re.findall(r"[\"“]([^\"”]+)[\"”]", prose)}
    words = [tomllib.loads(path.read_text("utf-8")) for path in (ROOT / "sim/show/texts").glob("*.toml")]
    shown = "\n".join(text for of in words for text in texts(of, language))
    missing = [name for name in quoted if not re.search(re.escape(name).replace("……", ".*"), shown)]
    assert set(missing) <= NAMES_OF_SYSTEMS


@pytest.mark.parametrize("page", WRITTEN, ids=lambda page: page.name)
def test_no_line_of_chinese_ends_within_a_clause(page: Path) -> None:
    """A line end is shown as a blank: behind a mark it is not seen, between two letters it is."""
    prose = FENCE.sub("", page.read_text("utf-8"))
    assert re.findall(r"^(?!#).*[\u4e00-\u9fff]\n *[\u4e00-\u9fff].*$", prose, flags=re.MULTILINE) == []


@pytest.mark.parametrize("name", ["README.md", "README.zh.md"])
def test_a_readme_is_short(name: str) -> None:
    assert len((ROOT / name).read_text("utf-8").splitlines()) <= 120
