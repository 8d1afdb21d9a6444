"""Ellipses and splines as rational Bézier pieces, cut until each is tame; and curves that were fitted to them.

Ellipses and splines as rational Bézier pieces in the plane, cut until each is tame: short of turns, evenly run.

Curves that were fitted, and how far off they are.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.dxf.entities import BEGIN, MAJOR, MINOR, SWEEP, Spline
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between

MOST_DEGREE = 24
"""No CAD draws beyond degree 11; binomials of far more lose digits."""
MOST_PIECES = 300_000
_MOST_TURN_RAD = 1.0
_UNEVEN = 8.0  # the longest leg of a control polygon beside its shortest
_MOST_RATIO = 3.0  # of weights
_TINY_OF_TOLERANCE = 0.125  # what is shorter is not looked into
_MOST_ROUNDS = 60  # halvings, each of at least the length or the ratio of weights
_LONGEST_STEP_RAD = 0.25 * math.pi  # of an ellipse in one piece


class Pieces(NamedTuple):
    """Rational Bézier pieces of one degree, in running order.

    Attributes
    ----------
    control
        (n, degree + 1, 3) control points as x·w and y·w in µm, and w > 0; each curve from an origin of its own.
    of
        (n,) which curve each is of, never decreasing.
    """

    control: Floats
    of: Ints


class Spans(NamedTuple):
    """Spans of B-splines of one degree, each with what bears on it.

    Attributes
    ----------
    control
        (n, degree + 1, 3) control points, as those of `Pieces`.
    knot
        (n, 2·degree) knots; the span lies between the middle two.
    """

    control: Floats
    knot: Floats


def spans_of(spline: Spline, origin_um: Floats) -> Spans:
    """The spans of a placed spline from an origin (2,). ValueError for numbers that make no curve."""
    degree, knot = spline.degree, spline.knot
    if not 1 <= degree <= MOST_DEGREE:
        raise ValueError(f"degree {degree}")
    if not (np.isfinite(spline.weight).all() and (spline.weight > 0.0).all()):
        raise ValueError("weights that are not positive")
    weight = spline.weight / spline.weight.max()
    rational = np.column_stack([(spline.control[:, :2] - origin_um) * weight[:, None], weight])
    inner = knot[degree : len(spline.control) + 1]
    at = degree + np.flatnonzero(np.diff(inner) > 0.0)
    if not len(at) or not np.isfinite(knot).all():
        raise ValueError("knots that span nothing")
    control = rational[at[:, None] + np.arange(-degree, 1)]
    return Spans(control, knot[at[:, None] + np.arange(1 - degree, degree + 1)])


def pieces_of_spans(spans: Sequence[Spans]) -> Pieces:
    """The pieces of splines of one degree.

    Control point j of a piece is the blossom of the ends of its span, the second taken j times (Ramshaw 1989).
    """
    control, knot = (
        np.concatenate([getattr(each_spans, name) for each_spans in spans]) for name in ("control", "knot")
    )
    degree = control.shape[1] - 1
    blossoms = [_blossom(control, knot, taken) for taken in range(degree + 1)]
    return Pieces(
        np.stack(blossoms, axis=1), np.repeat(np.arange(len(spans)), [len(each_spans.control) for each_spans in spans])
    )


def _blossom(control: Floats, knot: Floats, taken: int) -> Floats:
    """De Boor's scheme with another argument at each level: the end of the span `taken` times, then its start."""
    degree = control.shape[1] - 1
    part = control
    for level in range(1, degree + 1):
        at = knot[:, degree if level <= taken else degree - 1][:, None]
        low, high = knot[:, level - 1 : degree], knot[:, degree : 2 * degree - level + 1]
        share = ((at - low) / (high - low))[:, :, None]
        part = (1.0 - share) * part[:, :-1] + share * part[:, 1:]
    blossom: Floats = part[:, 0]
    return blossom


def pieces_of_ellipses(forms: Floats) -> Pieces:
    """The pieces of placed arcs of ellipses (k, 17) seen from above, each from the ellipse's centre."""
    parts = np.ceil(np.abs(forms[:, SWEEP]) / _LONGEST_STEP_RAD).astype(np.int64)
    of = np.repeat(np.arange(len(parts)), parts)
    at = np.arange(len(of)) - (np.cumsum(parts) - parts)[of]
    step = forms[of, SWEEP] / parts[of]
    weight = np.cos(0.5 * step)
    control = np.empty((len(of), 3, 3))
    for corner in range(3):
        angle = forms[of, BEGIN] + (at + 0.5 * corner) * step
        stretch = 1.0 if corner != 1 else 1.0 / weight
        out = (
            forms[of, MAJOR] * (stretch * np.cos(angle))[:, None]
            + forms[of, MINOR] * (stretch * np.sin(angle))[:, None]
        )
        own = weight if corner == 1 else np.ones(len(of))
        control[:, corner] = np.column_stack([out[:, :2] * own[:, None], own])
    return Pieces(control, of)


def halves(control: Floats, share: Floats | float = 0.5) -> tuple[Floats, Floats]:
    """Control points (n, p + 1, d) before and behind a share (n,) of the parameter: de Casteljau's algorithm."""
    share = np.asarray(share).reshape(-1, 1, 1)
    before, behind = [control[:, 0]], [control[:, -1]]
    level = control
    while level.shape[1] > 1:
        level = (1.0 - share) * level[:, :-1] + share * level[:, 1:]
        before.append(level[:, 0])
        behind.append(level[:, -1])
    return np.stack(before, axis=1), np.stack(behind[::-1], axis=1)


def tamed(pieces: Pieces, tolerance_um: float) -> Pieces:
    """The pieces, halved until they turn little and run evenly, or are tiny beside the tolerance; none of no length.

    Raises ValueError where they become too many.
    """
    control, of = pieces
    tame = _are_tame(control, tolerance_um)
    for _ in range(_MOST_ROUNDS):
        if tame.all():
            break
        into = np.where(tame, 1, 2)
        if into.sum() > MOST_PIECES:
            raise ValueError("pieces without number")
        row = np.cumsum(into) - into
        parted = np.repeat(control, into, axis=0)
        before, behind = halves(control[~tame])
        parted[row[~tame]], parted[row[~tame] + 1] = before, behind
        looked = np.repeat(~tame, into)
        tame = ~looked
        tame[looked] = _are_tame(parted[looked], tolerance_um)
        control, of = parted, np.repeat(of, into)
    long = legs_of(control)[1].max(axis=1) > 0.0
    return Pieces(control[long], of[long])


def legs_of(control: Floats) -> tuple[Floats, Floats]:
    """Legs (n, p, 2) of control polygons, and their lengths (n, p)."""
    leg = np.diff(control[:, :, :2] / control[:, :, 2:], axis=1)
    return leg, np.hypot(leg[:, :, 0], leg[:, :, 1])


def _are_tame(control: Floats, tolerance_um: float) -> Bools:
    leg, length = legs_of(control)
    weight = control[:, :, 2]
    crossed = leg[:, :-1, 0] * leg[:, 1:, 1] - leg[:, :-1, 1] * leg[:, 1:, 0]
    turn = np.abs(np.arctan2(crossed, (leg[:, :-1] * leg[:, 1:]).sum(axis=2))).sum(axis=1)
    even = length.max(axis=1) <= _UNEVEN * length.min(axis=1)
    tiny = length.sum(axis=1) <= _TINY_OF_TOLERANCE * tolerance_um
    return np.asarray(
        tiny | ((turn <= _MOST_TURN_RAD) & even & (weight.max(axis=1) <= _MOST_RATIO * weight.min(axis=1)))
    )


FLATTEST_UM = 1e7
"""Arcs of larger radii are lines: controllers count 7 digits of µm (10 m)."""


class Fitted(NamedTuple):
    """Lines and arcs (n,), which of the curves fitted each is of (n,), and a proved bound of how far off they are."""

    curves: Curves
    of: Ints
    max_um: float


def no_curves() -> Curves:
    """Curves of nothing, to which parts are joined."""
    nowhere = np.empty((0, 2))
    return curves_between(nowhere, nowhere, nowhere, np.empty(0))
