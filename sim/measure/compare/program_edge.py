"""The cut edge of a program: every loop of its path, moved by the offset to the side of the part."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely

from controller.offset.reach import reach
from controller.offset.sections import Side
from parser.findings.remarks import Remark
from parser.geometry.curves import Ints, joined
from parser.toolpath import Toolpath
from sim.measure.compare.edge import Edge
from sim.measure.compare.leads import gouges
from sim.measure.compare.rings import PathLoop, Rings, orientation, polygon, rings_of


class ProgramEdges(NamedTuple):
    """A program's loops with the sides of their parts.

    `sides` are one or two guesses (k,) of them, +1 left, −1 right: the second where no lead-in tells a side.
    """

    rings: Rings
    sides: tuple[Ints, ...]
    offset_um: float

    def alone(self, at: int) -> "ProgramEdges":
        """One of the rings by itself."""
        rings = self.rings._replace(rings=self.rings.rings[at : at + 1], open_blocks=())
        return self._replace(rings=rings, sides=tuple(sides[[at]] for sides in self.sides))


def program_edges(toolpath: Toolpath, offset_um: float) -> ProgramEdges:
    """Loops and sides of a program whose wire cuts `offset_um` past its path; no loop where no contour closes."""
    rings = rings_of(toolpath)
    told = np.array([ring.part_side for ring in rings.rings], dtype=np.int64)
    if told.all():
        return ProgramEdges(rings, (told,), offset_um)
    nested = _nested_sides(rings.rings)
    return ProgramEdges(rings, tuple(np.where(told == 0, guess, told) for guess in (nested, -nested)), offset_um)


def _nested_sides(rings: Sequence[PathLoop]) -> Ints:
    """Side (k,) of each ring's part, +1 left, −1 right, if outermost rings are parts and those in them holes."""
    shapes = [polygon(ring.curves) for ring in rings]
    begins = shapely.points([ring.curves.start_um[0] for ring in rings])
    inner, _ = shapely.STRtree(shapes).query(begins, predicate="within")
    depth = np.bincount(inner, minlength=len(rings))
    turns = np.array([orientation(ring.curves) for ring in rings], dtype=np.int64)
    return turns * np.where(depth % 2 == 0, 1, -1)


def edge_at(of: ProgramEdges, sides: Ints, offset_um: float) -> Edge:
    """The edge `offset_um` to the side of the part, negative to the other side, 0 for the path itself.

    A wire cuts it where the offset is above 0; the others tell only where an edge would lie.
    """
    loops, notes = [], []
    for ring, side in zip(of.rings.rings, sides.tolist(), strict=True):
        made = _moved(ring, side, offset_um)
        if not made:
            first, last = int(ring.block[0]), int(ring.block[-1])
            notes.append(Remark("no-edge-beside", {"first": first, "last": last, "offset": offset_um}))
        loops += made
    notes += [Remark("no-loop", {"first": first, "last": last}) for first, last in of.rings.open_blocks]
    if not loops:
        nothing = np.empty(0, dtype=np.int64)
        return Edge(of.rings.leads.picked(nothing), nothing, nothing, nothing, offset_um, notes=tuple(notes))
    number = [len(loop.curves) for loop in loops]
    return Edge(
        curves=joined([loop.curves for loop in loops]),
        block=np.concatenate([loop.block for loop in loops]),
        loop=np.repeat(np.arange(len(loops)), number),
        part_side=np.repeat(np.array([loop.part_side for loop in loops], dtype=np.int64), number),
        offset_um=offset_um,
        reach_um=max(offset_um, 0.0),
        notes=tuple(notes),
    )


def with_gouges(of: ProgramEdges, edge: Edge) -> Edge:
    """The edge with what the program's leads cut into the part beside it."""
    found = gouges(edge, of.rings.leads, of.rings.lead_block, of.offset_um)
    return replace(edge, gouges=found)


def _moved(ring: PathLoop, side: int, offset_um: float) -> list[PathLoop]:
    """The ring moved to a side, in as many pieces as that makes."""
    if offset_um == 0.0:
        return [ring._replace(part_side=side)]
    toward = Side(side if offset_um > 0.0 else -side)
    reached = reach(ring.curves, abs(offset_um), toward)
    return [PathLoop(loop.curves, ring.block[loop.source_row], side) for loop in reached.loops]
