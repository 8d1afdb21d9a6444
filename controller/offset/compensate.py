"""Offset of a toolpath block by block, as a controller with C-type compensation runs it."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.chain import Chain, joined_blocks, turned_ends
from controller.offset.joints import Joining
from controller.offset.path import Made, OffsetPath
from controller.offset.sections import OffsetSection, Side
from controller.offset.shifted import NOTHING_UM, Blocks, shifted_blocks
from parser.geometry.curves import CurveKind, Curves, Floats, Ints, curves_between, joined

# Order of rows that come from one row of the toolpath.
_LEAD_IN, _ITSELF, _BRIDGE, _LEAD_OUT = range(4)


class _Rows(NamedTuple):
    """Rows of the path, in any order."""

    curves: Curves
    source_row: Ints
    made: Made
    place: int


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
        return OffsetPath(toolpath.picked(slice(None)), np.arange(n), np.full(n, Made.AS_IT_IS), np.arange(0))
    left_um = np.broadcast_to(np.asarray(offset_um * side, dtype=np.float64), len(sections))
    blocks = shifted_blocks(toolpath, sections, left_um)
    chain = joined_blocks(blocks, sections)
    edges = _edges(toolpath, sections, blocks, chain)
    left = np.flatnonzero(chain.is_left)
    parts = [
        _Rows(_cut(blocks, chain, left), blocks.row[left], Made.SHIFTED, _ITSELF),
        *_bridges(blocks, chain, left[chain.bridge[left] != Joining.NONE]),
        *_others(toolpath, blocks.row, edges),
        *_leads(toolpath, edges),
    ]
    source_row = np.concatenate([part.source_row for part in parts])
    made, place = (
        np.concatenate([np.full(len(part.source_row), value) for part, value in zip(parts, values, strict=True)])
        for values in ([part.made for part in parts], [part.place for part in parts])
    )
    order = np.lexsort((place, source_row))
    curves = _continued(joined([part.curves for part in parts]).picked(order))
    return OffsetPath(curves, source_row[order], made[order].astype(np.int64), np.sort(blocks.row[~chain.is_left]))


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


def _bridges(blocks: Blocks, chain: Chain, bridged: Ints) -> list[_Rows]:
    """Bridges behind the blocks `bridged` (k,): arcs round their corners, of the offset's radius, and lines."""
    arc, line = (bridged[chain.bridge[bridged] == kind] for kind in (Joining.ARC, Joining.LINE))
    lines = _lines(chain.end_um[line], chain.start_um[chain.late[line]])
    arcs = curves_between(chain.end_um[arc], chain.start_um[chain.late[arc]], chain.corner_um[arc], chain.turn_rad[arc])
    radius = np.abs(blocks.left_um[arc])
    arcs = replace(arcs, radius_um=radius, length_um=radius * np.abs(arcs.sweep_rad))
    return [_Rows(curves, blocks.row[of], Made.BRIDGE, _BRIDGE) for curves, of in ((arcs, arc), (lines, line))]


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


def _others(toolpath: Curves, inside: Ints, edges: _Edges) -> list[_Rows]:
    """Rows outside all sections: those that lead in or out, and the rest as they are."""
    start, end = toolpath.start_um.copy(), toolpath.end_um.copy()
    into, out = edges.first[edges.led_in] - 1, edges.last[edges.led_out] + 1
    end[into], start[out] = edges.start_um[edges.led_in], edges.end_um[edges.led_out]
    leads = np.union1d(into, out)
    rest = np.ones(len(toolpath), dtype=np.bool_)
    rest[leads] = rest[inside] = False
    as_it_is = np.flatnonzero(rest)
    return [
        _Rows(_lines(start[leads], end[leads]), leads, Made.LEAD, _ITSELF),
        _Rows(toolpath.picked(as_it_is), as_it_is, Made.AS_IT_IS, _ITSELF),
    ]


def _leads(toolpath: Curves, edges: _Edges) -> list[_Rows]:
    """Leads of sections that have none, between their ends with and without offset, where these are not the same.

    A section that vanishes as a whole leaves its lead-out in any case, so that the path has a row.
    """
    first, last = edges.first, edges.last
    into = ~edges.led_in & (toolpath.start_um[first] != edges.start_um).any(axis=1)
    out = ~edges.led_out & ((toolpath.end_um[last] != edges.end_um).any(axis=1) | ~edges.is_left)
    lead_in = _lines(toolpath.start_um[first[into]], edges.start_um[into])
    lead_out = _lines(edges.end_um[out], toolpath.end_um[last[out]])
    return [
        _Rows(lead_in, first[into], Made.LEAD, _LEAD_IN),
        _Rows(lead_out, last[out], Made.LEAD, _LEAD_OUT),
    ]


def _continued(curves: Curves) -> Curves:
    """Curves of which each line and jump begins where the one before it ends."""
    off = (curves.start_um[1:] != curves.end_um[:-1]).any(axis=1) & ~curves.is_arc[1:]
    late = np.flatnonzero(off) + 1
    start, length = curves.start_um.copy(), curves.length_um.copy()
    start[late] = curves.end_um[late - 1]
    length[late] = _lines(start[late], curves.end_um[late]).length_um
    return replace(curves, start_um=start, length_um=length)


def _lines(start_um: Floats, end_um: Floats) -> Curves:
    """Lines between places; a line that is nothing but rounding gets the length 0."""
    lines = curves_between(start_um, end_um, np.full_like(start_um, np.nan), np.zeros(len(start_um)))
    return replace(lines, length_um=np.where(lines.length_um > NOTHING_UM, lines.length_um, 0.0))
