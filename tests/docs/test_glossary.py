"""The words of the trade: one for each idea, in all that drycut says in Chinese."""

import tomllib
from itertools import chain

import pytest
from places import ROOT

GLOSSARY = tomllib.loads((ROOT / "docs" / "glossary.toml").read_text("utf-8"))
TERMS = {name: term for room in GLOSSARY.values() for name, term in room.items()}
TEXTS = {
    path: path.read_text("utf-8")
    for path in chain(
        *((ROOT / package).rglob("*.toml") for package in ("parser", "controller", "sim", "scenarios")),
        ROOT.glob("*.zh.md"),
        (ROOT / "docs").glob("*.zh.md"),
    )
}


@pytest.mark.parametrize("name", TERMS)
def test_an_idea_has_one_word(name: str) -> None:
    never = TERMS[name]["never"]
    found = [
        f"{path.relative_to(ROOT)}:{number}: {word}, not {TERMS[name]['zh']}"
        for path, text in TEXTS.items()
        for number, line in enumerate(text.splitlines(), start=1)
        for word in never
        if word in line
    ]
    assert found == []


@pytest.mark.parametrize("name", TERMS)
def test_a_word_of_the_glossary_is_used(name: str) -> None:
    assert any(TERMS[name]["zh"] in text for text in TEXTS.values())


def test_no_word_is_both_used_and_never_used() -> None:
    words = [term["zh"] for term in TERMS.values()]
    never = [word for term in TERMS.values() for word in term["never"]]
    assert len(set(words)) == len(words)
    assert not [word for word in never if any(word in good for good in words)]
