"""Messages of errors in both languages: code says them in English, which the texts of ``errors.toml`` are known by.

An error is raised where no words are known, far below what shows it; so it carries its English sentence, and here that
is taken apart by its template, as catalogues of gettext go by the English text.
"""

from functools import cache
from string import Formatter
from typing import Final, NamedTuple

from parser.findings.catalogue import LANGUAGES, Said, term_known_as
from parser.findings.catalogue import texts as texts_of
from parser.findings.errors import DrycutError, ProgramError
from sim.show.words.words import texts

_LONGEST: Final = 4_000
"""Characters of a message: what is longer cites whole files, in which parts may stand in parts without end."""

_OF_A_TERM: Final = 2
"""Spaces of the terms that stand within messages, such as ``this is a folder``; files have names of a word or two."""


class _Known(NamedTuple):
    """A message: what stands round the places of its English text, the names of these, and the Chinese template."""

    literals: tuple[str, ...]
    places: tuple[str, ...]
    zh: str

    def filling(self, text: str) -> dict[str, str] | None:
        """What stands in the places of a text; None where it is not of this template. It is looked through once."""
        if not self.places:
            return {} if text == self.literals[0] else None
        first, *between, last = self.literals
        end = len(text) - len(last)
        at = len(first)
        if not text.startswith(first) or not text.endswith(last) or at > end:
            return None
        found: list[str] = []
        for literal in between:
            next_one = text.find(literal, at, end)
            if next_one < 0:
                return None
            found.append(text[at:next_one])
            at = next_one + len(literal)
        return dict(zip(self.places, [*found, text[at:end]], strict=True))


def told(error: DrycutError) -> Said:
    """What an error says in both languages."""
    if isinstance(error, ProgramError):
        return Said(*(texts_of(error.finding, language).message for language in LANGUAGES))
    return in_both(str(error))


def in_both(message: str) -> Said:
    """The message of an error; one that no template knows stays English in both."""
    return Said(message, _in_chinese(message) or message)


def _in_chinese(text: str) -> str:
    """A message, or a part of one; empty where it is not known.

    Parts of one word are names that people gave: of a folder ``part``, of a layer ``wire``. Parts of ours are longer.
    """
    if len(text) > _LONGEST or " " not in text:
        return ""
    for known in _messages():
        filling = known.filling(text)
        if filling is not None:
            return known.zh.format(**{name: _in_chinese(part) or part for name, part in filling.items()})
    return term_known_as(text, "zh") if text.count(" ") >= _OF_A_TERM else ""


@cache
def _messages() -> tuple[_Known, ...]:
    """All templates, those first that leave least open."""
    known = (_known(said) for said in texts("errors").values())
    return tuple(sorted(known, key=lambda one: -sum(map(len, one.literals))))


def _known(said: Said) -> _Known:
    literals, places = [""], []
    for literal, name, _, _ in Formatter().parse(said.en):
        literals[-1] += literal
        if name:
            places.append(name)
            literals.append("")
    return _Known(tuple(literals), tuple(places), said.zh)
