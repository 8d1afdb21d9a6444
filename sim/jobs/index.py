"""``index.json`` of a shop: a row for each of its programs, and what they come to (docs/batch.md)."""

import json
from collections import Counter
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

from parser import __version__
from parser.findings.catalogue import Bilingual
from parser.findings.codes import Severity
from parser.findings.findings import Count
from sim.show.index_page.model import CountsEntry, IndexDocument, IndexRowEntry

_NONE: Final = Bilingual("", "")
VERDICTS: Final = ("pass", "fail", "refused", "fault")
_WORST_FIRST: Final = tuple(Severity)


class Row(NamedTuple):
    """What came of one program.

    Attributes
    ----------
    verdict
        That of its report; ``refused`` where it, its scenario or its drawing cannot be read or run, ``fault`` where
        drycut itself failed.
    title
        Title of its scenario in both languages; of a program alone, its file name.
    message
        Why there is no report; empty where there is one. Only findings are told in Chinese as well.
    findings
        How many there are of each code, the worst severity first, then by code.
    time_s, max_um
        How long the machine runs, and the largest deviation of the wire; None without a report.
    time_within_s
        Its interval, the least and the most, as the report has it; None where it has none.
    drawing_um
        Largest deviation of the edge from the drawing; None where it was held against none.
    to_check
        Whether it passes, and someone has to look at a finding before the cut.
    picture
        The path that ran, small: SVG path data (`sim.show.index_page.page`); empty without a report.
    """

    verdict: str
    title: Bilingual
    message: Bilingual = _NONE
    findings: tuple[Count, ...] = ()
    time_s: float | None = None
    time_within_s: tuple[float, float] | None = None
    max_um: float | None = None
    drawing_um: float | None = None
    to_check: bool = False
    picture: str = ""


class Entry(NamedTuple):
    """A row in its place: the file as it was named, its folder in OUT (None without a report), and where it is from."""

    file: str
    folder: str | None
    row: Row
    from_cache: bool


def build_index(entries: Sequence[Entry]) -> IndexDocument:
    """The index as plain data, in the order of the entries; the order of keys is fixed, and there is no clock in it."""
    return {
        "schema": "drycut.index/1",
        "drycut": __version__,
        "counts": _counts(entries),
        "programs": [_program(entry) for entry in entries],
    }


def index_text(index: IndexDocument) -> str:
    """The index as JSON text, a line for each program."""
    head = {key: value for key, value in index.items() if key != "programs"}
    top = "".join(f'"{key}": {_line(value)},\n' for key, value in head.items())
    programs = ",\n".join(map(_line, index["programs"]))
    return f'{{\n{top}"programs": [\n{programs}\n]\n}}\n'


def _counts(entries: Sequence[Entry]) -> CountsEntry:
    verdicts = Counter(entry.row.verdict for entry in entries)
    severities = Counter[Severity]()
    for entry in entries:
        for count in entry.row.findings:
            severities[count.severity] += count.n
    return {
        "programs": len(entries),
        "pass": verdicts["pass"],
        "fail": verdicts["fail"],
        "to_check": sum(entry.row.to_check for entry in entries),
        "refused": verdicts["refused"],
        "fault": verdicts["fault"],
        "from_cache": sum(entry.from_cache for entry in entries),
        "errors": severities[Severity.ERROR],
        "warnings": severities[Severity.WARNING],
        "notes": severities[Severity.NOTE],
    }


def _program(entry: Entry) -> IndexRowEntry:
    row = entry.row
    least_s, most_s = row.time_within_s or (None, None)
    return {
        "file": entry.file,
        "title": row.title.en,
        "title_zh": row.title.zh if row.title.zh != row.title.en else None,
        "verdict": row.verdict,
        "to_check": row.to_check,
        "message": row.message.en or None,
        "findings": [{"code": of.code, "severity": str(of.severity), "count": of.n} for of in row.findings],
        "time_s": row.time_s,
        "time_least_s": least_s,
        "time_most_s": most_s,
        "max_um": row.max_um,
        "drawing_um": row.drawing_um,
        "folder": entry.folder,
        "from_cache": entry.from_cache,
    }


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
