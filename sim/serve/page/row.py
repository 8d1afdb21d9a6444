"""A program as a list of them shows it: its verdict, what is found, how large it is, and its path, small."""

import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from parser.findings.catalogue import LANGUAGES, Bilingual, page, texts
from parser.findings.errors import DrycutError, ProgramError
from parser.findings.findings import Finding, counted
from parser.text.encoding import printable
from sim.check.file_check import as_typed
from sim.serve.page.answers import read_file, size_of
from sim.show.index_page.page import thumbnail
from sim.show.texts.phrases import same


def row_of(name: str, file: Path | None, data: bytes) -> dict[str, Any]:
    """The row of a file's bytes, whatever they hold; `file` is where they stand, None where nobody knows.

    Lengths are µm. ``verdict`` is pass, to-check, incomplete, fail, or refused where there is no program.
    """
    try:
        read = read_file(data)
    except ProgramError as error:
        return _row(name, "refused", (error.finding,), _message(error.finding))
    program, result = (found := as_typed(name, file, read.text)).program, found.result
    if result.unreadable:
        return _row(name, "refused", result.findings, _message(result.findings[0]))
    size = size_of(result)
    row = _row(name, result.outcome, result.findings)
    if program is not None and len(program.toolpath) and size is not None:
        row |= {"picture": thumbnail(program.toolpath), "cut_um": size["cut_um"], "box_um": size["box_um"]}
    return row


def row_or_why(name: str, file: Path | None, data: bytes) -> dict[str, Any]:
    """As `row_of`; where drycut itself fails at it, the row says so."""
    try:
        return row_of(name, file, data)
    except DrycutError as error:
        return refused(name, error.in_both())
    except Exception:
        return _row(name, "fault", message=same(traceback.format_exc().strip().splitlines()[-1]))


def refused(name: str, why: Bilingual) -> dict[str, Any]:
    """The row of a file that cannot be read."""
    return _row(name, "refused", message=why)


def _message(finding: Finding) -> Bilingual:
    return Bilingual(*(texts(finding, language).message for language in LANGUAGES))


def _row(name: str, verdict: str, findings: Sequence[Finding] = (), message: Bilingual | None = None) -> dict[str, Any]:
    counts = counted(findings)
    name_text = printable(name)
    return {
        "file": name_text,
        "title": name_text,
        "verdict": verdict,
        "message": None if message is None else {"en": printable(message.en), "zh": printable(message.zh)},
        "findings": [{"code": of.code, "severity": str(of.severity), "count": of.n} for of in counts],
        "titles": {of.code: {language: page(of.code, language).title for language in LANGUAGES} for of in counts},
        "picture": "",
        "cut_um": None,
        "box_um": None,
    }
