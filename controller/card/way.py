"""The way that a card drove X and Y along while a program used it: a `Way`.

The whole way of a card: its stretches, one behind the other, as rows and one plan on the card's clock.

One stretch as X and Y see it: the rows that were run, as lines and arcs in the plane, and phases of motion.

The plan of a stretch goes along a path in four axes. Of a line that climbs, X and Y see a share, the same all along it;
of an arc in X and Y all. Of an arc in another plane they see a line, run with a share that changes: it is cut into
short ones.
"""

import math
from typing import Final, NamedTuple, TypeVar

import numpy as np

from controller.card.engine.motion import Driven
from controller.motion.limits import Path
from controller.motion.plan import EMPTY_PLAN, Plan
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between

_UPRIGHT_RAD: Final = math.radians(1.0)
"""Longest piece of an arc in another plane: its share changes by 1.7 % of the radius' speed at most."""
_LEVEL: Final = 1e-9
"""Direction cosines below this are rounding."""


class Rows(NamedTuple):
    """n pieces in X and Y, one behind the other.

    Attributes
    ----------
    start_um, end_um, center_um
        (n, 2) float64; centres NaN on lines.
    sweep_rad
        (n,) float64, positive counter-clockwise; 0 on lines.
    length_um
        (n,) float64, in X and Y.
    end_s
        (n,) float64, when each is done, on the card's clock.
    call, number
        (n,) int64, the call that each came from, and its number in the list.
    """

    start_um: Floats
    end_um: Floats
    center_um: Floats
    sweep_rad: Floats
    length_um: Floats
    end_s: Floats
    call: Ints
    number: Ints


class Motions(NamedTuple):
    """m phases, all (m,) float64: begin and end on the clock, way in X and Y, speed and acceleration at first, jerk."""

    begin_s: Floats
    end_s: Floats
    way_um: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats
    jerk_um_s3: Floats


def flat(driven: Driven) -> tuple[Rows, Motions] | None:
    """Rows and phases of what was run of a stretch; None where it ran nothing."""
    stretch, clock_s = driven.stretch, driven.stretch.start.clock_s
    ran_um = stretch.along(driven.until_s) if stretch.rows else 0.0
    count = int(np.searchsorted(stretch.path.before_um[:-1], ran_um, side="left"))
    if not count:
        return None
    row, since, until = _pieces(stretch.path, count, ran_um)
    rows = _rows(stretch.path, row, since, until)
    done_s = stretch.plan.time_at(stretch.path.before_um[row] + until)
    whole = until - since
    share = np.divide(rows.length_um, whole, out=np.zeros_like(whole), where=whole > 0.0)
    motions = _motions(stretch.plan, driven.until_s - clock_s, done_s, share)
    calls = np.array([getattr(entry, "call", 0) for entry in stretch.rows], dtype=np.int64)
    flat_rows = rows._replace(end_s=done_s + clock_s, call=calls[row], number=stretch.numbers.astype(np.int64)[row])
    return flat_rows, motions._replace(begin_s=motions.begin_s + clock_s, end_s=motions.end_s + clock_s)


def _pieces(path: Path, count: int, ran_um: float) -> tuple[Ints, Floats, Floats]:
    """Row, begin and end (n,) on it, of the pieces of the first `count` rows."""
    ran = np.minimum(path.length_um[:count], ran_um - path.before_um[:count])
    aside = np.hypot(path.tangent[:count, 2:], path.normal[:count, 2:]).max(axis=1, initial=0.0)
    turn = np.where(aside > _LEVEL, path.curvature[:count] * ran, 0.0)
    parts = np.maximum(np.ceil(turn / _UPRIGHT_RAD), 1.0).astype(np.int64)
    row = np.repeat(np.arange(count), parts)
    part = np.arange(len(row)) - np.repeat(np.cumsum(parts) - parts, parts)
    return row, ran[row] * (part / parts[row]), ran[row] * ((part + 1) / parts[row])


def _rows(path: Path, row: Ints, since: Floats, until: Floats) -> Rows:
    start, end = path.place(row, since)[:, :2], path.place(row, until)[:, :2]
    tangent, normal = path.tangent[row, :2], path.normal[row, :2]
    across = tangent[:, 0] * normal[:, 1] - tangent[:, 1] * normal[:, 0]
    is_arc = (path.curvature[row] > 0.0) & (np.abs(across) > 1.0 - _LEVEL)
    radius = np.divide(1.0, path.curvature[row], out=np.zeros(len(row)), where=is_arc)
    center = np.where(is_arc[:, None], path.start_um[row, :2] + normal * radius[:, None], np.nan)
    sweep = np.where(is_arc, np.sign(across) * path.curvature[row] * (until - since), 0.0)
    length = np.where(is_arc, until - since, np.hypot(*(end - start).T))
    none = np.zeros(len(row), dtype=np.int64)
    return Rows(start, end, center, sweep, length, np.zeros(len(row)), none, none)


def _motions(plan: Plan, until_s: float, done_s: Floats, share: Floats) -> Motions:
    """Phases of a plan up to a time, cut where pieces with another share begin; times from the start of the plan."""
    last = min(until_s, plan.duration_s)
    borders = np.concatenate([[0.0, last], plan.time_s, done_s])
    borders = np.unique(borders[(borders >= 0.0) & (borders <= last)])
    begin, end = borders[:-1], borders[1:]
    middle = 0.5 * (begin + end)
    phase = np.clip(np.searchsorted(plan.time_s, middle, side="right") - 1, 0, len(plan.speed_um_s) - 1)
    of = share[np.minimum(np.searchsorted(done_s, middle, side="left"), len(share) - 1)]
    dt = begin - plan.time_s[phase]
    speed, acceleration, jerk = plan.speed_um_s[phase], plan.acceleration_um_s2[phase], plan.jerk_um_s3[phase]
    way = np.diff(plan.at(borders).along_um)
    return Motions(
        begin,
        end,
        way * of,
        np.maximum(speed + dt * (acceleration + dt * jerk / 2.0), 0.0) * of,
        (acceleration + dt * jerk) * of,
        jerk * of,
    )


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
        for step in (-1, 1):
            other = np.clip(row + step, 0, last)
            row = np.where((self.number[row] != number) & (self.number[other] == number), other, row)
        return row


class WayRecorder:
    """Listener of a card (`on_driven`) that keeps what was run of its stretches."""

    def __init__(self) -> None:
        self._rows: list[Rows] = []
        self._motions: list[Motions] = []

    def __call__(self, driven: Driven) -> None:
        """Keep a stretch, as far as it was run."""
        rows = flat(driven)
        if rows is not None:
            self._rows.append(rows[0])
            self._motions.append(rows[1])

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
