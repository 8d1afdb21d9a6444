"""What a program says that is to be cut, before any offset: counts of its blocks, length, box, first and last place."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import CurveKind, extents
from parser.toolpath import Point, Toolpath


class Programmed(NamedTuple):
    """What a program runs as it is written, in the order in which it runs: subprograms as often as they are called.

    Attributes
    ----------
    lines, arcs, rapids
        Blocks of each kind; a new place of the wire, threaded by hand, is no rapid.
    cut_length_um
        Length of lines and arcs, leads included, rapids not.
    box_um
        Lowest X and Y and highest X and Y of lines and arcs; None where nothing is cut.
    first_um, last_um
        Where the path begins and ends; None where there is none.
    """

    lines: int = 0
    arcs: int = 0
    rapids: int = 0
    cut_length_um: float = 0.0
    box_um: tuple[float, float, float, float] | None = None
    first_um: Point | None = None
    last_um: Point | None = None


def programmed_of(toolpath: Toolpath, threadings: int = 0) -> Programmed:
    """What a toolpath runs, of which some jumps are threadings."""
    if not len(toolpath):
        return Programmed()
    cut = ~toolpath.is_jump
    return Programmed(
        lines=int((toolpath.kind == CurveKind.LINE).sum()),
        arcs=int((toolpath.kind == CurveKind.ARC).sum()),
        rapids=int(toolpath.is_jump.sum()) - threadings,
        cut_length_um=float(toolpath.length_um[cut].sum()),
        box_um=_box(toolpath) if cut.any() else None,
        first_um=Point(*toolpath.start_um[0].tolist()),
        last_um=Point(*toolpath.end_um[-1].tolist()),
    )


def _box(toolpath: Toolpath) -> tuple[float, float, float, float]:
    low, high = extents(toolpath.picked(~toolpath.is_jump))
    x0, y0, x1, y1 = np.concatenate([low.min(axis=0), high.max(axis=0)]).tolist()
    return x0, y0, x1, y1
