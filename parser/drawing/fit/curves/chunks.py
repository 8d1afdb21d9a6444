"""Runs along strings: whole strings, the long ones cut, so that all runs together take few steps."""

import numpy as np

from parser.drawing.fit.curves.longest import Runs
from parser.drawing.fit.curves.strings import Strings
from parser.drawing.fit.fitted import FLATTEST_UM
from parser.geometry.curves import Floats, Ints, total_before

_MOST_ARCS_A_RUN = 96.0
_ARCS_A_RUN = 40.0  # of a string that is cut: a cut costs half an arc
_OF_ARC = 124.7
"""The length of an arc between nodes on a curve is (124.7 t / κ')^⅓: its deviation is a cubic with three zeros, of
which the largest value is √3/216 · κ'·L³."""
_MOST_ARCS = 300_000


def runs_of(strings: Strings, tolerance_um: float) -> tuple[Runs, Ints]:
    """The runs of strings, and the string (r,) of each. ValueError where they need arcs without number."""
    low, high = (strings.along[at * _steps(strings)] for at in (strings.first, _ends(strings)))
    needed = total_before(_arcs_needed(strings, tolerance_um))
    before = needed[strings.first * _steps(strings)]
    number = needed[_ends(strings) * _steps(strings)] - before
    if number.sum() > _MOST_ARCS:
        raise ValueError("arcs without number")
    parts = np.where(number <= _MOST_ARCS_A_RUN, 1, np.ceil(number / _ARCS_A_RUN)).astype(np.int64)
    of = np.repeat(np.arange(len(parts)), parts)
    at = np.arange(len(of)) - (np.cumsum(parts) - parts)[of]
    start, end = (_at_share(strings, needed, before[of] + number[of] * (at + more) / parts[of]) for more in (0, 1))
    start, end = np.where(at == 0, low[of], start), np.where(at + 1 == parts[of], high[of], end)
    return Runs(start, end, strings.first[of], strings.last[of]), of


def _steps(strings: Strings) -> int:
    return (len(strings.along) - 1) // len(strings.control)


def _ends(strings: Strings) -> Ints:
    """The piece before which a string has been run once."""
    return strings.first + (strings.last - strings.first) // np.where(strings.is_closed, 2, 1)


def _at_share(strings: Strings, needed: Floats, wanted: Floats) -> Floats:
    return np.interp(wanted, needed, strings.along)


def _arcs_needed(strings: Strings, tolerance_um: float) -> Floats:
    """How many arcs each step of the table of lengths takes, near enough.

    ∫ (κ' / 124.7 t)^⅓ ds of arcs; ∫ √(κ / 8t) ds of lines, where arcs would be too flat.
    """
    steps = _steps(strings)
    share = np.tile((np.arange(steps) + 0.5) / steps, len(strings.control))
    bend = _curvature(strings, np.repeat(np.arange(len(strings.control)), steps), share)
    step = np.diff(strings.along)
    change = np.abs(np.diff(bend, append=bend[-1:]))
    arcs = np.cbrt(change * step**2 / (_OF_ARC * tolerance_um))
    lines = step * np.sqrt(np.abs(bend) / (8.0 * tolerance_um))
    needed = np.where(np.abs(bend) * FLATTEST_UM < 1.0, np.minimum(lines, 1e9), arcs)
    tiny = step / (0.1 * tolerance_um)  # no arc is shorter
    return np.minimum(np.where(np.isfinite(needed), needed, 0.0), tiny)


def _curvature(strings: Strings, piece: Ints, share: Floats) -> Floats:
    """Curvature (m,) in 1/µm at shares of pieces: (x'y'' − y'x'') / |P'|³, of P = X / w."""
    value, slope, second = (np.zeros((len(piece), 3)) for _ in range(3))
    for factors in strings.power[::-1]:
        second = second * share[:, None] + 2.0 * slope
        slope = slope * share[:, None] + value
        value = value * share[:, None] + factors[piece]
    w, w1, w2 = (part[:, 2:] for part in (value, slope, second))
    place = value[:, :2] / w
    one = (slope[:, :2] - w1 * place) / w
    two = (second[:, :2] - 2.0 * w1 * one - w2 * place) / w
    bend: Floats = (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / np.hypot(one[:, 0], one[:, 1]) ** 3
    return bend
