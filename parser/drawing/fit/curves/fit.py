"""Pieces of curves to as few arcs as lie within a tolerance of them, proved: `arcs_of_pieces`, the one way in."""

from typing import NamedTuple

import numpy as np

from parser.drawing.fit.curves.bounds import are_within, off_at_most
from parser.drawing.fit.curves.chunks import runs_of
from parser.drawing.fit.curves.even import best_starts, even_arcs
from parser.drawing.fit.curves.longest import STEPS, Arcs, Runs, joined_arcs
from parser.drawing.fit.curves.pieces import Pieces, tamed
from parser.drawing.fit.curves.strings import Strings, places_on, strings_of
from parser.drawing.fit.fitted import Fitted, no_curves
from parser.geometry.curves import Curves, Floats, Ints, curves_between

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
