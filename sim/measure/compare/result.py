"""What a comparison of a cut edge with a drawing says."""

from dataclasses import dataclass
from typing import NamedTuple

from parser.drawing.model import Drawing
from parser.findings.remarks import Remark
from parser.geometry.curves import Curves, Floats
from parser.toolpath import Point
from sim.measure.compare.directed import Directed
from sim.measure.compare.edge import Edge, LeadGouge
from sim.measure.compare.placement import Placement


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """A cut edge beside a drawing.

    Attributes
    ----------
    edge, drawing
        What was compared.
    laid
        The drawing's curves in the program's coordinates.
    placement, fitted
        Where the drawing lies in the program's coordinates, and whether it was fitted there.
    scale
        How many times as large as the drawing the program is, by a slip of units; 1 without. Nothing is scaled.
    edge_to_drawing, drawing_to_edge
        Distances of the edge's curves from the drawing, and of the drawing's from the edge.
    edge_side, drawing_side
        (n,) of each of these largest distances: +1 where material is left there, −1 where the part is gouged, 0 where
        that is not known.
    gouges
        Leads that cut into the part by more than the tolerance.
    tolerance_um
        Largest deviation that passes.
    names
        What is wrong as a whole, such as a slip of units.
    notes
        What was assumed or left out.
    """

    edge: Edge
    drawing: Drawing
    laid: Curves
    placement: Placement
    fitted: bool
    scale: float
    edge_to_drawing: Directed
    drawing_to_edge: Directed
    edge_side: Floats
    drawing_side: Floats
    gouges: tuple[LeadGouge, ...]
    tolerance_um: float
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
        return self.max_um <= self.tolerance_um and self.scale == 1.0


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
