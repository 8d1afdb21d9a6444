"""The verdict on a run, and findings on it as a whole: what its scenario expects of the report, which has it not."""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

from parser.findings.catalogue import TO
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from sim.setup.expectations import Expectation, Missed, wanted

_LONGEST_SHOWN = 80


def verdict(findings: Iterable[Finding]) -> Literal["pass", "fail"]:
    """``fail`` where any finding is an error, else ``pass``."""
    return "fail" if any(finding.severity is Severity.ERROR for finding in findings) else "pass"


def to_check(findings: Sequence[Finding]) -> bool:
    """Whether none is an error, and someone has to look at one of them before the cut."""
    return verdict(findings) == "pass" and any(finding.spoils for finding in findings)


def outcome(findings: Sequence[Finding]) -> Literal["pass", "to-check", "fail"]:
    """The verdict as people are told it."""
    return "to-check" if to_check(findings) else verdict(findings)


def expectation_findings(missed: Iterable[Missed]) -> list[Finding]:
    """Finding 3B490 for each expectation that is not met."""
    return [
        Finding(
            "3B490",
            {
                "path": each_missed.expected.path,
                "found": _as_expected(each_missed.found),
                "wanted": _wanted(each_missed.expected),
            },
        )
        for each_missed in missed
    ]


def _wanted(expectation: Expectation) -> str:
    """A value as the report has it; a range as its ends, one of them left out where it is open."""
    if not expectation.is_range:
        return _as_expected(expectation.value)
    ends = wanted(expectation)
    return TO.join(f"{ends[key]:g}" if key in ends else "" for key in ("min", "max"))


def _as_expected(value: Any) -> str:
    """A value as ``[expect]`` would have it; of tables in a list, the codes or the first values; empty for nothing."""
    if value is None:
        return ""
    if isinstance(value, list):
        value = [next(iter(each.values()), None) if isinstance(each, Mapping) else each for each in value]
    text = f"{value:g}" if isinstance(value, float) else json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}…"
