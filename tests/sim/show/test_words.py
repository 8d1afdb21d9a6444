"""Words for people: every text in both languages with the same places, each of them used, and none of them in code."""

import re
import string
import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT

from parser.findings.catalogue import LANGUAGES, Said
from sim.show.words import Words, said
from sim.show.words.words import FOLDER, texts

PACKAGES = ("parser", "controller", "sim")
FILES = sorted(path.stem for path in FOLDER.glob("*.toml"))
CODE = (".py", ".js", ".j2")
CHINESE = re.compile(r"[\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef]")
COUNTED = ("findings.one-", "findings.some-", "phrases.one-", "phrases.some-")
FROM_DATA = ("report.is-", "report.of-", "report.by-", "report.kind-", "report.as-cut-", "report.nominal-", *COUNTED)
"""Texts of kinds, axes and numbers that the report page meets in the report, and a check in its findings."""

CHECK = """
import atexit, sys
from sim.cli import main
from sim.show.words.words import texts

atexit.register(lambda: sys.stderr.write(f"{texts.cache_info().currsize} files"))
main()
"""


def sources(*suffixes: str) -> dict[Path, str]:
    paths = (path for package in PACKAGES for path in sorted((ROOT / package).rglob("*")) if path.suffix in suffixes)
    return {path: path.read_text(encoding="utf-8") for path in paths}


def places(text: str) -> list[str]:
    return sorted({name for _, name, _, _ in string.Formatter().parse(text) if name is not None})


@pytest.mark.parametrize("file", FILES)
def test_every_text_stands_in_both_languages_with_the_same_places(file: str) -> None:
    assert texts(file)
    for name, text in texts(file).items():
        assert all(text), name
        assert places(text.en) == places(text.zh), name


def test_every_text_is_used() -> None:
    source = "\n".join(sources(*CODE).values())
    words = set(re.findall(r"""["']([\w.-]+)["']""", source))
    formed = [form for _, form in re.findall(r"""f(["'])([a-z_]+\.[^\s"]*?\{[^\s"]*?)\1""", source)]
    joined = [f"{stem}{{}}" for stem in re.findall(r"""["']([a-z_]+\.[\w-]+)["'] ~""", source)]
    patterns = [re.sub(r"\\{.*?\\}", ".+", re.escape(form)) for form in formed + joined]
    known = re.compile("|".join(pattern for pattern in patterns if re.search(r"\.(\w|.*[a-z])", pattern)))
    unused = [
        key
        for file in FILES
        for name in texts(file)
        if not (key := f"{file}.{name}").startswith(FROM_DATA)
        and key not in words
        and name not in words
        and not known.fullmatch(key)
    ]
    assert not unused, unused


@pytest.mark.parametrize("page", ["replay", "report"])
def test_scripts_ask_for_texts_that_their_page_hands_over(page: str) -> None:
    folder = ROOT / "sim" / "show" / {"replay": "replay", "report": "report_page"}[page] / "assets"
    source = "\n".join(path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.js")))
    asked = re.findall(r"""\b(?:say|said)\((?:[^()]*\? )?"(\w+)"(?: : "(\w+)")?""", source)
    assert {key for keys in asked for key in keys if key} == set(texts(f"{page}_scripts"))


def test_no_chinese_stands_in_code() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path, text in sources(*CODE).items()
        for number, line in enumerate(text.splitlines(), start=1)
        if CHINESE.search(line)
    ]
    assert found == []


def test_a_text_is_filled_in_each_language_with_its_own() -> None:
    turning = said("quiz.turn_answer", turn=said("quiz.clockwise"), word="SR")
    assert turning == Said("clockwise (SR)", "顺时针（SR）")
    assert tuple(Words(language)("quiz.turn_answer", turn="{x}", word="SR") for language in LANGUAGES) == (
        "{x} (SR)",
        "{x}（SR）",
    )


@pytest.mark.parametrize("key", ["cut.none", "none.cut", "cut", "../cut.kerf", ""])
def test_an_unknown_key_is_a_key_error(key: str) -> None:
    with pytest.raises(KeyError):
        said(key)


@pytest.mark.parametrize("form", ["text", "json", "sarif", "junit", "github"])
def test_a_check_reads_no_words_but_its_own(form: str, tmp_path: Path) -> None:
    program = tmp_path / "part.3b"
    program.write_text("B9900 B0 B39600 GX NR1\n", encoding="ascii")
    command = [sys.executable, "-c", CHECK, "check", str(program), "--format", form]
    made = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert made.returncode == 1, made.stderr
    assert made.stderr in ("0 files", "1 files")
