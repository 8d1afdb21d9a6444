"""JSON of schema ``drycut.check/1``: docs/check.md and docs/check.schema.json."""

import json
from collections.abc import Iterable, Iterator

from parser import __version__
from parser.documents import BlockCountsEntry
from parser.findings.catalogue import Language, term, texts
from parser.findings.codes import Severity
from parser.findings.findings import Edit, Finding
from sim.check.programmed import Programmed
from sim.check.result import CheckResult, CheckState, Coverage, Silenced
from sim.show.findings.model import (
    CheckEntry,
    CoverageEntry,
    EditEntry,
    FileEntry,
    FindingEntry,
    ProgrammedEntry,
    SilencedEntry,
    TotalsEntry,
)
from sim.show.findings.options import Options
from sim.show.findings.tidy import joined, spot, tidy
from sim.show.findings.totals import Totals
from sim.show.terminal.finding import message

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
