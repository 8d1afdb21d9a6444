"""The whole way of a card: its stretches, one behind the other, as rows and one plan on the card's clock."""

from typing import Final, NamedTuple, TypeVar

import numpy as np

from controller.card.engine.motion import Driven
from controller.card.way.flat import Motions, Rows, flat
from controller.motion.plan import EMPTY_PLAN, Plan
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between

_NO_WAY_UM: Final = 1e-6
"""X and Y stand on a row that is shorter: it only climbs, or comes from rounding."""
_SAME_UM: Final = 1e-6
_SAME: Final = 1e-9
_MOMENT_S: Final = 1e-12
_Columns = TypeVar("_Columns", Rows, Motions)


class Way(NamedTuple):
    """What X and Y of a card were driven along, in pulses from where they stood when the card was made; one is 1 µm.

    Attributes
    ----------
    curves
        n rows, each from where the one before it ends.
    call, number
        (n,) int64, number of the call that each row came from, from 1, and its number in the list.
    end_s
        (n,) float64, when each row is done, on the card's clock.
    plan
        Motion along them from 0 on the card's clock; a rest is a phase without length.
    """

    curves: Curves
    call: Ints
    number: Ints
    end_s: Floats
    plan: Plan

    def row_of(self, t_s: Floats, number: Ints) -> Ints:
        """Rows (m,) that pulses at times (m,) belong to, which name the `number` (m,) that theirs has in the list.

        The card works out a servo period at a time: a pulse near a border of rows may belong to the one beside.
        """
        last = len(self.call) - 1
        row = np.minimum(np.searchsorted(self.end_s, t_s, side="left"), last)
        for beside in (-1, 1):
            other = np.clip(row + beside, 0, last)
            row = np.where((self.number[row] != number) & (self.number[other] == number), other, row)
        return row


class WayRecorder:
    """Listener of a card (`on_driven`) that keeps what was run of its stretches."""

    def __init__(self) -> None:
        self._rows: list[Rows] = []
        self._motions: list[Motions] = []

    def __call__(self, driven: Driven) -> None:
        """Keep a stretch, as far as it was run."""
        told = flat(driven)
        if told is not None:
            self._rows.append(told[0])
            self._motions.append(told[1])

    def way(self) -> Way:
        """All so far."""
        if not any((rows.length_um > _NO_WAY_UM).any() for rows in self._rows):
            none = np.zeros(0, dtype=np.int64)
            pairs = np.empty((0, 2))
            return Way(curves_between(pairs, pairs, pairs, np.empty(0)), none, none, np.empty(0), EMPTY_PLAN)
        return _way(_joined(self._rows), _joined(self._motions))


def _joined(parts: list[_Columns]) -> _Columns:
    columns = (np.concatenate(column) for column in zip(*parts, strict=True))
    return type(parts[0])._make(columns)


def _way(rows: Rows, motions: Motions) -> Way:
    rows = _picked(rows, np.flatnonzero(rows.length_um > _NO_WAY_UM))
    first = np.flatnonzero(~_goes_on(rows))
    last = np.append(first[1:], len(rows.call)) - 1
    end = rows.end_um[last]
    start = np.concatenate([rows.start_um[first[:1]], end[:-1]])
    sweep = np.add.reduceat(rows.sweep_rad, first)
    curves = curves_between(start, end, rows.center_um[first], sweep)
    return Way(curves, rows.call[first], rows.number[first], rows.end_s[last], _plan(motions))


def _picked(rows: Rows, at: Ints) -> Rows:
    return Rows._make(column[at] for column in rows)


def _goes_on(rows: Rows) -> Bools:
    """Whether each row is the one before it going on: of the same call, on the same line or about the same centre."""
    by = rows.end_um - rows.start_um
    heading = by / np.maximum(np.hypot(*by.T), _NO_WAY_UM)[:, None]
    is_arc = rows.sweep_rad != 0.0
    same = np.zeros(len(rows.call), dtype=np.bool_)
    straight = np.abs(heading[1:] - heading[:-1]).max(axis=1, initial=0.0) < _SAME
    about = np.abs(rows.center_um[1:] - rows.center_um[:-1]).max(axis=1, initial=0.0) < _SAME_UM
    bent = about & (np.sign(rows.sweep_rad[1:]) == np.sign(rows.sweep_rad[:-1]))
    meets = np.abs(rows.start_um[1:] - rows.end_um[:-1]).max(axis=1, initial=0.0) < _SAME_UM
    alike = np.where(is_arc[1:], bent, straight) & (is_arc[1:] == is_arc[:-1])
    same[1:] = (rows.call[1:] == rows.call[:-1]) & meets & alike
    return same


def _plan(motions: Motions) -> Plan:
    """One plan of phases in order, with rests between them and before the first."""
    before = np.concatenate([[0.0], motions.end_s[:-1]])
    gaps = np.flatnonzero(motions.begin_s - before > _MOMENT_S)
    rest = np.zeros(len(gaps))
    way, speed, acceleration, jerk = (
        np.insert(column, gaps, rest)
        for column in (motions.way_um, motions.speed_um_s, motions.acceleration_um_s2, motions.jerk_um_s3)
    )
    begin = np.insert(np.maximum(motions.begin_s, before), gaps, before[gaps])
    time = np.maximum.accumulate(np.append(begin, motions.end_s[-1]))
    return Plan(np.concatenate([[0.0], np.cumsum(way)]), time, speed, acceleration, jerk)
