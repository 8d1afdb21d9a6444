"""What hangs together as the wire is taken back, stretch by stretch: what it took last comes back first."""

import heapq
from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

from parser.geometry.curves import Ints
from sim.cut.pieces.cells import CellAt, Cells, touch

_LOOKED_AT = 64  # stretches near a part, in one go

Node = int | CellAt
"""A part by its index, 0 for the frame, or a cell."""


class _NearStretches(NamedTuple):
    """Stretches that come near a node, the last ones first, and those that may do so behind them."""

    near: Ints
    rest: Ints


class Hanging:
    """What hangs together with some nodes as the wire is taken back.

    Attributes
    ----------
    parts, cells
        Those that do so far, in the order they came.
    reached
        Parts that are known already, and where no way goes on.
    """

    def __init__(self, cells: Cells, begin: Iterable[Node], is_known: Callable[[int], bool]) -> None:
        self._cells, self._is_known = cells, is_known
        self._seen: set[Node] = set()
        self._todo: list[tuple[int, int, Node, _NearStretches]] = []
        self.parts: list[int] = []
        self.cells: list[CellAt] = []
        self.reached: set[int] = set()
        for node in begin:
            self._take(node)

    @property
    def next(self) -> int:
        """The stretch that may come back next; −1 where there is none."""
        return -self._todo[0][0] if self._todo else -1

    def take_back(self) -> bool:
        """Take the wire back by a stretch; whether something more hangs together then."""
        stretch = self.next
        _, at, node, stretches = heapq.heappop(self._todo)
        self._look(node, _NearStretches(stretches.near[1:], stretches.rest), at)
        new = list(self._new_beside(node, stretch))
        for each in new:
            self._take(each)
        return bool(new)

    def _take(self, node: Node) -> None:
        if node in self._seen:
            return
        if isinstance(node, CellAt):
            self._seen.add(node)
            self.cells.append(node)
            near = self._cells.stretches_near(self._cells.cell(node).outline_um.bounds)
            self._look(node, _NearStretches(near, near[:0]), len(self._seen))
            for part in self._cells.touched(node):
                self._take(part)
        elif self._is_known(node):
            self.reached.add(node)
        else:
            self._seen.add(node)
            self.parts.append(node)
            near = self._cells.stretches_near(self._cells.parts_um[node].bounds)
            self._look(node, _NearStretches(near[:0], near), len(self._seen))

    def _look(self, node: Node, stretches: _NearStretches, at: int) -> None:
        """Put the next of some stretches in turn; beside a part, those alone that come near its border."""
        near, rest = stretches
        while not len(near) and len(rest) and not isinstance(node, CellAt):
            near, rest = self._cells.near_line(self._cells.borders_um[node], rest[:_LOOKED_AT]), rest[_LOOKED_AT:]
        if len(near):
            heapq.heappush(self._todo, (-int(near[0]), at, node, _NearStretches(near, rest)))

    def _new_beside(self, node: Node, stretch: int) -> Iterator[CellAt]:
        """Cells of a stretch that touch a node, and have not come back yet."""
        for number, cell in enumerate(self._cells.of_stretch(stretch)):
            at = CellAt(stretch, number)
            if at in self._seen:
                continue
            if isinstance(node, CellAt):
                if touch(self._cells.cell(node), cell):
                    yield at
            elif node in self._cells.touched(at):
                yield at


class Came(NamedTuple):
    """A stretch with which more came, earlier than all before, and how many parts and cells there were then."""

    stretch: int
    parts: int
    cells: int


class Break(NamedTuple):
    """A stretch that parts what hung together, `parts` and `cells`, from more."""

    stretch: int
    parts: list[int]
    cells: list[CellAt]
