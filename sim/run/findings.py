"""Findings on a run as a whole: what its scenario expects of the report, and the report does not say."""

import math
from collections.abc import Iterable
from typing import Any

from parser.findings.findings import Finding
from sim.setup.expectations import Expectation, Missed


def expectation_findings(missed: Iterable[Missed]) -> list[Finding]:
    """Finding 3B490 for each expectation that is not met."""
    return [
        Finding("3B490", {"path": one.expected.path, "found": _show(one.found), "wanted": _wanted(one.expected)})
        for one in missed
    ]


def _wanted(expectation: Expectation) -> str:
    if not expectation.is_range:
        return _show(expectation.value)
    low, high = expectation.value
    if low == -math.inf:
        return f"at most {high:g}"
    return f"at least {low:g}" if high == math.inf else f"{low:g} to {high:g}"


def _show(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
