"""Numbers of the report: rounded, and None where there is no such thing."""

from collections.abc import Iterable
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats

Entry = TypeVar("Entry")
_DIGITS = 6
DEG_DIGITS = 9


def rounded(value: float) -> float:
    """To the report's digits; never −0."""
    return round(float(value), _DIGITS) + 0.0


def moment(t_s: float, ran_s: float) -> float:
    """Time of what happened in a run of `ran_s`; what the table does while it comes to rest counts at the last step."""
    return rounded(min(t_s, ran_s))


def known(value: float | None) -> float | None:
    """Rounded, or None."""
    return None if value is None else rounded(value)


def column(values: Floats, digits: int = _DIGITS) -> list[float | None]:
    """Rounded numbers; None for NaN."""
    found = (np.round(values, digits) + 0.0).tolist()
    return [None if value != value else value for value in found]  # noqa: PLR0124 - NaN


def place(of: Iterable[float]) -> list[float]:
    """Rounded coordinates."""
    return [rounded(along) for along in of]


def corners(pairs: NDArray[np.float64]) -> list[list[float]]:
    """Rounded pairs, none of them NaN."""
    found: list[list[float]] = (np.round(pairs, _DIGITS) + 0.0).tolist()
    return found


def numbers(values: Floats, digits: int = _DIGITS) -> list[float]:
    """Rounded numbers, none of them NaN."""
    found: list[float] = (np.round(values, digits) + 0.0).tolist()
    return found


def points(pairs: NDArray[np.float64]) -> list[list[float] | None]:
    """Rounded pairs; None for NaN."""
    found = (np.round(pairs, _DIGITS) + 0.0).tolist()
    return [None if pair[0] != pair[0] else pair for pair in found]


def rows(model: type[Entry], columns: dict[str, list[Any]]) -> list[Entry]:
    """Columns as a list of entries of a model, a `TypedDict`; mypy does not look into columns."""
    names = tuple(columns)
    return cast("list[Entry]", [dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)])
