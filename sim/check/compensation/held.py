"""The compensated path held against the contours that it runs along."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from controller.offset.closest import approaches
from controller.offset.gouges import TOLERANCE_UM
from controller.offset.path import OffsetPath
from parser.geometry.curves import Bools, Curves, Ints, joined
from sim.check.beside import Beside, beside_round, rows_beside
from sim.check.compensation.rounds import CompensatedRound, contour_of


class Held(NamedTuple):
    """A stretch held against its contour: what it is, the contour, and what became of it."""

    run: CompensatedRound
    contour: Curves
    beside: Beside


def held(curves: Curves, path: OffsetPath, rounds: Sequence[CompensatedRound]) -> tuple[Held, ...]:
    """The stretches of a program's `curves` held against their contours.

    Most leave nothing and gouge nothing. A path that comes to every block, and too near to none, goes through every
    part of what the wire can reach: there is one closed path, and nothing to be worked out.
    """
    contours = [contour_of(curves, one.round.section) for one in rounds]
    is_near = _come_near(path, rounds, contours)
    found = []
    for one, contour, near in zip(rounds, contours, is_near.tolist(), strict=True):
        section = one.round.section
        counted = one.is_nearest and section.closed
        low, high = np.searchsorted(path.vanished, (section.first, section.last + 1))
        if near or low < high:
            beside = beside_round(contour, path, one.round, one.distances, counted=counted)
        else:
            beside = Beside(np.zeros(0), (), 1 if counted else None)
        found.append(Held(one, contour, beside))
    return tuple(found)


def _come_near(path: OffsetPath, rounds: Sequence[CompensatedRound], contours: Sequence[Curves]) -> Bools:
    """(k,) whether the path along a round comes nearer to its contour than it may."""
    is_near = np.zeros(len(rounds), dtype=np.bool_)
    if not rounds:
        return is_near
    rows = [rows_beside(path, one.round) for one in rounds]
    own, other = _numbered(rows), _numbered([np.arange(len(contour)) for contour in contours])
    below_um = np.array([one.kerf_um for one in rounds]) - TOLERANCE_UM
    close = approaches(joined(contours), path.curves.picked(np.concatenate(rows)), float(below_um.max()))
    of = own[close.path_row]
    is_near[of[(of == other[close.row]) & (close.distance_um < below_um[of])]] = True
    return is_near


def _numbered(parts: Sequence[Ints]) -> Ints:
    """Of the members of all parts, one behind the other, the number of the part of each."""
    return np.repeat(np.arange(len(parts)), [len(part) for part in parts])
