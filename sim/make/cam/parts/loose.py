"""Curves that close no contour: which may be left out, and which are contours with something missing."""

from typing import Final, NamedTuple

import numpy as np
import shapely

from parser.drawing.loops.chain import DOT_UM
from parser.drawing.model import SAME_WITHIN_UM, Drawing, DrawnLoop, Entity, LeftOut, running
from parser.geometry.broad_phase_places import near_places
from parser.geometry.curves import Bools, Curves, Floats, Ints, joined
from parser.geometry.distance import distance_to_curves
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.model import CannotCutError, Refusal

_ALMOST_UM: Final = 1000.0
"""Loose ends this near are meant to meet: no drawing leaves a contour open by less on purpose (assumed)."""
_ALMOST_OF_LENGTH: Final = 0.4  # a bent chain open by less of its length is meant to close (assumed)
_LONGER: Final = 4.0  # times as long as they lie apart are curves that are meant to meet; strokes of a mark are not


class _Chains(NamedTuple):
    """Open chains (c,): both ends (c, 2, 2), length, whether it is more than a line, the entity of its first curve."""

    end_um: Floats
    length_um: Floats
    is_bent: Bools
    entity: Ints


def left_open(drawing: Drawing, loops: list[DrawnLoop], contours: Curves | None, gap_um: float) -> tuple[LeftOut, ...]:
    """What is left out of open chains of a drawing.

    CannotCutError where one of them is surely no free line: where it almost closes, alone or with another one
    (``almost-closed``), or where both of its ends lie on a contour or on another chain, so that it divides what lies
    there (``divided``).
    """
    if not loops:
        return ()
    chains = _chains(drawing, loops)
    near, by = _nearest(chains.end_um)
    _refuse_almost(drawing, chains, near, gap_um)
    _refuse_dividing(drawing, loops, chains, contours, gap_um)
    gap = by.min(axis=1)
    columns = zip(chains.entity.tolist(), chains.length_um.tolist(), chains.end_um[:, 0].tolist(), gap, strict=True)
    return tuple(
        LeftOut(
            drawing.entities[entity],
            "dot" if length <= DOT_UM else "open",
            (place[0], place[1]),
            float(open_um) if np.isfinite(open_um) else None,
        )
        for entity, length, place, open_um in columns
    )


def _chains(drawing: Drawing, loops: list[DrawnLoop]) -> _Chains:
    ends, lengths, bent, entity = [], [], [], []
    for loop in loops:
        ran = running(drawing.curves, loop.row, loop.backwards)
        ends.append((ran.start_um[0], ran.end_um[-1]))
        lengths.append(ran.length_um.sum())
        bent.append(len(ran) > 1 or bool(ran.is_arc[0]))
        entity.append(drawing.entity[loop.row[0]])
    return _Chains(np.array(ends), np.array(lengths), np.array(bent), np.array(entity))


def _nearest(end_um: Floats) -> tuple[Ints, Floats]:
    """Of each end (c, 2) the nearest other one in another place, numbered 2c and 2c + 1, and how far it lies, µm."""
    places = end_um.reshape(-1, 2)
    points = np.asarray(shapely.points(places))
    own, other = shapely.STRtree(points).query_nearest(points, exclusive=True, all_matches=False)
    near, by = np.arange(len(points)), np.full(len(points), np.inf)
    near[own], by[own] = other, np.hypot(*(places[own] - places[other]).T)
    return near.reshape(-1, 2), by.reshape(-1, 2)


def _refuse_almost(drawing: Drawing, chains: _Chains, near: Ints, gap_um: float) -> None:
    """Look at each end with the one nearest to it, and at both ends of each chain."""
    ends = chains.end_um.reshape(-1, 2)
    each = np.arange(len(chains.length_um))
    end, mate = np.concatenate([np.arange(len(ends)), 2 * each]), np.concatenate([near.ravel(), 2 * each + 1])
    apart = np.hypot(*(ends[end] - ends[mate]).T)
    shorter = np.minimum(chains.length_um[end // 2], chains.length_um[mate // 2])
    itself = (end // 2 == mate // 2) & chains.is_bent[end // 2] & (apart < _ALMOST_OF_LENGTH * shorter)
    close = (apart < _ALMOST_UM) & (shorter > _LONGER * apart)
    almost = np.flatnonzero((itself | close) & (apart > gap_um))
    if not len(almost):
        return
    first = almost[np.argmin(apart[almost])]
    entity = drawing.entities[int(chains.entity[end[first] // 2])]
    values = (("entity", named(entity)), ("gap_mm", f"{mm(float(apart[first])):.4g}"))
    places = _points(0.5 * (ends[end[almost]] + ends[mate[almost]]))
    raise CannotCutError(Refusal("almost-closed", places, values))


def _refuse_dividing(
    drawing: Drawing, loops: list[DrawnLoop], chains: _Chains, contours: Curves | None, gap_um: float
) -> None:
    within = max(gap_um, SAME_WITHIN_UM)
    ran = [running(drawing.curves, loop.row, loop.backwards) for loop in loops]
    chain = np.repeat(np.arange(len(loops)), [len(each) for each in ran])
    lines = joined([*ran, *([] if contours is None else [contours])])
    chain = np.append(chain, np.full(len(lines) - len(chain), -1))
    end = chains.end_um.reshape(-1, 2)
    near = near_places(lines, end, within)
    near = near.take(np.flatnonzero(chain[near.row] != near.other // 2))
    distance, _ = distance_to_curves(lines, near.row, end[near.other, 0], end[near.other, 1])
    tied = np.zeros(len(end), dtype=np.bool_)
    tied[near.other[distance <= within]] = True
    divides = np.flatnonzero(tied.reshape(-1, 2).all(axis=1))
    if len(divides):
        entity = drawing.entities[int(chains.entity[divides[0]])]
        raise CannotCutError(
            Refusal("divided", _points(chains.end_um[divides].reshape(-1, 2)), (("entity", named(entity)),))
        )


def named(entity: Entity) -> str:
    """An entity as people find it: its kind, its handle, its layer."""
    return " ".join(filter(None, (entity.kind, entity.handle, f"({entity.layer})")))


def _points(places: Floats) -> tuple[Point, ...]:
    """Each of places (k, 2) once, from left to right."""
    return tuple(Point(x, y) for x, y in np.unique(np.round(places, 3), axis=0).tolist())
