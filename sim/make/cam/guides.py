"""The way of the guides along which a wire that lags behind them cuts the way that is wanted.

The wire is dragged: it moves straight toward its guides, as far behind them as its lag (`sim.cut.wire_lag`). So where
it is to run on in a direction, the guides are its lag ahead in that direction. That is the tractrix read backwards, and
exact: a line becomes the same line, begun and ended a lag later; an arc of radius ρ becomes one of √(ρ² + lag²) about
the same centre, turned ahead by atan(lag/ρ). At a corner the wire stays while the guides go round it within their lag:
they run past it by the lag, straight to the lag behind it on the new way, and on.
"""

import math
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from controller.offset.chain import lines_between
from controller.offset.shifted import Side
from parser.geometry.along import Directions, directions, to_left
from parser.geometry.curves import Bools, Curves, Floats, curves_between, joined
from sim.make.cam.leads import run_back
from sim.make.cam.model import FigureCut, PassCut

CORNER_SHARE: Final = 0.95
"""Of the lag that is corrected at corners.

Lines at corners of 3° … 170°, lag 20 µm: corrected in full, a lag that is 30 % smaller than was said leaves up to 0.013
lag more at blunt corners than no correction does. With 0.95 of it no corner is worse within ±30 %, and where the lag is
as was said they are off by 0.05 lag at most, in place of 0.66 lag at 90° (measured; `tests/sim/make/cam/test_guides`).
"""
ARC_SHARE: Final = 0.99
"""Of the lag that is corrected on arcs, √0.98.

A wire with another lag L makes √(ρ² + lag² − L²) of ρ. With L = 0.7 lag that is off by 0.255 lag²/ρ, uncorrected by
0.245 lag²/ρ: with √0.98 of the lag it is off by no more.
"""
OVERLAP_LAGS: Final = 5.0
"""How far the last pass runs on over its start, in lags.

The wire ends it a lag before the guides do. On the 4 lags between it comes from a lead-in at 90° to 0.04 lag off the
way (tan(φ/2) = e^−4, off by lag · sin φ).
"""
_STEP_UM: Final = 0.5
"""Ends of two curves no farther apart than that become one place: a line between them would be no step of a table."""
_SAME_UM: Final = 1e-6
_SAME_RAD: Final = 1e-6
_CORNER_RAD: Final = 0.02  # less is no corner, but a joint that was to be smooth


class _Led(NamedTuple):
    """A pass as the wire is to run it, and as the guides do."""

    wire: PassCut
    guides: PassCut


def guided(cut: FigureCut, lag_um: float) -> FigureCut:
    """A cut whose passes are the ways of the guides, where those of the cut are the ways of a wire with a lag, µm.

    On lead-ins and lead-outs, in the waste, the guides run where the wire would: it cuts the corner to the pass off, on
    the side of the waste. Where a pass runs all round the guides end where the wire would, too. What the wire leaves
    there is cut by the last pass, which is to run on over its start by `OVERLAP_LAGS`. Up to a tab and over it they run
    past the end, so that the wire comes to it; what goes on from there begins where they are.
    """
    open_passes = 0 if not cut.cut_off else 1 if cut.figure.runs_inside else len(cut.passes)
    before: _Led | None = None
    led = list[PassCut]()
    for at, way in enumerate(cut.passes):
        made = _guided(way, lag_um, before, is_past=at < open_passes)
        led.append(made)
        if at < open_passes:
            before = _Led(way, made)
    cut_off = tuple(_over_tab(each, lag_um, before, cut) for each in cut.cut_off)
    return cut._replace(passes=tuple(led), cut_off=cut_off)


def _over_tab(way: PassCut, lag_um: float, before: _Led | None, cut: FigureCut) -> PassCut:
    """The cut-off as the guides run it: past its end, and where it goes there and back, back as they came.

    Back they run past each corner on its other side, and would cross their way there. Where all corners turn to the
    part, they may go back as they came: the wire is dragged into the waste.
    """
    if not _returns(way):
        return _guided(way, lag_um, before, is_past=True)
    there = way._replace(along=way.along.picked(slice(0, len(way.along) // 2)), out=way.out.picked(slice(0)))
    if not _turns_to_part(there, cut):
        return _guided(way, lag_um, before, is_past=False)
    led = _guided(there, lag_um, before, is_past=True)
    along = joined([led.along, run_back(led.along)])
    return led._replace(along=along, out=_lead(way.out, along.end_um[-1], way.out.end_um[-1]))


def before_corner_um(way: Curves, lag_um: float) -> float:
    """How far along a way it may be left by guides that run past its end by the lag, and meet no corner of it."""
    corner = np.flatnonzero(_turn(directions(way)) > _CORNER_RAD)
    length_um = float(way.length_um[: int(corner[0]) + 1 if len(corner) else None].sum())
    return max(length_um - lag_um, 0.0)


def _returns(way: PassCut) -> bool:
    """Whether a pass ends where it begins."""
    return bool(np.hypot(*(way.along.end_um[-1] - way.along.start_um[0])) <= _SAME_UM)


def _turns_to_part(way: PassCut, cut: FigureCut) -> bool:
    """Whether every corner of a pass turns to the side of the part."""
    heading = directions(way.along)
    before, behind = heading.arriving[:-1], heading.leaving[1:]
    to_left = before[:, 0] * behind[:, 1] - before[:, 1] * behind[:, 0]
    part_is_left = (cut.side == Side.LEFT) == way.is_back
    return bool(((to_left if part_is_left else -to_left) >= -_CORNER_RAD).all())


def _guided(way: PassCut, lag_um: float, before: _Led | None, *, is_past: bool) -> PassCut:
    """The ways of the guides of a pass, from where it begins to where it ends, or past that."""
    first, last = joined([way.into, way.along]).start_um[0], joined([way.along, way.out]).end_um[-1]
    goes_on = before is not None and bool(np.hypot(*(first - before.wire.along.end_um[-1])) <= _SAME_UM)
    if before is not None and goes_on:
        first = before.guides.along.end_um[-1]
    ahead = _ahead(way.along, lag_um, is_led=goes_on and not len(way.into), is_past=is_past)
    begin, end = ahead.start_um[0], ahead.end_um[-1]
    return way._replace(
        into=_lead(way.into, first, begin),
        along=_chain(begin, ahead, end),
        out=_lead(_back(way, lag_um), end, last) if len(way.out) or not is_past else way.out,
    )


def _back(way: PassCut, lag_um: float) -> Curves:
    """The way out of a pass, its arcs that run back over those of the pass on the circles of the guides."""
    out, along = way.out, way.along.picked(np.flatnonzero(way.along.is_arc))
    apart = np.hypot(*np.moveaxis(out.center_um[:, None] - along.center_um[None], 2, 0))
    is_same = (apart <= _SAME_UM) & (np.abs(out.radius_um[:, None] - along.radius_um[None]) <= _SAME_UM)
    is_back = is_same.any(axis=1)
    radius = np.where(is_back, np.hypot(out.radius_um, ARC_SHARE * lag_um), out.radius_um)
    starts, ends = (_on(out, radius, out.start_angle_rad + turn) for turn in (0.0, out.sweep_rad))
    starts, ends = np.where(is_back[:, None], starts, out.start_um), np.where(is_back[:, None], ends, out.end_um)
    return curves_between(starts, ends, out.center_um, out.sweep_rad)


def _lead(way: Curves, start: Floats, end: Floats) -> Curves:
    """A lead from a place (2,) to another one: its lines turn a little, to where the arcs beside them are now."""
    if not len(way):
        return _chain(start, way, end)
    before, after = np.concatenate([start[None], way.end_um[:-1]]), np.concatenate([way.start_um[1:], end[None]])
    starts = np.where(way.is_arc[:, None], way.start_um, before)
    ends = np.where(way.is_arc[:, None], way.end_um, after)
    return _chain(start, curves_between(starts, ends, way.center_um, way.sweep_rad), end)


def _ahead(way: Curves, lag_um: float, *, is_led: bool, is_past: bool) -> Curves:
    """Each curve as the guides run it, ahead of a wire on it; to the end of the last one, or past it.

    Where they are led the guides are ahead of the first one's start already.

    Two curves of one line or circle keep the joint between them: so a way round and on ends as it began.
    """
    heading, goes_on = directions(way), _goes_on(way)
    is_led_from, is_led_to = np.append(is_led, ~goes_on), np.append(~goes_on, is_past)
    share = np.where(_turn(heading) > _CORNER_RAD, CORNER_SHARE, ARC_SHARE)
    from_um = lag_um * np.append(CORNER_SHARE, share) * is_led_from
    to_um = lag_um * np.append(share, CORNER_SHARE) * is_led_to
    radius = np.hypot(way.radius_um, ARC_SHARE * lag_um)
    turn = np.sign(way.sweep_rad) * np.arctan2(ARC_SHARE * lag_um, np.where(way.is_arc, way.radius_um, 1.0))
    first = way.start_angle_rad + turn * is_led_from
    last = way.start_angle_rad + way.sweep_rad + turn * is_led_to
    starts = np.where(way.is_arc[:, None], _on(way, radius, first), way.start_um + from_um[:, None] * heading.leaving)
    ends = np.where(way.is_arc[:, None], _on(way, radius, last), way.end_um + to_um[:, None] * heading.arriving)
    return curves_between(starts, ends, way.center_um, np.where(way.is_arc, last - first, 0.0))


def _goes_on(way: Curves) -> Bools:
    """(n - 1,) whether each curve and the next one lie on one line or circle, and run the same way along it."""
    apart = np.hypot(*np.diff(way.center_um, axis=0).T)
    is_circle = (apart <= _SAME_UM) & (np.abs(np.diff(way.radius_um)) <= _SAME_UM)  # NaN of lines is neither
    is_line = ~way.is_arc[1:] & ~way.is_arc[:-1]
    on: Bools = (_turn(directions(way)) <= _SAME_RAD) & (is_circle | is_line)
    return on


def _turn(heading: Directions) -> Floats:
    """(n - 1,) by how much the way turns between each curve and the next one, as the chord of the angle."""
    turn: Floats = np.hypot(*(heading.leaving[1:] - heading.arriving[:-1]).T)
    return turn


def _on(way: Curves, radius_um: Floats, angle_rad: Floats) -> Floats:
    """Places (n, 2) about the centres of arcs."""
    heading = np.stack([np.cos(angle_rad), np.sin(angle_rad)], axis=1)
    places: Floats = way.center_um + radius_um[:, None] * heading
    return places


def _chain(start: Floats, curves: Curves, end: Floats) -> Curves:
    """Curves from a place (2,) to another one, each from where the one before it ends: lines join what lies apart.

    What lies apart by less than `_STEP_UM` is brought together. Arcs of up to half a turn keep how far they turn,
    others their centres.
    """
    ends = np.concatenate([start[None], curves.end_um])
    starts = np.concatenate([curves.start_um, end[None]])
    apart = np.hypot(*(starts - ends).T)
    is_line = apart > (_STEP_UM if len(curves) else _SAME_UM)
    past = curves.end_um.copy()
    past[-1:] = past[-1:] if is_line[-1] else end
    moved = _moved(curves, np.where(is_line[:-1, None], starts[:-1], ends[:-1]), past)
    lines = lines_between(ends[is_line], starts[is_line])
    order = np.argsort(np.concatenate([2 * np.arange(len(moved)) + 1, 2 * np.flatnonzero(is_line)]), kind="stable")
    return joined([moved, lines]).picked(order)


def _moved(curves: Curves, start_um: Floats, end_um: Floats) -> Curves:
    """Curves with other ends (n, 2); where these are the same, as they were."""
    off = np.hypot(*(start_um - curves.start_um).T) + np.hypot(*(end_um - curves.end_um).T)
    row = np.flatnonzero(off > _SAME_UM)
    if not len(row):
        return replace(curves, start_um=start_um, end_um=end_um)
    start, end, sweep = start_um[row], end_um[row], curves.sweep_rad[row]
    is_small = (sweep != 0.0) & (np.abs(sweep) <= math.pi)
    half_tan = np.tan(0.5 * np.where(is_small, sweep, math.pi))
    middle = 0.5 * (start + end) + to_left(end - start) / (2.0 * half_tan)[:, None]
    center = np.where(is_small[:, None], middle, curves.center_um[row])
    fresh = curves_between(start, end, center, sweep)
    order = np.arange(len(curves))
    order[row] = len(curves) + np.arange(len(row))
    return joined([curves, fresh]).picked(order)
