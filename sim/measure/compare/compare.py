"""Lay a drawing on a cut edge, measure both ways, and name what is wrong as a whole."""

from collections.abc import Iterator

import numpy as np

from parser.drawing.model import Drawing
from parser.findings.remarks import Remark
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.directions import headings, headings_at
from parser.geometry.feet import feet
from sim.measure.compare.directed import Directed, directed
from sim.measure.compare.edge import Edge
from sim.measure.compare.fit import fit
from sim.measure.compare.nearest import indexed
from sim.measure.compare.placement import IN_PLACE, Placement, placed
from sim.measure.compare.result import Comparison
from sim.measure.compare.slips import unit_slip

_MOST_LAYERS = 8  # named one by one


def compare(edge: Edge, drawing: Drawing, tolerance_um: float, *, fitted: bool = True) -> Comparison:
    """The edge against the drawing, one curve or more each; the drawing is turned and shifted on to it if `fitted`."""
    index, loop = indexed(drawing.curves), _loop_of_row(drawing)
    as_it_is = fit(edge.curves, edge.loop, index, loop) if fitted else None
    placement = as_it_is.placement if as_it_is else IN_PLACE
    laid = placed(drawing.curves, placement)
    there, back = directed(edge.curves, indexed(laid)), directed(laid, indexed(edge.curves))
    slip = unit_slip(edge.curves, edge.loop, index, loop, as_it_is)
    gouges = tuple(gouge for gouge in edge.gouges if gouge.depth_um > tolerance_um)
    names = [slip.remark] if slip else _posed(placement, edge.curves, tolerance_um)
    names += [Remark("lead-in-part", {"block": gouge.block, "depth": gouge.depth_um}) for gouge in gouges]
    return Comparison(
        edge=edge,
        drawing=drawing,
        laid=laid,
        placement=placement,
        fitted=fitted,
        scale=slip.scale if slip else 1.0,
        edge_to_drawing=there,
        drawing_to_edge=back,
        edge_side=_edge_sides(edge, laid, there),
        drawing_side=_drawing_sides(edge, back),
        gouges=gouges,
        tolerance_um=tolerance_um,
        names=tuple(names),
        notes=(*edge.notes, *_of_drawing(drawing)),
    )


def _loop_of_row(drawing: Drawing) -> Ints:
    """Which closed loop each curve of the drawing belongs to, from 0; −1 for none."""
    loop = np.full(len(drawing.curves), -1, dtype=np.int64)
    for number, closed in enumerate(each for each in drawing.loops if each.closed):
        loop[closed.row] = number
    return loop


def _of_drawing(drawing: Drawing) -> Iterator[Remark]:
    """What its reader notes, and signs that it holds more than the contours of a part: construction lines, a frame."""
    yield from drawing.notes
    loose = sum(not loop.closed for loop in drawing.loops)
    if loose:
        yield Remark("open-chains", {"open": loose, "all": len(drawing.loops)})
    layers = sorted({entity.layer for entity in drawing.entities})
    if len(layers) > 1:
        more = ["…"] if len(layers) > _MOST_LAYERS else []
        yield Remark("all-layers", {"layers": ", ".join([*layers[:_MOST_LAYERS], *more])})


def _posed(placement: Placement, edge: Curves, tolerance_um: float) -> list[Remark]:
    """What is to be said of how the drawing had to be laid; a turn that moves no place past the tolerance is none."""
    names = []
    if placement.mirror:
        names.append(Remark("mirrored"))
    size = float(np.ptp(edge.start_um, axis=0).max())
    if abs(placement.turn_rad) * size > tolerance_um:
        names.append(Remark("turned", {"turn_deg": float(np.degrees(placement.turn_rad))}))
    return names


def _edge_sides(edge: Edge, laid: Curves, there: Directed) -> Floats:
    """Sides (n,) of the largest distance of each curve of the edge."""
    row = np.arange(len(edge.curves))
    foot = feet(laid, there.other, there.where_um).place_um
    return _sides(headings(edge.curves, row, there.fraction), edge.part_side, there.where_um - foot)


def _drawing_sides(edge: Edge, back: Directed) -> Floats:
    """Sides (n,) of the largest distance of each curve of the drawing."""
    foot = feet(edge.curves, back.other, back.where_um).place_um
    heading = headings_at(edge.curves, back.other, foot)
    return _sides(heading, edge.part_side[back.other], foot - back.where_um)


def _sides(heading: Floats, part_side: Ints, from_drawing: Floats) -> Floats:
    """+1 where the edge lies outside of the drawing's part, −1 inside: moved on to the side where the part lies."""
    to_left = heading[:, 0] * from_drawing[:, 1] - heading[:, 1] * from_drawing[:, 0]
    return -np.sign(to_left) * part_side
