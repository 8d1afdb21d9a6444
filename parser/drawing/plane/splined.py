"""Splines where a drawing places them, as lines or arcs in the plane."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.dxf.forms import Spline
from parser.drawing.fit.fitted import Fitted, no_curves
from parser.drawing.fit.splines import arcs_of_splines
from parser.drawing.model import SAME_WITHIN_UM
from parser.drawing.plane.flat import is_near, refuse_many
from parser.drawing.plane.splines import flattened
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined


class FlatSplines(NamedTuple):
    """Curves (n,) of splines (k,), and how they were made.

    Attributes
    ----------
    of
        (n,) the spline that each is of, never decreasing.
    unreadable
        (k,) splines whose knots, weights or places cannot be, and that have no curves.
    slanted
        Not level, so that they are seen shortened from above.
    fit_max_um
        How far arcs lie off them at most; 0 for lines.
    """

    curves: Curves
    of: Ints
    unreadable: Bools
    slanted: int
    fit_max_um: float


def placed_spline(spline: Spline, place: Floats) -> Spline:
    """A spline that a map (4, 3) places."""
    return spline._replace(control=spline.control @ place[:3] + place[3])


def flat_splines(splines: Sequence[Spline], tolerance_um: float, fit_um: float | None = None) -> FlatSplines:
    """Placed splines as lines within a tolerance of them, or as lines and arcs within `fit_um` where that is given.

    Raises DrawingError, without the name of the file, where they become too many.
    """
    near = np.array([bool(is_near(one.control).all()) for one in splines], dtype=np.bool_)
    rows = np.flatnonzero(near)
    if fit_um is None:
        made, refused = _lines(splines, rows, tolerance_um)
    else:
        made, refused = arcs_of_splines([splines[row] for row in rows.tolist()], fit_um)
        made, refused = made._replace(of=rows[made.of]), rows[refused]
    refuse_many(len(made.curves))
    unreadable = ~near
    unreadable[refused] = True
    slanted = sum(_is_slanted(one) for one, bad in zip(splines, unreadable.tolist(), strict=True) if not bad)
    return FlatSplines(made.curves, made.of, unreadable, slanted, made.max_um)


def _lines(splines: Sequence[Spline], rows: Ints, tolerance_um: float) -> tuple[Fitted, Ints]:
    parts = [no_curves()]
    of: list[int] = []
    refused: list[int] = []
    total = 0
    for row in rows.tolist():
        try:
            at = flattened(splines[row], tolerance_um)
        except Exception:  # knots or weights that cannot be
            refused.append(row)
            continue
        if not is_near(at).all():
            refused.append(row)
            continue
        parts.append(curves_between(at[:-1], at[1:], at[1:], np.zeros(len(at) - 1)))
        of.append(row)
        total += len(at) - 1
        refuse_many(total)
    number = [len(part) for part in parts[1:]]
    made = Fitted(joined(parts), np.repeat(np.array(of, dtype=np.int64), number), 0.0)
    return made, np.array(refused, dtype=np.int64)


def _is_slanted(spline: Spline) -> bool:
    """Whether the control points are not all of one height."""
    return bool(np.ptp(spline.control[:, 2]) > SAME_WITHIN_UM)
