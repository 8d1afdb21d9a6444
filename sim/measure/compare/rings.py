"""What the wire's path cuts along each edge: its passes, each closed one cut to one turn, and the leads beside them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely

from parser.drawing.model import running
from parser.findings.errors import SettingsError
from parser.geometry.along import outline
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import feet
from parser.shape.contours import CLOSED_WITHIN_UM, contour_rows
from parser.shape.passes import Pass, Passes, find_passes
from parser.toolpath import Toolpath

MOST_CONTOURS = 2_000
"""Contours of a program that are compared: overlapping ones cost some 0.04 s each."""
MOST_PASSES = 10_000
"""Passes over all of them: five over each of the most contours."""


class PathLoop(NamedTuple):
    """One closed loop: its curves, end to start, and the block of each; `part_side` +1 with the part on the left."""

    curves: Curves
    block: Ints
    part_side: int


class PathPass(NamedTuple):
    """One pass over an edge: its curves and the block of each; `sense` is −1 where it runs against the first one."""

    curves: Curves
    block: Ints
    sense: int


class PathEdge(NamedTuple):
    """What the wire cuts along one edge.

    Attributes
    ----------
    passes
        In the order they are cut.
    loop
        The way round of the last of them, of the last one over the tab too, run as the first pass; gaps are bridged.
    part_side
        +1 with the part on the left of the loop, −1 on the right, 0 where no lead-in tells.
    contours
        Numbers of the contours that they are cut in.
    """

    passes: tuple[PathPass, ...]
    loop: PathPass
    part_side: int
    contours: Ints

    @property
    def block(self) -> Ints:
        """Blocks of all passes."""
        return np.concatenate([pass_.block for pass_ in self.passes])

    @property
    def last_blocks(self) -> tuple[int, int]:
        """The first and the last block of the last way round."""
        return int(self.loop.block.min()), int(self.loop.block.max())


class Rings(NamedTuple):
    """Edges of a program; `leads` is cut beside any pass over them, by which blocks and in which contours (m,).

    `open_blocks` are the first and last blocks of contours that close no loop.
    """

    rings: tuple[PathEdge, ...]
    leads: Curves
    lead_block: Ints
    lead_contour: Ints
    open_blocks: tuple[tuple[int, int], ...]


def rings_of(toolpath: Toolpath) -> Rings:
    """Edges of all contours, the leads beside them, and the contours without one.

    SettingsError where there are more than `MOST_CONTOURS` edges or `MOST_PASSES` passes.
    """
    found = find_passes(toolpath)
    edges = _by_edge(found)
    _refuse_too_many(edges)
    block, contour = toolpath.source.block, contour_rows(toolpath)
    rings, open_blocks, within = [], [], []
    leads: list[PathPass] = []
    for passes in edges:
        if not _is_ring(passes):
            open_blocks.append((int(block[passes[0].first]), int(block[passes[0].last])))
            continue
        made, rests = zip(*(_path(toolpath, pass_) for pass_ in passes), strict=True)
        contours = contour[[pass_.first for pass_ in passes]]
        rings.append(PathEdge(made, _way_round(passes, made), _part_side(passes), np.unique(contours)))
        leads += rests
        within += [np.full(len(rest.block), of) for rest, of in zip(rests, contours.tolist(), strict=True)]
    led = np.concatenate([ring.contours for ring in rings]) if rings else np.empty(0, dtype=np.int64)
    is_lead = (found.of_row < 0) & (contour >= 0) & np.isin(contour, led)
    leads.append(PathPass(toolpath.picked(is_lead), block[is_lead], 1))
    return Rings(
        rings=tuple(rings),
        leads=joined([lead.curves for lead in leads]),
        lead_block=np.concatenate([lead.block for lead in leads]),
        lead_contour=np.concatenate([*within, contour[is_lead]]),
        open_blocks=tuple(open_blocks),
    )


def _by_edge(found: Passes) -> list[list[Pass]]:
    """The passes over each edge."""
    edges: dict[int, list[Pass]] = {}
    for pass_ in found.passes:
        edges.setdefault(pass_.edge, []).append(pass_)
    return list(edges.values())


def _is_ring(passes: Sequence[Pass]) -> bool:
    return len(passes) > 1 or passes[0].is_closed


def _refuse_too_many(edges: Sequence[Sequence[Pass]]) -> None:
    rings = [len(passes) for passes in edges if _is_ring(passes)]
    if len(rings) > MOST_CONTOURS:
        raise SettingsError("too-many-contours", found=len(rings), most=MOST_CONTOURS)
    if sum(rings) > MOST_PASSES:
        raise SettingsError("too-many-passes", found=sum(rings), most=MOST_PASSES)


def _path(toolpath: Toolpath, pass_: Pass) -> tuple[PathPass, PathPass]:
    """The path of a pass, one turn of it where it closes, and what is cut behind that turn."""
    row = np.arange(pass_.first, pass_.last + 1)
    block, sense = toolpath.source.block[row], -1 if pass_.is_back else 1
    if not pass_.is_closed:
        return PathPass(toolpath.picked(row), block, sense), PathPass(toolpath.picked(row[:0]), block[:0], sense)
    alone = pass_.first == pass_.last
    to_start, rest = _parted(toolpath.picked(row[-1:]), toolpath.start_um[pass_.first], alone=alone)
    ring = PathPass(joined([toolpath.picked(row[:-1]), to_start]), block, sense)
    return ring, PathPass(rest, block[len(row) - len(rest) :], sense)


def _part_side(passes: Sequence[Pass]) -> int:
    """Side of the part along the first pass over an edge, told by the first pass that has one."""
    told_passes = (-pass_.part_side if pass_.is_back else pass_.part_side for pass_ in passes)
    return next((side for side in told_passes if side), 0)


def _way_round(passes: Sequence[Pass], made: Sequence[PathPass]) -> PathPass:
    """The last pass all along the edge, and the last one over the tab behind it, run as the first pass."""
    last = [
        max((at for at, pass_ in enumerate(passes) if pass_.is_tab == is_tab), default=None) for is_tab in (False, True)
    ]
    ahead = [_ahead(made[at]) for at in last if at is not None]
    if len(ahead) == 1:
        return ahead[0]
    return PathPass(joined([each.curves for each in ahead]), np.concatenate([each.block for each in ahead]), 1)


def _ahead(path_pass: PathPass) -> PathPass:
    """A pass, turned round where it runs against the first one."""
    if path_pass.sense > 0:
        return path_pass
    back = np.arange(len(path_pass.curves))[::-1]
    return PathPass(running(path_pass.curves, back, np.ones(len(back), dtype=np.bool_)), path_pass.block[::-1], 1)


def polygon(curves: Curves) -> shapely.Polygon:
    """Outline of a closed chain as a polygon; an empty one where it has no inside."""
    corners = outline(curves)
    return shapely.Polygon(corners) if len(corners) > 2 else shapely.Polygon()


def orientation(curves: Curves) -> int:
    """+1 of a closed chain that runs counter-clockwise, −1 clockwise."""
    x, y = (outline(curves) - curves.start_um[0]).T
    return 1 if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) >= 0.0 else -1


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
