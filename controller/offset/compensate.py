"""Offset of a toolpath block by block, as a controller with C-type compensation runs it."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.chain import (
    Chain,
    OffsetPath,
    Order,
    RowOrigin,
    Rows,
    bridge_rows,
    in_order,
    joined_blocks,
    lines_between,
    moved_rows,
)
from controller.offset.joints import Joining
from controller.offset.shifted import Blocks, OffsetSection, Side, shifted_blocks
from parser.geometry.curves import CurveKind, Curves, Floats, Ints


class _Edges(NamedTuple):
    """Ends of k sections.

    The first and the last row of each, whether the row before it leads in and the row behind it leads out, where its
    offset begins and ends, and whether any of its blocks is left.
    """

    first: Ints
    last: Ints
    led_in: NDArray[np.bool_]
    led_out: NDArray[np.bool_]
    start_um: Floats
    end_um: Floats
    is_left: NDArray[np.bool_]


def compensate(
    toolpath: Curves, sections: Sequence[OffsetSection], offset_um: float | Floats, side: Side | Ints
) -> OffsetPath:
    """Path of the wire's centre, an offset (≥ 0) to a side of the blocks of k sections, none of them a jump.

    Offset and side are the same for all sections, or one (k,) for each.

    The row before a section leads in: a line from where it begins to where the offset begins. One that is an arc
    becomes a line, as a controller without a radius for it runs it. A section without such a row, behind a jump or
    another section, gets a lead-in of its own from where it begins without offset. The same holds behind a section.

    Blocks that have no place on the path vanish, and their neighbours are joined with each other; where their curves
    do not meet, by a straight bridge, so that there always is a path. Where a section vanishes as a whole the path
    goes to where it begins without offset, and on from there. Lines and jumps that begin elsewhere than the row before
    them ends, as behind a pass that ended some µm off, begin where that one ends.
    """
    n = len(toolpath)
    if not sections:
        origins, places = (np.full(n, value) for value in (RowOrigin.AS_IT_IS, Order.ITSELF))
        return OffsetPath(toolpath.picked(slice(None)), np.arange(n), origins, places, np.arange(0))
    left_um = np.broadcast_to(np.asarray(offset_um * side, dtype=np.float64), len(sections))
    blocks = shifted_blocks(toolpath, sections, left_um)
    chain = joined_blocks(blocks, sections, "lengthen")
    edges = _edges(toolpath, sections, blocks, chain)
    left = np.flatnonzero(chain.is_left)
    parts = [
        moved_rows(blocks, chain, left),
        *bridge_rows(blocks, chain, left),
        *_others(toolpath, blocks.row, edges),
        *_leads(toolpath, edges),
    ]
    return in_order(parts, np.sort(blocks.row[~chain.is_left]))


def _edges(toolpath: Curves, sections: Sequence[OffsetSection], blocks: Blocks, chain: Chain) -> _Edges:
    first, last = (np.array(rows, dtype=np.int64) for rows in list(zip(*sections, strict=True))[:2])
    before, behind = first - 1, last + 1
    led_in, led_out = _leads_beside(toolpath, blocks.row, before), _leads_beside(toolpath, blocks.row, behind)
    number = np.cumsum(last - first + 1)
    left = np.append(np.flatnonzero(chain.is_left), len(blocks.row))
    low = np.searchsorted(left, number - (last - first + 1))
    high = np.searchsorted(left, number)
    start, end = toolpath.start_um[first], toolpath.start_um[first].copy()
    there = high > low
    head, tail = left[low[there]], left[high[there] - 1]
    start[there] = chain.start_um[head]
    is_bridged = (chain.bridge[tail] != Joining.NONE)[:, None]
    end[there] = np.where(is_bridged, chain.start_um[head], chain.end_um[tail])
    return _Edges(first, last, led_in, led_out, start, end, there)


def _leads_beside(toolpath: Curves, inside: Ints, row: Ints) -> NDArray[np.bool_]:
    """Whether rows (k,) are blocks outside all sections, with which the wire can be led."""
    is_free = np.ones(len(toolpath) + 1, dtype=np.bool_)
    is_free[inside] = False
    is_free[:-1] &= toolpath.kind != CurveKind.JUMP
    is_free[-1] = False  # beyond the last row, and before the first
    return is_free[row]


def _others(toolpath: Curves, inside: Ints, edges: _Edges) -> list[Rows]:
    """Rows outside all sections: those that lead in or out, and the rest as they are."""
    start, end = toolpath.start_um.copy(), toolpath.end_um.copy()
    into, out = edges.first[edges.led_in] - 1, edges.last[edges.led_out] + 1
    end[into], start[out] = edges.start_um[edges.led_in], edges.end_um[edges.led_out]
    leads = np.union1d(into, out)
    rest = np.ones(len(toolpath), dtype=np.bool_)
    rest[leads] = rest[inside] = False
    as_it_is = np.flatnonzero(rest)
    return [
        Rows(lines_between(start[leads], end[leads]), leads, RowOrigin.LEAD, Order.ITSELF),
        Rows(toolpath.picked(as_it_is), as_it_is, RowOrigin.AS_IT_IS, Order.ITSELF),
    ]


def _leads(toolpath: Curves, edges: _Edges) -> list[Rows]:
    """Leads of sections that have none, between their ends with and without offset, where these are not the same.

    A section that vanishes as a whole leaves its lead-out in any case, so that the path has a row.
    """
    first, last = edges.first, edges.last
    into = ~edges.led_in & (toolpath.start_um[first] != edges.start_um).any(axis=1)
    out = ~edges.led_out & ((toolpath.end_um[last] != edges.end_um).any(axis=1) | ~edges.is_left)
    lead_in = lines_between(toolpath.start_um[first[into]], edges.start_um[into])
    lead_out = lines_between(edges.end_um[out], toolpath.end_um[last[out]])
    return [
        Rows(lead_in, first[into], RowOrigin.LEAD, Order.LEAD_IN),
        Rows(lead_out, last[out], RowOrigin.LEAD, Order.LEAD_OUT),
    ]
