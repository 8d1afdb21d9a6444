"""JSON of schema ``drycut.check/1``: docs/check.md and docs/check.schema.json."""

import json
from collections.abc import Iterable, Iterator
from typing import Any

from parser import __version__
from parser.findings.catalogue import Language, term, texts
from parser.findings.findings import Edit, Finding
from sim.check.result import CheckResult, CheckState, Coverage
from sim.show.findings.options import Options
from sim.show.findings.tidy import joined, spot, tidy
from sim.show.findings.totals import BLOCKS, Totals
from sim.show.terminal.finding import message

SCHEMA = "drycut.check/1"


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """One object, a line for each file; what is summed over all files stands behind them."""
    totals = Totals()
    head = {"schema": SCHEMA, "drycut": __version__, "language": options.language}
    yield f'{_dump(head)[:-1]}, "files": [\n'
    yield from joined((_dump(_file(result, options.language)) for result in totals.over(results)), ",\n")
    yield f'\n], "totals": {_dump(_totals(totals))}, "verdict": {_dump(totals.verdict)}}}\n'


def _file(result: CheckResult, language: Language) -> dict[str, Any]:
    return {
        "name": result.name,
        "encoding": result.encoding or None,
        "dialect": result.dialect or None,
        "assumptions": [assumption.entry(language) for assumption in result.assumptions],
        "verdict": result.verdict,
        "settings_file": result.settings_file or None,
        "silenced": result.silenced._asdict(),
        "coverage": _coverage(result.coverage, language),
        "length_um": result.length_um,
        "steps": result.steps,
        "programmed": result.programmed and result.programmed._asdict(),
        "findings": [_finding(result, finding, language) for finding in result.findings],
    }


def _coverage(coverage: Coverage, language: Language) -> dict[str, Any]:
    return {
        "blocks": {name: getattr(coverage, name) for name in BLOCKS},
        "checks": [_check(check, language) for check in coverage.checks],
    }


def _check(check: CheckState, language: Language) -> dict[str, Any]:
    return {
        "name": check.name,
        "title": term(check.name, language),
        "state": check.state,
        "reason": check.reason or None,
        "reason_text": check.because(language) or None,
    }


def _finding(result: CheckResult, finding: Finding, language: Language) -> dict[str, Any]:
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
        "values": finding.values,
        "fixable": bool(finding.edits),
        "edits": [_edit(edit) for edit in finding.edits],
    }


def _edit(edit: Edit) -> dict[str, Any]:
    return edit._asdict()


def _totals(totals: Totals) -> dict[str, Any]:
    return {
        "files": {"checked": totals.files.total(), **totals.by_verdict()},
        "findings": {severity.value: count for severity, count in totals.by_severity().items()},
        "codes": totals.codes,
        "fixable": totals.fixable,
        "silenced": totals.silenced._asdict(),
        "blocks": {name: totals.blocks[name] for name in BLOCKS},
        "length_um": totals.length_um,
        "steps": totals.steps,
    }


def _dump(value: object) -> str:
    # ASCII alone: the same bytes whatever the encoding of stdout.
    return json.dumps(tidy(value), allow_nan=False)
