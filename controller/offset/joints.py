"""How the offset of one block goes on into that of the next, by the three types of C-type compensation.

Shortened (suōduǎn) on the inner side of a corner, lengthened (shēncháng) on the outer side up to 90°, and beyond that
with a bridge inserted (chārù): an arc round the corner, or a chamfer. Tangent blocks need none of them. Beside a jump
nothing is inserted: it runs straight between the ends of its neighbours (docs/iso.md §9).

The way of single blocks through compensation, to be looked at: their ends moved aside, and how each is joined.

Compensation works in stages: where the contour ends, where the end lies moved aside, and how the block goes on from the
one before it (docs/iso.md §8). The whole path, in which blocks may also vanish, is that of `compensate`.
"""

from enum import IntEnum, StrEnum
from typing import NamedTuple

import numpy as np

from controller.offset.shifted import NOTHING_UM, Blocks, turned_rad
from parser.controller_words import Compensation, Outer
from parser.geometry.along import directions, headings_at, to_left
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.geometry.distance import prolonged_meet

SHARPEST_RAD = 0.5 * np.pi + 0.01
"""Turn of the sharpest corner that is lengthened: 90°, and what whole µm make of it between lines of 0.1 mm."""
_FARTHEST = 1.0 / np.cos(0.5 * SHARPEST_RAD) + 1e-9
"""How far from its corner lengthened lines meet at most, per offset: √2 at 90°."""
_BACK_RAD = np.pi - 1e-6
"""A block that turns more runs back along the one before it: rounding decides the side, the wire goes round the end."""
_SMOOTH_UM = 0.01
"""Blocks whose ends are this near are tangent: it is a turn of 1e-4 rad under an offset of 0.1 mm."""
_TANGENT_UM, _FAR_PER_GAP = 2.0, 10.0
"""At an inner corner, blocks with ends this near are tangent, but for whole µm, if their curves meet this many times
the gap away: arcs of one circle of 1 mm that miss each other by 1 µm may meet anywhere on it."""
_FLAT_RAD = 1e-6  # of curves that meet; rounding of 1e-10 µm then moves the place by 1e-4 µm
APART_UM = 1e-3
"""Blocks whose ends are farther apart than this have no corner: others between them have vanished."""


class Joining(IntEnum):
    """What lies between two blocks: an arc round their corner, a line between their ends, or a chamfer.

    A chamfer is a line between places that lie an offset beyond the corner, straight on behind the early block and
    straight back before the late one. Lines reach these places themselves.
    """

    NONE = 0
    ARC = 1
    LINE = 2
    CHAMFER = 3


class Joints(NamedTuple):
    """How k blocks go on into others.

    Attributes
    ----------
    end_um, start_um
        (k, 2) where the early one ends and where the late one begins; the same where nothing lies between them.
    bridge
        (k,) values of `Joining`.
    corner_um, turn_rad
        (k, 2) and (k,) the corner, and the angle that the path turns there.
    is_apart
        (k,) True without a corner.
    early_vanishes, late_vanishes
        (k,) True on an arc that the offset made so small that it does not reach the other block any more.
    """

    end_um: Floats
    start_um: Floats
    bridge: Ints
    corner_um: Floats
    turn_rad: Floats
    is_apart: Bools
    early_vanishes: Bools
    late_vanishes: Bools


class _Met(NamedTuple):
    """Where blocks meet (k, 2), NaN where they do not; how far that is from the corner, and beyond their ends."""

    place_um: Floats
    off_um: Floats
    beyond_um: Floats
    is_met: Bools


def joints(blocks: Blocks, early: Ints, late: Ints, outer: Outer) -> Joints:
    """Joints of the blocks `early` (k,) with the blocks `late` (k,); `outer` says what is done at outer corners."""
    left = blocks.left_um[early]
    farthest = _FARTHEST * np.abs(left)
    end, start = blocks.shifted.end_um[early], blocks.shifted.start_um[late]
    corner = 0.5 * (blocks.drawn.end_um[early] + blocks.drawn.start_um[late])
    is_apart = _length(blocks.drawn.end_um[early] - blocks.drawn.start_um[late]) > APART_UM
    turn = _turn(blocks, early, late)
    is_inner = turn * left > 0.0
    met = _met(blocks, early, late, corner, is_apart)
    lengthens = (np.abs(turn) <= SHARPEST_RAD) & (met.off_um <= farthest) & (met.beyond_um >= -NOTHING_UM)
    lengthens &= outer != "arc"
    middle, wide = 0.5 * (end + start), _length(end - start)
    is_far = met.is_met & (_length(met.place_um - middle) > _FAR_PER_GAP * wide)
    is_smooth = (wide <= _SMOOTH_UM) | (is_far & is_inner & ~is_apart & (wide <= _TANGENT_UM))
    is_one = is_smooth | (met.is_met & (is_apart | is_inner | lengthens) & ~_spared(blocks, early, late, met))
    # The place where nearly tangent curves meet is ill-conditioned, but it lies between their ends.
    is_middle = is_smooth & ~(_length(met.place_um - middle) <= wide)
    place = np.where(is_middle[:, None], middle, met.place_um)
    misses = ~is_one & is_inner & np.isnan(met.place_um[:, 0]) & (early != late)
    early_vanishes, late_vanishes = _too_small(blocks, early, late, misses)
    made = Joints(
        end_um=np.where(is_one[:, None], place, end),
        start_um=np.where(is_one[:, None], place, start),
        bridge=_bridge(is_one, ~is_apart & ~is_inner, turn, outer),
        corner_um=corner,
        turn_rad=turn,
        is_apart=is_apart,
        early_vanishes=early_vanishes,
        late_vanishes=late_vanishes,
    )
    _jump_between(blocks, early, late, made)
    _prolong(blocks, early, late, made)
    return made


def _bridge(is_one: Bools, is_outer: Bools, turn: Floats, outer: Outer) -> Ints:
    """(k,) what lies between blocks that turn by angles; arcs that do not meet up to 90° are never chamfered."""
    is_chamfer = is_outer & (np.abs(turn) > SHARPEST_RAD) & (outer == "chamfer")
    bridge = np.select([is_one, is_chamfer, is_outer], [Joining.NONE, Joining.CHAMFER, Joining.ARC], Joining.LINE)
    return bridge.astype(np.int64)


def _spared(blocks: Blocks, early: Ints, late: Ints, met: _Met) -> Bools:
    """(k,) True beside a jump if one of the two would vanish: no jump takes a cut away."""
    is_jump, length = blocks.shifted.kind == CurveKind.JUMP, blocks.drawn.length_um
    spared: Bools = (is_jump[early] | is_jump[late]) & (met.beyond_um < -np.minimum(length[early], length[late]))
    return spared


def _prolong(blocks: Blocks, early: Ints, late: Ints, made: Joints) -> None:
    """Let lines reach the places of their chamfers."""
    chamfer = np.flatnonzero(made.bridge == Joining.CHAMFER)
    before, behind = early[chamfer], late[chamfer]
    by_um = np.abs(blocks.left_um[before])[:, None]
    is_line = ~blocks.shifted.is_arc[:, None]
    made.end_um[chamfer] += np.where(is_line[before], by_um * blocks.arriving[before], 0.0)
    made.start_um[chamfer] -= np.where(is_line[behind], by_um * blocks.leaving[behind], 0.0)


def _jump_between(blocks: Blocks, early: Ints, late: Ints, made: Joints) -> None:
    """Let jumps begin and end where their neighbours do, instead of a bridge."""
    is_jump = blocks.shifted.kind == CurveKind.JUMP
    if not is_jump.any():
        return
    bridged = made.bridge != Joining.NONE
    before, behind = bridged & is_jump[early], bridged & is_jump[late] & ~is_jump[early]
    made.end_um[before], made.start_um[behind] = made.start_um[before], made.end_um[behind]
    made.bridge[before | behind] = Joining.NONE


def _turn(blocks: Blocks, early: Ints, late: Ints) -> Floats:
    """Angles (k,) that the path turns between blocks, positive to the left; straight back it turns outward."""
    u, v = blocks.arriving[early], blocks.leaving[late]
    turn: Floats = np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))
    is_back = np.abs(turn) >= _BACK_RAD
    turn[is_back] = -np.pi * np.sign(blocks.left_um[early[is_back]])
    return turn


def _met(blocks: Blocks, early: Ints, late: Ints, corner_um: Floats, is_apart: Bools) -> _Met:
    """Where blocks meet nearest their corner. Blocks that are apart must cross, and within an offset of their ends."""
    shifted = blocks.shifted
    places = prolonged_meet(shifted, early, late).place_um
    joint, which = np.nonzero(~np.isnan(places[:, :, 0]))
    place = places[joint, which]
    ends = _beyond(shifted, early[joint], place, True), _beyond(shifted, late[joint], place, False)
    off = _length(place - corner_um[joint])
    apart = np.flatnonzero(is_apart[joint])
    is_far = np.maximum(ends[0][apart], ends[1][apart]) > np.abs(blocks.left_um[early[joint[apart]]]) + NOTHING_UM
    off[apart[is_far | _is_flat(shifted, early[joint[apart]], late[joint[apart]], place[apart])]] = np.inf
    offs, least = np.full((len(early), 2), np.inf), np.full((len(early), 2), np.nan)
    offs[joint, which], least[joint, which] = off, np.minimum(*ends)
    at, nearest = np.arange(len(early)), (offs[:, 1] < offs[:, 0]).astype(np.int64)
    off = offs[at, nearest]
    return _Met(places[at, nearest], off, least[at, nearest], np.isfinite(off))


def _is_flat(shifted: Curves, early: Ints, late: Ints, place_um: Floats) -> Bools:
    """Whether curves (k,) meet at so flat an angle that rounding decides where."""
    u, v = headings_at(shifted, early, place_um), headings_at(shifted, late, place_um)
    flat: Bools = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) < _FLAT_RAD
    return flat


def _beyond(shifted: Curves, row: Ints, place_um: Floats, at_end: bool) -> Floats:
    """How far (k,) places (k, 2) lie beyond one end of the blocks `row` (k,), outside them; negative within."""
    end = shifted.end_um[row] if at_end else shifted.start_um[row]
    way = shifted.end_um[row] - shifted.start_um[row]
    length = _length(way)
    along: Floats = ((place_um - end) * way).sum(axis=1) / np.where(length > 0.0, length, np.nan)
    arc = np.flatnonzero(shifted.is_arc[row])
    on = row[arc]
    angle = shifted.start_angle_rad[on] + (shifted.sweep_rad[on] if at_end else 0.0)
    along[arc] = turned_rad(shifted, on, angle, place_um[arc]) * shifted.radius_um[on]
    return along if at_end else -along


def _too_small(blocks: Blocks, early: Ints, late: Ints, misses: Bools) -> tuple[Bools, Bools]:
    """Which of two blocks that should meet, and do not, is an arc made too small; of two arcs the shorter, or both.

    An arc of radius R at an inner corner of angle θ misses the offset f of a line where R (1 + cos θ) < 2 f. An arc of
    R ≥ 2 f is not too small: its corner is sharp, or what lay between the two blocks has vanished.
    """
    smaller = (blocks.drawn.sweep_rad * blocks.left_um > 0.0) & (blocks.drawn.radius_um < 2.0 * np.abs(blocks.left_um))
    this, other = misses & smaller[early], misses & smaller[late]
    length = blocks.shifted.radius_um * np.abs(blocks.shifted.sweep_rad)
    longer = this & other & ~np.isclose(length[early], length[late], rtol=1e-6, atol=0.0)
    return this & ~(longer & (length[early] > length[late])), other & ~(longer & (length[late] > length[early]))


def _length(way: Floats) -> Floats:
    return np.hypot(way[:, 0], way[:, 1])


_TANGENT_RAD = 1e-3
"""Blocks that turn less are tangent: whole µm make as much of it between blocks of some mm."""


class JointKind(StrEnum):
    """How a block goes on from the one before it.

    NONE: neither has an offset. SET_UP and CANCEL: it leads from the contour to the offset path, or back. NORMAL: the
    first block behind the set-up begins on its own normal. SHORTENED: on the inner side of the corner both end where
    they meet. LENGTHENED and INSERTED: on the outer side, up to 90° and beyond.
    """

    NONE = "none"
    SET_UP = "set-up"
    NORMAL = "normal"
    TANGENT = "tangent"
    SHORTENED = "shortened"
    LENGTHENED = "lengthened"
    INSERTED = "inserted"
    CANCEL = "cancel"


class AsideEnds(NamedTuple):
    """Ends (n, 2) of blocks moved aside, each by itself, to the left (P′) and to the right (P″); NaN without offset."""

    left_um: Floats
    right_um: Floats


def aside_ends(curves: Curves, compensation: Compensation) -> AsideEnds:
    """Ends of n blocks moved aside by the offset in force, across the way in which each arrives."""
    aside = to_left(directions(curves).arriving) * np.abs(compensation.left_um)[:, None]
    aside[compensation.side == 0] = np.nan
    return AsideEnds(curves.end_um + aside, curves.end_um - aside)


def joint_kinds(curves: Curves, compensation: Compensation) -> tuple[JointKind, ...]:
    """How each of n blocks goes on from the one before it."""
    turn = _turns_rad(curves)
    size = np.abs(turn)
    known = np.where(np.isnan(compensation.left_um), compensation.side, compensation.left_um)
    is_inner = (turn * np.roll(known, 1) > 0.0) & (size < _BACK_RAD)
    sharpest = 0.0 if compensation.rules.outer == "arc" else SHARPEST_RAD
    sides = np.concatenate([[False, False], compensation.side != 0])
    earlier, before, here = sides[:-2], sides[1:-1], sides[2:]
    is_on_normal = ~earlier & (compensation.rules.startup == "next-normal")
    kinds = {
        JointKind.CANCEL: ~here & before,
        JointKind.NONE: ~here,
        JointKind.SET_UP: ~before,
        JointKind.NORMAL: is_on_normal,
        JointKind.TANGENT: size <= _TANGENT_RAD,
        JointKind.SHORTENED: is_inner,
        JointKind.LENGTHENED: size <= sharpest,
    }
    return tuple(map(JointKind, np.select(list(kinds.values()), list(kinds), JointKind.INSERTED).tolist()))


def _turns_rad(curves: Curves) -> Floats:
    """Angle (n,) by which the path turns before each of n blocks, positive to the left; before the first of no use."""
    ways = directions(curves)
    (x, y), (to_x, to_y) = np.roll(ways.arriving, 1, axis=0).T, ways.leaving.T
    turn: Floats = np.arctan2(x * to_y - y * to_x, x * to_x + y * to_y)
    return turn
