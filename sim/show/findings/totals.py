"""What formats for other programs share: sums over results, and values and places as files can hold them.

Sums over the results that a format writes.
"""

import math
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import PurePath
from typing import NamedTuple, get_args

from parser.findings.codes import Severity
from parser.findings.findings import Finding
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


_SURROGATE = re.compile("[\ud800-\udfff]")


class Spot(NamedTuple):
    """Place of a finding in its line: line, first column, and one past the last; 0 where unknown."""

    line: int
    column: int
    end_column: int


def spot(finding: Finding, excerpts: Mapping[int, str]) -> Spot:
    """Place of a finding; one that goes on in a later line ends with its first line."""
    if not finding.column:
        return Spot(finding.line, 0, 0)
    first, past = finding.span
    end = finding.column + past - first
    if finding.line in excerpts:
        end = min(end, len(excerpts[finding.line]) + 1)
    return Spot(finding.line, finding.column, max(end, finding.column))


def clean(text: str) -> str:
    """Text without lone surrogates, which names of files may hold (PEP 383) and no encoding writes."""
    return text if text.isascii() else _SURROGATE.sub("\ufffd", text)


def posix(name: str) -> str:
    """Name of a file with forward slashes and without ``./``."""
    return PurePath(name).as_posix()


def tidy(value: object) -> object:
    """A value for JSON: texts clean, numbers rounded to 10⁻⁶, what is no number null."""
    if isinstance(value, str):
        return clean(str(value))
    if isinstance(value, float):
        return round(value, 6) if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {clean(str(key)): tidy(inner) for key, inner in value.items()}
    if isinstance(value, Sequence):
        return [tidy(inner) for inner in value]
    return value


def joined(parts: Iterable[str], joint: str) -> Iterator[str]:
    """The parts with a joint between any two of them."""
    for index, part in enumerate(parts):
        yield joint + part if index else part
