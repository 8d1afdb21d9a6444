"""The cut edge: where the part ends once the program is cut, curve by curve with the blocks that make it."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from parser.findings.catalogue import Remark
from parser.geometry.curves import Curves, Ints
from parser.toolpath import Point


class LeadGouge(NamedTuple):
    """A lead-in or lead-out that cuts into the part: its block, where the wire stands deepest, and how deep it cuts."""

    block: int
    where_um: Point
    depth_um: float


@dataclass(frozen=True, slots=True, eq=False)
class Edge:
    """The edge of the part, n curves.

    Attributes
    ----------
    curves
        Lines and arcs in the program's coordinates; polylines where the edge is one as cut.
    block
        (n,) number of the block that cuts each, from 1.
    loop
        (n,) which loop each belongs to, from 0.
    part_side
        (n,) +1 with the part on the left of the curve, −1 on its right, 0 where that is not known.
    offset_um
        How far the wire cuts past its path, where the edge is made of that; None of an edge as cut.
    reach_um
        How far the wire cuts past its centre: what no inside corner can be sharper than; 0 where any can.
    gouges
        Where lead-ins and lead-outs cut into the part beside it.
    notes
        What was assumed, and what has no edge.
    """

    curves: Curves
    block: Ints
    loop: Ints
    part_side: Ints
    offset_um: float | None = None
    reach_um: float = 0.0
    gouges: tuple[LeadGouge, ...] = ()
    notes: tuple[Remark, ...] = ()

    def on(self, loops: Ints) -> "Edge":
        """Some of its loops, whose curves stand together, numbered anew."""
        first, past = (np.searchsorted(self.loop, loops, side=side) for side in ("left", "right"))
        loop = np.repeat(np.arange(len(loops)), past - first)
        rows = np.arange(len(loop)) + (first - np.cumsum(past - first) + past - first)[loop]
        return replace(
            self, curves=self.curves.picked(rows), block=self.block[rows], loop=loop, part_side=self.part_side[rows]
        )
