"""The documents for users, which pages of findings cite: beside the code in a wheel, in ``docs`` of the repository.

A document in Chinese stands beside the English one: ``check.zh.md`` and ``check.md`` are one document.
"""

import re
from functools import cache
from pathlib import Path
from typing import Final

from parser.findings.catalogue import Language

_PACKAGE: Final = Path(__file__).parents[2]
_NOT_FOR_USERS: Final = {"architecture", "code-flow", "findings", "record"}
"""Documents of those who change drycut, and those made of the pages of all codes; a wheel has none of them."""
_CHINESE = ".zh"
_TWIN = re.compile(r"^\[[^\[\]]+\]\([\w.-]+\.md\)\n\n", re.MULTILINE)
"""The paragraph that leads to the same document in the other language."""
_LINK = re.compile(r"\[([^\[\]]+)\]\([^)]+\)")
_CITED = re.compile(r"\b(?:docs/)?(\w+)(\.zh)?\.md\b", re.ASCII)
_HEADING = re.compile(r"^#+ ")
_FENCE = "```"


@cache
def documents() -> tuple[str, ...]:
    """Names of the documents, in their order; ``drycut explain NAME`` shows them."""
    return tuple(sorted({file.split(".")[0] for file in files()}))


@cache
def files() -> tuple[str, ...]:
    """Their files, in English and in Chinese where a document is written in it."""
    return tuple(sorted(path.name for path in _folder().glob("*.md") if path.name.split(".")[0] not in _NOT_FOR_USERS))


def document(name: str, language: Language = "en") -> str:
    """Markdown of a document, in English where the language has none. KeyError where there is no such document."""
    if name not in documents():
        raise KeyError(name)
    chinese = _folder() / f"{name}{_CHINESE}.md"
    is_chinese = language == "zh" and chinese.exists()
    return (chinese if is_chinese else _folder() / f"{name}.md").read_text(encoding="utf-8")


def section(markdown: str, number: str) -> str:
    """The section ``## NUMBER. …`` of a document. KeyError where it has none."""
    lines, inside, fenced = [], False, False
    for line in markdown.splitlines():
        fenced ^= line.startswith(_FENCE)
        if not fenced and line.startswith("## "):
            inside = line.startswith(f"## {number}. ")
        if inside:
            lines.append(line)
    if not lines:
        raise KeyError(number)
    return "\n".join(lines)


def cited(markdown: str) -> str:
    """Markdown that cites documents by the command that shows them: ``docs/3b.md §2`` is ``drycut explain 3b §2``."""
    return _CITED.sub(_command, _LINK.sub(r"\1", _TWIN.sub("", markdown)))


def title(name: str, language: Language = "en") -> str:
    """Heading of a document, in English where the language has none. KeyError where there is no such document."""
    return _HEADING.sub("", document(name, language).split("\n", 1)[0])


def _folder() -> Path:
    shipped = _PACKAGE / "docs"
    return shipped if shipped.is_dir() else _PACKAGE.parent / "docs"


def _command(match: re.Match[str]) -> str:
    if match[1] == "findings":  # made of the pages of all codes, which the command lists
        return "drycut explain --lang zh" if match[2] else "drycut explain"
    return f"drycut explain {match[1]}" if match[1] in documents() else match[0]
