"""Messages of errors in both languages: code says them in English, which the texts of ``errors.toml`` are known by.

An error is raised where no words are known, far below what shows it; so it carries its English sentence, and here that
is taken apart by its template, as catalogues of gettext go by the English text.
"""

import re
from functools import cache
from string import Formatter
from typing import NamedTuple

from parser.findings.catalogue import LANGUAGES, Said, term_known_as
from parser.findings.catalogue import texts as texts_of
from parser.findings.errors import DrycutError, ProgramError
from sim.show.words.words import texts


class _Known(NamedTuple):
    """A message: what its English text looks like, the Chinese template, and how much of it is no place."""

    pattern: re.Pattern[str]
    zh: str
    literal: int


def told(error: DrycutError) -> Said:
    """What an error says in both languages."""
    if isinstance(error, ProgramError):
        return Said(*(texts_of(error.finding, language).message for language in LANGUAGES))
    return in_both(str(error))


def in_both(message: str) -> Said:
    """The message of an error; one that no template knows stays English in both."""
    return Said(message, _in_chinese(message) or message)


def _in_chinese(text: str) -> str:
    """A message, or a part of one; empty where it is not known."""
    for known in _messages():
        match = known.pattern.fullmatch(text)
        if match:
            return known.zh.format(**{name: _in_chinese(part) or part for name, part in match.groupdict().items()})
    return term_known_as(text, "zh")


@cache
def _messages() -> tuple[_Known, ...]:
    """All templates, those first that leave least open."""
    known = (_known(said) for said in texts("errors").values())
    return tuple(sorted(known, key=lambda one: -one.literal))


def _known(said: Said) -> _Known:
    parts = list(Formatter().parse(said.en))
    pattern = "".join(f"{re.escape(literal)}{f'(?P<{name}>.*?)' if name else ''}" for literal, name, _, _ in parts)
    return _Known(re.compile(pattern, re.DOTALL), said.zh, sum(len(literal) for literal, _, _, _ in parts))
