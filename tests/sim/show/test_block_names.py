"""Blocks are called as the listing calls them: by their labels, in every text, table, picture and page."""

import itertools
import re
from collections.abc import Iterator

import numpy as np
import pytest
from report_pages import Made, made
from runs import plain_scenario

from parser.findings.catalogue import LANGUAGES, Example, Language, example
from parser.findings.codes import CODES
from parser.program import parse_program
from parser.text.source import BlockNames
from sim.base.progress import silent
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings
from sim.run.course import course_of
from sim.run.recording import recorded
from sim.show.film.readout import read_out
from sim.show.replay.document import replay_document
from sim.show.terminal.finding import message
from sim.show.terminal.run import summary_rows
from sim.show.texts import Words

COUNTED = re.compile(r"(?<!two )\bblocks? \d+\b(?!\.)|(?:第|至|到|段号) ?\d+(?:–\d+)? ?段|第 \d+(?:–| 至)")
"""A block that is called by its number, in both languages."""
BLOCK = re.compile(r"(?<![A-Z0-9])(?:B *\d* *){3,4}G *[XY] *D{0,2} *(?:L|[SN]R) *[1-4]")
PART = """
B0 B3000 B3000 GY L2
B2000 B0 B2000 GX L1
B0 B4000 B4000 GY L2
B4000 B0 B4000 GX L3
B0 B4000 B4000 GY L4
D
B2000 B0 B2000 GX L1
B0 B3000 B3000 GY L4
D
B10000 B0 B10000 GX L1
D
B2000 B0 B2000 GX L1
B2000 B0 B8000 GY NR1
B2000 B0 B2000 GX L3
DD
"""
"""A square that is held at a D, and a circle beside it."""


def labelled(text: str) -> str:
    """A program with the labels N500, N510, … before its blocks."""
    numbers = itertools.count(500, 10)
    return BLOCK.sub(lambda block: f"N{next(numbers)}: {block[0]}", text)


def examples() -> Iterator[tuple[str, Example]]:
    for code in sorted(CODES):
        shown = example(code)
        if shown and not shown.options and code.startswith("3B") and not re.search(r"N ?\d|Start", shown.program):
            yield code, shown


@pytest.mark.alike(1)
@pytest.mark.parametrize("language", LANGUAGES)
def test_no_finding_counts_a_block_that_has_a_label(language: Language) -> None:
    called = set()
    for _, shown in examples():
        result = check_file(Job("part.3b", labelled(shown.program).encode(), CheckSettings()))
        for finding in result.findings:
            said = message(finding, language)
            assert not COUNTED.search(said), said
            called |= {finding.code} if re.search(r"N5\d0", said) else set()
    assert len(called) > 25


def test_a_label_that_several_blocks_bear_has_the_number_behind_it() -> None:
    names = BlockNames(np.array([1, 2, 3, 3, 4, 5]), ["N1", "N2", "N1", "", "", "N123456789"])
    assert names.of_rows() == ["N1 (1)", "N2", "N1 (3)", "N1 (3)", "4", "5"]
    assert (names(2), names.at(2), names.of_row(1), names(7)) == ("N2", "N2", "N2", "7")


def test_a_program_without_labels_is_counted() -> None:
    result = check_file(Job("part.3b", b"B9900B0B39600GXNR1\nDD\n", CheckSettings()))
    assert {finding.block_name for finding in result.findings if finding.block} == {"1"}


@pytest.fixture(scope="module")
def page() -> Made:
    return made(labelled(PART), kerf=True)


def test_the_terminal_calls_blocks_by_their_labels(page: Made) -> None:
    rows = [f"{name} {text}" for name, text in summary_rows(page.run) if name != "blocks"]
    assert not [row for row in rows if COUNTED.search(row)]
    by_name = dict(summary_rows(page.run))
    assert by_name["pieces"].endswith("can be clamped at the D behind block N540")
    assert {"  blocks N500–N560", "  blocks N580–N600"} < set(by_name)


def test_tables_of_the_report_call_blocks_by_their_labels(page: Made) -> None:
    assert page.column("blocks", "block") == [f"N{number}" for number in range(500, 610, 10)]
    assert page.column("contours", "first block") == ["N500", "N580"]
    assert page.column("pieces", "free in block") == ["N550", "N590"]
    told = re.sub(r"<script.*?</script>|<svg.*?</svg>|<style.*?</style>|<[^>]+>", " ", page.html, flags=re.DOTALL)
    assert not COUNTED.search(told)


def test_pictures_number_blocks_by_their_labels(page: Made) -> None:
    written = re.findall(r"<text[^>]*>([^<]+)</text>", page.html)
    assert {"N510", "N590"} <= set(written)
    assert not [text for text in written if COUNTED.search(text)]


def test_replay_and_film_call_blocks_by_their_labels() -> None:
    with recorded(parse_program(labelled(PART)), plain_scenario(kerf=True), silent) as recording:
        blocks = replay_document(recording)["blocks"]
        assert blocks["name"] == [f"N{number}" for number in range(500, 610, 10)]
        course = course_of(recording)
        line = read_out(course, course.at(course.duration_s / 2.0), 1.0, Words("en"))[0].value
        assert re.fullmatch(r"block N5\d0 \(\d+ of 11\)", line)
