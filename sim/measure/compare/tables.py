"""The worst places of a comparison, and its deviations by block and by entity of the drawing."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.toolpath import Point
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.result import Comparison, CornerPlace, WorstPlace

_MOST_PLACES = 10
_APART = 0.02  # of the edge's extent: worst places lie no nearer to each other


class _Rows(NamedTuple):
    """Largest deviations (m,) of curves, leads among them, as the columns of `WorstPlace`."""

    deviation_um: Floats
    side: Floats
    where_um: Floats
    block: Ints
    entity: Ints
    measured_from: tuple[str, ...]

    def and_(self, others: "_Rows") -> "_Rows":
        """These and others behind them."""
        return _Rows(
            np.concatenate([self.deviation_um, others.deviation_um]),
            np.concatenate([self.side, others.side]),
            np.concatenate([self.where_um, others.where_um]),
            np.concatenate([self.block, others.block]),
            np.concatenate([self.entity, others.entity]),
            self.measured_from + others.measured_from,
        )

    def place(self, at: int) -> WorstPlace:
        """The entry `at`."""
        return WorstPlace(
            deviation_um=float(self.deviation_um[at]),
            side=int(self.side[at]),
            where_um=Point(*self.where_um[at].tolist()),
            block=int(self.block[at]),
            entity=int(self.entity[at]),
            measured_from=self.measured_from[at],
        )


def worst_places(of: Comparison) -> tuple[WorstPlace, ...]:
    """Up to ten of the largest deviations, apart from each other, the largest first."""
    from_edge, from_drawing = _from_edge(of), _from_drawing(of)
    rows = from_edge.and_(from_drawing)
    apart = _APART * float(np.ptp(of.edge.curves.start_um, axis=0).max())
    left = rows.deviation_um.copy()
    places: list[WorstPlace] = []
    while len(places) < _MOST_PLACES and left.max() >= 0.0:
        worst = int(np.argmax(left))
        places.append(rows.place(worst))
        left[np.hypot(*(rows.where_um - rows.where_um[worst]).T) <= apart] = -1.0
    return tuple(places)


def corner_places(of: Comparison) -> tuple[CornerPlace, ...]:
    """The sharp inside corners that the wire cannot reach, in the order of the drawing's curves."""
    if not of.unreachable:
        return ()
    near = nearest(indexed(of.edge.curves), np.array([corner.where_um for corner in of.unreachable]))
    return tuple(
        CornerPlace(corner.where_um, corner.depth_um, corner.angle_rad, block, corner.entity)
        for corner, block in zip(of.unreachable, of.edge.block[near.row].tolist(), strict=True)
    )


def by_block(of: Comparison) -> tuple[WorstPlace, ...]:
    """The largest deviation of the edge of each block that has one, in the order of the blocks."""
    rows = _from_edge(of)
    return tuple(rows.place(at) for at in _largest_of_each(rows.block, rows.deviation_um))


def by_entity(of: Comparison) -> tuple[WorstPlace, ...]:
    """The largest distance of each entity of the drawing from the edge, in the order of the entities."""
    rows = _from_drawing(of)
    return tuple(rows.place(at) for at in _largest_of_each(rows.entity, rows.deviation_um))


def _largest_of_each(key: Ints, deviation: Floats) -> list[int]:
    order = np.lexsort((np.arange(len(key)), -deviation, key))
    first: list[int] = order[np.diff(key[order], prepend=-2) != 0].tolist()
    return first


def _from_edge(of: Comparison) -> _Rows:
    there, gouges = of.edge_to_drawing, of.gouges
    return _Rows(
        np.append(there.max_um, [gouge.depth_um for gouge in gouges]),
        np.append(of.edge_side, np.full(len(gouges), -1.0)),
        np.concatenate([there.where_um, np.array([gouge.where_um for gouge in gouges]).reshape(-1, 2)]),
        np.append(of.edge.block, np.array([gouge.block for gouge in gouges], dtype=np.int64)),
        np.append(of.target.entity[there.other], np.full(len(gouges), -1)),
        ("edge",) * len(there.max_um) + ("lead",) * len(gouges),
    )


def _from_drawing(of: Comparison) -> _Rows:
    back = of.drawing_to_edge
    block = of.edge.block[back.other]
    names = ("drawing",) * len(back.max_um)
    return _Rows(back.max_um, of.drawing_side, back.where_um, block, of.target.entity, names)
