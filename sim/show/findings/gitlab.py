"""Code quality report of GitLab (docs.gitlab.com, "Code Quality report format"): a list of issues.

Its schema has no place for the settings file, nor for what is not shown.
"""

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from parser.findings.catalogue import Language
from parser.findings.codes import Severity
from sim.check.result import CheckResult, fingerprints
from sim.show.findings.totals import joined, posix, tidy
from sim.show.findings.wording import Options, reason
from sim.show.terminal.finding import message

_SEVERITIES: Mapping[Severity, str] = {Severity.ERROR: "major", Severity.WARNING: "minor", Severity.NOTE: "info"}


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """An issue for each finding and for each check that did not come to its end, a line each."""
    issues = (json.dumps(tidy(issue)) for result in results for issue in _issues(result, options.language))
    yield "[\n"
    yield from joined(issues, ",\n")
    yield "\n]\n"


def _issues(result: CheckResult, language: Language) -> Iterator[dict[str, Any]]:
    path = _path(result.name)
    for finding, known in zip(result.findings, fingerprints(result), strict=True):
        yield {
            "description": message(finding, language),
            "check_name": finding.code,
            "fingerprint": _fingerprint(path, known),
            "severity": _SEVERITIES[finding.severity],
            "location": _location(path, finding.line),
        }
    for check in result.coverage.checks:
        if check.state == "incomplete":
            yield {
                "description": reason(check, language),
                "check_name": check.name,
                "fingerprint": _fingerprint(path, check.name),
                "severity": "minor",
                "location": _location(path),
            }


def _fingerprint(path: str, known: str) -> str:
    """Of what is known in its file; GitLab shows one issue of those that have the same fingerprint."""
    return hashlib.sha256(f"{path}\n{known}".encode(errors="surrogatepass")).hexdigest()[:32]


def _location(path: str, line: int = 0) -> dict[str, Any]:
    return {"path": path, "lines": {"begin": max(line, 1)}}


def _path(name: str) -> str:
    """Name of a file from the folder that drycut runs in, which in a job is that of the project."""
    path, here = Path(name), Path.cwd()
    return posix(str(path.relative_to(here)) if path.is_absolute() and path.is_relative_to(here) else name)
