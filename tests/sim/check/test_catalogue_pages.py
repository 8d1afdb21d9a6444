"""Every page of the catalogue: its example shows the finding, and mended it is sound."""

from pathlib import Path

import pytest
from example_checks import checked

from parser.findings.catalogue import LANGUAGES, Example, Language, example, page
from parser.findings.codes import CODES, Severity
from sim.show.findings.pages import list_text, page_text, severity_word
from sim.show.terminal.markdown import documents
from sim.show.texts import Words

OF_A_RUN = {code for code, of in CODES.items() if of.check is None}
WITHOUT_EXAMPLE = {"3B100", "3B303", "ISO100"} | OF_A_RUN
"""No program; no arc known that misses so far on the right axis; what a check cannot see."""
EXAMPLES = {code: shown for code in sorted(CODES) if (shown := example(code))}
ALSO = {
    "3B304": {"3B301"},  # the contour that it is a suspect of
    "3B322": {"3B307", "3B311"},  # what comes of the word
    "3B314": {"3B307"},  # the rough cut runs through the trim that it comes past
    "3B109": {"3B110"},  # a 4B block is in both
    "ISO507": {"ISO506"},  # it runs through the neck all the same
    "ISO512": {"ISO506"},  # the lead-in crosses the contour
    **{code: {"3B110"} for code in ("3B212", "3B214", "3B215", "3B216")},
}
ASSUMED = {"ISO112"}
"""What is assumed of a program that does not tell its dialect, beside all that is found."""


def test_every_finding_that_a_program_can_show_has_an_example() -> None:
    assert set(CODES) - set(EXAMPLES) == WITHOUT_EXAMPLE


@pytest.mark.parametrize(("code", "shown"), EXAMPLES.items(), ids=EXAMPLES)
def test_the_example_gives_its_finding_alone(code: str, shown: Example, tmp_path: Path) -> None:
    found = {finding.code for finding in checked(shown.program, shown, tmp_path).findings}
    assert found - ASSUMED == {code} - ASSUMED | ALSO.get(code, set())
    assert code in found


@pytest.mark.parametrize(("code", "shown"), EXAMPLES.items(), ids=EXAMPLES)
def test_the_mended_example_is_sound(code: str, shown: Example, tmp_path: Path) -> None:
    found = checked(shown.mended, shown, tmp_path).findings
    assert [finding.code for finding in found if finding.severity is not Severity.NOTE] == []
    assert code not in {finding.code for finding in found} or code in ("3B110", "ISO112")


@pytest.mark.parametrize("language", LANGUAGES)
def test_pages_call_severities_what_a_check_calls_them(language: Language) -> None:
    assert {code: severity_word(code, language) for code in CODES} == {
        code: Words(language)(f"findings.{of.severity}") for code, of in CODES.items()
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_list_has_every_code_with_its_title_below_its_layer_then_the_documents(language: Language) -> None:
    *layers, named = [part.splitlines()[2:-1] for part in list_text(language).split("\n\n")]
    assert [{line.split()[0][:-2] for line in lines} for lines in layers] == [
        *({f"3B{layer}"} for layer in range(1, 8)),
        {"GEC4"},
        *({f"ISO{layer}"} for layer in range(1, 7)),
        {"PMC1"},
        {"PMC2"},
    ]
    listed = {line.split()[0]: line.split(maxsplit=2)[2] for lines in layers for line in lines}
    assert listed == {code: page(code, language).title for code in CODES}
    assert [line.split()[0] for line in named] == list(documents())


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("code", sorted(CODES))
def test_a_page_reads_well_in_a_terminal(code: str, language: Language) -> None:
    text = page_text(code, language)
    assert text.startswith(f"# {code}")
    assert text.endswith("\n")
    assert "\n\n\n" not in text
    assert text.count("```") % 2 == 0
