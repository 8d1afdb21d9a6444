"""On which side of a curve the part lies, of the edge and of the drawing beside it."""

import numpy as np

from parser.drawing.model import Drawing, running
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.directions import headings, headings_at
from parser.geometry.feet import feet
from sim.measure.compare.directed import Directed
from sim.measure.compare.edge import Edge
from sim.measure.compare.nearest import Index, nearest
from sim.measure.compare.placement import Placement, placed
from sim.measure.compare.spread import spread

_PLACES = 400  # of a drawn loop
_BESIDE = 4.0  # times the wire's reach: how far an edge may lie from the loop that it is of, on its wrong side too


def part_sides(edge: Edge, index: Index, drawing: Drawing, placement: Placement) -> Ints:
    """Side (k,) of the part along each closed loop of the drawing: +1 left, −1 right, 0 where no edge lies beside it.

    The index is that of the edge. Loops are run as the drawing has them, counter-clockwise before they are mirrored.
    """
    sides = []
    for loop in (each for each in drawing.loops if each.closed):
        ring = placed(running(drawing.curves, loop.row, loop.backwards), placement)
        at = spread(ring, _PLACES)
        near = nearest(index, at.place_um)
        foot = feet(edge.curves, near.row, at.place_um).place_um
        along = (headings_at(ring, at.row, at.place_um) * headings_at(edge.curves, near.row, foot)).sum(axis=1)
        told = np.where(
            near.distance_um <= _BESIDE * edge.reach_um, at.weight_um * along * edge.part_side[near.row], 0.0
        )
        sides.append(int(np.sign(told.sum())) * (-1 if placement.mirror else 1))
    return np.array(sides, dtype=np.int64)


def edge_sides(edge: Edge, laid: Curves, there: Directed) -> Floats:
    """Sides (n,) of the largest distance of each curve of the edge."""
    row = np.arange(len(edge.curves))
    foot = feet(laid, there.other, there.where_um).place_um
    return _sides(headings(edge.curves, row, there.fraction), edge.part_side, there.where_um - foot)


def drawing_sides(edge: Edge, back: Directed) -> Floats:
    """Sides (n,) of the largest distance of each curve of the drawing."""
    foot = feet(edge.curves, back.other, back.where_um).place_um
    heading = headings_at(edge.curves, back.other, foot)
    return _sides(heading, edge.part_side[back.other], foot - back.where_um)


def _sides(heading: Floats, part_side: Ints, from_drawing: Floats) -> Floats:
    """+1 where the edge lies outside of the drawing's part, −1 inside: moved on to the side where the part lies."""
    to_left = heading[:, 0] * from_drawing[:, 1] - heading[:, 1] * from_drawing[:, 0]
    return -np.sign(to_left) * part_side
