"""What a comparison of a cut edge with a drawing says."""

from dataclasses import dataclass
from typing import NamedTuple

from parser.drawing.model import Drawing
from parser.findings.catalogue import Remark
from parser.geometry.curves import Curves, Floats
from parser.toolpath import Point
from sim.measure.compare.directed import Directed
from sim.measure.compare.edge import Edge, LeadGouge
from sim.measure.compare.starts import Placement
from sim.measure.compare.unreachable import Reachable, Unreachable
from sim.setup.part import SharpCorners


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
