"""What falls, and when: of each figure its slug or its part, at the end of its own cut, and nothing besides."""

from collections.abc import Iterator

import numpy as np
import shapely

from parser.geometry.along import places
from parser.geometry.curves import Bools
from parser.shape.contours import runs
from parser.toolpath import Point, Toolpath
from sim.cut.pieces.pieces import Piece, Pieces
from sim.make.cam.model import CutPlan
from sim.make.cam.order.sides import with_sides
from sim.make.cam.proof.result import Fault
from sim.make.cam.proof.target import Target

_CRUMB_UM2 = 2000.0
"""Of less than 0.001 mm² nothing is told when it falls (`sim.cut.pieces`); twice that has fallen."""


def side_faults(plan: CutPlan, target: Target, toolpath: Toolpath) -> Iterator[Fault]:
    """Figures of which the wire runs on the other side than is asked for, by how the contours lie in each other.

    More than half of the path to a figure and round it lies within the contour of the drawing, or outside of it.
    """
    wanted, of_run = _within(plan, target), runs(toolpath)
    for loop, at in enumerate(target.cut.tolist()):
        first, past = of_run[at].tolist()
        rows = toolpath.picked(np.arange(first, past))
        middle = shapely.points(places(rows, np.arange(len(rows)), np.full(len(rows), 0.5)))
        inside = shapely.contains(target.shapes[loop], middle)
        if (2.0 * float(rows.length_um[inside].sum()) > float(rows.length_um.sum())) != bool(wanted[loop]):
            yield Fault("side", {}, Point(*rows.start_um[0].tolist()), plan.cuts[at].figure.number, first + 1)


def _within(plan: CutPlan, target: Target) -> Bools:
    """(k,) whether the wire is to run within each contour: by its depth, and as is asked for."""
    figures = [
        plan.cuts[at].figure._replace(runs_inside=bool(deep % 2), kind="hole" if deep % 2 else "outline")
        for at, deep in zip(target.cut.tolist(), target.depth.tolist(), strict=True)
    ]
    return np.array([figure.runs_inside for figure in with_sides(figures, plan.making)])


def fall_faults(plan: CutPlan, target: Target, pieces: Pieces, reach_um: float) -> Iterator[Fault]:
    """Figures of which nothing falls, or something else than should, or by another figure's cut."""
    fallen: dict[int, list[Piece]] = {}
    for piece in pieces.freed:
        if not piece.is_scrap:
            fallen.setdefault(piece.freed.contour - 1, []).append(piece)
    wanted = _within(plan, target)
    for loop, at in enumerate(target.cut.tolist()):
        cut, found = plan.cuts[at], fallen.pop(at, [])
        kind = "slug" if wanted[loop] else "part"
        most_um = max((one.by_um for one in cut.passes), default=0.0) or reach_um
        left = target.shapes[loop]
        left = left.buffer(-most_um - reach_um) if kind == "slug" else left
        place = Point(*cut.figure.contour.start_um[0].tolist())
        if not found and left.area > _CRUMB_UM2:
            yield Fault(f"no-{kind}", {}, place, cut.figure.number)
        elif any(piece.kind != kind for piece in found):
            yield Fault(f"not-{kind}", {}, place, cut.figure.number)
        elif len(found) > max(int(shapely.get_num_geometries(left)), 1):
            yield Fault("pieces", {"number": len(found)}, place, cut.figure.number)
    for at, found in fallen.items():
        number = plan.cuts[at].figure.number if at < len(plan.cuts) else 0
        yield Fault("pieces", {"number": len(found)}, found[0].freed.wire_um, number)
