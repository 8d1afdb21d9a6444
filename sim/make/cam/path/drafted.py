"""A plan to a draft: figure after figure, with a jump and a pause between, and a pause before a tab."""

from collections.abc import Sequence

import numpy as np

from parser.geometry.curves import CurveKind, Curves, curves_between, joined
from parser.toolpath import Stop
from parser.write.draft import Draft
from sim.make.cam.model import CutPlan, FigureCut


def draft_of_plan(plan: CutPlan) -> Draft:
    """The draft of a plan, its offsets worked into the path."""
    return draft_of_cuts(plan.cuts)


def draft_of_cuts(cuts: Sequence[FigureCut]) -> Draft:
    """The draft of figures that are cut one behind the other."""
    parts: list[Curves] = []
    stops: list[Stop] = []
    rows = 0
    for at, cut in enumerate(cuts):
        if at:
            jump = _jump(cuts[at - 1], cut)
            stops.append(Stop("pause", rows, 0))
            parts.append(jump)
            rows += len(jump)
        for one in (*cut.passes, *cut.cut_off):
            if cut.cut_off and one is cut.cut_off[0]:
                stops.append(Stop("pause", rows, 0))
            parts += [one.into, one.along, one.out]
            rows += len(one.into) + len(one.along) + len(one.out)
    stops.append(Stop("end", rows, 0))
    nowhere = np.full((rows, 2), np.nan)
    return Draft(joined(parts), tuple(stops), np.zeros(rows, dtype=np.bool_), nowhere, is_meant=True)


def _jump(before: FigureCut, behind: FigureCut) -> Curves:
    start, end = (np.array([one.thread.place_um]) for one in (before, behind))
    line = curves_between(start, end, np.full((1, 2), np.nan), np.zeros(1))
    line.kind[:] = CurveKind.JUMP
    return line
