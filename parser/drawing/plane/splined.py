"""Splines where a drawing places them, as lines or arcs in the plane.

B-splines to polylines that lie no farther off them than a tolerance.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.dxf.forms import Spline
from parser.drawing.fit.fitted import Fitted, no_curves
from parser.drawing.fit.splines import arcs_of_splines
from parser.drawing.model import SAME_WITHIN_UM
from parser.drawing.plane.flat import is_near, refuse_many
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined

_BETWEEN = np.array([0.25, 0.5, 0.75])  # shares of a chord's parameters where its distance from the curve is looked at
_OF_TOLERANCE = 0.75  # the distance is not looked at everywhere
_MOST_ROUNDS = 24  # each at least halves what is too far off: an end for splines that never come near
_AT_ONCE = 1 << 16
MOST_PLACES = 1_000_000  # no spline that is drawn needs more; damaged ones do


def flattened(spline: Spline, tolerance_um: float) -> Floats:
    """Places (k, 2) µm on a placed spline, so that the lines between them lie within a tolerance of it.

    A spline that is straight gives its two ends. Raises ValueError where a spline needs more than a million places.
    """
    if _is_straight(spline):
        return places_at(spline, _ends(spline))
    at = _corners(spline)
    for _ in range(_MOST_ROUNDS):
        parts = np.ceil(np.sqrt(_off(spline, at) / (_OF_TOLERANCE * tolerance_um))).astype(np.int64)
        if parts.max() <= 1:
            break
        if parts.sum() > MOST_PLACES:
            raise ValueError(f"{parts.sum()} places on one spline")
        at = _parted(at, np.maximum(parts, 1))
    return places_at(spline, at)


def places_at(spline: Spline, at: Floats) -> Floats:
    """Places (k, 2) at parameters (k,), one or more, within the knots that bound the spline."""
    return np.concatenate([_de_boor(spline, at[first : first + _AT_ONCE]) for first in range(0, len(at), _AT_ONCE)])


def _de_boor(spline: Spline, at: Floats) -> Floats:
    """Places by de Boor's algorithm, which holds some ten arrays for each degree."""
    degree, knot = spline.degree, spline.knot
    span = np.clip(np.searchsorted(knot, at, side="right") - 1, degree, len(spline.control) - 1)
    rational = np.column_stack([spline.control[:, :2] * spline.weight[:, None], spline.weight])
    part = [rational[span - degree + step] for step in range(degree + 1)]
    for level in range(1, degree + 1):
        for step in range(degree, level - 1, -1):
            low, high = knot[span + step - degree], knot[span + step - level + 1]
            share = np.where(high > low, (at - low) / np.where(high > low, high - low, 1.0), 0.0)[:, None]
            part[step] = (1.0 - share) * part[step - 1] + share * part[step]
    place: Floats = part[degree][:, :2] / part[degree][:, 2:]
    return place


def _ends(spline: Spline) -> Floats:
    return spline.knot[[spline.degree, len(spline.control)]]


def _corners(spline: Spline) -> Floats:
    """Parameters of the ends and the knots, where a spline may have corners; each span is cut into `degree` parts."""
    first, last = _ends(spline)
    knot = np.unique(np.clip(spline.knot, first, last))
    return _parted(knot, np.full(len(knot) - 1, spline.degree, dtype=np.int64))


def _parted(at: Floats, parts: Ints) -> Floats:
    """Parameters (k,) with each step between them cut in so many equal ones."""
    of = np.repeat(np.arange(len(parts)), parts)
    share = (np.arange(len(of)) - (np.cumsum(parts) - parts)[of]) / parts[of]
    return np.append(at[of] + share * np.diff(at)[of], at[-1])


def _off(spline: Spline, at: Floats) -> Floats:
    """How far (k - 1,) the curve lies off the chords between parameters (k,)."""
    between = at[:-1] + _BETWEEN[:, None] * np.diff(at)
    place = places_at(spline, np.append(at, between))
    start, by = place[: len(at) - 1], np.diff(place[: len(at)], axis=0)
    out = place[len(at) :].reshape(len(_BETWEEN), -1, 2) - start
    square = (by**2).sum(axis=1)
    along = np.clip((out * by).sum(axis=2) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    off = out - along[:, :, None] * by
    farthest: Floats = np.hypot(off[:, :, 0], off[:, :, 1]).max(axis=0)
    return farthest


def _is_straight(spline: Spline) -> bool:
    """Whether the control points, between which the curve runs, lie on the line from the first to the last."""
    by = spline.control[-1, :2] - spline.control[0, :2]
    length = np.hypot(*by)
    if length <= SAME_WITHIN_UM or not (spline.weight > 0.0).all():
        return False
    along, across = (
        np.array([[by[0], by[1]], [-by[1], by[0]]]) @ (spline.control[:, :2] - spline.control[0, :2]).T / length
    )
    inside = (along >= -SAME_WITHIN_UM) & (along <= length + SAME_WITHIN_UM)
    return bool((inside & (np.abs(across) <= SAME_WITHIN_UM)).all())


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
    near = np.array([bool(is_near(spline.control).all()) for spline in splines], dtype=np.bool_)
    rows = np.flatnonzero(near)
    if fit_um is None:
        made, refused = _lines(splines, rows, tolerance_um)
    else:
        made, refused = arcs_of_splines([splines[row] for row in rows.tolist()], fit_um)
        made, refused = made._replace(of=rows[made.of]), rows[refused]
    refuse_many(len(made.curves))
    unreadable = ~near
    unreadable[refused] = True
    slanted = sum(_is_slanted(spline) for spline, bad in zip(splines, unreadable.tolist(), strict=True) if not bad)
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
