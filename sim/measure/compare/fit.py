"""The motion that lays the cut edge on the drawing: least squares of its distances from the nearest curves.

From each start a few steps, then from the best ones until nothing moves any more.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Ints
from sim.measure.compare.descent import LAST, Fitted, Stage, descended, last_stage, placement_of, places_of
from sim.measure.compare.nearest import Index
from sim.measure.compare.placement import Placement
from sim.measure.compare.starts import CurveGroup, RigidMotion, groups, starts

_NEXT_STARTS, _NEXT_LEAST_TURNED = 6, 2
_EQUAL_RMS_UM, _EQUAL_MAX_UM = 0.1, 1.0
_FIRST, _NEXT = Stage(300, 3, 1e4), Stage(600, 12, 1e3)
_AS_IT_LIES = LAST._replace(steps=1)
_GROSS_UM, _FAR_BETTER = 20.0, 0.1  # µm of root mean square, and what is left of it


class Fit(NamedTuple):
    """Where the drawing lies on the edge, and the root mean square of the distances of the edge, µm."""

    placement: Placement
    rms_um: float


def fit(edge: Curves, edge_loop: Ints, index: Index, drawing_loop: Ints) -> Fit:
    """Lay the drawing of the index on the edge; both have their loops (n,) told apart, −1 for none.

    Of placements that fit equally well, root mean square within 0.1 µm and the largest within 1 µm, the one without a
    mirror is taken, then the one that turns least. Where the whole lies off by far and its longest loop fits by itself,
    that loop is what counts.
    """
    whole = _fitted(edge, edge_loop, index, drawing_loop)
    longest = groups(edge, edge_loop)[1:2]
    if whole.rms_um <= _GROSS_UM or not longest or len(longest[0].curves) == len(edge):
        return Fit(placement_of(whole.motion), whole.rms_um)
    # Something is cut that is not drawn, or is drawn elsewhere: the fit of the whole pulls all the rest off its place.
    outline = longest[0].curves
    by_one = _fitted(outline, np.zeros(len(outline), dtype=np.int64), index, drawing_loop)
    if by_one.rms_um > _FAR_BETTER * whole.rms_um:
        return Fit(placement_of(whole.motion), whole.rms_um)
    (laid,) = _stepped(index, edge, [by_one.motion], _AS_IT_LIES)
    return Fit(placement_of(laid.motion), laid.rms_um)


def _fitted(edge: Curves, edge_loop: Ints, index: Index, drawing_loop: Ints) -> Fitted:
    """The least squares of all of the edge."""
    from_, to = groups(edge, edge_loop), groups(index.curves, drawing_loop)
    tried = _stepped(index, edge, list(starts(from_, to)), _FIRST)
    tried = _stepped(index, edge, _different(tried, to[0]), _NEXT)
    chosen = _preferred(tried)
    (last,) = _stepped(index, edge, [chosen.motion], last_stage(edge))
    return last


def _stepped(index: Index, edge: Curves, motions: list[RigidMotion], stage: Stage) -> list[Fitted]:
    """The motions after the steps of a stage, with its places of the edge."""
    places = places_of(edge, stage)
    return [descended(index, places, motion, stage) for motion in motions]


def _different(tried: list[Fitted], drawing: CurveGroup) -> list[RigidMotion]:
    """The best motions, only one of those that nearly agree, and the least turned ones.

    A part that looks the same after several turns fits equally well by each, but for rounding: the least is wanted.
    """
    kept: list[Fitted] = []
    least_turned = sorted(tried, key=_turned)[:_NEXT_LEAST_TURNED]
    for most, ranked in (
        (_NEXT_STARTS, sorted(tried, key=lambda fitted: fitted.rms_um)),
        (_NEXT_STARTS + _NEXT_LEAST_TURNED, least_turned),
    ):
        for one in ranked:
            if len(kept) < most and not any(_agree(one.motion, other.motion, drawing.length_um) for other in kept):
                kept.append(one)
    return [fitted.motion for fitted in kept]


def _turned(fitted: Fitted) -> tuple[bool, float]:
    """What to prefer of placements that fit equally well: no mirror, then the least turn."""
    return fitted.motion.mirror, abs(fitted.motion.turn_rad)


def _agree(one: RigidMotion, other: RigidMotion, length_um: float) -> bool:
    apart = np.abs(one.matrix - other.matrix).max() * length_um + np.abs(one.shift_um - other.shift_um).max()
    return bool(apart < 1e-4 * length_um)


def _preferred(tried: list[Fitted]) -> Fitted:
    best = min(tried, key=lambda fitted: fitted.rms_um)
    equal = [
        fitted
        for fitted in tried
        if fitted.rms_um <= best.rms_um + _EQUAL_RMS_UM and fitted.max_um <= best.max_um + _EQUAL_MAX_UM
    ]
    return min(equal, key=_turned)
