"""Values and places of findings as files of other programs can hold them."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import PurePath
from typing import NamedTuple

from parser.findings.findings import Finding

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
