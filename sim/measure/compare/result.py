"""What a comparison says: the cut edge, how far off it is and where, and the strips between it and the drawing.

The cut edge: where the part ends once the program is cut, curve by curve with the blocks that make it.

The strips between the edge of a cut and its drawing, where they lie farther apart than is allowed, and the sizes that
are off.
"""

from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
import shapely

from parser.drawing.model import Drawing
from parser.findings.catalogue import Remark
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints, extents, joined
from parser.geometry.distance import feet
from parser.toolpath import Point
from sim.cut.sizes import Sizes
from sim.measure.compare.directed import Directed
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.starts import Placement, laid_loops
from sim.measure.compare.unreachable import Reachable, Unreachable
from sim.setup.part import SharpCorners


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


class FitRequest(NamedTuple):
    """How an edge is to be held against a drawing.

    Attributes
    ----------
    tolerance_um
        Largest deviation that passes.
    fitted
        Whether the drawing is turned and shifted on to the edge; else it is taken as it lies.
    sharp_corners
        Whether what the wire must leave in sharp inside corners is told apart, or fails.
    """

    tolerance_um: float
    fitted: bool = True
    sharp_corners: SharpCorners = "tell"


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """A cut edge beside a drawing.

    Attributes
    ----------
    edge, drawing
        What was compared.
    target, laid
        What the edge is held against: the drawing's curves, with a fillet in each inside corner that the wire cannot
        reach where these do not fail; and they in the program's coordinates.
    request
        How they were held against each other.
    placement
        Where the drawing lies in the program's coordinates.
    scale
        How many times as large as the drawing the program is, by a slip of units; 1 without. Nothing is scaled.
    edge_to_drawing, drawing_to_edge
        Distances of the edge's curves from the drawing, and of the drawing's from the edge.
    edge_side, drawing_side
        (n,) of each of these largest distances: +1 where material is left there, −1 where the part is gouged, 0 where
        that is not known.
    gouges
        Leads that cut into the part by more than the tolerance.
    unreachable
        The sharp inside corners that the wire cannot reach, in the program's coordinates.
    names
        What is wrong as a whole, such as a slip of units.
    notes
        What was assumed or left out.
    """

    edge: Edge
    drawing: Drawing
    target: Reachable
    laid: Curves
    request: FitRequest
    placement: Placement
    scale: float
    edge_to_drawing: Directed
    drawing_to_edge: Directed
    edge_side: Floats
    drawing_side: Floats
    gouges: tuple[LeadGouge, ...]
    unreachable: tuple[Unreachable, ...]
    names: tuple[Remark, ...]
    notes: tuple[Remark, ...]

    @property
    def deepest(self) -> LeadGouge | None:
        """The deepest gouge where it is deeper than the edge lies from the drawing anywhere."""
        gouge = max(self.gouges, key=lambda gouge: gouge.depth_um, default=None)
        return gouge if gouge and gouge.depth_um > self.edge_to_drawing.max_um.max() else None

    @property
    def edge_max_um(self) -> float:
        """How far the edge lies from the drawing at most, gouges of leads among it."""
        gouge = self.deepest
        return gouge.depth_um if gouge else float(self.edge_to_drawing.max_um.max())

    @property
    def max_um(self) -> float:
        """The largest deviation, of both directions."""
        return max(self.edge_max_um, float(self.drawing_to_edge.max_um.max()))

    @property
    def passes(self) -> bool:
        """Whether nothing deviates by more than the tolerance, and units agree."""
        return self.max_um <= self.request.tolerance_um and self.scale == 1.0


class CornerPlace(NamedTuple):
    """A sharp inside corner that the wire cannot reach, in the program's coordinates.

    Attributes
    ----------
    where_um
        The deepest place of it, on the drawing.
    depth_um
        How far that lies from what the wire can leave.
    angle_rad
        Between its two sides.
    block, entity
        The block that cuts nearest to it, and the number of the drawing's entity there, from 0.
    """

    where_um: Point
    depth_um: float
    angle_rad: float
    block: int
    entity: int


class WorstPlace(NamedTuple):
    """One of the worst places.

    Attributes
    ----------
    deviation_um
        How far edge and drawing are apart there.
    side
        +1 material left, −1 gouged, 0 not known.
    where_um
        In the program's coordinates: on the edge, or on the drawing where that is measured from.
    block
        The block that cuts there, or nearest to it.
    entity
        Number of the drawing's entity there, from 0; −1 of a gouge by a lead.
    measured_from
        ``edge``, ``drawing`` or ``lead``.
    """

    deviation_um: float
    side: int
    where_um: Point
    block: int
    entity: int
    measured_from: str


_PARTS: Final = 64
"""Of a curve of the edge, at most."""
_PART_UM: Final = 250.0


class Strips(NamedTuple):
    """Strips between an edge and a drawing, in the program's coordinates; one for each curve of the edge that is off.

    Attributes
    ----------
    drawn
        The drawing's loops as they are laid on the part.
    edge_um, foot_um
        (k, 2) places along the edge, and the nearest ones of what it was held against.
    strip
        (k,) which strip each place is of, rising.
    side
        (k,) −1 where the part is gouged, +1 where material is left.
    tolerance_um
        What may be off.
    """

    drawn: tuple[Curves, ...]
    edge_um: Floats
    foot_um: Floats
    strip: Ints
    side: Ints
    tolerance_um: float

    @property
    def widest_um(self) -> float:
        """Width of the widest strip."""
        return float(np.hypot(*(self.edge_um - self.foot_um).T).max())


def strips_of(comparison: Comparison) -> Strips | None:
    """The strips of a comparison; None where the edge is nowhere off, or it is not known to which side."""
    found, edge = comparison.edge_to_drawing, comparison.edge.curves
    is_off = (found.max_um > comparison.request.tolerance_um) & (comparison.edge_side != 0.0)
    rows = np.flatnonzero(is_off)
    if not len(rows):
        return None
    parts = np.clip(np.ceil(edge.length_um[rows] / _PART_UM), 2, _PARTS).astype(np.int64)
    strip = np.repeat(np.arange(len(rows)), parts + 1)
    number = np.arange(len(strip)) - np.searchsorted(strip, strip)
    place = places(edge, rows[strip], number / parts[strip])
    foot = feet(comparison.laid, nearest(indexed(comparison.laid), place).row, place).place_um
    side = comparison.edge_side[rows].astype(np.int64)[strip]
    drawn = tuple(laid_loops(comparison.drawing, comparison.placement))
    return Strips(drawn, place, foot, strip, side, comparison.request.tolerance_um)


_MOST_APART: Final = 0.25
"""Of a size as cut: the one that is drawn lies no farther from it, and differs by no more."""


class OffSize(NamedTuple):
    """A size as cut and as drawn, µm."""

    cut_um: float
    drawn_um: float


class OffSizes(NamedTuple):
    """Sizes that are off the drawing by more than its tolerance, None where one is not: in the order of `Sizes`.

    Attributes
    ----------
    widths
        Of each box, along X and along Y.
    radii
        Of each arc.
    """

    widths: tuple[tuple[OffSize | None, ...], ...]
    radii: tuple[OffSize | None, ...]


def off_sizes(strips: Strips, sizes: Sizes) -> OffSizes:
    """The sizes that are off, each held against the loop or the arc that is drawn nearest to it."""
    boxes = np.array([[*box.center_um, *box.cut_um] for box in sizes.boxes]).reshape(-1, 4)
    arcs = np.array([[*arc.center_um, arc.cut_um] for arc in sizes.radii]).reshape(-1, 3)
    widths = _off(boxes, _drawn_boxes(strips.drawn), strips.tolerance_um)
    radii = _off(arcs, _drawn_arcs(strips.drawn), strips.tolerance_um)
    return OffSizes(widths, tuple(radius for (radius,) in radii))


def _drawn_boxes(loops: tuple[Curves, ...]) -> Floats:
    """Centres and widths (k, 4) µm of the boxes round loops."""
    if not loops:
        return np.empty((0, 4))
    first = np.cumsum([0, *map(len, loops[:-1])])
    low, high = extents(joined(loops))
    low, high = np.minimum.reduceat(low, first), np.maximum.reduceat(high, first)
    return np.hstack([(low + high) / 2.0, high - low])


def _drawn_arcs(loops: tuple[Curves, ...]) -> Floats:
    """Centres and radii (k, 3) µm of the arcs of loops."""
    if not loops:
        return np.empty((0, 3))
    curves = joined(loops)
    return np.column_stack([curves.center_um, curves.radius_um])[curves.is_arc]


def _nearest_drawn(cut: Floats, drawn: Floats) -> Floats:
    """Sizes (n, d) drawn beside those that are cut, NaN where there are none; rows are a centre (2,) and sizes (d,).

    All are µm.
    """
    nearest_um = np.full_like(cut[:, 2:], np.nan)
    within = _MOST_APART * cut[:, 2:].min(axis=1, initial=np.inf)
    tree = shapely.STRtree(list(shapely.points(drawn[:, :2])))  # type: ignore[arg-type]
    of, at = tree.query(shapely.points(cut[:, :2]), predicate="dwithin", distance=within)
    apart = np.hypot(*(cut[of, :2] - drawn[at, :2]).T) + np.abs(cut[of, 2:] - drawn[at, 2:]).max(axis=1, initial=0.0)
    farthest_first = np.argsort(-apart, kind="stable")
    farthest_first = farthest_first[(apart <= within[of])[farthest_first]]
    nearest_um[of[farthest_first]] = drawn[at[farthest_first], 2:]  # the nearest comes last, and stays
    return nearest_um


def _off(cut: Floats, drawn: Floats, tolerance_um: float) -> tuple[tuple[OffSize | None, ...], ...]:
    """Of each row of centre and sizes that is cut, its sizes that are off those drawn beside it."""
    nearest_um = _nearest_drawn(cut, drawn)
    is_off = np.abs(cut[:, 2:] - nearest_um) > tolerance_um
    rows = zip(cut[:, 2:].tolist(), nearest_um.tolist(), is_off.tolist(), strict=True)
    return tuple(
        tuple(OffSize(each, other) if differs else None for each, other, differs in zip(*row, strict=True))
        for row in rows
    )
