"""The passes that a program writes out itself, each between its own set-up and cancel."""

from collections.abc import Sequence

import numpy as np

from controller.offset.path import OffsetPath
from parser.geometry.curves import Floats, Ints
from parser.shape.passes import Pass, Passes, with_edges
from sim.check.beside import PassBeside
from sim.check.compensation.rounds import CompensatedRound


def drawn_passes(runs: Sequence[CompensatedRound], rows: int) -> Passes:
    """Passes in the `rows` of the program's own toolpath, which all of them run along the same places."""
    bounds = np.array([one.round.section[:2] for one in runs], dtype=np.int64).reshape(-1, 2)
    return _passes([one._replace(by_um=0.0) for one in runs], bounds, rows)


def path_passes(runs: Sequence[CompensatedRound], path: OffsetPath) -> Passes:
    """Passes in the rows of the compensated path."""
    bounds = np.array([(one.round.section.first, one.round.section.last + 1) for one in runs], dtype=np.int64)
    first, past = np.searchsorted(path.source_row, bounds.reshape(-1, 2)).T
    return _passes(runs, np.stack([first, past - 1], axis=1), len(path.source_row))


def passes_beside(runs: Sequence[CompensatedRound], left_um: Floats) -> tuple[PassBeside, ...]:
    """The passes of each number: the least offset, and the direction of the first of them.

    Where no contour is run along, one pass at the least of the offsets `left_um` (n,) of the blocks.
    """
    found: dict[int, PassBeside] = {}
    for one in runs:
        number = one.along.number
        known = found.setdefault(number, PassBeside(one.by_um, one.along.is_back))
        found[number] = known._replace(by_um=min(known.by_um, one.by_um))
    if not found:
        by_um = np.abs(left_um[left_um != 0.0])
        return (PassBeside(float(by_um.min()) if len(by_um) else 0.0, is_back=False),)
    return tuple(found[number] for number in sorted(found))


def _passes(runs: Sequence[CompensatedRound], bounds: Ints, rows: int) -> Passes:
    """Passes in the rows between `bounds` (k, 2), both included; a pass without a row is none."""
    waste: dict[int, float] = {}
    last: dict[tuple[int, bool], float] = {}
    for one in runs:
        waste.setdefault(one.along.edge, float(np.sign(_aside_um(one))))
        last[one.along.edge, one.along.is_tab] = _aside_um(one)
    of_row = np.full(rows, -1, dtype=np.int64)
    passes: list[Pass] = []
    for one, (low, high) in zip(runs, bounds.tolist(), strict=True):
        edge, number, is_back, is_tab = one.along
        if low <= high:
            of_row[low : high + 1] = len(passes)
            shift_um = (_aside_um(one) - last[edge, is_tab]) * waste[edge]
            closed = one.round.section.closed
            passes.append(Pass(edge, number, low, high, is_back, closed, is_tab, shift_um, -one.side, one.by_um))
    return Passes(with_edges(passes), of_row)


def _aside_um(one: CompensatedRound) -> float:
    """How far to the left of the first pass over its edge the wire runs, along that."""
    return one.by_um * one.side * (-1 if one.along.is_back else 1)
