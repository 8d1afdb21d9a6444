"""Builds the site of the documents: `make site`. In English and Chinese, it needs no network where it is read.

Documents stand as they are; each finding has a page of its own with the picture of its example; the box to try drycut
in is a lesson (docs/class.md), which runs in the page.
"""

import logging
import re
import shutil
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Final

import yaml
from mkdocs.commands.build import build
from mkdocs.config import load_config

from parser.dialect.reader import Choices
from parser.findings.catalogue import Language, example, page
from parser.findings.errors import ProgramError
from parser.program import moving, parse_program, usual_name
from sim.jobs.lessons import lesson_names, lesson_of
from sim.setup.scenario import load_scenario
from sim.show.findings.catalogue_document import anchor
from sim.show.findings.pages import layers, page_text, page_title, severity_word
from sim.show.lesson_page import lesson_page
from sim.show.pictures.cut.of_path import PATH, PathAlone, programmed
from sim.show.pictures.files import PictureFiles, write_pictures
from sim.show.texts import Words

ROOT: Final = Path(__file__).parents[2]
DOCS: Final = ROOT / "docs"
LESSONS: Final = ROOT / "sim" / "teach" / "lessons"
LANGUAGES: Final[tuple[Language, ...]] = ("en", "zh")
NAV: Final = {
    "begin": ("index.md", "try.md", "start.md", "3b.md"),
    "check": ("check.md", "findings.md", "limits.md", "iso.md", "pmac.md", "ci.md", "editor.md"),
    "run": (
        *("scenarios.md", "report.md", "replay.md", "pictures.md"),
        *("technology.md", "sparks.md", "taper.md", "time.md", "batch.md", "terminal.md"),
    ),
    "make": ("program.md", "drawing.md", "compare.md"),
    "measure": ("ballbar.md", "fit.md", "accept.md"),
    "teach": ("class.md", "drill.md", "open.md"),
    "build": (
        *("python.md", "card.md", "libges.md", "architecture.md"),
        *("code-flow.md", "speed.md", "licences.md", "record.md"),
    ),
}
"""Pages by what somebody wants to do; titles are those of the pages."""
_SECTIONS: Final = {
    "begin": ("Begin", "开始"),
    "check": ("Check", "检查"),
    "run": ("Run", "空运行"),
    "make": ("Make programs", "编程"),
    "measure": ("Measure", "测量"),
    "teach": ("Teach", "教学"),
    "build": ("Build on it", "开发"),
}
WORDS: Final = "words.txt"
_SWITCH: Final = re.compile(r"^\[(?:中文|English)\]\([\w.-]+\.md\)\n\n", re.MULTILINE)
_OF_CHINESE: Final = re.compile(r"\(([\w-]+)\.zh\.md")
_LINK: Final = re.compile(r"\[([^\]]*)\]\(([\w-]+)\.md(#[^)]*)?\)")
_OUTSIDE: Final = re.compile(r"\[([^\]]*)\]\(\.\./[^)]*\)")
_ANCHOR: Final = re.compile(r"\((findings\.md)#[^)]*\)")
_CITED: Final = re.compile(r"docs/([\w-]+)\.md")
_WIDTH: Final = 900


def site_into(folder: Path) -> None:
    """Build the site into a folder; ends with what is wrong where a link leads nowhere."""
    with tempfile.TemporaryDirectory() as scratch:
        pages = Path(scratch) / "pages"
        write_pages(pages)
        pages.with_name(WORDS).write_text("".join(f"{word} 1000\n" for word in words_of_the_trade()), "utf-8")
        config = Path(scratch) / "mkdocs.yml"
        config.write_text(yaml.safe_dump(settings(pages, folder), allow_unicode=True, sort_keys=False), "utf-8")
        loaded = load_config(str(config), strict=True)
        loaded["mdx_configs"]["toc"]["slugify"] = lambda heading, _: anchor(heading)
        build(loaded)


def settings(pages: Path, folder: Path) -> dict[str, object]:
    """What mkdocs is told."""
    content = yaml.safe_load((Path(__file__).with_name("mkdocs.yml")).read_text("utf-8"))
    nav = [{_SECTIONS[key][0]: list(names)} for key, names in NAV.items()]
    plugins = {name: options for plugin in content["plugins"] for name, options in plugin.items()}
    plugins["i18n"]["languages"][1]["nav_translations"] = dict(_SECTIONS.values())
    plugins["search"]["jieba_dict_user"] = str(pages.with_name(WORDS))
    return {**content, "docs_dir": str(pages), "site_dir": str(folder), "nav": nav}


def words_of_the_trade() -> list[str]:
    """Words by which Chinese texts are parted for the search, longer than a letter."""
    glossary = tomllib.loads((DOCS / "glossary.toml").read_text("utf-8"))
    words = {entry["zh"] for section in glossary.values() for entry in section.values()}
    return sorted(word for word in words if len(word) > 1)


def write_pages(folder: Path) -> None:
    """Write all pages as mkdocs reads them."""
    (folder / "findings").mkdir(parents=True)
    for path in sorted(DOCS.glob("*.md")):
        if not path.name.startswith("findings."):
            (folder / path.name).write_text(page_of(path), "utf-8")
            if not _has_twin(path.name):
                (folder / path.name.replace(".md", ".zh.md")).write_text(_in_chinese_site(page_of(path)), "utf-8")
    for path in (*DOCS.glob("*.json"), *Path(__file__).parent.glob("*.md")):
        shutil.copy(path, folder)
    shutil.copytree(DOCS / "images", folder / "images")
    for name in lesson_names():
        (folder / f"lesson-{name}.html").write_text(lesson_page(lesson_of(LESSONS / name / "lesson.toml")), "utf-8")
    for language in LANGUAGES:
        ending = ".md" if language == "en" else ".zh.md"
        (folder / f"findings{ending}").write_text("\n".join(_index(language)), "utf-8")
        for _, codes in layers(language):
            for code in codes:
                (folder / "findings" / f"{code}{ending}").write_text(_finding(code, language, folder), "utf-8")


def _has_twin(name: str) -> bool:
    """Whether a document is in Chinese, or has a twin that is."""
    return name.endswith(".zh.md") or (DOCS / name.replace(".md", ".zh.md")).exists()


def page_of(path: Path) -> str:
    """A document as the site has it: the theme has the switch of languages, and links lead to pages of the site."""
    text = _SWITCH.sub("", path.read_text("utf-8"))
    text = _ANCHOR.sub(r"(\1)", _OUTSIDE.sub(r"\1", text))
    if path.name.endswith(".zh.md"):
        text = _LINK.sub(_english, text)
    return _OF_CHINESE.sub(r"(\1.md", text)


def _english(link: re.Match[str]) -> str:
    """A link from a Chinese document to the English twin of one, as its page."""
    if not _has_twin(f"{link[2]}.md"):
        return link[0]
    return f'<a href="../{link[2]}.html{link[3] or ""}">{link[1]}</a>'


def _in_chinese_site(text: str) -> str:
    """An English document among Chinese ones: those have other headings than it names."""
    return _LINK.sub(lambda link: f"[{link[1]}]({link[2]}.md)" if _has_twin(f"{link[2]}.md") else link[0], text)


def _index(language: Language) -> Iterator[str]:
    """What findings are, and their tables."""
    say = Words(language)
    introduction = say("findings_document.introduction")
    yield _linked(_SWITCH.sub("", introduction), "")
    heads = [say(f"findings_document.{name}") for name in ("head-code", "head-severity", "head-title")]
    for title, codes in layers(language):
        yield f"## {title}\n"
        yield f"| {' | '.join(heads)} |\n|---|---|---|"
        for code in codes:
            yield f"| [{code}](findings/{code}.md) | {severity_word(code, language)} | {page(code, language).title} |"
        yield ""


def _linked(text: str, up: str) -> str:
    return _CITED.sub(lambda found: f"[{found[1]}]({up}{found[1]}.md)", _OF_CHINESE.sub(rf"({up}\1.md", text))


def _finding(code: str, language: Language, folder: Path) -> str:
    """The page of a finding, with the picture of its example where that can be drawn."""
    picture = f"{code}.{language}.svg"
    text = _linked(page_text(code, language), "../")
    if not _drawn(code, language, folder / "findings" / picture):
        return text
    head, _, rest = text.partition("\n\n")
    return f"{head}\n\n![{page_title(code, language)}]({picture})\n\n{rest}"


def _drawn(code: str, language: Language, path: Path) -> bool:
    """Draw the example of a code; whether it has a path to be drawn."""
    of = example(code)
    if of is None:
        return False
    name = f"{code}.{usual_name(of.program).rpartition('.')[2]}"
    with suppress(ProgramError):
        program = moving(parse_program(of.program, name, choices=Choices()))
        scenario = replace(load_scenario(Path(name)), title=code)
        subject = PathAlone(programmed(program, scenario))
        write_pictures(subject, PictureFiles(path.parent, {PATH: path.name}), _WIDTH, "light", language)
        return True
    return False


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    logging.getLogger("jieba").setLevel(logging.WARNING)
    site_into(Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "out" / "site").resolve())
