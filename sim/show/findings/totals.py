"""Sums over the results that a format writes."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from typing import get_args

from parser.findings.codes import Severity
from sim.check.result import CheckResult, Outcome, Silenced, Verdict

BLOCKS = ("found", "read", "decoded", "stepped")


class Totals:
    """Sums over results: files by verdict, findings by code and severity, blocks, steps and path.

    Beside them what is not shown: in how many files a check is in a state (``checks[state][name]``), the findings that
    were silenced, and the settings files that counted, in their order.
    """

    def __init__(self) -> None:
        self.files: Counter[str] = Counter()
        self.to_check = 0
        self.counts: Counter[tuple[str, Severity]] = Counter()
        self.blocks: Counter[str] = Counter()
        self.checks: defaultdict[str, Counter[str]] = defaultdict(Counter)
        self.silenced = Silenced()
        self._settings_files: dict[str, None] = {}
        self.fixable = 0
        self.steps = 0
        self.length_um = 0.0

    def over(self, results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The same results, each counted as it goes by."""
        for result in results:
            self._add(result)
            yield result

    def by_outcome(self) -> dict[Outcome, int]:
        """Files of each outcome."""
        counts = {**self.files, "pass": self.files["pass"] - self.to_check, "to-check": self.to_check}
        return {outcome: counts.get(outcome, 0) for outcome in get_args(Outcome)}

    def by_severity(self) -> dict[Severity, int]:
        """Findings of each severity, the worst first."""
        return {severity: sum(n for (_, of), n in self.counts.items() if of is severity) for severity in Severity}

    @property
    def codes(self) -> dict[str, int]:
        """Findings of each code, of whatever severity, by their codes."""
        return {code: sum(self.counts[code, severity] for severity in Severity) for code, _ in sorted(self.counts)}

    @property
    def settings_files(self) -> tuple[str, ...]:
        """Settings files that counted for any file, in the order in which they came."""
        return tuple(self._settings_files)

    @property
    def verdict(self) -> Verdict:
        """``fail`` where any file fails, else ``incomplete`` where any is, else ``pass``."""
        if self.files["fail"]:
            return "fail"
        return "incomplete" if self.files["incomplete"] else "pass"

    def _add(self, result: CheckResult) -> None:
        self.files[result.verdict] += 1
        self.to_check += result.to_check
        self.counts.update((finding.code, finding.severity) for finding in result.findings)
        self.blocks.update({name: getattr(result.coverage, name) for name in BLOCKS})
        for check in result.coverage.checks:
            self.checks[check.state][check.name] += 1
        self.silenced = Silenced(*map(sum, zip(self.silenced, result.silenced, strict=True)))
        if result.settings_file:
            self._settings_files[result.settings_file] = None
        self.fixable += sum(bool(finding.edits) for finding in result.findings)
        self.steps += result.steps
        self.length_um += result.length_um
