"""Findings for the page: their texts in both languages, the source line with a caret, and the pages of their codes.

Texts hold a little Markdown, which becomes HTML: paragraphs, fenced text, ``code`` and **bold**.
"""

import re
from collections.abc import Iterable
from typing import Final, NamedTuple

from markupsafe import Markup, escape

from parser.findings.catalogue import LANGUAGES, Bilingual, page, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.program import Program
from parser.text.places import caret_lines
from sim.run.dryrun import DryRun
from sim.show.texts import bilingual

MOST: Final = 200
"""Findings that the page shows; report.json has them all."""

PARTS: Final = ("found", "expected", "machine", "hint")

_FENCED = re.compile(r"^```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_CODE = re.compile(r"`([^`]+)`")
_JOINT = re.compile(r"(?<=[^\x00-\x7f])\n(?=[^\x00-\x7f])")
"""A line's end between Chinese characters, which stand without a blank."""
_BOLD = re.compile(r"\*\*(.+?)\*\*", re.DOTALL)


class ShownFinding(NamedTuple):
    """A finding as the page shows it.

    Attributes
    ----------
    address
        Its address in the page.
    code, severity, word, title
        What it is: its severity as a key and as a word.
    line, column
        Where it is; 0 where that is not meant.
    block
        What people call the block it is in; empty where no one block is meant.
    texts
        What was found and expected, what the machine does, and how to mend it, each by its key; only those there are.
    source
        The source line and the carets under it; None without a line.
    """

    address: str
    code: str
    severity: str
    word: Bilingual
    title: Bilingual
    line: int
    column: int
    block: str
    texts: tuple[tuple[str, Bilingual], ...]
    source: tuple[str, str] | None


class Explained(NamedTuple):
    """The page of a code: why it is a fault, and how to mend it."""

    code: str
    title: Bilingual
    why: tuple[Markup, Markup]
    mend: tuple[Markup, Markup]


def shown_findings(run: DryRun) -> list[ShownFinding]:
    """The findings that the page shows, in file order."""
    return [_shown_finding(run.program, finding, address(at)) for at, finding in enumerate(run.findings[:MOST])]


def gravest_findings(run: DryRun, most: int) -> list[ShownFinding]:
    """The gravest findings of all, those that the page has no room for too: errors first, then in file order."""
    severities = list(Severity)
    order = sorted(range(len(run.findings)), key=lambda at: severities.index(run.findings[at].severity))
    return [_shown_finding(run.program, run.findings[at], address(at)) for at in order[:most]]


def address(at: int) -> str:
    """Address in the page of a finding, counted from 0: of its own, or that of the list where it is not shown."""
    return f"finding-{at + 1}" if at < MOST else "findings"


def explained(findings: Iterable[Finding]) -> list[Explained]:
    """Pages of the codes that occur, in their order."""
    return [_explained(code) for code in sorted({finding.code for finding in findings})]


def _shown_finding(program: Program, finding: Finding, address: str) -> ShownFinding:
    english, chinese = (texts(finding, language)._asdict() for language in LANGUAGES)
    return ShownFinding(
        address=address,
        code=finding.code,
        severity=str(finding.severity),
        word=bilingual(f"findings.{finding.severity}"),
        title=Bilingual(english["title"], chinese["title"]),
        line=finding.line,
        column=finding.column,
        block=finding.block_name,
        texts=tuple((part, Bilingual(english[part], chinese[part])) for part in PARTS if english[part]),
        source=_source(program, finding),
    )


def _source(program: Program, finding: Finding) -> tuple[str, str] | None:
    if not finding.line:
        return None
    width = finding.span[1] - finding.span[0]
    line, carets = caret_lines(program.excerpt(finding.line), max(finding.column, 1), width)
    return line, carets if finding.column else ""


def _explained(code: str) -> Explained:
    pages = page(code, "en"), page(code, "zh")
    return Explained(
        code,
        Bilingual(pages[0].title, pages[1].title),
        (prose(pages[0].why), prose(pages[1].why)),
        (prose(pages[0].mend), prose(pages[1].mend)),
    )


def prose(markdown: str) -> Markup:
    """HTML of a text; all that is not Markdown of these kinds is escaped."""
    parts = _FENCED.split(markdown)  # every second one is fenced
    return Markup("").join(
        Markup("<pre>{}</pre>").format(part) if at % 2 else _paragraphs(part) for at, part in enumerate(parts)
    )


def _paragraphs(text: str) -> Markup:
    paragraphs = filter(None, map(str.strip, text.split("\n\n")))
    return Markup("").join(Markup("<p>{}</p>").format(inline(paragraph)) for paragraph in paragraphs)


def inline(text: str) -> Markup:
    """HTML of a text without paragraphs."""
    coded = _CODE.sub(r"<code>\1</code>", _JOINT.sub("", str(escape(text))))
    return Markup(_BOLD.sub(r"<strong>\1</strong>", coded))  # noqa: S704 - escaped just above
