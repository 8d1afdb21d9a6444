"""Text for people fits its width in cells, and nothing of it is lost."""

import io
import runpy
from pathlib import Path
from random import Random

import pytest
from check_results import AXIS, HOSTILE, hostile, kind, quieted, result, unknown
from example_checks import checked
from places import ROOT

from parser.findings.catalogue import LANGUAGES, Language, example, texts
from parser.findings.codes import CODES
from parser.findings.findings import Finding
from parser.text.places import caret_lines, cells
from sim.check.result import CheckResult
from sim.show.findings import render
from sim.show.findings.wording import Options
from sim.show.terminal.finding import LABELS
from sim.show.terminal.wrap import width_of, wrapped

WIDTHS = (60, 80, 100)
VALUES = runpy.run_path(str(ROOT / "tests" / "parser" / "test_catalogue.py"))["VALUES"]
CLOSING = "，。；：、！？）】》」』”’,.;:!?)]}%"
OPENING = "（【《「『“‘([{"


def lines(results: list[CheckResult], language: Language, width: int = 80) -> list[str]:
    return "".join(render("text", results, Options(language, statistics=True, width=width))).split("\n")[:-1]


def squeezed(text: str) -> str:
    return "".join(text.split())


def made(code: str) -> CheckResult:
    """A finding of a code as its catalogue's test fills it, in the sixth digit of blocks and lines."""
    finding = Finding(code, VALUES[code], span=(12, 14), line=1234, column=13, block=1234)
    return result("part.3b", finding, excerpts={1234: "B9900B0B39600GXNR1"})


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_finding_of_the_catalogue_fits_and_says_all(language: Language) -> None:
    for code in CODES:
        for width in WIDTHS:
            shown = lines([made(code)], language, width)
            assert max(map(cells, shown[1:])) <= width
            assert cells(shown[0]) <= 80
            of = texts(made(code).findings[0], language)
            for text in (of.title, of.found, of.expected, of.machine, of.hint):
                assert squeezed(text) in squeezed("".join(shown)), (code, text)


@pytest.mark.deeper
def test_every_example_fits(tmp_path: Path) -> None:
    for code in CODES:
        shown = example(code)
        if shown:
            found = checked(shown.program, shown, tmp_path)
            assert found.findings
            assert max(cells(line) for language in LANGUAGES for line in lines([found], language)) <= 80, code


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("results", [kind, quieted, hostile], ids=["kind", "quieted", "hostile"])
def test_all_fits_but_lines_with_the_name_of_a_file(results: object, language: Language) -> None:
    for one in results():  # type: ignore[operator]
        for line in lines([one], language):
            head = "�[31m]]>" in line or one.name in line
            assert cells(line) <= 80 or head, line


def test_no_line_begins_or_ends_with_what_belongs_to_the_other() -> None:
    for code in CODES:
        for width in WIDTHS:
            shown = [line.strip() for line in lines([made(code)], "zh", width)]
            labelled = [line for line in shown if line and not line.startswith(("1234 |", "|"))]
            assert not [line for line in labelled if line[0] in CLOSING or line[-1] in OPENING]


def test_a_label_stands_before_its_text_alone() -> None:
    shown = lines([result("a.3b", AXIS)], "en")
    heads = [line[4:].split(":")[0].removeprefix("= ") for line in shown if line.startswith("    = ")]
    assert heads == list(LABELS)
    assert {line[:16] for line in shown if line.startswith(" " * 16)} == {" " * 16}


@pytest.mark.parametrize("width", [20, 60, 80, 100])
def test_wrapping_keeps_every_character_but_blanks_in_its_order(width: int) -> None:
    random = Random(20261122)
    letters = [
        "ab",
        "B9900",
        "µm",
        "140.00",
        "加",
        "工",
        "，",
        "。",
        "（",
        "）",
        "(",
        "::error",
        "…",
        "e\u0301",
        "/",
        HOSTILE,
    ]
    for _ in range(400):
        text = "".join(random.choice(letters) + " " * random.choice([0, 0, 1, 3]) for _ in range(random.randint(1, 60)))
        head, indent = random.choice([("", None), ("    = 发现：", None), ("part.3b: ", "    "), ("x" * 90, "    ")])
        shown = wrapped(text, width, head, indent)
        assert squeezed("".join(shown)) == squeezed(head + text)
        assert all(cells(line) <= max(width, 20 + cells(head if indent is None else indent)) for line in shown[1:])
        assert cells(shown[0]) <= max(width, cells(head))


def test_wrapping_is_full_where_it_can_be() -> None:
    assert wrapped("加工" * 25, 60, "= 发现：") == ["= 发现：" + "加工" * 13, " " * 8 + "加工" * 12]
    assert wrapped("a line of words", 9) == ["a line of", "words"]
    assert wrapped("", 80, "head ") == ["head"]


def test_a_number_stays_with_what_it_counts() -> None:
    assert wrapped("blocks read, 6 decoded", 16) == ["blocks read,", "6 decoded"]
    assert wrapped("读入 16 段", 8) == ["读入", "16 段"]


def test_what_is_longer_than_a_line_is_broken_without_beginning_with_punctuation() -> None:
    assert wrapped("x" * 45, 20) == ["x" * 20, "x" * 20, "x" * 5]
    assert wrapped("y " + "x" * 19 + "::error::", 20) == ["y " + "x" * 18, "x::error::"]
    assert wrapped(":" * 50, 20) == [":" * 20, ":" * 20, ":" * 10]


@pytest.mark.parametrize(("columns", "width"), [("40", 60), ("72", 72), ("400", 100), ("0", 80)])
def test_the_width_is_that_of_the_terminal_in_bounds(monkeypatch: pytest.MonkeyPatch, columns: str, width: int) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.setenv("COLUMNS", columns)
    assert width_of(Terminal()) == width
    assert width_of(io.StringIO()) == 80


@pytest.mark.parametrize("room", [60, 74])
def test_a_shown_line_is_cut_only_where_it_must_be(room: int) -> None:
    fits = "加工" * (room // 4)
    assert caret_lines(fits, len(fits), 1, room)[0] == fits
    shown, carets = caret_lines("B" * room, room + 1, 1, room)
    assert (len(shown), len(carets)) == (room - 1, room)  # a caret behind the last character has its cell too
    for line in ("B" * 300, "加工B1" * 100, "\t" * 300, "e\u0301" * 300):
        for column in (1, 50, 150, len(line)):
            shown, carets = caret_lines(line, column, 40, room)
            assert cells(shown) <= room
            assert cells(carets) <= room
            assert cells(carets.rstrip("^")) <= 0.6 * room or column == len(line)


def test_a_long_line_of_a_program_fits() -> None:
    text = unknown("字" * 300)
    shown = lines([result("a.3b", text, excerpts={3: "\t" + "字" * 300})], "zh")
    assert cells(shown[1]) in {79, 80}
    assert shown[2].endswith("^" * 60)
