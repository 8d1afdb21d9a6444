"""The ways of a plan on a page: contours, passes and leads in px, and which way each figure is run."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Floats
from sim.cam.model import CutPlan, FigureCut
from sim.show.draw.flatten import bounds_um, flatten
from sim.show.draw.layout import View
from sim.show.draw.simplify import CHORD_PX, simplify

_LEAST_UM = 100.0


class Heading(NamedTuple):
    """A place (2,) px of a way, and the unit vector (2,) on the page in which it is run there."""

    tip: Floats
    ahead: Floats


def line_px(curves: Curves, view: View) -> Floats:
    """Curves that follow each other as points (k, 2) px; none where there is no curve."""
    if not len(curves):
        return np.empty((0, 2))
    return simplify(view.to_px(flatten(curves, CHORD_PX / view.px_per_um)[0]), CHORD_PX)


def plan_bounds_um(plan: CutPlan) -> Floats:
    """Box around all that is shown, (2, 2), at least 0.1 mm wide."""
    boxes = [bounds_um(one) for cut in plan.cuts for one in _curves(cut) if len(one)]
    places = np.array([cut.thread.place_um for cut in plan.cuts])
    low = np.min([*(box[0] for box in boxes), *places], axis=0)
    high = np.max([*(box[1] for box in boxes), *places], axis=0)
    missing = max(_LEAST_UM - float((high - low).max()), 0.0)
    box: Floats = np.stack([low, high]) + 0.5 * missing * np.array([[-1.0], [1.0]])
    return box


def heading_px(cut: FigureCut, view: View) -> Heading | None:
    """Which way the first pass runs, at the end of its first third; None where it has no length."""
    line = line_px(cut.passes[0].along, view)
    ways = np.diff(line, axis=0)
    lengths = np.hypot(ways[:, 0], ways[:, 1])
    if not lengths.sum():
        return None
    at = int(np.searchsorted(np.cumsum(lengths), lengths.sum() / 3.0))
    share = (lengths.sum() / 3.0 - lengths[:at].sum()) / lengths[at]
    return Heading(line[at] + share * ways[at], ways[at] / lengths[at])


def _curves(cut: FigureCut) -> list[Curves]:
    ways = [one for each in (*cut.passes, *cut.cut_off) for one in (each.into, each.along, each.out)]
    return [cut.figure.contour, *ways]
