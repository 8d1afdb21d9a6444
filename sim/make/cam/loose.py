"""Curves of a drawing that close no contour: free lines, contours with something missing, lines across contours.

A contour with something missing is not cut. It still lies around others: it is closed by lines, so that what lies
within it is a hole and no outline.
"""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
import shapely

from parser.drawing.loops.chain import DOT_UM, Run, signed_areas
from parser.drawing.model import BESIDE_UM, SAME_WITHIN_UM, Drawing, DrawnLoop, LeftOut, running
from parser.geometry.along import directions
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import near_places
from sim.make.cam.contours import Contours

_ALMOST_UM: Final = 1000.0
"""Loose ends this near are meant to meet: no drawing leaves a contour open by less on purpose (assumed)."""
_ALMOST_OF_LENGTH: Final = 0.4  # a bent chain open by less of its length is meant to close (assumed)
_AROUND_OF_LENGTH: Final = 0.75
"""A bent chain open by less of its length lies around what its ends and it enclose: two sides of a square by 0.71."""
_LONGER: Final = 4.0  # times as long as they lie apart are curves that are meant to meet; strokes of a mark are not
_CORNER_RAD: Final = (
    0.1  # a contour that turns by more at a place may as well have gone on along a line that ends there
)


class Closing(NamedTuple):
    """A contour that is closed by lines, counter-clockwise, and the first of the open loops that it is of."""

    contour: Curves
    loop: DrawnLoop


class Loose(NamedTuple):
    """What becomes of open chains.

    Attributes
    ----------
    left_out
        Each of them, and why: ``almost-closed``, ``divides``, ``dot``, ``open``.
    almost
        Contours that they are with something missing, closed by lines.
    around
        Open chains that lie around something, closed by lines: whether what lies within is a hole nobody can tell.
    gaps_um
        (k, 2) the middles of all that is missing in them.
    divided
        Numbers of the closed contours of which nobody can tell whether they go on as they do or along an open chain.
    """

    left_out: tuple[LeftOut, ...] = ()
    almost: tuple[Closing, ...] = ()
    around: tuple[Curves, ...] = ()
    gaps_um: Floats = np.empty((0, 2))
    divided: frozenset[int] = frozenset()


class _Chains(NamedTuple):
    """Open chains (c,): as they run, both ends, their length, whether they are more than a line, their first entity."""

    ran: list[Curves]
    end_um: Floats
    length_um: Floats
    is_bent: Bools
    entity: Ints


class _Links(NamedTuple):
    """Ends (k,) that are meant to meet, numbered 2c and 2c + 1 of chain c, and how far apart they lie, µm."""

    end: Ints
    mate: Ints
    apart_um: Floats


def loose_of(drawing: Drawing, loops: list[DrawnLoop], contours: Contours | None, gap_um: float) -> Loose:
    """What becomes of the open chains of a drawing beside its closed contours, None where there are none.

    A chain almost closes where its ends, or those of two chains, are meant to meet and lie farther apart than the gap.
    It divides a contour where both of its ends lie on contours. Which way the contour goes there is certain where it
    goes straight on. Where it turns at both ends, or where what divides it is drawn twice, as the edge of two squares
    is, nobody can tell what is to be cut.
    """
    if not loops:
        return Loose()
    chains = _chains(drawing, loops)
    near, by = _nearest(chains.end_um)
    links = _links(chains, near, gap_um)
    divides, divided = _dividing(drawing, chains, contours, max(gap_um, SAME_WITHIN_UM))
    apart, place = _almost(chains, links)
    is_almost, is_open = np.isfinite(apart), np.isinf(apart) & ~divides
    why = np.select([chains.length_um <= DOT_UM, is_almost, divides], ["dot", "almost-closed", "divides"], "open")
    gap = np.select([is_almost, is_open], [apart, by.min(axis=1)], np.inf)
    where = np.where(is_almost[:, None], place, chains.end_um[:, 0])
    columns = zip(chains.entity.tolist(), why.tolist(), where.tolist(), gap.tolist(), strict=True)
    ends = chains.end_um.reshape(-1, 2)
    return Loose(
        left_out=tuple(
            LeftOut(drawing.entities[entity], reason, (x, y), gap_um if np.isfinite(gap_um) else None)
            for entity, reason, (x, y), gap_um in columns
        ),
        almost=tuple(_closed(chains, loops, links)),
        around=tuple(_around(chains, is_open)),
        gaps_um=0.5 * (ends[links.end] + ends[links.mate]),
        divided=divided,
    )


def _chains(drawing: Drawing, loops: list[DrawnLoop]) -> _Chains:
    ran = [running(drawing.curves, loop.row, loop.backwards) for loop in loops]
    return _Chains(
        ran,
        np.array([(each.start_um[0], each.end_um[-1]) for each in ran]),
        np.array([each.length_um.sum() for each in ran]),
        np.array([len(each) > 1 or bool(each.is_arc[0]) for each in ran]),
        np.array([drawing.entity[loop.row[0]] for loop in loops]),
    )


def _nearest(end_um: Floats) -> tuple[Ints, Floats]:
    """Of each end (c, 2) the nearest other one in another place, numbered 2c and 2c + 1, and how far it lies, µm."""
    places = end_um.reshape(-1, 2)
    points = np.asarray(shapely.points(places))
    own, other = shapely.STRtree(points).query_nearest(points, exclusive=True, all_matches=False)
    near, by = np.arange(len(points)), np.full(len(points), np.inf)
    near[own], by[own] = other, np.hypot(*(places[own] - places[other]).T)
    return near.reshape(-1, 2), by.reshape(-1, 2)


def _links(chains: _Chains, near: Ints, gap_um: float) -> _Links:
    """Look at each end with the one nearest to it, and at both ends of each chain; the nearest ends come first."""
    ends = chains.end_um.reshape(-1, 2)
    chain_number = np.arange(len(chains.length_um))
    end, mate = (
        np.concatenate([np.arange(len(ends)), 2 * chain_number]),
        np.concatenate([near.ravel(), 2 * chain_number + 1]),
    )
    apart = np.hypot(*(ends[end] - ends[mate]).T)
    shorter = np.minimum(chains.length_um[end // 2], chains.length_um[mate // 2])
    itself = (end // 2 == mate // 2) & chains.is_bent[end // 2] & (apart < _ALMOST_OF_LENGTH * shorter)
    close = (apart < _ALMOST_UM) & (shorter > _LONGER * apart)
    almost = np.flatnonzero((itself | close) & (apart > gap_um))
    order = almost[np.argsort(apart[almost], kind="stable")]
    return _Links(end[order], mate[order], apart[order])


def _almost(chains: _Chains, links: _Links) -> tuple[Floats, Floats]:
    """How far (c,) each chain is open, infinite where it is meant to be, and the middle (c, 2) of what is open."""
    apart, place = np.full(len(chains.length_um), np.inf), np.zeros((len(chains.length_um), 2))
    ends = chains.end_um.reshape(-1, 2)
    chain, at = np.unique(np.stack([links.end // 2, links.mate // 2], axis=1).ravel(), return_index=True)
    link = at // 2  # the first of each chain: of the nearest ends
    apart[chain], place[chain] = links.apart_um[link], 0.5 * (ends[links.end[link]] + ends[links.mate[link]])
    return apart, place


def _closed(chains: _Chains, loops: list[DrawnLoop], links: _Links) -> list[Closing]:
    """The contours that chains are whose ends meet, each end with the nearest one that is free."""
    mate_of: dict[int, int] = {}
    for end, mate in zip(links.end.tolist(), links.mate.tolist(), strict=True):
        if end not in mate_of and mate not in mate_of:
            mate_of[end], mate_of[mate] = mate, end
    found, seen = list[Closing](), set[int]()
    for first in sorted(mate_of):
        way, end = list[int](), first
        while end in mate_of and end // 2 not in seen:
            seen.add(end // 2)
            way.append(end)
            end = mate_of.get(end ^ 1, -1)
        if way and end == first:
            found.append(Closing(_with_lines(chains, way), loops[first // 2]))
    return found


def _around(chains: _Chains, is_open: Bools) -> Iterator[Curves]:
    """Those of some chains that lie around something, closed by lines."""
    chord = np.hypot(*(chains.end_um[:, 1] - chains.end_um[:, 0]).T)
    for at in np.flatnonzero(is_open & chains.is_bent & (chord < _AROUND_OF_LENGTH * chains.length_um)).tolist():
        yield _with_lines(chains, [2 * at])


def _with_lines(chains: _Chains, way: list[int]) -> Curves:
    """Chains one after the other, each run from the end of the way's number, lines between them; counter-clockwise."""
    parts: list[Curves] = []
    for end in way:
        ran = chains.ran[end // 2]
        rows = np.arange(len(ran))
        parts.append(running(ran, rows[::-1], rows >= 0) if end % 2 else ran)
    lines = [
        curves_between(this.end_um[-1:], after.start_um[:1], np.full((1, 2), np.nan), np.zeros(1))
        for this, after in zip(parts, [*parts[1:], parts[0]], strict=True)
    ]
    ring = joined([each for pair in zip(parts, lines, strict=True) for each in pair])
    rows = np.arange(len(ring))
    run = Run(rows, rows < 0, np.zeros_like(rows), np.array([True]))
    return ring if signed_areas(ring, run)[0] >= 0.0 else running(ring, rows[::-1], rows >= 0)


def _dividing(
    drawing: Drawing, chains: _Chains, contours: Contours | None, within_um: float
) -> tuple[Bools, frozenset[int]]:
    """Whether each chain (c,) divides contours, and the numbers of those that are not certain for it."""
    divides: Bools = np.zeros(len(chains.ran), dtype=np.bool_)
    if contours is None:
        return divides, frozenset()
    end = chains.end_um.reshape(-1, 2)
    near = near_places(contours.curves, end, within_um)
    distance, _ = distance_to_curves(contours.curves, near.row, end[near.other, 0], end[near.other, 1])
    near = near.take(np.flatnonzero(distance <= within_um))
    tied = np.zeros(len(end), dtype=np.bool_)
    tied[near.other] = True
    divides = tied[::2] & tied[1::2]
    turned = np.zeros(len(end), dtype=np.bool_)
    turned[near.other[_turns(contours, near.row, end[near.other], within_um)]] = True
    is_unsure = turned[::2] & turned[1::2]
    is_unsure[_drawn_twice(drawing, chains, np.flatnonzero(divides))] = True
    unsure = contours.loop[near.row[(divides & is_unsure)[near.other // 2]]]
    return divides, frozenset(unsure.tolist())


def _turns(contours: Contours, row: Ints, place_um: Floats, within_um: float) -> Bools:
    """Whether rows (k,) of contours begin or end at places (k, 2), and their contour turns there."""
    curves, along = contours.curves, directions(contours.curves)
    first = np.searchsorted(contours.loop, contours.loop[row])
    past = np.searchsorted(contours.loop, contours.loop[row], side="right")
    before, after = np.where(row == first, past - 1, row - 1), np.where(row + 1 == past, first, row + 1)
    turns = np.zeros(len(row), dtype=np.bool_)
    for this, other, at in ((before, row, curves.start_um[row]), (row, after, curves.end_um[row])):
        (x, y), (to_x, to_y) = along.arriving[this].T, along.leaving[other].T
        turn = np.abs(np.arctan2(x * to_y - y * to_x, x * to_x + y * to_y))
        turns[(np.hypot(*(at - place_um).T) <= within_um) & (turn > _CORNER_RAD)] = True
    return turns


def _drawn_twice(drawing: Drawing, chains: _Chains, which: Ints) -> Ints:
    """Which of some chains (k,) are drawn again by another curve."""
    again = [each.place_um for each in drawing.left_out if each.why in {"drawn-twice", "overlaps"} and each.place_um]
    if not again or not len(which):
        return which[:0]
    curves = joined([chains.ran[at] for at in which.tolist()])
    of = np.repeat(which, [len(chains.ran[at]) for at in which.tolist()])
    place = np.array(again)
    near = near_places(curves, place, BESIDE_UM)
    distance, _ = distance_to_curves(curves, near.row, place[near.other, 0], place[near.other, 1])
    twice: Ints = np.unique(of[near.row[distance <= BESIDE_UM]])
    return twice
