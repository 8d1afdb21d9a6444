"""Sums over the results that a format writes."""

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import get_args

from parser.findings.codes import CODES, Severity
from sim.check.result import CheckResult, Verdict

BLOCKS = ("found", "read", "decoded", "stepped")


class Totals:
    """Sums over results: files by verdict, findings by code, blocks, steps and path."""

    def __init__(self) -> None:
        self.files: Counter[str] = Counter()
        self.codes: Counter[str] = Counter()
        self.blocks: Counter[str] = Counter()
        self.fixable = 0
        self.steps = 0
        self.length_um = 0.0

    def over(self, results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The same results, each counted as it goes by."""
        for result in results:
            self._add(result)
            yield result

    def by_verdict(self) -> dict[Verdict, int]:
        """Files of each verdict."""
        return {verdict: self.files[verdict] for verdict in get_args(Verdict)}

    def by_severity(self) -> dict[Severity, int]:
        """Findings of each severity, the worst first."""
        return {
            severity: sum(count for code, count in self.codes.items() if CODES[code].severity is severity)
            for severity in Severity
        }

    @property
    def verdict(self) -> Verdict:
        """``fail`` where any file fails, else ``incomplete`` where any is, else ``pass``."""
        if self.files["fail"]:
            return "fail"
        return "incomplete" if self.files["incomplete"] else "pass"

    def _add(self, result: CheckResult) -> None:
        self.files[result.verdict] += 1
        self.codes.update(finding.code for finding in result.findings)
        self.blocks.update({name: getattr(result.coverage, name) for name in BLOCKS})
        self.fixable += sum(bool(finding.edits) for finding in result.findings)
        self.steps += result.steps
        self.length_um += result.length_um
