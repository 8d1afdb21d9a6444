"""How near arcs are fitted to what is drawn, so that the written path keeps its tolerance with few of them."""

import numpy as np

from parser.drawing.model import Drawing
from parser.findings.errors import SettingsError
from parser.program import Program
from sim.cam.model import CutPlan
from sim.cam.proof.as_run import least_um
from sim.cam.proof.target import target_of
from sim.measure.compare.compared_program import compare_program
from sim.measure.compare.result import Asked

_STEP = 0.03  # of the tolerance, by which each fit is nearer than the one before it
_MOST_STEPS = 6
_MOST_CURVES = 500
"""Of all fits in steps together: of so many arcs some one is always rounded to its wrong side."""
_ROUNDING_UM = 0.5
"""What whole µm add at most: 0.49 µm, written as 3B over an ellipse of 40 × 20 mm fitted within 0.5 … 5 µm."""
_LEAST_SHARE = 0.5
"""Of the tolerance: with less of it, a fit takes ever more arcs, each of them rounded."""


def fits_um(tolerance_um: float, curves: int) -> tuple[float, ...]:
    """How far arcs may lie off what is drawn, the first fit to be tried first, where the path may by a tolerance.

    `curves` says how many the first fit has. Other arcs are rounded otherwise, mostly by less than the last fit allows
    for: so as few of them as of the whole tolerance often do.
    """
    steps = min(_MOST_STEPS, _MOST_CURVES // max(curves, 1) - 1)
    surely_um = max(tolerance_um - _ROUNDING_UM, _LEAST_SHARE * tolerance_um)
    nearer = (round(tolerance_um * (1.0 - _STEP * step), 6) for step in range(1, steps + 1))
    return (tolerance_um, *(one for one in nearer if one > surely_um), surely_um)


def path_off_um(program: Program, plan: CutPlan, drawn: Drawing, reach_um: float) -> float | None:
    """How far a written path lies at most from where the drawing wants it, both ways, gaps aside.

    None where figures end at different offsets, or where it cannot be worked out.
    """
    edge_um = {least_um(cut.figure, plan.making, reach_um) for cut in plan.cuts}
    target, _ = target_of(drawn, plan)
    if target is None or len(edge_um) != 1:
        return None
    try:
        asked = Asked(plan.making.tolerance_um, fitted=False)
        found = compare_program(program.toolpath, edge_um.pop(), target.drawing, asked)
    except SettingsError:
        return None
    return max(found.max_um - target.gap_um, 0.0) if np.isfinite(found.max_um) else None
