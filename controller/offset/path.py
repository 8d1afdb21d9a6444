"""The offset path, block by block, each with the block that it comes from."""

from dataclasses import dataclass
from enum import IntEnum

from parser.geometry.curves import Curves, Ints


class Made(IntEnum):
    """How a row of the offset path came about.

    AS_IT_IS: a block without offset, such as a jump. LEAD: a lead-in or lead-out, between a place without offset and
    the offset path. SHIFTED: a block moved aside, shortened or lengthened at its ends. BRIDGE: an arc round an outer
    corner, or a line between ends that do not meet.
    """

    AS_IT_IS = 0
    LEAD = 1
    SHIFTED = 2
    BRIDGE = 3


@dataclass(frozen=True, slots=True, eq=False)
class OffsetPath:
    """Path of the wire's centre, m rows.

    Attributes
    ----------
    curves
        Its geometry, each row from the end of the one before it. Offset arcs have the centres of their blocks, and
        radii that differ from theirs by the offset, exactly.
    source_row
        (m,) row of the toolpath that each comes from; a bridge has that of the block before it.
    made
        (m,) values of `Made`.
    vanished
        (v,) rows of the toolpath that have no place on the offset path.
    """

    curves: Curves
    source_row: Ints
    made: Ints
    vanished: Ints
