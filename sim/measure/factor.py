"""How much longer cuts take than predicted, learned from a shop's own: a factor with its interval.

Of each logged cut r is the logarithm of its measured over its predicted time. A shop's own mean μ is N(0, 0.35²) before
anything is known of it (assumed: 40 % is one standard deviation), and its cuts scatter about that by σ, which nobody
knows: ln σ is N(ln 0.12, 0.7²), so that most shops scatter by 4 to 38 % (assumed). Given σ the mean is normal again,

    E(μ) = r̄ · (n/σ²) / (n/σ² + 1/0.35²),   Var(μ) = 1 / (n/σ² + 1/0.35²),

and a new cut is that with σ² more. Over all σ, each weighed by how well it explains the log, this is a mixture of
normals, wider than for any one σ; its quantiles are found by bisection. From 20 cuts on the interval needs no such
model: by split-conformal prediction (H. Papadopoulos et al., Inductive confidence machines, 2002) half of the log says
the middle, and of the other half the deviations from there say how far 90 % lie off.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats

PRIOR_SD: Final = 0.35
"""Of the logarithm of a shop's own factor (assumed)."""
LEVEL: Final = 0.9
UNKNOWN: Final = 0.4
"""Without any cut of a machine: so much shorter or longer, as one standard deviation of the prior is."""
_SPREAD: Final = 0.12
_SPREAD_SD: Final = 0.7
"""Of the scatter of a shop's cuts: its middle, and the standard deviation of its logarithm (assumed)."""
_LEAST_SPLIT: Final = 20
_GRID: Final = np.linspace(math.log(_SPREAD) - 4.0 * _SPREAD_SD, math.log(_SPREAD) + 4.0 * _SPREAD_SD, 81)
_HALVINGS: Final = 50


class Factor(NamedTuple):
    """By how much cuts take longer than predicted: between `least` and `most` at a level, and the middle.

    `from_cuts` says of how many cuts.
    """

    least: float
    middle: float
    most: float
    level: float
    from_cuts: int


class Interval(NamedTuple):
    """A time, and how sure it is that it lies between the least and the most; of one unit."""

    least: float
    middle: float
    most: float
    level: float


def interval_of(predicted: float, factor: Factor) -> Interval:
    """A predicted time with what a factor makes of it."""
    return Interval(factor.least * predicted, factor.middle * predicted, factor.most * predicted, factor.level)


class _Mixture(NamedTuple):
    """What is known of a shop's mean, for each scatter (k,): the weights, means, variances, and the scatters."""

    weight: Floats
    mean: Floats
    variance: Floats
    scatter: Floats


def factor_of(log_ratios: Floats, extra_sd: float = 0.0, shares: Floats | None = None) -> Factor:
    """The factor of a new cut, by the logarithms (n,) of measured over predicted times.

    `extra_sd` is added for what no logged cut was like. Of several cuts together `shares` (m,) are their parts of the
    whole: they have the shop's mean and that in common, and scatter each by itself.
    """
    number = len(log_ratios)
    if not number:
        return Factor(1.0 - UNKNOWN, 1.0, 1.0 + UNKNOWN, _level_of_unknown(), 0)
    known = _known(log_ratios)
    alone = shares is None or len(shares) == 1
    scatter = 1.0 if shares is None else float(np.sqrt((shares**2).sum()))
    sd = np.sqrt(known.variance + (scatter * known.scatter) ** 2 + extra_sd**2)
    middle = _quantile(known, sd, 0.5)
    if number >= _LEAST_SPLIT and alone:
        least, most = _split(log_ratios, extra_sd)
    else:
        least, most = (_quantile(known, sd, 0.5 + side * 0.5 * LEVEL) for side in (-1.0, 1.0))
    return Factor(math.exp(min(least, middle)), math.exp(middle), math.exp(max(most, middle)), LEVEL, number)


def _level_of_unknown() -> float:
    """How likely the prior holds a shop's factor to lie within `UNKNOWN` of 1."""
    low, high = (0.5 * (1.0 + math.erf(math.log(1.0 + side * UNKNOWN) / PRIOR_SD / math.sqrt(2.0))) for side in (-1, 1))
    return round(high - low, 2)


def _known(log_ratios: Floats) -> _Mixture:
    """The posterior of the shop's mean, for each scatter of the grid, weighed by how well that explains the log."""
    number, mean = len(log_ratios), float(log_ratios.mean())
    within = float(((log_ratios - mean) ** 2).sum())
    square, prior = np.exp(2.0 * _GRID), PRIOR_SD**2
    weight = (
        -0.5 * ((_GRID - math.log(_SPREAD)) / _SPREAD_SD) ** 2
        - (number - 1) * _GRID
        - 0.5 * np.log(square + number * prior)
        - 0.5 * within / square
        - 0.5 * number * mean**2 / (square + number * prior)
    )
    weight = np.exp(weight - weight.max())
    variance = 1.0 / (number / square + 1.0 / prior)
    return _Mixture(weight / weight.sum(), variance * number * mean / square, variance, np.exp(_GRID))


def _quantile(known: _Mixture, sd: Floats, share: float) -> float:
    """Where a share of a mixture of normals with deviations (k,) lies below."""
    low, high = float((known.mean - 8.0 * sd).min()), float((known.mean + 8.0 * sd).max())
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = [0.5 * (1.0 + math.erf(each / math.sqrt(2.0))) for each in ((middle - known.mean) / sd).tolist()]
        low, high = (middle, high) if float(known.weight @ np.array(below)) < share else (low, middle)
    return 0.5 * (low + high)


_NORMAL_90: Final = 1.6448536269514722


def _split(log_ratios: Floats, extra_sd: float) -> tuple[float, float]:
    """The interval by split-conformal prediction; between two of the deviations where the rank is no whole number."""
    fitted = _known(log_ratios[::2])
    center = float(fitted.weight @ fitted.mean)
    off = np.sort(np.abs(log_ratios[1::2] - center))
    rank = min(LEVEL * (len(off) + 1.0), float(len(off)))
    reach = float(np.interp(rank, np.arange(1, len(off) + 1), off))
    reach = math.hypot(reach, _NORMAL_90 * extra_sd)
    return center - reach, center + reach
