"""Types of the fields of documents: what a value may be, and the limits that a JSON schema states of it.

A document is a `TypedDict`, so that mypy holds what is written against the model. Lengths are µm, times s, angles
degrees, unless the name of a field says otherwise.
"""

from typing import Annotated, Any, Literal, NamedTuple, TypedDict


class Limits(NamedTuple):
    """Limits of a value, as pairs of a keyword of JSON Schema and its value."""

    keywords: tuple[tuple[str, Any], ...]


def between(least: float | None, most: float | None) -> Limits:
    """Numbers from `least` to `most`, both allowed; None where there is no limit."""
    return _limits(minimum=least, maximum=most)


def matching(pattern: str) -> Limits:
    """Texts in which a regular expression (ECMA-262) is found."""
    return _limits(pattern=pattern)


def of_length(least: int, most: int | None = None) -> Limits:
    """Lists of so many items."""
    return _limits(minItems=least, maxItems=most)


def one_of(*names: str) -> Limits:
    """Texts that are one of some names."""
    return _limits(enum=names)


def _limits(**keywords: Any) -> Limits:
    return Limits(tuple((name, value) for name, value in keywords.items() if value is not None))


Text = Annotated[str, _limits(minLength=1)]
"""A text that is not empty."""
Slug = Annotated[str, matching("^[a-z][a-z-]*$")]
"""A name of ours, in lower case with hyphens."""
Version = Annotated[str, matching(r"^[0-9]+\.[0-9]+\.[0-9]+")]
Code = Annotated[str, matching("^(3B[1-6]|[A-Z]{2,8}[1-9])[0-9]{2}$")]
"""Code of a finding: of drycut, or of a check of a shop's own."""
Ordinal = Annotated[int, between(1, None)]
"""Number of something that is counted from 1: block, line, column, contour."""
Count = Annotated[int, between(0, None)]
Size = Annotated[float, between(0, None)]
"""A number that is not negative."""
Positive = Annotated[float, _limits(exclusiveMinimum=0)]
Point = Annotated[list[float], of_length(2, 2)]
"""Coordinates x, y."""
StepPoint = Annotated[list[int], of_length(2, 2)]
"""Coordinates x, y in whole steps of 1 µm."""
BlockRange = Annotated[list[Ordinal], of_length(2, 2)]
"""First and last block."""
Ring = Annotated[list[Point], of_length(3)]
"""Corners of a closed polygon."""
Encoding = Annotated[str, one_of("utf-8", "utf-8-sig", "utf-16-le", "utf-16-be", "gb18030", "big5", "latin-1")]
"""Encoding of a program file."""
DIALECT = r"3B|4B|3B\+4B|PMAC|[a-z0-9][a-z0-9_-]*"
"""Names of dialects: in small letters those of ISO, profiles and a shop's own."""
DialectName = Annotated[str, matching(f"^(?:{DIALECT})$")]
"""Dialect of a program, of ISO the profile that it was read by, or a dialect of a shop's own."""
AxisName = Annotated[str, one_of("X", "Y")]
CurveName = Annotated[str, one_of("line", "arc", "jump")]
Sense = Annotated[str, one_of("ccw", "cw")]
SeverityName = Annotated[str, one_of("error", "warning", "note")]
Judgement = Literal["pass", "fail"]
CheckVerdict = Annotated[str, one_of("pass", "fail", "incomplete")]
CheckProgress = Annotated[str, one_of("complete", "incomplete", "not asked")]


class AssumptionEntry(TypedDict):
    """What a program's text leaves open: what it is, what it was taken for, and why."""

    what: Slug
    taken: Text
    why: Text


class BlockCountsEntry(TypedDict):
    """How many blocks were found, read, decoded and stepped."""

    found: Count
    read: Count
    decoded: Count
    stepped: Count


class SaidEntry(TypedDict):
    """A text in both languages."""

    en: str
    zh: str
