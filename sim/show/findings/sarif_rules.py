"""The tool of a SARIF log: a rule for each code, from its page, and a notification for each check."""

import re
from typing import Any

from parser.findings.catalogue import Language, page, term
from parser.findings.findings import SEVERITIES
from sim import __version__
from sim.show.findings.checks import CHECKS

RULES = tuple(sorted(SEVERITIES))
"""Codes in the order of the rules: a result names its rule by the index too."""


def driver(language: Language) -> dict[str, Any]:
    """The tool component (§3.19)."""
    return {
        "name": "drycut",
        "version": __version__,
        "semanticVersion": __version__,
        "language": language,
        "rules": [_rule(code, language) for code in RULES],
        "notifications": [{"id": name, "shortDescription": {"text": said(term(name, language))}} for name in CHECKS],
    }


def said(text: str) -> str:
    """A plain text message: braces doubled (§3.11.5), and nothing in it taken for a link (§3.11.6)."""
    return _literal(text).replace("](", "] (")


def _literal(text: str) -> str:
    return text.replace("{", "{{").replace("}", "}}")


def _rule(code: str, language: Language) -> dict[str, Any]:
    of = page(code, language)
    markdown = f"{of.why.strip()}\n\n{of.mend.strip()}"
    first, *_ = of.why.strip().split("\n\n")
    return {
        "id": code,
        "name": _identifier(page(code).title),
        "shortDescription": {"text": said(of.title)},
        "fullDescription": {"text": said(" ".join(first.split()))},
        "help": {"text": said(markdown), "markdown": _literal(markdown)},
        "defaultConfiguration": {"level": SEVERITIES[code].value},
    }


def _identifier(title: str) -> str:
    """``wrong count axis`` as ``WrongCountAxis``, the same in every language."""
    return "".join(part[:1].upper() + part[1:] for part in re.split(r"\W+", title))
