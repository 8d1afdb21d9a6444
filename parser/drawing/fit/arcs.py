"""Pieces of curves to as few arcs as lie within a tolerance of them, proved: `arcs_of_pieces`, the one way in.

Runs along strings: whole strings, the long ones cut, so that all runs together take few steps.

As few arcs as can be along strings, each as full as the others: the best start, and the least tolerance for it.
"""

from typing import NamedTuple

import numpy as np

from parser.drawing.fit.bounds import are_within, off_at_most
from parser.drawing.fit.pieces import FLATTEST_UM, Fitted, Pieces, no_curves, tamed
from parser.drawing.fit.strings import STEPS, Arcs, Runs, Strings, joined_arcs, longest_arcs, places_on, strings_of
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, total_before

_MOST_STARTS = 24
_STARTS_AT_ONCE = 1_000  # over all closed curves of a drawing: many have few starts each
_ROUNDS = 3
_FULL = 0.9  # of the length of an arc
_TAIL = 4  # arcs
_LEAST = 1e-3  # of the tolerance: what lies nearer needs no less


def best_starts(strings: Strings, runs: Runs, closed: Bools, tolerance_um: Floats) -> Runs:
    """The runs, those that are closed begun where the arcs are fewest, and of these where the last one is shortest."""
    at = np.flatnonzero(closed)
    number = min(_STARTS_AT_ONCE // max(len(at), 1), _MOST_STARTS)
    if not len(at) or number < 2:
        return runs
    of = np.repeat(at, number)
    length = (runs.high - runs.low)[of]
    low = runs.low[of] + length * np.tile(np.arange(number) / number, len(at))
    tried = Runs(low, low + length, runs.first[of], runs.last[of])
    arcs = longest_arcs(strings, tried, tolerance_um[of])
    count, last = _counts(arcs, len(of))
    order = np.lexsort((last / length, count, of))
    best = order[np.searchsorted(of, at)]
    low, high = runs.low.copy(), runs.high.copy()
    low[at], high[at] = tried.low[best], tried.high[best]
    return runs._replace(low=low, high=high)


def even_arcs(strings: Strings, runs: Runs, tolerance_um: Floats, steps: int = STEPS) -> Arcs:
    """Arcs as few as a tolerance (r,) allows, of about the least tolerance that needs no more of them.

    About vertices a little less may take one arc more: there the last arcs alone share what the very last one lacks.
    """
    best = _evened(strings, runs, tolerance_um, longest_arcs(strings, runs, tolerance_um, steps=steps), steps)
    count, _ = _counts(best, len(runs.low))
    rows = np.flatnonzero((_filled(best, count) < 1.0) & (count > _TAIL))
    if not len(rows):
        return best
    last = np.cumsum(count)
    tail = np.isin(best.run, rows) & (last[best.run] - np.arange(len(best.run)) <= _TAIL)
    own = best.picked(tail)
    ends = runs.picked(rows)._replace(low=best.start[last[rows] - _TAIL])
    better = _evened(strings, ends, tolerance_um[rows], own._replace(run=np.searchsorted(rows, own.run)), steps)
    return joined_arcs([best.picked(~tail), better._replace(run=rows[better.run])])


def _evened(strings: Strings, runs: Runs, tolerance_um: Floats, best: Arcs, steps: int) -> Arcs:
    """Arcs of a lower tolerance, no more of them than the `best` so far.

    The length of an arc goes with the cube root of its tolerance: so all arcs are made shorter by what the last one
    lacks, and where that was too much, by half of it.
    """
    count, _ = _counts(best, len(runs.low))
    low, high = (count - 1) / np.maximum(count, 1), np.ones(len(count))
    share = high * _filled(best, count)
    for _ in range(_ROUNDS):
        todo = np.flatnonzero(share < high)
        if not len(todo):
            break
        found = longest_arcs(strings, runs.picked(todo), (tolerance_um * share**3)[todo], _of_runs(best, todo), steps)
        enough = _counts(found, len(todo))[0] <= count[todo]
        low[todo], high[todo] = np.where(enough, low[todo], share[todo]), np.where(enough, share[todo], high[todo])
        better = found.picked(enough[found.run])
        best = _merged(best, better._replace(run=todo[better.run]), np.isin(np.arange(len(count)), todo[enough]))
        count, _ = _counts(best, len(count))
        next_share = high * _filled(best, count)
        share = np.where(next_share < high, np.maximum(next_share, 0.5 * (low + high)), high)
    return best


def _filled(arcs: Arcs, count: Ints) -> Floats:
    """By what all arcs (r,) are longer than they would be if the last one were as full; 1 where that is little."""
    last = arcs.spare[np.cumsum(count) - 1]
    full = np.cbrt(np.clip(1.0 - last, _LEAST, 1.0))
    return np.where(full < _FULL, (count - 1 + full) / count, 1.0)


def _of_runs(arcs: Arcs, which: Ints) -> Arcs:
    """The arcs of some runs, by their number among these."""
    some = arcs.picked(np.isin(arcs.run, which))
    return some._replace(run=np.searchsorted(which, some.run))


def _counts(arcs: Arcs, runs: int) -> tuple[Ints, Floats]:
    """How many arcs each run has, and how long its last one is."""
    count = np.bincount(arcs.run, minlength=runs)
    last = np.cumsum(count) - 1
    return count, (arcs.end - arcs.start)[last]


def _merged(arcs: Arcs, better: Arcs, is_better: Bools) -> Arcs:
    parts = arcs.picked(~is_better[arcs.run]), better.picked(is_better[better.run])
    return joined_arcs(parts)


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
    first = (slope[:, :2] - w1 * place) / w
    two = (second[:, :2] - 2.0 * w1 * first - w2 * place) / w
    bend: Floats = (first[:, 0] * two[:, 1] - first[:, 1] * two[:, 0]) / np.hypot(first[:, 0], first[:, 1]) ** 3
    return bend


_SEARCHED = 0.997  # of the tolerance: the search looks at places, and the farthest may lie between two
_STRICTER = ((1.0, STEPS), (1.0, 3 * STEPS), (0.98, 3 * STEPS), (0.9, 6 * STEPS))
"""Of that, and in how many steps: for runs whose bound turned out too large."""
_MOST_HALVINGS = 48


class Drawn(NamedTuple):
    """Where curves (k,) are: the origins (k, 2) of their pieces, and their exact ends (k, 2, 2)."""

    origin_um: Floats
    ends_um: Floats


def arcs_of_pieces(pieces: Pieces, drawn: Drawn, tolerance_um: float) -> Fitted:
    """Lines and arcs for curves given by their pieces, within a tolerance of them.

    Raises ValueError where a curve is torn or needs pieces without number.
    """
    with np.errstate(all="ignore"):
        tame = tamed(pieces, tolerance_um)
        if not len(tame.of):
            return Fitted(no_curves(), tame.of, 0.0)
        strings = strings_of(tame)
        runs, string = runs_of(strings, tolerance_um)
        whole = np.bincount(string)[string] == 1
        runs = best_starts(strings, runs, strings.is_closed[string] & whole, np.full(len(string), tolerance_um))
        arcs, bound = _proved_arcs(strings, runs, tolerance_um)
        covered = _Covered(strings, runs, string, arcs)
        return Fitted(*_curves_of(covered, drawn), bound)


def _proved_arcs(strings: Strings, runs: Runs, tolerance_um: float) -> tuple[Arcs, float]:
    """Arcs that cover the runs, and the largest of their bounds; lines where no arcs were found that can be proved."""
    left = np.arange(len(runs.low))
    done: list[Arcs] = []
    most = 0.0
    for share, steps in _STRICTER:
        some = runs.picked(left)
        arcs = even_arcs(strings, some, np.full(len(left), _SEARCHED * share * tolerance_um), steps)
        bound = off_at_most(strings, some, arcs, tolerance_um)
        fails = np.bincount(arcs.run, weights=~are_within(bound, tolerance_um)) > 0
        fine = ~fails[arcs.run]
        most = max(most, float(bound[fine].max(initial=0.0)))
        done.append(arcs._replace(run=left[arcs.run]).picked(fine))
        left = left[fails]
        if not len(left):
            break
    else:
        lines, most_of_lines = _lines(strings, runs, left, tolerance_um)
        done.append(lines)
        most = max(most, most_of_lines)
    return joined_arcs(done), most


def _lines(strings: Strings, runs: Runs, which: Ints, tolerance_um: float) -> tuple[Arcs, float]:
    """Lines that cover some runs, halved until each is proved."""
    todo = Arcs(which, runs.low[which], runs.high[which], *np.zeros((2, len(which))))
    done: list[Arcs] = []
    most = 0.0
    for _ in range(_MOST_HALVINGS):
        bound = off_at_most(strings, runs, todo, tolerance_um)
        fine = are_within(bound, tolerance_um)
        most = max(most, float(bound[fine].max(initial=0.0)))
        done.append(todo.picked(fine))
        todo = todo.picked(~fine)
        if not len(todo.run):
            return joined_arcs(done), most
        middle = 0.5 * (todo.start + todo.end)
        todo = joined_arcs([todo._replace(end=middle), todo._replace(start=middle)])
    raise ValueError("a curve that no lines come near")


class _Covered(NamedTuple):
    """Strings, the runs along them, the string (r,) of each run, and the arcs that cover the runs."""

    strings: Strings
    runs: Runs
    string: Ints
    arcs: Arcs


def _curves_of(covered: _Covered, drawn: Drawn) -> tuple[Curves, Ints]:
    """The arcs as curves, and the curve that each is of: where one ends, the next starts."""
    strings, runs, string, arcs = covered
    of = strings.of[string[arcs.run]]
    place = places_on(strings, np.stack([arcs.start, arcs.end], axis=1), runs.first[arcs.run], runs.last[arcs.run])
    start, end = place[:, 0] + drawn.origin_um[of], place[:, 1] + drawn.origin_um[of]
    goes_on = of[1:] == of[:-1]
    first, last = np.flatnonzero(np.append(True, ~goes_on)), np.flatnonzero(np.append(~goes_on, True))
    closes = strings.is_closed[string[arcs.run[first]]]
    start[first] = np.where(closes[:, None], start[first], drawn.ends_um[of[first], 0])
    end[:-1][goes_on] = start[1:][goes_on]
    end[last] = np.where(closes[:, None], start[first], drawn.ends_um[of[last], 1])
    return _curves(start, end, arcs.bend), of


def _curves(start_um: Floats, end_um: Floats, bend: Floats) -> Curves:
    by = end_um - start_um
    left = np.column_stack([-by[:, 1], by[:, 0]]) / np.hypot(by[:, 0], by[:, 1])[:, None]
    height = 1.0 / bend
    center = 0.5 * (start_um + end_um) + left * height[:, None]
    # A centre to the left of the chord is that of a minor arc run counter-clockwise.
    sweep = 2.0 * np.arctan(0.5 * np.hypot(by[:, 0], by[:, 1]) * bend)
    return curves_between(start_um, end_um, center, np.where(bend != 0.0, sweep, 0.0))
