"""The documents for users, which pages of findings cite: beside the code in a wheel, in ``docs`` of the repository."""

import re
from pathlib import Path
from typing import Final

DOCUMENTS: Final = (
    "3b",
    "ballbar",
    "card",
    "check",
    "compare",
    "drawing",
    "limits",
    "pictures",
    "python",
    "replay",
    "report",
    "scenarios",
    "terminal",
)
"""Names of the documents that a wheel brings (``pyproject.toml``); ``drycut explain NAME`` shows them."""

_PACKAGE: Final = Path(__file__).parents[2]
_LINK = re.compile(r"\[([^\[\]]+)\]\([^)]+\)")
_CITED = re.compile(r"\b(?:docs/)?(\w+)(\.zh)?\.md\b")
_HEADING = re.compile(r"^(#+) ")
_FENCE = "```"


def document(name: str) -> str:
    """Markdown of a document. KeyError where there is no such document."""
    if name not in DOCUMENTS:
        raise KeyError(name)
    folders = (_PACKAGE / "docs", _PACKAGE.parent / "docs")
    path = next((path for folder in folders if (path := folder / f"{name}.md").is_file()), None)
    if path is None:
        raise KeyError(name)
    return path.read_text(encoding="utf-8")


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
    return _CITED.sub(_command, _LINK.sub(r"\1", markdown))


def title(name: str) -> str:
    """Heading of a document. KeyError where there is no such document."""
    return _HEADING.sub("", document(name).split("\n", 1)[0])


def _command(match: re.Match[str]) -> str:
    if match[1] == "findings":  # made of the pages of all codes, which the command lists
        return "drycut explain --lang zh" if match[2] else "drycut explain"
    return f"drycut explain {match[1]}" if match[1] in DOCUMENTS else match[0]
