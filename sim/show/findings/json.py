"""JSON of schema ``drycut.check/1``, with its model: docs/check.md and docs/check.schema.json."""

import json
from collections.abc import Iterable, Iterator
from typing import Annotated, Final, Literal, TypedDict

from parser import __version__
from parser.documents import (
    AssumptionEntry,
    BlockCountsEntry,
    CheckVerdict,
    Code,
    Count,
    DialectName,
    Document,
    Encoding,
    Ordinal,
    Point,
    SeverityName,
    Size,
    Text,
    Version,
    matching,
    of_length,
    one_of,
)
from parser.findings.catalogue import Language, term, texts
from parser.findings.codes import Severity
from parser.findings.findings import Edit, Finding
from sim.check.result import CheckResult, CheckState, Coverage, Programmed, Silenced
from sim.show.findings.totals import Totals, joined, spot, tidy
from sim.show.findings.wording import Options
from sim.show.terminal.finding import message


class SilencedEntry(TypedDict):
    """How many findings were silenced, by what; and checks that did not end, as the baseline has it."""

    options: Count
    settings: Count
    remarks: Count
    baseline: Count
    checks: Count


class CheckEntry(TypedDict):
    """How far a check came, and why it is not complete."""

    name: Annotated[str, matching(r"^check-[a-z-]+$")]
    title: Text
    state: Annotated[str, one_of("complete", "incomplete", "known", "not asked")]
    reason: Annotated[str, matching(r"^reason-[a-z-]+$")] | None
    reason_text: Text | None


class CoverageEntry(TypedDict):
    """How far the checks of a file came."""

    blocks: BlockCountsEntry
    checks: list[CheckEntry]


class ProgrammedEntry(TypedDict):
    """What the program asks for: curves, length and extent."""

    lines: Count
    arcs: Count
    rapids: Count
    cut_length_um: Size | None
    box_um: Annotated[list[float], of_length(4, 4)] | None
    first_um: Point | None
    last_um: Point | None


class EditEntry(TypedDict):
    """Characters of the file to be replaced, and by what."""

    first: Count
    past: Count
    text: str


class FindingEntry(TypedDict):
    """What is wrong, with places, values and how it is mended."""

    code: Code
    severity: SeverityName
    title: Text
    found: str
    expected: str
    machine: str
    hint: str
    message: Text
    line: Ordinal | None
    column: Ordinal | None
    end_column: Ordinal | None
    block: Ordinal | None
    block_name: Text | None
    values: dict[str, str | float | None]
    fixable: bool
    edits: list[EditEntry]


class FileEntry(TypedDict):
    """A file, and what was found in it."""

    name: Text
    encoding: Encoding | None
    dialect: DialectName | None
    assumptions: list[AssumptionEntry]
    verdict: CheckVerdict
    to_check: bool
    settings_file: Text | None
    silenced: SilencedEntry
    coverage: CoverageEntry
    length_um: Size | None
    steps: Count
    programmed: ProgrammedEntry | None
    findings: list[FindingEntry]


FileCountsEntry = TypedDict(
    "FileCountsEntry",
    {
        "checked": Count,
        "pass": Count,
        "fail": Count,
        "incomplete": Count,
        "to_check": Count,
    },
)


class SeverityCountsEntry(TypedDict):
    """Findings of each severity."""

    error: Count
    warning: Count
    note: Count


class TotalsEntry(TypedDict):
    """What is summed over all files."""

    files: FileCountsEntry
    findings: SeverityCountsEntry
    codes: dict[Code, Ordinal]
    fixable: Count
    silenced: SilencedEntry
    blocks: BlockCountsEntry
    length_um: Size | None
    steps: Count


class CheckDocument(TypedDict):
    """Files and what was found in them, ``drycut check --format json``."""

    schema: Literal["drycut.check/1"]
    drycut: Version
    language: Annotated[str, one_of("en", "zh")]
    files: list[FileEntry]
    totals: TotalsEntry
    verdict: CheckVerdict


CHECK: Final = Document(CheckDocument, "docs/check.md")


SCHEMA = "drycut.check/1"


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """One object, a line for each file; what is summed over all files stands behind them."""
    totals = Totals()
    head = {"schema": SCHEMA, "drycut": __version__, "language": options.language}
    yield f'{_dump(head)[:-1]}, "files": [\n'
    yield from joined((_dump(_file(result, options.language)) for result in totals.over(results)), ",\n")
    yield f'\n], "totals": {_dump(_totals(totals))}, "verdict": {_dump(totals.verdict)}}}\n'


def _file(result: CheckResult, language: Language) -> FileEntry:
    return {
        "name": result.name,
        "encoding": result.encoding or None,
        "dialect": result.dialect or None,
        "assumptions": [assumption.entry(language) for assumption in result.assumptions],
        "verdict": result.verdict,
        "to_check": result.to_check,
        "settings_file": result.settings_file or None,
        "silenced": _silenced(result.silenced),
        "coverage": _coverage(result.coverage, language),
        "length_um": result.length_um,
        "steps": result.steps,
        "programmed": result.programmed and _programmed(result.programmed),
        "findings": [_finding(result, finding, language) for finding in result.findings],
    }


def _coverage(coverage: Coverage, language: Language) -> CoverageEntry:
    return {
        "blocks": _block_counts(coverage),
        "checks": [_check(check, language) for check in coverage.checks],
    }


def _block_counts(counts: Coverage) -> BlockCountsEntry:
    return {"found": counts.found, "read": counts.read, "decoded": counts.decoded, "stepped": counts.stepped}


def _silenced(silenced: Silenced) -> SilencedEntry:
    return {
        "options": silenced.options,
        "settings": silenced.settings,
        "remarks": silenced.remarks,
        "baseline": silenced.baseline,
        "checks": silenced.checks,
    }


def _programmed(programmed: Programmed) -> ProgrammedEntry:
    return {
        "lines": programmed.lines,
        "arcs": programmed.arcs,
        "rapids": programmed.rapids,
        "cut_length_um": programmed.cut_length_um,
        "box_um": programmed.box_um and list(programmed.box_um),
        "first_um": programmed.first_um and list(programmed.first_um),
        "last_um": programmed.last_um and list(programmed.last_um),
    }


def _check(check: CheckState, language: Language) -> CheckEntry:
    return {
        "name": check.name,
        "title": term(check.name, language),
        "state": check.state,
        "reason": check.reason or None,
        "reason_text": check.because(language) or None,
    }


def _finding(result: CheckResult, finding: Finding, language: Language) -> FindingEntry:
    of = texts(finding, language)
    at = spot(finding, result.excerpts)
    return {
        "code": finding.code,
        "severity": finding.severity.value,
        "title": of.title,
        "found": of.found,
        "expected": of.expected,
        "machine": of.machine,
        "hint": of.hint,
        "message": message(finding, language),
        "line": at.line or None,
        "column": at.column or None,
        "end_column": at.end_column or None,
        "block": finding.block or None,
        "block_name": finding.block_name or None,
        "values": dict(finding.values),
        "fixable": bool(finding.edits),
        "edits": [_edit(edit) for edit in finding.edits],
    }


def _edit(edit: Edit) -> EditEntry:
    return {"first": edit.first, "past": edit.past, "text": edit.text}


def _totals(totals: Totals) -> TotalsEntry:
    severities = totals.by_severity()
    return {
        "files": {
            "checked": totals.files.total(),
            "pass": totals.files["pass"],
            "fail": totals.files["fail"],
            "incomplete": totals.files["incomplete"],
            "to_check": totals.to_check,
        },
        "findings": {
            "error": severities[Severity.ERROR],
            "warning": severities[Severity.WARNING],
            "note": severities[Severity.NOTE],
        },
        "codes": totals.codes,
        "fixable": totals.fixable,
        "silenced": _silenced(totals.silenced),
        "blocks": {
            "found": totals.blocks["found"],
            "read": totals.blocks["read"],
            "decoded": totals.blocks["decoded"],
            "stepped": totals.blocks["stepped"],
        },
        "length_um": totals.length_um,
        "steps": totals.steps,
    }


def _dump(value: object) -> str:
    # ASCII alone: the same bytes whatever the encoding of stdout.
    return json.dumps(tidy(value), allow_nan=False)
