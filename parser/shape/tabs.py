"""Tabs that another contour cuts: the edge was left open, and the wire comes back to it after a jump."""

import numpy as np

from parser.geometry.boxes import distinct
from parser.geometry.broad_phase_places import near_places
from parser.geometry.curves import Ints
from parser.geometry.distance import distance_to_curves
from parser.shape.contours import runs
from parser.shape.open_edges import AT_END_UM, Section, sections_elsewhere
from parser.toolpath import Toolpath


def cut_elsewhere(
    toolpath: Toolpath, contour: Ints, sections: dict[int, list[Section]], wanted: Ints
) -> dict[int, tuple[int, list[Section]]]:
    """Of the contours `wanted` those that cut a tab, each with the contour that left it and with its own sections.

    `contour` (n,) is each row's; `sections` are those of the contours that leave an edge open.
    """
    bounds = [(first, past) for first, past in runs(toolpath).tolist()]
    left = [at for at, several in sections.items() if not any(section.is_tab for section in several)]
    rows = np.flatnonzero(np.isin(contour, wanted))
    if not left or not len(rows):
        return {}
    found: dict[int, tuple[int, list[Section]]] = {}
    for number, at in zip(*_at_both_ends(toolpath, rows, contour, [sections[at][-1] for at in left]), strict=True):
        section = sections[left[number]][-1]
        edge = np.arange(section.first, section.last + 1)
        several = sections_elsewhere(toolpath, bounds[at], edge)
        if bounds[at][0] > section.last and any(one.is_tab for one in several):
            found[at] = left[number], several
    return found


def _at_both_ends(toolpath: Toolpath, rows: Ints, contour: Ints, edges: list[Section]) -> tuple[list[int], list[int]]:
    """Which edge, and which contour: pairs of which a row of `rows` (r,) comes near both ends of the edge."""
    first, last = (np.array([getattr(edge, end) for edge in edges], dtype=np.int64) for end in ("first", "last"))
    place = np.concatenate([toolpath.start_um[first], toolpath.end_um[last]])
    curves = toolpath.picked(rows)
    near = near_places(curves, place, AT_END_UM)
    off, _ = distance_to_curves(curves, near.row, place[near.other, 0], place[near.other, 1])
    near = near.take(np.flatnonzero(off <= AT_END_UM))
    base = int(contour.max()) + 1
    edge, is_last = near.other % len(edges), near.other // len(edges)
    pair = distinct((edge * base + contour[rows[near.row]]) * 2 + is_last) // 2
    both = pair[:-1][pair[1:] == pair[:-1]]
    return (both // base).tolist(), (both % base).tolist()
