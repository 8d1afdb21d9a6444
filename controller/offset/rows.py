"""Rows of an offset path: made of joined blocks, and put in their order.

The offset path, block by block, each with the block that it comes from, and the toolpath that it makes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from controller.offset.chain import Chain, turned_ends
from controller.offset.joints import Joining
from controller.offset.passes import PassedPath
from controller.offset.shifted import NOTHING_UM, Blocks
from controller.stepping.words import stepped_words
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.toolpath import Toolpath


class RowOrigin(IntEnum):
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
        (m,) values of `RowOrigin`.
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
    as_it_is = (path.made == RowOrigin.AS_IT_IS) & ~passed.is_back[path.source_row]
    return Toolpath(
        **{field.name: getattr(path.curves, field.name) for field in fields(Curves)},
        printed_end_um=np.where(as_it_is[:, None], drawn.printed_end_um[row], np.nan),
        words=None if drawn.words is None else stepped_words(path.curves),
        source=drawn.source.picked(row),
        stops=tuple(stop._replace(after=int(np.searchsorted(path.source_row, stop.after))) for stop in passed.stops),
    )


class Order(IntEnum):
    """Order of rows that come from one row of the toolpath; a chamfer has up to three lines."""

    LEAD_IN = 0
    ITSELF = 1
    BRIDGE = 2
    CHAMFER = 3
    BACK = 4
    LEAD_OUT = 5


class Rows(NamedTuple):
    """Rows of the path, in any order: their curves, the rows (k,) that they come from, and how they came about."""

    curves: Curves
    source_row: Ints
    made: RowOrigin
    place: Order


def moved_rows(blocks: Blocks, chain: Chain, left: Ints) -> Rows:
    """The blocks `left` (k,) of a chain as rows, each from where it begins to where it ends."""
    return Rows(_cut(blocks, chain, left), blocks.row[left], RowOrigin.SHIFTED, Order.ITSELF)


def bridge_rows(blocks: Blocks, chain: Chain, left: Ints) -> list[Rows]:
    """The bridges behind the blocks `left` (k,) of a chain: arcs of the offset's radius round corners, and lines."""
    arc, line, chamfer = (left[chain.bridge[left] == kind] for kind in (Joining.ARC, Joining.LINE, Joining.CHAMFER))
    lines = lines_between(chain.end_um[line], chain.start_um[chain.late[line]])
    arcs = curves_between(chain.end_um[arc], chain.start_um[chain.late[arc]], chain.corner_um[arc], chain.turn_rad[arc])
    radius = np.abs(blocks.left_um[arc])
    arcs = replace(arcs, radius_um=radius, length_um=radius * np.abs(arcs.sweep_rad))
    return [
        Rows(arcs, blocks.row[arc], RowOrigin.BRIDGE, Order.BRIDGE),
        Rows(lines, blocks.row[line], RowOrigin.BRIDGE, Order.BRIDGE),
        *_chamfers(blocks, chain, chamfer),
    ]


def _chamfers(blocks: Blocks, chain: Chain, early: Ints) -> list[Rows]:
    """Chamfers behind the blocks `early` (k,): where a block is an arc, a tangent of the offset's length leads on."""
    late = chain.late[early]
    by_um = np.abs(blocks.left_um[early])[:, None]
    on, back = blocks.shifted.is_arc[early], blocks.shifted.is_arc[late]
    end, start = chain.end_um[early], chain.start_um[late]
    far_end = end + np.where(on[:, None], by_um * blocks.arriving[early], 0.0)
    far_start = start - np.where(back[:, None], by_um * blocks.leaving[late], 0.0)
    row = blocks.row[early]
    return [
        Rows(lines_between(end[on], far_end[on]), row[on], RowOrigin.BRIDGE, Order.BRIDGE),
        Rows(lines_between(far_end, far_start), row, RowOrigin.BRIDGE, Order.CHAMFER),
        Rows(lines_between(far_start[back], start[back]), row[back], RowOrigin.BRIDGE, Order.BACK),
    ]


def in_order(parts: Sequence[Rows], vanished: Ints) -> OffsetPath:
    """The path of all parts; `vanished` (v,) are the rows without a place on it.

    Each line and jump begins where the row before it ends.
    """
    source_row = np.concatenate([part.source_row for part in parts])
    made, place = (
        np.concatenate([np.full(len(part.source_row), value) for part, value in zip(parts, values, strict=True)])
        for values in ([part.made for part in parts], [part.place for part in parts])
    )
    order = np.lexsort((place, source_row))
    curves = _continued(joined([part.curves for part in parts]).picked(order))
    return OffsetPath(curves, source_row[order], made[order].astype(np.int64), vanished)


def lines_between(start_um: Floats, end_um: Floats) -> Curves:
    """Lines between places; a line that is nothing but rounding gets the length 0."""
    lines = curves_between(start_um, end_um, np.full_like(start_um, np.nan), np.zeros(len(start_um)))
    return replace(lines, length_um=np.where(lines.length_um > NOTHING_UM, lines.length_um, 0.0))


def _cut(blocks: Blocks, chain: Chain, left: Ints) -> Curves:
    """The shifted blocks `left` (k,) from where each begins to where it ends."""
    shifted = blocks.shifted.picked(left)
    start, end = chain.start_um[left], chain.end_um[left]
    turn = np.sign(shifted.sweep_rad)
    since, until = np.zeros(len(left)), np.zeros(len(left))
    since[shifted.is_arc], until[shifted.is_arc] = turned_ends(chain, blocks, left[shifted.is_arc])
    sweep = shifted.sweep_rad + turn * (until - since)
    way = end - start
    angle = shifted.start_angle_rad + turn * since
    return replace(
        shifted,
        start_um=start,
        end_um=end,
        start_angle_rad=np.where(np.abs(angle) > np.pi, angle - 2.0 * np.pi * np.rint(angle / (2.0 * np.pi)), angle),
        sweep_rad=sweep,
        length_um=np.where(shifted.is_arc, shifted.radius_um * np.abs(sweep), np.hypot(way[:, 0], way[:, 1])),
    )


def _continued(curves: Curves) -> Curves:
    """Curves of which each line and jump begins where the one before it ends."""
    off = (curves.start_um[1:] != curves.end_um[:-1]).any(axis=1) & ~curves.is_arc[1:]
    late = np.flatnonzero(off) + 1
    start, length = curves.start_um.copy(), curves.length_um.copy()
    start[late] = curves.end_um[late - 1]
    length[late] = lines_between(start[late], curves.end_um[late]).length_um
    return replace(curves, start_um=start, length_um=length)
