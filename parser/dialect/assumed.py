"""Assumptions as documents for programs have them."""

from parser.dialect.reader import Assumption
from parser.findings.catalogue import Language, term


def assumption_entry(assumption: Assumption, language: Language) -> dict[str, str]:
    """An assumption as documents have it; why it was made is told in a language."""
    return {
        "what": assumption.what.removeprefix("assumed-"),
        "taken": assumption.taken,
        "why": term(assumption.why, language),
    }
