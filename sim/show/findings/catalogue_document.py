"""docs/findings.md and docs/findings.zh.md, all of them made from the pages of the catalogue."""

import re
from collections.abc import Mapping
from pathlib import Path

from parser.findings.catalogue import Language, page
from sim.show.findings.pages import layers, page_text, page_title, severity_word
from sim.show.words import Words

NAMES: Mapping[Language, str] = {"en": "findings.md", "zh": "findings.zh.md"}

_PATH = re.compile(r"docs/(\w+\.md)")
_HEADS = ("head-code", "head-severity", "head-title", "head-other")


def findings_document(language: Language) -> str:
    """The whole document: what findings are, and by layer a table of the codes and their pages."""
    parts = [Words(language)("findings_document.introduction")]
    for title, codes in layers(language):
        parts += [f"## {title}\n", _table(codes, language)]
        parts += [page_text(code, language, level=3) for code in codes]
    return _PATH.sub(r"[\1](\1)", "\n".join(parts))


def anchor(heading: str) -> str:
    """Anchor that GitHub gives a heading."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def _table(codes: tuple[str, ...], language: Language) -> str:
    other: Language = "en" if language == "zh" else "zh"
    rows = []
    for code in codes:
        link = f"[{code}](#{anchor(page_title(code, language))})"
        rows.append((link, severity_word(code, language), page(code, language).title, page(code, other).title))
    heads = tuple(Words(language)(f"findings_document.{name}") for name in _HEADS)
    head, *lines = (f"| {' | '.join(row)} |\n" for row in (heads, *rows))
    return "".join([head, "|---" * len(heads) + "|\n", *lines])


def write_documents(folder: Path) -> None:
    """Write the documents of all languages into a folder."""
    for language, name in NAMES.items():
        (folder / name).write_text(findings_document(language), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    write_documents(Path("docs"))
