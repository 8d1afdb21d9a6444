"""What the documents say of the codes.

docs/findings.md and docs/findings.zh.md are made from the pages of the catalogue. In the table of checks of
docs/check.md the codes of each check are renewed, and in docs/start.md and its Chinese twin how many codes there are.
"""

import re
from collections.abc import Mapping
from pathlib import Path

from parser.findings.catalogue import Language, page
from parser.findings.codes import CODES
from sim.show.findings.pages import layers, page_text, page_title, severity_word
from sim.show.terminal.markdown import files
from sim.show.texts import Words

NAMES: Mapping[Language, str] = {"en": "findings.md", "zh": "findings.zh.md"}
_TOURS: Mapping[Language, str] = {"en": "start.md", "zh": "start.zh.md"}

_PATH = re.compile(r"docs/(\w+)\.md")
_CHECK_ROW = re.compile(r"^(\| `(check-[\w-]+)` \|[^|]*\| )[^|]*( \|)", re.MULTILINE)
_HEADS = ("head-code", "head-severity", "head-title", "head-other")


def findings_document(language: Language) -> str:
    """The whole document: what findings are, and by layer a table of the codes and their pages."""
    parts = [Words(language)("findings_document.introduction")]
    for title, codes in layers(language):
        parts += [f"## {title}\n", _table(codes, language)]
        parts += [page_text(code, language, level=3) for code in codes]
    return _PATH.sub(lambda found: _link(found[1], language), "\n".join(parts))


def anchor(heading: str) -> str:
    """Anchor that GitHub gives a heading."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def _link(name: str, language: Language) -> str:
    """Link to a document, in the language where it is written in it."""
    own = f"{name}.{language}.md"
    file = own if own in files() else f"{name}.md"
    return f"[{file}]({file})"


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
    docs, check = root / "docs", root / "docs" / "check.md"
    return {
        **{docs / name: findings_document(language) for language, name in NAMES.items()},
        **{docs / name: _counted(docs / name, language) for language, name in _TOURS.items()},
        check: _CHECK_ROW.sub(_check_row, check.read_text(encoding="utf-8")),
    }


def count_of_codes(language: Language) -> str:
    """What a document says of how many codes there are."""
    return Words(language)("findings_document.count", n=len(CODES))


def _counted(tour: Path, language: Language) -> str:
    count = count_of_codes(language)
    return re.sub(re.escape(count).replace(str(len(CODES)), r"\d+"), count, tour.read_text(encoding="utf-8"))


def _check_row(row: re.Match[str]) -> str:
    begin, check, end = row.groups()
    return begin + ", ".join(code for code, of in CODES.items() if of.check == check) + end


if __name__ == "__main__":
    for path, text in documents(Path()).items():
        path.write_text(text, encoding="utf-8", newline="\n")
