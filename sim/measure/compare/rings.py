"""The closed loops of a program's contours, each cut to one turn, and what is cut before and behind them."""

from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.geometry.feet import feet
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.shape.contours import contour_rows
from parser.shape.loops import find_loops
from parser.toolpath import Toolpath

_SAGITTA_UM = 0.05  # of the chords of an outline


class PathLoop(NamedTuple):
    """One closed loop of the wire's path: its curves, end to start, and the block of each.

    `part_side` is +1 with the part on the left, −1 on the right, 0 where no lead-in tells.
    """

    curves: Curves
    block: Ints
    part_side: int


class Rings(NamedTuple):
    """Loops of a program; `leads` is cut outside of any of them, `lead_block` (m,) tells by which blocks.

    `open_blocks` are the first and last blocks of contours that close no loop.
    """

    rings: tuple[PathLoop, ...]
    leads: Curves
    lead_block: Ints
    open_blocks: tuple[tuple[int, int], ...]


def rings_of(toolpath: Toolpath) -> Rings:
    """Loops of all contours, the leads beside them, and the contours without one."""
    contour = contour_rows(toolpath)
    loops = find_loops(toolpath, contour, np.arange(contour.max(initial=-1) + 1))
    block = toolpath.source.block
    rings, leads, on_leads = [], [], []
    for first, last, side in zip(loops.first.tolist(), loops.last.tolist(), loops.part_side.tolist(), strict=True):
        row = np.arange(first, last + 1)
        to_start, beyond = _parted(toolpath.picked(row[-1:]), toolpath.start_um[first], alone=first == last)
        rings.append(PathLoop(joined([toolpath.picked(row[:-1]), to_start]), block[row], side))
        leads.append(beyond)
        on_leads.append(block[row[len(row) - len(beyond) :]])
    is_lead = np.isin(contour, loops.contour)
    is_lead &= ~_within(len(toolpath), loops.first, loops.last)
    leads.append(toolpath.picked(is_lead))
    on_leads.append(block[is_lead])
    return Rings(tuple(rings), joined(leads), np.concatenate(on_leads), _open(contour, loops.contour, block))


def outline(curves: Curves) -> Floats:
    """Places (m, 2) along a closed chain of curves, on arcs so many that their chords lie 0.05 µm off at most."""
    radius = np.where(curves.is_arc, curves.radius_um, 1.0)
    step = np.sqrt(8.0 * _SAGITTA_UM / np.maximum(radius, _SAGITTA_UM))
    parts = np.maximum(np.ceil(np.abs(curves.sweep_rad) / step), 1.0).astype(np.int64)
    parts[curves.is_arc] = np.maximum(parts[curves.is_arc], 3)
    row = np.repeat(np.arange(len(curves)), parts)
    at = np.arange(len(row)) - (np.cumsum(parts) - parts)[row]
    return places(curves, row, at / parts[row])


def polygon(curves: Curves) -> shapely.Polygon:
    """Outline of a closed chain as a polygon; an empty one where it has no inside."""
    corners = outline(curves)
    return shapely.Polygon(corners) if len(corners) > 2 else shapely.Polygon()


def orientation(curves: Curves) -> int:
    """+1 of a closed chain that runs counter-clockwise, −1 clockwise."""
    x, y = (outline(curves) - curves.start_um[0]).T
    return 1 if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) >= 0.0 else -1


def _within(n: int, first: Ints, last: Ints) -> NDArray[np.bool_]:
    """(n,) True on rows from `first` to `last` of any loop."""
    edges = np.zeros(n + 1, dtype=np.int64)
    np.add.at(edges, first, 1)
    np.add.at(edges, last + 1, -1)
    within: NDArray[np.bool_] = np.cumsum(edges[:-1]) > 0
    return within


def _parted(curves: Curves, place_um: Floats, *, alone: bool) -> tuple[Curves, Curves]:
    """One curve up to its foot of a place, and the rest of it; `alone` it is a loop by itself, of a whole turn."""
    if not alone and np.hypot(*(curves.end_um[0] - place_um)) <= CLOSED_WITHIN_UM:
        return curves, curves.picked(slice(0, 0))
    foot = feet(curves, np.zeros(1, dtype=np.int64), place_um[None])
    sweep = float(curves.sweep_rad[0])
    turned = float(np.clip(sweep, -2.0 * np.pi, 2.0 * np.pi)) if alone else float(foot.angle_rad[0])
    if sweep and not alone:
        turned -= float(curves.start_angle_rad[0])
    middle = curves.end_um if alone and turned == sweep else foot.place_um
    starts, ends = np.concatenate([curves.start_um, middle]), np.concatenate([middle, curves.end_um])
    both = curves_between(starts, ends, curves.center_um[[0, 0]], np.array([turned, sweep - turned]))
    rest = both.length_um[1] > CLOSED_WITHIN_UM
    return both.picked(slice(0, 1)), both.picked(slice(1, 2) if rest else slice(0, 0))


def _open(contour: Ints, closed: Ints, block: Ints) -> tuple[tuple[int, int], ...]:
    """First and last blocks of the contours that are not among the closed ones."""
    numbers = np.setdiff1d(contour[contour >= 0], closed).tolist()
    return tuple((int(block[contour == of][0]), int(block[contour == of][-1])) for of in numbers)
