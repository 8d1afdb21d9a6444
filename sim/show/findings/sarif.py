"""SARIF 2.1.0 (OASIS Standard, errata 01), which code hosts and editors read; § names its sections."""

import json
from collections.abc import Iterable, Iterator
from typing import Any

from parser.findings.catalogue import Language
from sim.check.result import CheckResult
from sim.show.findings.options import Options
from sim.show.findings.sarif_result import artifact_location, results_of
from sim.show.findings.sarif_rules import driver, said
from sim.show.findings.tidy import joined, tidy
from sim.show.findings.wording import reason

_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"

# Names of the IANA registry, which §3.24.9 wants.
_CHARSETS = {"utf-8": "UTF-8", "utf-8-sig": "UTF-8", "utf-16": "UTF-16", "gb18030": "GB18030", "latin-1": "ISO-8859-1"}


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """One log of one run; files and what went wrong in the checks themselves stand behind the results."""
    run = _Run(options.language)
    head = {
        "tool": {"driver": driver(options.language)},
        "language": options.language,
        "columnKind": "unicodeCodePoints",
    }
    yield f'{{"$schema": {_dump(_SCHEMA)}, "version": "2.1.0", "runs": [{{{_dump(head)[1:-1]}, "results": [\n'
    yield from joined(map(_dump, run.results(results)), ",\n")
    yield f'\n], "artifacts": {_lines(run.artifacts)}, "invocations": [{_dump(run.invocation())}]}}]}}\n'


class _Run:
    """What is gathered while the results go by: their files, and the checks that did not come to their end."""

    def __init__(self, language: Language) -> None:
        self.artifacts: list[dict[str, Any]] = []
        self._language = language
        self._notices: list[dict[str, Any]] = []
        self._successful = True

    def results(self, results: Iterable[CheckResult]) -> Iterator[dict[str, Any]]:
        """The SARIF results of all files."""
        for index, result in enumerate(results):
            self.artifacts.append(_artifact(result))
            self._notices += self._incomplete(result, index)
            self._successful &= not result.unreadable
            yield from results_of(result, index, self._language)

    def invocation(self) -> dict[str, Any]:
        """The run (§3.20): it succeeded where every file was a program that could be read."""
        return {"executionSuccessful": self._successful, "toolExecutionNotifications": self._notices}

    def _incomplete(self, result: CheckResult, index: int) -> Iterator[dict[str, Any]]:
        for check in result.coverage.checks:
            if check.state == "incomplete":
                yield {
                    "descriptor": {"id": check.name},
                    "level": "warning",
                    "message": {"text": said(reason(check, self._language))},
                    "locations": [{"physicalLocation": {"artifactLocation": artifact_location(result.name, index)}}],
                }


def _artifact(result: CheckResult) -> dict[str, Any]:
    charset = {"encoding": _CHARSETS[result.encoding]} if result.encoding in _CHARSETS else {}
    return {"location": artifact_location(result.name), "roles": ["analysisTarget"], **charset}


def _lines(values: list[dict[str, Any]]) -> str:
    return "[\n" + ",\n".join(map(_dump, values)) + "\n]" if values else "[]"


def _dump(value: object) -> str:
    # ASCII alone: UTF-8, as §3.1 wants it, whatever the encoding of stdout.
    return json.dumps(tidy(value), allow_nan=False)
