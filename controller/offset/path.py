"""The offset path, block by block, each with the block that it comes from, and the toolpath that it makes."""

from dataclasses import dataclass, fields
from enum import IntEnum

import numpy as np

from controller.offset.passes import PassedPath
from controller.stepping.words import stepped_words
from parser.geometry.curves import Curves, Ints
from parser.toolpath import Toolpath


class Made(IntEnum):
    """How a row of the offset path came about.

    AS_IT_IS: a block without offset, such as a jump. LEAD: a lead-in or lead-out, between a place without offset and
    the offset path. SHIFTED: a block moved aside, shortened or lengthened at its ends. BRIDGE: an arc or a chamfer
    round an outer corner, or a line between ends that do not meet.
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
        (m,) row that each comes from, rising; a bridge has that of the block before it.
    made
        (m,) values of `Made`.
    vanished
        (v,) rows that have no place on the offset path.
    """

    curves: Curves
    source_row: Ints
    made: Ints
    vanished: Ints


def offset_toolpath(passed: PassedPath, path: OffsetPath) -> Toolpath:
    """Toolpath of the offset `path` of a toolpath in passes: its exact curves, to be stepped like any other.

    If the program has words, its offset has words too, in whole µm. Every row has the source of the block that it comes
    from, and stops keep their places among these blocks. Only blocks without offset keep their printed ends, and only
    where they run as they are drawn.
    """
    drawn, row = passed.drawn, passed.row[path.source_row]
    as_it_is = (path.made == Made.AS_IT_IS) & ~passed.is_back[path.source_row]
    return Toolpath(
        **{field.name: getattr(path.curves, field.name) for field in fields(Curves)},
        printed_end_um=np.where(as_it_is[:, None], drawn.printed_end_um[row], np.nan),
        words=None if drawn.words is None else stepped_words(path.curves),
        source=drawn.source.picked(row),
        stops=tuple(stop._replace(after=int(np.searchsorted(path.source_row, stop.after))) for stop in passed.stops),
    )
