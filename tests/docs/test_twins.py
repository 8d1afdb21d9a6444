"""Documents in two languages: each says what its twin says, section by section."""

import re
from pathlib import Path
from typing import NamedTuple

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
    """What must be alike in a section of both languages."""

    heading: str
    commands: list[str]
    codes: set[str]
    rows: list[str]
    numbers: set[str]


def twin(page: Path) -> Path:
    return page.with_name(page.name.replace(".zh.md", ".md"))


def sections(page: Path) -> list[Section]:
    """The sections of a page, one for each heading, with level and number of the heading."""
    text, fences = page.read_text("utf-8"), []

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


def is_shortened(page: Path, number: int) -> bool:
    """Whether a section names the English one, which has more."""
    body = re.split(r"^#+ .*\n", FENCE.sub("", page.read_text("utf-8")), flags=re.MULTILINE)[number + 1]
    return f"]({twin(page).name}#" in body


def test_there_are_documents_in_chinese() -> None:
    names = {page.name for page in CHINESE}
    assert {"README.zh.md", "start.zh.md", "findings.zh.md"} <= names


@pytest.mark.parametrize("page", CHINESE, ids=lambda page: page.name)
def test_twins_lead_to_each_other_in_their_first_lines(page: Path) -> None:
    for here, there in ((page, twin(page)), (twin(page), page)):
        assert f"]({there.name})" in "\n".join(here.read_text("utf-8").splitlines()[:6]), here.name


@pytest.mark.parametrize("page", WRITTEN, ids=lambda page: page.name)
def test_twins_have_the_same_headings_and_commands(page: Path) -> None:
    here, there = sections(page), sections(twin(page))
    assert [one.heading for one in here] == [one.heading for one in there]
    for number, (chinese, english) in enumerate(zip(here, there, strict=True)):
        assert chinese.commands == english.commands, number


@pytest.mark.parametrize("page", WRITTEN, ids=lambda page: page.name)
def test_twins_name_the_same_options_files_codes_and_figures(page: Path) -> None:
    """A section that leads to the English one may have less, and nothing else."""
    for number, (chinese, english) in enumerate(zip(sections(page), sections(twin(page)), strict=True)):
        if is_shortened(page, number):
            assert chinese.codes <= english.codes, number
            assert chinese.numbers <= english.numbers, number
            continue
        assert chinese.codes == english.codes, number
        assert chinese.rows == english.rows, number
        assert chinese.numbers == english.numbers, number


@pytest.mark.parametrize("name", ["README.md", "README.zh.md"])
def test_a_readme_is_short(name: str) -> None:
    assert len((ROOT / name).read_text("utf-8").splitlines()) <= 120
