"""What the documents say of the codes.

docs/findings.md and docs/findings.zh.md are made from the pages of the catalogue. In the table of checks of
docs/check.md the codes of each check are renewed, and in README.md how many codes there are.
"""

import re
from collections.abc import Mapping
from pathlib import Path

from parser.findings.catalogue import Language, page
from parser.findings.codes import CODES
from sim.show.findings.pages import layers, page_text, page_title, severity_word
from sim.show.words import Words

NAMES: Mapping[Language, str] = {"en": "findings.md", "zh": "findings.zh.md"}

_PATH = re.compile(r"docs/(\w+\.md)")
_CHECK_ROW = re.compile(r"^(\| `(check-[\w-]+)` \|[^|]*\| )[^|]*( \|)", re.MULTILINE)
_COUNT = re.compile(r"There are \d+ codes")
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


def documents(root: Path) -> dict[Path, str]:
    """Every document of a folder of the project that tells of the codes, as it should be."""
    check, readme = root / "docs" / "check.md", root / "README.md"
    return {
        **{root / "docs" / name: findings_document(language) for language, name in NAMES.items()},
        check: _CHECK_ROW.sub(_check_row, check.read_text(encoding="utf-8")),
        readme: _COUNT.sub(f"There are {len(CODES)} codes", readme.read_text(encoding="utf-8")),
    }


def _check_row(row: re.Match[str]) -> str:
    begin, check, end = row.groups()
    return begin + ", ".join(code for code, of in CODES.items() if of.check == check) + end


if __name__ == "__main__":
    for path, text in documents(Path()).items():
        path.write_text(text, encoding="utf-8", newline="\n")
