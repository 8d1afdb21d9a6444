"""Numbers of the report: rounded, and None where there is no such thing."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats

_DIGITS = 6
DEG_DIGITS = 9


def rounded(value: float) -> float:
    """To the report's digits; never −0."""
    return round(value, _DIGITS) + 0.0


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


def points(pairs: NDArray[np.float64]) -> list[list[float] | None]:
    """Rounded pairs; None for NaN."""
    found = (np.round(pairs, _DIGITS) + 0.0).tolist()
    return [None if pair[0] != pair[0] else pair for pair in found]


def rows(columns: dict[str, list[Any]]) -> list[dict[str, Any]]:
    """Columns as a list of entries."""
    names = tuple(columns)
    return [dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)]
