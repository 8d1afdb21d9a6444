"""What a drawing places in space, seen from above: lines and arcs in the plane.

Forms and splines seen from above, as lines and arcs in µm; the border type is `Flat`.

Placed forms and splines to lines and arcs in the plane: circles stay arcs, ellipses and splines become lines.

B-splines to polylines that lie no farther off them than a tolerance.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.drawing.dxf.entities import BEGIN, CENTER, END, MAJOR, MINOR, START, SWEEP, Spline
from parser.drawing.fit.curves import arcs_of_ellipses, arcs_of_splines
from parser.drawing.fit.pieces import Fitted, no_curves
from parser.drawing.model import MOST_CURVES, SAME_WITHIN_UM, refuse_many
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined

FARTHEST_UM = 1e10  # 10 km: no part is drawn there, and floating point still tells 0.001 µm apart
_LONGEST_STEP_RAD = 0.5 * np.pi  # of an ellipse, however small: its lines still go round its centre


class Flat(NamedTuple):
    """Curves (n,), which form each comes from (n,), and how many forms, or which, were treated how.

    Attributes
    ----------
    ellipses
        Made lines.
    slanted
        Not level, so that they are seen shortened from above.
    upright
        Rows of forms that are ellipses and lines seen from above; left out.
    beyond
        Rows of those with places beyond any table, or that are no numbers; left out.
    fit_max_um
        How far arcs lie off the ellipses that they were fitted to, at most.
    """

    curves: Curves
    form: Ints
    ellipses: int
    slanted: int
    upright: Ints
    beyond: Ints
    fit_max_um: float


def flat_forms(forms: Floats, maps: Floats, which: Ints, tolerance_um: float, fit_um: float | None = None) -> Flat:
    """Forms (k, 17) to curves in µm, by the maps (m, 4, 3), of which `which` (k,) tells each form its own.

    Ellipses become lines within `tolerance_um`, or arcs within `fit_um` where that is given.

    Raises DrawingError, without the name of the file, where ellipses become too many lines.
    """
    forms = _placed(forms, maps[which])
    rho, thin = _axes(forms[:, MAJOR], forms[:, MINOR])
    line = forms[:, SWEEP] == 0.0
    arc = np.isfinite(forms).all(axis=1) & ((rho <= FARTHEST_UM) | (_is_round(forms) & _bends_near(forms, rho)))
    near = is_near(forms[:, START]) & is_near(forms[:, END]) & (line | arc)
    upright = near & ~line & (thin <= SAME_WITHIN_UM)
    kept_rows = np.flatnonzero(near & ~upright)
    forms, line, rho = forms[kept_rows], line[kept_rows], rho[kept_rows]
    exact = line | _is_round(forms)
    if fit_um is None:
        made = _chords(forms[~exact], rho[~exact], tolerance_um)
    else:
        made, refused = arcs_of_ellipses(forms[~exact], fit_um)
        refuse_many(MOST_CURVES + 1 if len(refused) else len(made.curves))
    form = np.concatenate([kept_rows[exact], kept_rows[~exact][made.of]])
    order = np.argsort(form, kind="stable")
    return Flat(
        joined([_exact(forms[exact]), made.curves]).picked(order),
        form[order],
        ellipses=int((~exact).sum()),
        slanted=int(_is_slanted(forms).sum()),
        upright=np.flatnonzero(upright),
        beyond=np.flatnonzero(~near),
        fit_max_um=made.max_um,
    )


def is_near(place: Floats) -> NDArray[np.bool_]:
    """Whether places (k, d) are numbers that a table may have."""
    return np.asarray((np.abs(place) <= FARTHEST_UM).all(axis=1))


def _placed(forms: Floats, maps: Floats) -> Floats:
    """Forms (k, 17) by a map (k, 4, 3) each; half-axes are directions, and are turned and stretched only."""
    placed = forms.copy()
    for column in (START, END, CENTER, MAJOR, MINOR):
        placed[:, column] = np.einsum("ki,kij->kj", forms[:, column], maps[:, :3])
    for column in (START, END, CENTER):
        placed[:, column] += maps[:, 3]
    return placed


def _axes(major: Floats, minor: Floats) -> tuple[Floats, Floats]:
    """Half the length and half the width (k,) of ellipses seen from above, from conjugate half-axes."""
    mean, apart = _squares(major, minor)
    rho = np.sqrt(mean + np.hypot(apart, (major[:, :2] * minor[:, :2]).sum(axis=1)))
    return rho, np.abs(_cross(major, minor)) / np.where(rho > 0.0, rho, 1.0)


def _squares(major: Floats, minor: Floats) -> tuple[Floats, Floats]:
    this, other = (major[:, :2] ** 2).sum(axis=1), (minor[:, :2] ** 2).sum(axis=1)
    return 0.5 * (this + other), 0.5 * (this - other)


def _cross(major: Floats, minor: Floats) -> Floats:
    crossed: Floats = major[:, 0] * minor[:, 1] - major[:, 1] * minor[:, 0]
    return crossed


def _is_round(forms: Floats) -> NDArray[np.bool_]:
    """Whether ellipses (k,) are circles: half-axes of one length, at right angles."""
    major, minor = forms[:, MAJOR], forms[:, MINOR]
    long = np.hypot(major[:, 0], major[:, 1])
    unequal = np.abs(long - np.hypot(minor[:, 0], minor[:, 1]))
    along = np.abs((major[:, :2] * minor[:, :2]).sum(axis=1))
    return np.asarray((unequal <= SAME_WITHIN_UM) & (along <= SAME_WITHIN_UM * long))


def _bends_near(forms: Floats, radius: Floats) -> NDArray[np.bool_]:
    """Whether arcs (k,) of circles bulge no farther from their chord than a table may reach: R (1 − cos(sweep / 2))."""
    return np.asarray(2.0 * radius * np.sin(0.25 * forms[:, SWEEP]) ** 2 <= FARTHEST_UM)


def _is_slanted(forms: Floats) -> NDArray[np.bool_]:
    start, end, major, minor = (forms[:, column][:, 2] for column in (START, END, MAJOR, MINOR))
    rise = np.abs(np.column_stack([end - start, major, minor]))
    return np.asarray((rise > SAME_WITHIN_UM).any(axis=1))


def _exact(forms: Floats) -> Curves:
    """Lines, and circles as arcs; an arc that is flatter than files can tell becomes a line too."""
    major = forms[:, MAJOR]
    radius = np.hypot(major[:, 0], major[:, 1])
    sweep = forms[:, SWEEP] * np.sign(_cross(major, forms[:, MINOR]))
    sagitta = 2.0 * radius * np.sin(0.25 * sweep) ** 2
    arc = (forms[:, SWEEP] != 0.0) & (sagitta > SAME_WITHIN_UM)
    start, end, center = (_xy(forms, column) for column in (START, END, CENTER))
    curves = curves_between(start, end, center, np.where(arc, sweep, 0.0))
    radius = np.where(arc, radius, np.nan)
    return replace(curves, radius_um=radius, length_um=np.where(arc, radius * np.abs(sweep), curves.length_um))


def _chords(forms: Floats, rho: Floats, tolerance_um: float) -> Fitted:
    """Lines (m,) between places on ellipses (k,), and which ellipse each is of.

    Over a step h of the angle, a chord lies off the curve by at most h²/8 times the second derivative. That is nowhere
    more than half the length of the ellipse.
    """
    step = np.minimum(np.sqrt(8.0 * tolerance_um / np.maximum(rho, tolerance_um)), _LONGEST_STEP_RAD)
    parts = np.ceil(np.abs(forms[:, SWEEP]) / step).astype(np.int64)
    refuse_many(int(parts.sum()))
    of = np.repeat(np.arange(len(parts)), parts)
    at = np.arange(len(of)) - (np.cumsum(parts) - parts)[of]
    start, end = (_on_ellipse(forms[of], share / parts[of]) for share in (at, at + 1))
    last = at + 1 == parts[of]
    start[at == 0], end[last] = _xy(forms, START), _xy(forms, END)
    return Fitted(curves_between(start, end, end, np.zeros(len(of))), of, 0.0)


def _xy(forms: Floats, column: slice) -> Floats:
    """A place or a half-axis (k, 2) of forms as it is seen from above."""
    return forms[:, column][:, :2]


def _on_ellipse(forms: Floats, share: Floats) -> Floats:
    angle = (forms[:, BEGIN] + share * forms[:, SWEEP])[:, None]
    center, major, minor = (_xy(forms, column) for column in (CENTER, MAJOR, MINOR))
    place: Floats = center + major * np.cos(angle) + minor * np.sin(angle)
    return place


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
    slanted = sum(
        _is_slanted_spline(spline) for spline, bad in zip(splines, unreadable.tolist(), strict=True) if not bad
    )
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


def _is_slanted_spline(spline: Spline) -> bool:
    """Whether the control points are not all of one height."""
    return bool(np.ptp(spline.control[:, 2]) > SAME_WITHIN_UM)
