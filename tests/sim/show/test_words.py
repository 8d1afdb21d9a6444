"""Words for people: every text in both languages with the same places, each of them used, and none of them in code."""

import ast
import re
import string
import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT

from parser.findings.catalogue import LANGUAGES, Bilingual
from sim.run.ballbar.figures import NAMES, SENSES
from sim.show.html.environment import joined
from sim.show.texts import Words, bilingual
from sim.show.texts.texts import FOLDER, texts

PACKAGES = ("parser", "controller", "sim")
FILES = sorted(path.stem for path in FOLDER.glob("*.toml"))
CODE = (".py", ".js", ".j2")
CHINESE = re.compile(r"[\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef]")
ESCAPE = re.compile(r"(?:\\u\{?|\\U0000|\\|&#x)0{0,4}([0-9a-f]{4})(?![0-9a-f])|&#(\d{5});", re.IGNORECASE)
"""A character by its number: in Python and scripts, in style sheets, in pages."""
COUNTED = ("findings.one-", "findings.some-", "phrases.one-", "phrases.some-")
OF_REPORT = ("report.is-", "report.of-", "report.by-", "report.kind-", "report.as-cut-", "report.nominal-")
FROM_DATA = (*OF_REPORT, *COUNTED, "progress.run-", "commands.", "options.", "errors.")
"""Texts of kinds, axes, numbers, directions: of the report, of the findings of a check, of a circular test; and
help, of which tests/sim/cli/test_help.py holds every text to its command or option, and errors, of which
tests/sim/show/test_errors_told.py does."""

ENGINE = ("sim/run", "sim/measure", "sim/cut", "sim/table", "parser/drawing", "controller")
SENTENCE = re.compile(r"[A-Za-z]+(?:\W* \W*[A-Za-z]+){2}")
"""Three words with spaces between them."""
NO_SENTENCES = {
    "--radius in mm (travel of {})": "what the error about a number calls it",
    "--feed in mm/min": "what the error about a number calls it",
    "a whole number ": "of the text of a ValueError",
    "drycut card log 1": "first line of a file, by which it is known",
    "static const char *const {}{} = {};\n": "C",
    'DRYCUT {} { return drycut_call({}, "{}"{}); }\n': "C",
    "{} cannot be answered: {}: {} ({}:{})": "a fault of drycut itself, in the process of somebody's program",
}
"""Texts of the engine that look like sentences, and why they stand there."""

CHECK = """
import atexit, sys
from sim.cli import main
from sim.show.texts.texts import texts

atexit.register(lambda: sys.stderr.write(f"{texts.cache_info().currsize} files"))
main()
"""


def sources(*suffixes: str) -> dict[Path, str]:
    paths = (path for package in PACKAGES for path in sorted((ROOT / package).rglob("*")) if path.suffix in suffixes)
    return {path: path.read_text(encoding="utf-8") for path in paths}


def sentences(source: str) -> list[tuple[int, str]]:
    """Line and text of what reads like a sentence in Python; places of an f-string are ``{}``.

    Docstrings, what errors and asserts say, and regular expressions are none.
    """
    tree = ast.parse(source)
    other = {id(node) for part in ast.walk(tree) if for_no_one(part) for node in ast.walk(part)}
    found = []
    for node in ast.walk(tree):
        if id(node) in other:
            continue
        if isinstance(node, ast.JoinedStr):
            other |= {id(value) for value in node.values}
            text = "".join(str(value.value) if isinstance(value, ast.Constant) else "{}" for value in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            text = node.value
        else:
            continue
        if SENTENCE.search(text):
            found.append((node.lineno, text))
    return found


def for_no_one(node: ast.AST) -> bool:
    """Whether no text in this part of a program is for people, as of a loop's signature, or it is that of an error."""
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Constant)
    if isinstance(node, ast.Call):
        called = ast.unparse(node.func)
        return called.endswith("Error") or called.startswith("re.") or called in {"compiled", "loop_part"}
    return isinstance(node, ast.Raise | ast.Assert)


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
    scripted = re.findall(r"`([a-z]+_\w*?\$\{[^`]*)`", source)
    named = re.compile("|".join(re.sub(r"\\\$\\\{.*?\\\}", ".+", re.escape(form)) for form in scripted))
    unused = [
        key
        for file in FILES
        for name in texts(file)
        if not (key := f"{file}.{name}").startswith(FROM_DATA)
        and key not in words
        and name not in words
        and not known.fullmatch(key)
        and not named.fullmatch(name)
    ]
    assert not unused, unused


def script_of(room: str) -> str:
    """The script of the page of a room, with all that it imports."""
    return joined(ROOT / "sim" / "show" / room / "assets" / "main.js")


def test_the_scripts_of_a_shop_name_all_texts_that_their_page_hands_over() -> None:
    named = set(re.findall(r'"([\w-]+)"', script_of("index_page")))
    assert set(texts("index_scripts")) - named == set()
    asked = set(re.findall(r'\b(?:say|said)\("([\w-]+)"', script_of("index_page")))
    assert asked - set(texts("index_scripts")) == set()


@pytest.mark.parametrize("page", ["drill", "replay", "report"])
def test_scripts_ask_for_texts_that_their_page_hands_over(page: str) -> None:
    source = script_of({"drill": "drill_page", "replay": "replay", "report": "report_page"}[page])
    asked = re.findall(r"""\b(?:say|said)\((?:[^()]*\? )?"(\w+)"(?: : "(\w+)")?""", source)
    assert {key for keys in asked for key in keys if key} == set(texts(f"{page}_scripts"))


def test_every_stage_of_the_work_has_a_text() -> None:
    source = "\n".join(sources(".py").values())
    stages = set(re.findall(r"""progress\("([\w-]+)",""", source)) | {f"run-{NAMES[sense]}" for sense in SENSES}
    assert stages | {"step", "left", "line"} == set(texts("progress"))


def spelled_out(line: str) -> str:
    """The line with characters in place of their numbers."""
    return ESCAPE.sub(lambda match: chr(int(match[1], 16) if match[1] else int(match[2])), line)


def test_no_chinese_stands_in_code() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path, text in sources(*CODE, ".css").items()
        for number, line in enumerate(text.splitlines(), start=1)
        if CHINESE.search(spelled_out(line))
    ]
    assert found == []


@pytest.mark.parametrize(
    "line", ["中", r"'\u4e2d'", r"'\U00004e2d'", r"`\u{4e2d}`", r"content: '\4e2d'", "&#x4E2D;", "&#20013;"]
)
def test_chinese_is_seen_however_it_is_written(line: str) -> None:
    assert CHINESE.search(spelled_out(line))


@pytest.mark.parametrize("line", [r"'\u2013'", "&#8211;", r"content: '\2013'", r"\d4e2d", "#4e2d4e"])
def test_no_chinese_is_seen_where_there_is_none(line: str) -> None:
    assert not CHINESE.search(spelled_out(line))


@pytest.mark.parametrize("room", ENGINE)
def test_the_engine_makes_no_sentences(room: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {text}"
        for path in sorted((ROOT / room).rglob("*.py"))
        for line, text in sentences(path.read_text(encoding="utf-8"))
        if text not in NO_SENTENCES
    ]
    assert found == []


def test_what_is_no_sentence_still_stands_in_the_engine() -> None:
    texts = {
        text
        for room in ENGINE
        for path in (ROOT / room).rglob("*.py")
        for _, text in sentences(path.read_text("utf-8"))
    }
    assert set(NO_SENTENCES) - texts == set()


@pytest.mark.parametrize(
    ("source", "found"),
    [
        ('note = "the file is damaged"', ["the file is damaged"]),
        ('note = f"{number} curves left out, as they are slanted"', ["{} curves left out, as they are slanted"]),
        ('Row("radial deviation F, max", 1)', ["radial deviation F, max"]),
        ('"""What stands in a docstring."""', []),
        ('raise ValueError(f"{name} is no whole number")', []),
        ('return SettingsError("names no such machine")', []),
        ('assert found, "the plan is never empty"', []),
        ('re.compile("one of these words")', []),
        ('raise Damaged("the settings are no JSON") from None', []),
        ('name = "radial-deviation"', []),
        ('unit = f"{value:g} mm"', []),
    ],
)
def test_a_sentence_is_told_from_other_texts(source: str, found: list[str]) -> None:
    assert [text for _, text in sentences(source)] == found


def test_a_text_is_filled_in_each_language_with_its_own() -> None:
    turning = bilingual("quiz.turn_answer", turn=bilingual("quiz.clockwise"), word="SR")
    assert turning == Bilingual("clockwise (SR)", "顺时针（SR）")
    assert tuple(Words(language)("quiz.turn_answer", turn="{x}", word="SR") for language in LANGUAGES) == (
        "{x} (SR)",
        "{x}（SR）",
    )


@pytest.mark.parametrize("key", ["cut.none", "none.cut", "cut", "../cut.kerf", ""])
def test_an_unknown_key_is_a_key_error(key: str) -> None:
    with pytest.raises(KeyError):
        bilingual(key)


@pytest.mark.alike(1)
@pytest.mark.parametrize("form", ["text", "concise", "json", "sarif", "junit", "github", "gitlab"])
def test_a_check_reads_no_words_but_its_own(form: str, tmp_path: Path) -> None:
    program = tmp_path / "part.3b"
    program.write_text("B9900 B0 B39600 GX NR1\n", encoding="ascii")
    command = [sys.executable, "-c", CHECK, "check", str(program), "--format", form]
    made = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert made.returncode == 1, made.stderr
    assert made.stderr in ("0 files", "1 files")
