"""Nests: parts that lie a kerf apart, in an order in which none falls before it is cut, each edge in common cut once.

The first part of a nest is cut all round. Each other one begins in the kerf of those before it and ends there: of what
these have cut of its edge, the longest stretch is left out. What else they have cut of it is run through in their kerf.
The wire is threaded in the kerf, so that no start hole is drilled for it.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Final, NamedTuple

import numpy as np

from parser.drawing.loops.once import over
from parser.findings.catalogue import Remark
from parser.geometry.along import places_at
from parser.geometry.arrangement import merged
from parser.geometry.curves import Bools, Curves, Floats, Ints, joined
from parser.geometry.near import near_pairs
from parser.shape.parallel_runs import BESIDE_UM
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.apart import LEAST_EDGE_UM
from sim.make.cam.entries import nearest_of
from sim.make.cam.leads import room_of, run_back
from sim.make.cam.model import CannotCutError, Figure, FigureCut, PassCut, Refusal, Thread
from sim.make.cam.offset_path import offset_path
from sim.make.cam.passes import parted, way_of
from sim.setup.making import Making

_MOST_PAIRS: Final = 20_000_000
_MOST_NUMBERS: Final = 20  # of figures that one note names
_NEAR_UM: Final = 1.0  # a step: stretches with a shorter gap between them are one
_INTO_UM: Final = 1000.0
_SHARES: Final = np.linspace(0.05, 0.45, 17)
"""So far in what is cut, or at a share of it, a part begins and ends in the kerf of others."""
_OFF_CORNERS_UM: Final = BESIDE_UM + 100.0
"""A reader of 3B takes what ends within a kerf of a corner for another pass (`parser.threeb.decode.air_lines`)."""


class InKerf(NamedTuple):
    """How a part is cut that begins and ends in the kerf of others: its thread, and its way as it runs."""

    thread: Thread
    along: Curves


class Nests(NamedTuple):
    """Nests of figures.

    Attributes
    ----------
    orders
        Of each nest the indices of its figures, in the order in which they are cut.
    in_kerf
        How those are cut that begin in the kerf of others, by their indices.
    notes
        What is to be said of them.
    """

    orders: tuple[tuple[int, ...], ...] = ()
    in_kerf: Mapping[int, InKerf] = MappingProxyType({})
    notes: tuple[Remark, ...] = ()

    def in_order(self, order: Sequence[int]) -> tuple[int, ...]:
        """An order of all figures, with the figures of each nest in its own order in the places that they have."""
        found = list(order)
        for nest in self.orders:
            slots = sorted(found.index(at) for at in nest)
            for slot, at in zip(slots, nest, strict=True):
                found[slot] = at
        return tuple(found)


class _Way(NamedTuple):
    """The way round a figure, counter-clockwise, and what of it others run over.

    Attributes
    ----------
    curves, length_um
        The way, and how long it is.
    turns_um
        (k, 2) from where to where along it the wire turns round corners of the figure.
    other, stretch_um
        (m,) figures whose ways run over it, and (m, 2) from where to where along it.
    """

    curves: Curves
    length_um: float
    turns_um: Floats
    other: Ints = np.empty(0, dtype=np.int64)
    stretch_um: Floats = np.empty((0, 2))

    @property
    def neighbours(self) -> frozenset[int]:
        """The figures whose ways run over it."""
        return frozenset(self.other.tolist())


class _Cut(NamedTuple):
    """What is cut of a way: the longest stretch, from a length along it, and all, µm."""

    first_um: float
    longest_um: float
    all_um: float


def nests_of(figures: Sequence[Figure], making: Making, by_um: float, whole: Collection[int] = ()) -> Nests:
    """The nests of parts whose ways at an offset run over each other; those of the numbers `whole` are cut all round.

    CannotCutError, ``common-falls``, where the order that is asked for leaves nothing of a part to be cut.
    """
    outer = [at for at, figure in enumerate(figures) if figure.kind == "outline" and not figure.runs_inside]
    if not making.common_edges or not outer:
        return Nests()
    ways = _ways(figures, outer, by_um, making)
    orders, in_kerf = list[tuple[int, ...]](), dict[int, InKerf]()
    for nest in _together(ways, len(figures)):
        order = _wished(figures, nest, making.order) if making.order else _grown(ways, nest)
        orders.append(order)
        begun = _begun_in_kerf(figures, ways, order, making)
        in_kerf |= {at: each for at, each in begun.items() if figures[at].number not in whole}
    saved_um = sum(ways[at].length_um - float(way.along.length_um.sum()) for at, way in in_kerf.items())
    return Nests(tuple(orders), in_kerf, tuple(_notes(figures, in_kerf, saved_um, whole)))


def _notes(
    figures: Sequence[Figure], in_kerf: Mapping[int, InKerf], saved_um: float, whole: Collection[int]
) -> Iterator[Remark]:
    if in_kerf:
        numbers = _listed([figures[at].number for at in in_kerf])
        yield Remark("common-edges", {"saved_mm": mm(saved_um), "figures": numbers})
    elif not whole:
        yield Remark("no-common-edges")
    if whole:
        yield Remark("cut-round", {"figures": _listed(whole)})


def _listed(numbers: Collection[int]) -> str:
    more = " …" if len(numbers) > _MOST_NUMBERS else ""
    return ", ".join(map(str, sorted(numbers)[:_MOST_NUMBERS])) + more


def cut_in_kerf(figure: Figure, in_kerf: InKerf, by_um: float, making: Making) -> FigureCut:
    """How a part is cut that begins and ends in the kerf of others."""
    way = way_of(figure, making)
    nothing = in_kerf.along.picked(slice(0))
    only = PassCut(by_um, False, nothing, in_kerf.along, nothing)
    return FigureCut(figure, in_kerf.thread, way.side, way.is_ccw, (only,))


def refuse_misfits(making: Making, by_um: float) -> None:
    """CannotCutError, ``common-with``, for what needs several passes through a kerf, or a kerf that nobody knows."""
    if not making.common_edges:
        return
    several = len(making.passes_um) > 1 or any(wish.passes_um for wish in making.layers)
    wishes = {
        "--pass": several or by_um <= 0.0,
        "--tab": making.tab_um > 0.0,
        "--slug-tab": making.slug_tab_um > 0.0,
        "--lag": making.lag_um > 0.0,
    }
    for option, is_wished in wishes.items():
        if is_wished:
            raise CannotCutError(Refusal("common-with", (), (("option", option),)))


def _ways(figures: Sequence[Figure], outer: Sequence[int], by_um: float, making: Making) -> dict[int, _Way]:
    """The way round each of some figures, with where those of others run over it."""
    ways = {at: _way(figures[at], by_um, making) for at in outer}
    curves = joined([way.curves for way in ways.values()])
    loop = np.repeat(np.array(outer), [len(way.curves) for way in ways.values()])
    before = np.concatenate([way.curves.before_um[:-1] for way in ways.values()])
    early, late, _ = near_pairs(curves, np.zeros_like(loop), _NEAR_UM, _MOST_PAIRS, _NEAR_UM)
    like = np.flatnonzero((loop[early] != loop[late]) & (curves.kind[early] == curves.kind[late]))
    found = over(curves, np.append(early[like], late[like]), np.append(late[like], early[like]))
    order = np.argsort(loop[found.row], kind="stable")
    row, by = found.row[order], found.by[order]
    stretch = before[row][:, None] + np.column_stack([found.first_um, found.last_um])[order]
    bounds = np.searchsorted(loop[row], np.array([outer, [at + 1 for at in outer]])).T.tolist()
    return {
        at: way._replace(other=loop[by[low:high]], stretch_um=stretch[low:high])
        for (at, way), (low, high) in zip(ways.items(), bounds, strict=True)
    }


def _way(figure: Figure, by_um: float, making: Making) -> _Way:
    curves = offset_path(figure, by_um, making.corners)
    before, corner = curves.before_um, figure.contour.start_um
    off = [np.hypot(*np.moveaxis(end[:, None] - corner, 2, 0)) for end in (curves.start_um, curves.end_um)]
    turns = ((np.abs(off[0] - by_um) <= _NEAR_UM) & (np.abs(off[1] - by_um) <= _NEAR_UM)).any(axis=1)
    return _Way(curves, float(before[-1]), np.column_stack([before[:-1], before[1:]])[turns])


def _together(ways: Mapping[int, _Way], number: int) -> list[tuple[int, ...]]:
    """Figures that hang together by edges that are long enough, the nest of the first one first."""
    pairs = [
        (at, other)
        for at, way in ways.items()
        for other in sorted(way.neighbours)
        if float(np.diff(way.stretch_um[way.other == other]).sum()) >= LEAST_EDGE_UM
    ]
    label = merged(np.arange(number), np.array(pairs, dtype=np.int64).reshape(-1, 2))
    names, counts = np.unique(label, return_counts=True)
    return [tuple(np.flatnonzero(label == name).tolist()) for name in names[counts > 1].tolist()]


def _wished(figures: Sequence[Figure], nest: Sequence[int], order: Sequence[int]) -> tuple[int, ...]:
    """A nest in the order that is asked for by numbers of figures."""
    when = {number: at for at, number in enumerate(order)}
    return tuple(sorted(nest, key=lambda at: when.get(figures[at].number, len(when))))


def _grown(ways: Mapping[int, _Way], nest: Sequence[int]) -> tuple[int, ...]:
    """An order of a nest, grown from the part that has most of its edge to itself.

    Each time that part comes next of which least is left to be cut. But one that would leave nothing of another part to
    be cut waits until that part is cut: else both would fall at once.
    """
    alone = {at: ways[at].length_um - _cut_of(ways[at], ways[at].neighbours).all_um for at in nest}
    order = [max(nest, key=lambda at: (round(alone[at]), -at))]
    left = {at: ways[at].length_um for at in nest if at != order[0]}
    while left:
        for at in ways[order[-1]].neighbours & left.keys():
            left[at] = _left_um(ways[at], order)
        touched = [at for at in left if not ways[at].neighbours.isdisjoint(order)]
        touched.sort(key=lambda at: (round(left[at]), at))
        order.append(next((at for at in touched if not _closes(ways, left.keys(), order, at)), touched[0]))
        del left[order[-1]]
    return tuple(order)


def _left_um(way: _Way, cut: Collection[int]) -> float:
    return way.length_um - _cut_of(way, cut).all_um


def _closes(ways: Mapping[int, _Way], left: Collection[int], cut: Sequence[int], at: int) -> bool:
    """Whether nothing is left to be cut of another part once one is cut."""
    others = (other for other in ways[at].neighbours if other in left and other != at)
    return any(_left_um(ways[other], (*cut, at)) < LEAST_EDGE_UM for other in others)


def _cut_of(way: _Way, cut: Collection[int]) -> _Cut:
    """What of a way is cut once some figures are.

    A turn round a corner whose both ends are cut is cut, too: the wire touches the part in the corner alone, and has
    done so from either end.
    """
    stretches = way.stretch_um[np.isin(way.other, list(cut))]
    if not len(stretches):
        return _Cut(0.0, 0.0, 0.0)
    met = [_are_met(way.turns_um[:, side], stretches[:, 1 - side], way.length_um) for side in (0, 1)]
    every = np.concatenate([stretches, way.turns_um[met[0] & met[1]]])
    found: list[list[float]] = []
    for first, last in every[np.argsort(every[:, 0])].tolist():
        if found and first <= found[-1][1] + _NEAR_UM:
            found[-1][1] = max(found[-1][1], last)
        else:
            found.append([first, last])
    if len(found) > 1 and found[0][0] <= _NEAR_UM and found[-1][1] >= way.length_um - _NEAR_UM:
        found[-1][1] = way.length_um + found.pop(0)[1]
    first, last = max(found, key=lambda stretch: stretch[1] - stretch[0])
    return _Cut(first, last - first, sum(last - first for first, last in found))


def _are_met(place_um: Floats, other_um: Floats, length_um: float) -> Bools:
    """(k,) whether lengths along a closed way are those of others (m,), to a step."""
    off = np.mod(place_um[:, None] - other_um + 0.5 * length_um, length_um) - 0.5 * length_um
    met: Bools = np.any(np.abs(off) <= _NEAR_UM, axis=1)
    return met


def _begun_in_kerf(
    figures: Sequence[Figure], ways: Mapping[int, _Way], order: Sequence[int], making: Making
) -> dict[int, InKerf]:
    """How the parts of a nest are cut that begin in the kerf of those before them."""
    found = dict[int, InKerf]()
    corner = np.concatenate([ways[at].curves.start_um for at in order])
    for number, at in enumerate(order):
        cut = _cut_of(ways[at], order[:number])
        if cut.longest_um < LEAST_EDGE_UM:
            continue
        if ways[at].length_um - cut.all_um < LEAST_EDGE_UM:
            raise CannotCutError(Refusal("common-falls", (), (("number", str(figures[at].number)),)))
        along = _along(ways[at].curves, cut, corner, is_ccw=way_of(figures[at], making).is_ccw)
        start = along.start_um[0]
        entry = nearest_of(room_of([figures[at]]), np.array([-1.0]), 0, start)
        found[at] = InKerf(Thread(Point(*start.tolist()), "kerf", entry), along)
    return found


def _along(way: Curves, cut: _Cut, corner_um: Floats, *, is_ccw: bool) -> Curves:
    """The way round a figure without the longest stretch that is cut, but for a little at either end of that.

    Both ends lie off the corners (k, 2) of all ways, as far as there is room.
    """
    into = np.append(min(_INTO_UM, _SHARES[-1] * cut.longest_um), _SHARES * cut.longest_um)
    ends = [
        float(into[np.argmax(np.minimum(_off_corners(way, np.mod(at, way.before_um[-1]), corner_um), _OFF_CORNERS_UM))])
        for at in (cut.first_um + into, cut.first_um + cut.longest_um - into)
    ]
    ahead = _without(way, cut.first_um + ends[0], cut.longest_um - sum(ends))
    return ahead if is_ccw else run_back(ahead)


def _off_corners(way: Curves, at_um: Floats, corner_um: Floats) -> Floats:
    """How far (m,) places at lengths (m,) along a way lie from the nearest corner."""
    before = way.before_um
    row = np.clip(np.searchsorted(before, at_um, side="right") - 1, 0, len(way) - 1)
    place = places_at(way, row, at_um - before[row])
    off: Floats = np.hypot(*np.moveaxis(place[:, None] - corner_um, 2, 0)).min(axis=1)
    return off


def _without(way: Curves, first_um: float, length_um: float) -> Curves:
    """A closed way from the end of a stretch round to its start."""
    total_um = float(way.length_um.sum())
    early, late = parted(way, (first_um + length_um) % total_um)
    return parted(joined([late, early]), total_um - length_um)[0]
