"""What the wire cannot reach of a drawing: its sharp inside corners, and inside arcs tighter than the wire's reach.

A wire that cuts f past its centre leaves a fillet of radius f in an inside corner of the part, whatever its path: of a
corner of angle θ it leaves f (1 / sin(θ/2) − 1) in depth. What it can leave is the drawing rolled by a disc of radius
f. The disc's centre runs on the true offset of the drawing (`controller/offset/reach.py`); it turns on the spot, where
that offset has a corner, and its rim is the fillet.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from controller.offset.reach import OffsetLoop, reach
from controller.offset.shifted import Side
from parser.drawing.model import SAME_WITHIN_UM, Drawing, running
from parser.geometry.along import along_um, directions, headings_along, places, places_at
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.toolpath import Point

_LEAST_UM = 0.1  # as exact as a drawing's ellipses and splines are; shallower corners stay as they are drawn
_SAME_UM = 1e-5  # places on the offset this near are one
_SAME_RAD = 1e-6
_TURNS_RAD = 1e-3  # of a corner; what turns less leaves less than 1 nm
_NEAR_TANGENT = np.cos(np.radians(25.0))  # of a fillet that runs on from the sides that it joins
_DEEPEST = 2.0  # times what two straight sides would leave: what goes deeper is a slot narrower than the wire


class Unreachable(NamedTuple):
    """A place of the drawing that the wire cannot reach.

    Attributes
    ----------
    where_um
        The deepest place of it, on the drawing.
    depth_um
        How far that lies from what the wire can leave.
    angle_rad
        Between the two sides that the wire rests on there.
    entity
        The drawing's entity there, from 0.
    """

    where_um: Point
    depth_um: float
    angle_rad: float
    entity: int


class Reachable(NamedTuple):
    """A drawing as a wire can cut it: its curves (n,) with a fillet in each place that the wire cannot reach.

    Attributes
    ----------
    curves
        Those of the drawing, in its coordinates; loops with such places run counter-clockwise.
    entity, loop
        (n,) entity of each, and the closed loop that it belongs to, −1 for none.
    unreachable
        Those places, in the order of the curves.
    """

    curves: Curves
    entity: Ints
    loop: Ints
    unreachable: tuple[Unreachable, ...]


class _Fillet(NamedTuple):
    """A fillet about a centre (2,), from a length along the row `first` of a loop to one along the row `last`."""

    center_um: Floats
    turn_rad: float
    first: int
    last: int
    first_um: float
    last_um: float


def as_drawn(drawing: Drawing) -> Reachable:
    """The drawing itself."""
    return Reachable(drawing.curves, drawing.entity, loop_of_row(drawing), ())


def reachable(drawing: Drawing, part_side: Ints, reach_um: float) -> Reachable:
    """What a wire that cuts `reach_um` past its centre can leave of a drawing.

    `part_side` (k,) tells of each closed loop, run counter-clockwise, whether the part lies on its left, +1, or on its
    right, −1; of a loop with 0 nothing is known, and it stays as it is drawn. So do slots that are too narrow for the
    wire: what nobody can cut is no corner.
    """
    whole = as_drawn(drawing)
    is_whole = np.ones(len(drawing.curves), dtype=np.bool_)
    parts, entities, loops, corners = [], [], [], []
    closed = [loop for loop in drawing.loops if loop.closed]
    for number, (loop, side) in enumerate(zip(closed, part_side.tolist(), strict=True)):
        ring = running(drawing.curves, loop.row, loop.backwards)
        fillets = _fillets(ring, side, reach_um, loop.gap_um) if side and reach_um > 0.0 else []
        if not fillets:
            continue
        is_whole[loop.row] = False
        rolled, row = _rolled(ring, fillets, side)
        parts.append(rolled)
        entities.append(drawing.entity[loop.row[row]])
        loops.append(np.full(len(rolled), number))
        corners += [
            _unreachable(fillet, reach_um, ring, int(drawing.entity[loop.row[fillet.first]])) for fillet in fillets
        ]
    if not parts:
        return whole
    return Reachable(
        curves=joined([drawing.curves.picked(is_whole), *parts]),
        entity=np.concatenate([drawing.entity[is_whole], *entities]),
        loop=np.concatenate([whole.loop[is_whole], *loops]),
        unreachable=tuple(corners),
    )


def loop_of_row(drawing: Drawing) -> Ints:
    """Which closed loop each curve of the drawing belongs to, from 0; −1 for none."""
    loop = np.full(len(drawing.curves), -1, dtype=np.int64)
    for number, closed in enumerate(each for each in drawing.loops if each.closed):
        loop[closed.row] = number
    return loop


def _unreachable(fillet: _Fillet, reach_um: float, ring: Curves, entity: int) -> Unreachable:
    left = _left_out_places(ring, fillet)
    away = np.hypot(*(left - fillet.center_um).T)
    ahead, back = _sides(ring, fillet)
    turned = float(np.arccos(np.clip(ahead @ back, -1.0, 1.0)))
    deepest = int(np.argmax(away))
    return Unreachable(Point(*left[deepest].tolist()), float(away[deepest]) - reach_um, np.pi - turned, entity)


def _fillets(ring: Curves, side: int, reach_um: float, gap_um: float) -> list[_Fillet]:
    """Fillets in a loop with the part on a side, in the loop's order; one by one, since most loops have few or none.

    Ends that are joined may lie past each other by the gap that is bridged, or by what a file loses of its places: seen
    from a fillet's centre, the loop steps back there.
    """
    fillets = [fillet for offset in reach(ring, reach_um, Side(-side)).loops for fillet in _kinks(ring, offset, side)]
    deep = 2.0 * np.arccos(reach_um / (reach_um + _LEAST_UM))
    back = _SAME_RAD + (gap_um + SAME_WITHIN_UM) / reach_um
    found = [fillet for fillet in fillets if fillet.turn_rad > deep and _is_corner(ring, fillet, reach_um, back)]
    return sorted(found, key=lambda fillet: (fillet.first, fillet.first_um))


def _kinks(ring: Curves, offset: OffsetLoop, side: int) -> Iterator[_Fillet]:
    """A fillet for each corner of the offset that turns away from the part on the spot."""
    leaving, arriving = directions(offset.curves)
    leaving = np.roll(leaving, -1, axis=0)
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    turn = -side * np.arctan2(cross, (arriving * leaving).sum(axis=1))
    following = np.roll(offset.source_row, -1)
    at = np.flatnonzero((turn > _TURNS_RAD) & (offset.source_row != following))
    place, first, last = offset.curves.end_um[at], offset.source_row[at], following[at]
    columns = (turn[at], first, last, along_um(ring, first, place), along_um(ring, last, place))
    for center, *values in zip(place, *(column.tolist() for column in columns), strict=True):
        yield _Fillet(center, *values)


def _is_corner(ring: Curves, fillet: _Fillet, reach_um: float, back_rad: float) -> bool:
    """Whether a fillet lies in a corner, and not before a slot that is too narrow for the wire.

    In a corner both sides run on from the fillet, the wire's centre sees all that it leaves, which steps back by no
    more than `back_rad`, and what it leaves is not much deeper than between two straight sides.
    """
    out = _left_out_places(ring, fillet) - fillet.center_um
    away = np.hypot(out[:, 0], out[:, 1])
    turns = np.diff(np.unwrap(np.arctan2(out[:, 1], out[:, 0])))
    sees_all = bool((turns >= -back_rad).all() or (turns <= back_rad).all())
    straight_um = reach_um / np.cos(0.5 * fillet.turn_rad) - reach_um
    rim, side = out[[0, -1]] / away[[0, -1], None], _sides(ring, fillet)
    tangent = np.abs(rim[:, 0] * side[:, 1] - rim[:, 1] * side[:, 0])
    shallow = float(away.max()) - reach_um <= _DEEPEST * straight_um
    return sees_all and shallow and bool((tangent >= _NEAR_TANGENT).all())


def _sides(ring: Curves, fillet: _Fillet) -> Floats:
    """Directions (2, 2) in which the loop runs on where the fillet leaves it, and arrives where it comes back."""
    at_end = fillet.first_um >= float(ring.length_um[fillet.first]) - _SAME_UM
    leaving = ((fillet.first + 1) % len(ring), 0.0) if at_end else (fillet.first, fillet.first_um)
    row, along = zip(leaving, (fillet.last, fillet.last_um), strict=True)
    return headings_along(ring, np.array(row), np.array(along))


def _left_out_places(ring: Curves, fillet: _Fillet) -> Floats:
    """Places (m, 2) along the loop where the fillet leaves it out: on each row its ends and three between."""
    row = (fillet.first + np.arange((fillet.last - fillet.first) % len(ring) + 1)) % len(ring)
    begin, end = np.zeros(len(row)), ring.length_um[row].copy()
    begin[0], end[-1] = fillet.first_um, fillet.last_um
    along = begin[:, None] + (end - begin)[:, None] * np.linspace(0.0, 1.0, 5)
    return places_at(ring, np.repeat(row, 5), along.reshape(-1))


def _rolled(ring: Curves, fillets: list[_Fillet], side: int) -> tuple[Curves, Ints]:
    """The loop with its fillets, end to start, and the row of the loop that each curve stands for.

    A fillet is as many equal arcs as there are rows that it takes the place of, or one of the row before it.
    """
    begin, end = np.zeros(len(ring)), ring.length_um.copy()
    arcs, arc_row = [], []
    for fillet in fillets:
        between = (fillet.first + 1 + np.arange((fillet.last - fillet.first) % len(ring) - 1)) % len(ring)
        end[fillet.first], begin[fillet.last] = fillet.first_um, fillet.last_um
        end[between] = begin[between] = 0.0
        stands_for = between if len(between) else np.array([fillet.first])
        arcs.append(_arcs(ring, fillet, len(stands_for), side))
        arc_row.append(stands_for)
    row = np.flatnonzero(end > begin)
    left = _stretches(ring, row, begin[row], end[row])
    rows = np.concatenate([row, *arc_row])
    # A fillet stands behind the row that it leaves, and before those behind it.
    order = np.argsort(np.concatenate([2 * row, *(2 * row_ + 1 for row_ in arc_row)]), kind="stable")
    return joined([left, *arcs]).picked(order), rows[order]


def _arcs(ring: Curves, fillet: _Fillet, number: int, side: int) -> Curves:
    """The fillet, turned about its centre, in equal parts."""
    rows = np.array([fillet.first, fillet.last])
    ends = places_at(ring, rows, np.array([fillet.first_um, fillet.last_um]))
    out = ends - fillet.center_um
    angle = np.arctan2(out[:, 1], out[:, 0])
    sweep = -side * float(np.mod(-side * (angle[1] - angle[0]), 2.0 * np.pi))
    whole = curves_between(ends[:1], ends[1:], fillet.center_um[None], np.array([sweep]))
    corner = places(whole, np.zeros(number + 1, dtype=np.int64), np.linspace(0.0, 1.0, number + 1))
    return curves_between(
        corner[:-1], corner[1:], np.tile(fillet.center_um, (number, 1)), np.full(number, sweep / number)
    )


def _stretches(curves: Curves, row: Ints, begin_um: Floats, end_um: Floats) -> Curves:
    """The stretches (k,) of the rows `row` from and to lengths along them."""
    share = (end_um - begin_um) / np.where(curves.length_um[row] > 0.0, curves.length_um[row], 1.0)
    return curves_between(
        places_at(curves, row, begin_um),
        places_at(curves, row, end_um),
        curves.center_um[row],
        curves.sweep_rad[row] * share,
    )
