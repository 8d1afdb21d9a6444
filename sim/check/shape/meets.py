"""Places where the curves of blocks meet: lines and circles, each pair in closed form."""

from typing import NamedTuple

import numpy as np

from parser.toolpath import Floats, Ints, Toolpath

CLEAR_UM = 5.0
"""Both ends of each block lie this far, measured across the other block; two curves overlap this far at their lens."""


class Meets(NamedTuple):
    """Places (k, 2) where the curves of two rows (k,), lines and circles prolonged, meet."""

    early: Ints
    late: Ints
    place_um: Floats

    def take(self, at: Ints) -> "Meets":
        """Those at the indices `at`."""
        return Meets(self.early[at], self.late[at], self.place_um[at])


def curves_meet(toolpath: Toolpath, early: Ints, late: Ints) -> Meets:
    """Places where the curves of pairs of rows meet, those of each kind of pair after the other."""
    arcs = toolpath.is_arc[early].astype(np.int64) + toolpath.is_arc[late]
    parts = [Meets(early[:0], late[:0], np.empty((0, 2)))]
    for number, meet in enumerate((_lines_meet, _line_and_arc_meet, _arcs_meet)):
        which = np.flatnonzero(arcs == number)
        if len(which):
            parts.append(meet(toolpath, early[which], late[which]))
    early, late = (np.concatenate(rows) for rows in ([p.early for p in parts], [p.late for p in parts]))
    return Meets(early, late, np.concatenate([p.place_um for p in parts]))


def _lines_meet(toolpath: Toolpath, early: Ints, late: Ints) -> Meets:
    """Where lines meet inside both: most pairs that are near each other do not, and end here."""
    ax, ay = by_xy(toolpath, early)
    bx, by = by_xy(toolpath, late)
    gap_x = toolpath.start_um[late, 0] - toolpath.start_um[early, 0]
    gap_y = toolpath.start_um[late, 1] - toolpath.start_um[early, 1]
    cross = ax * by - ay * bx
    inverse = 1.0 / np.where(cross == 0.0, np.inf, cross)
    on_a, on_b = (gap_x * by - gap_y * bx) * inverse, (gap_x * ay - gap_y * ax) * inverse
    inside = np.flatnonzero((on_a > 0.0) & (on_a < 1.0) & (on_b > 0.0) & (on_b < 1.0))
    a, share = early[inside], on_a[inside, None]
    return Meets(a, late[inside], toolpath.start_um[a] + share * (toolpath.end_um[a] - toolpath.start_um[a]))


def by_xy(toolpath: Toolpath, row: Ints) -> tuple[Floats, Floats]:
    """Ways (k,) µm in X and in Y from the start to the end of rows (k,)."""
    start, end = toolpath.start_um, toolpath.end_um
    return end[:, 0][row] - start[:, 0][row], end[:, 1][row] - start[:, 1][row]


def _line_and_arc_meet(toolpath: Toolpath, early: Ints, late: Ints) -> Meets:
    early_is_arc = toolpath.is_arc[early]
    line, arc = np.where(early_is_arc, late, early), np.where(early_is_arc, early, late)
    by = np.stack(by_xy(toolpath, line), axis=1)
    way = by / np.hypot(by[:, 0], by[:, 1])[:, None]
    to_center = toolpath.center_um[arc] - toolpath.start_um[line]
    radius = toolpath.radius_um[arc]
    off = np.abs(way[:, 0] * to_center[:, 1] - way[:, 1] * to_center[:, 0])
    cut = np.flatnonzero(radius - off > CLEAR_UM)
    way, to_center, radius, off = way[cut], to_center[cut], radius[cut], off[cut]
    foot = toolpath.start_um[line[cut]] + way * (way * to_center).sum(axis=1)[:, None]
    half = way * np.sqrt((radius - off) * (radius + off))[:, None]
    return _both(early[cut], late[cut], foot, half)


def _arcs_meet(toolpath: Toolpath, early: Ints, late: Ints) -> Meets:
    by = toolpath.center_um[late] - toolpath.center_um[early]
    between = np.hypot(by[:, 0], by[:, 1])
    a, b = toolpath.radius_um[early], toolpath.radius_um[late]
    cut = np.flatnonzero(np.minimum(a + b - between, between - np.abs(a - b)) > CLEAR_UM)
    a, b, between = a[cut], b[cut], between[cut]
    way = by[cut] / between[:, None]
    along = 0.5 * (between + (a - b) * (a + b) / between)
    half = np.stack([-way[:, 1], way[:, 0]], axis=1) * np.sqrt((a - along) * (a + along))[:, None]
    return _both(early[cut], late[cut], toolpath.center_um[early[cut]] + way * along[:, None], half)


def _both(early: Ints, late: Ints, middle: Floats, half: Floats) -> Meets:
    return Meets(
        np.concatenate([early, early]), np.concatenate([late, late]), np.concatenate([middle - half, middle + half])
    )
