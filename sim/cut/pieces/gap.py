"""The gap that a stretch closes, between a piece and what it hangs on: up to which place of the wire it is open."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats, Ints
from sim.cut.kerf.swept import Box
from sim.cut.pieces.cells import THIN_UM, CellAt, Cells, are_in_contact, contacts, thick, touch
from sim.cut.pieces.hanging import Break, Hanging, Node
from sim.cut.regions import Regions, difference

_NEARLY_UM = 0.1  # as near as regions are exact, older kerf is come upon
OWN = 0
"""The group of what hung together."""

When = tuple[float, int]
"""Contour and place on the wire's way through it, in the order they are cut."""
FOREVER: When = (np.inf, 0)
_NEVER: When = (-1.0, 0)


class Uncut(NamedTuple):
    """What is left of a cell, and the groups that it touches."""

    cell_um: shapely.Polygon
    groups: frozenset[int]


class _Whole(NamedTuple):
    """A cell, the groups of its k neighbours, and where it touches these: (k,) regions along what they share."""

    cell_um: shapely.Polygon
    group: Ints
    contact_um: Regions


class Gap:
    """Cells of one stretch, which the wire takes, between what hung together and what lies behind.

    Groups: 0 what hung together, others what hangs together behind the gap, and holds until some place or nothing.

    Attributes
    ----------
    whole
        The cells through which what hung together hangs on to more.
    """

    def __init__(self, cells: Cells, parting: Break, holds_until: Callable[[int], When | None]) -> None:
        self._cells, self._stretch, self._holds_until = cells, parting.stretch, holds_until
        self._group: dict[Node, int] = dict.fromkeys([*parting.parts, *parting.cells], OWN)
        self._until: list[When] = [_NEVER]
        rest = [CellAt(parting.stretch, number) for number in range(len(cells.of_stretch(parting.stretch)))]
        nodes = {at: self._nodes_beside(at) for at in rest}
        linked = {OWN}
        while on := [at for at in rest if any(self._group.get(node) in linked for node in nodes[at])]:
            rest = [at for at in rest if at not in on]
            for node in (node for at in on for node in nodes[at]):
                if node not in self._group:
                    self._look_behind(node)
            linked |= {self._group[node] for at in on for node in nodes[at]}
        self.whole = [self._whole(at, nodes[at]) for at in nodes if at not in rest]

    @property
    def box(self) -> Box:
        """The box of all the cells."""
        low_x, low_y, high_x, high_y = shapely.total_bounds([each.cell_um for each in self.whole]).tolist()
        return low_x, low_y, high_x, high_y

    def _nodes_beside(self, at: CellAt) -> list[Node]:
        """Parts that a cell touches, and cells that later stretches take."""
        cell, later = self._cells.cell(at), list[CellAt]()
        for stretch in self._cells.stretches_near(cell.outline_um.bounds).tolist():
            if stretch <= self._stretch:
                break
            others = enumerate(self._cells.of_stretch(stretch))
            later += [CellAt(stretch, number) for number, other in others if touch(cell, other)]
        return [*self._cells.touched(at), *later]

    def _look_behind(self, node: Node) -> None:
        """Put what hangs together with a node, but for the stretch and what came before it, in a group."""
        hanging = Hanging(self._cells, [node], lambda part: self._holds_until(part) is not None)
        while hanging.next > self._stretch and not hanging.reached:
            hanging.take_back()
        own = [self._group[each] for each in (*hanging.parts, *hanging.cells) if each in self._group]
        until = max((self._holds_until(part) or _NEVER for part in hanging.reached), default=_NEVER)
        group = min(own, default=len(self._until))
        if own:
            self._until[group] = max(self._until[group], until)
        else:
            self._until.append(until)
        self._group.update(dict.fromkeys([node, *hanging.parts, *hanging.cells], group))

    def _whole(self, at: CellAt, nodes: list[Node]) -> _Whole:
        cell = self._cells.cell(at)
        shared = [self._cells.shared_um(cell, node) for node in nodes]
        return _Whole(cell.outline_um, np.array([self._group[node] for node in nodes]), contacts(shared))

    def closes_about(self, place_um: Floats, offset_um: float) -> int:
        """About which place (m, 2) of the stretch it closes: each cell is cut from older kerf to older kerf then."""
        places, reach = np.asarray(shapely.points(place_um), dtype=np.object_), offset_um + _NEARLY_UM
        return max(_second(_older_edges(each), places, reach) for each in self.whole)

    def uncut(self, at: int, since: int, wider_um: float = THIN_UM) -> list[Uncut]:
        """What is left of the cells once the wire has come from a place of the stretch to another; all of it before.

        The wire is wider than it is by as much as regions are inexact, so that no thread is left along the stretch.
        """
        if at < since:
            return [Uncut(whole.cell_um, frozenset(whole.group.tolist())) for whole in self.whole]
        front, found = self._cells.up_to(self._stretch, at, since, wider_um), list[Uncut]()
        for whole in self.whole:
            parts = thick(difference(whole.cell_um, front))
            touches = are_in_contact(parts[:, None], whole.contact_um[None, :])
            groups = (frozenset(whole.group[row].tolist()) for row in touches)
            found += [Uncut(*pair) for pair in zip(parts.tolist(), groups, strict=True)]
        return found

    def is_open(self, left: list[Uncut], when: When) -> bool:
        """Whether what hung together still hangs, at a place, on what holds it then, through what is left."""
        own, grew = {OWN}, True
        while grew:
            linked = set[int]().union(*(each.groups for each in left if each.groups & own))
            grew = not linked <= own
            own |= linked
        return max(self._until[group] for group in own) > when


def _older_edges(whole: _Whole) -> Regions:
    """Edges of a cell along what was cut before: those along which it touches nothing."""
    edges = shapely.difference(whole.cell_um.exterior, shapely.union_all(whole.contact_um))
    parts: Regions = shapely.get_parts(shapely.line_merge(edges))
    return parts


def _second(edges: Regions, places: Regions, reach_um: float) -> int:
    """Index of the first place within reach of two of some edges, one by one; of the last place where none comes to."""
    near = shapely.dwithin(edges[:, None], places[None, :], reach_um)
    first = np.sort(np.argmax(near, axis=1)[near.any(axis=1)])
    return int(first[1]) if len(first) > 1 else len(places) - 1
