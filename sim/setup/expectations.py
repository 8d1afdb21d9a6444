"""What a scenario expects of its report: paths into ``report.json`` with a value, or a lowest and highest one."""

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from parser.findings.errors import SettingsError
from sim.setup.toml.keys import Section, WrittenSection

EXPECT = Section("expect", ())
"""Its keys are paths into the report."""

_PLACE = re.compile(r"[0-9]{1,9}")  # in a list; Python reads other digits too, and refuses thousands of them
_OF_STEPS = {"stepped", "closure_stepped_um", "interpolator"}


class Expectation(NamedTuple):
    """One expected entry.

    Attributes
    ----------
    path
        Keys and list indices from the top of the report, joined with dots: ``contours.0.closure_exact_um``.
    value
        The value itself (text, truth, count, list of these), or a (low, high) range of numbers, both included.
    is_range
        Which of the two `value` is.
    """

    path: str
    value: Any
    is_range: bool


class Missed(NamedTuple):
    """An expectation that a report does not meet, and what stands there; None where nothing does."""

    expected: Expectation
    found: Any


def read_expectation(table: Mapping[str, Any], where: str) -> tuple[Expectation, ...]:
    """Expectations of an ``[expect]`` table: ``"path" = value`` or ``"path" = {min = …, max = …}``.

    SettingsError where a range has other keys or is no range of numbers.
    """
    found = []
    for path, value in table.items():
        if not isinstance(value, Mapping):
            found.append(Expectation(path, value, is_range=False))
            continue
        low, high = value.get("min", -math.inf), value.get("max", math.inf)
        if not value or set(value) - {"min", "max"} or not (_is_number(low) and _is_number(high) and low <= high):
            raise SettingsError("no-expected-value", where=where, path=path, found=dict(value))
        found.append(Expectation(path, (_end(low), _end(high)), is_range=True))
    return tuple(found)


def expect_section(expected: tuple[Expectation, ...]) -> WrittenSection:
    """The ``[expect]`` table that makes these."""
    return WrittenSection(EXPECT, {expectation.path: wanted(expectation) for expectation in expected})


def wanted(expected: Expectation) -> Any:
    """What an expectation asks for, as its file says it."""
    if not expected.is_range:
        return expected.value
    low, high = expected.value
    least = {} if low == -math.inf else {"min": low}
    return least if least and high == math.inf else {**least, "max": high}


def not_of_steps(expected: tuple[Expectation, ...]) -> tuple[Expectation, ...]:
    """The expectations but those of figures that each interpolator makes its own: counts and ends of steps."""
    return tuple(e for e in expected if e.path != "summary.steps" and not _OF_STEPS & set(e.path.split(".")))


def missed(report: Mapping[str, Any], expected: tuple[Expectation, ...]) -> tuple[Missed, ...]:
    """The expectations that the report does not meet, in their order."""
    return tuple(Missed(e, found) for e in expected if not _meets(found := _look_up(report, e.path), e))


def _look_up(report: Any, path: str) -> Any:
    """Entry under a path; None where there is none. A list answers its own keys as a list of theirs."""
    here = report
    for key in path.split("."):
        if isinstance(here, list) and _PLACE.fullmatch(key):
            here = here[int(key)] if int(key) < len(here) else None
        elif isinstance(here, list):
            here = [_entry(each, key) for each in here]
        else:
            here = _entry(here, key)
    return here


def _entry(table: Any, key: str) -> Any:
    return table.get(key) if isinstance(table, Mapping) else None


def _meets(found: Any, expectation: Expectation) -> bool:
    if not expectation.is_range:
        return isinstance(found, bool) == isinstance(expectation.value, bool) and bool(found == expectation.value)
    low, high = expectation.value
    return _is_number(found) and low <= found <= high


def _end(value: float) -> float:
    """End of a range; whole numbers may be larger than any of a report."""
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
