"""Lay a drawing on a cut edge, measure both ways, and name what is wrong as a whole."""

from collections.abc import Iterator

import numpy as np

from parser.drawing.model import Drawing
from parser.findings.errors import DrawingError
from parser.findings.remarks import Remark
from parser.geometry.curves import Curves
from parser.text.encoding import printable
from parser.toolpath import Point
from sim.measure.compare.consensus import settled
from sim.measure.compare.directed import directed
from sim.measure.compare.edge import Edge
from sim.measure.compare.fit import fit
from sim.measure.compare.nearest import indexed
from sim.measure.compare.placement import IN_PLACE, Placement, placed, turning
from sim.measure.compare.result import Asked, Comparison
from sim.measure.compare.sides import drawing_sides, edge_sides, part_sides
from sim.measure.compare.slips import unit_slip
from sim.measure.compare.unreachable import Reachable, Unreachable, as_drawn, reachable

_MOST_LAYERS = 8  # named one by one


def compare(edge: Edge, drawing: Drawing, asked: Asked) -> Comparison:
    """The edge against the drawing, one curve or more each.

    The wire leaves fillets in sharp inside corners. Where these are told apart, the edge is held against the drawing
    with the fillets; where they fail, against the drawing as it is. Raises DrawingError where that is too much work.
    """
    try:
        return _compare(edge, drawing, asked)
    except DrawingError as error:
        raise DrawingError(f"{printable(drawing.name)}: {error}") from None


def _compare(edge: Edge, drawing: Drawing, asked: Asked) -> Comparison:
    whole = as_drawn(drawing)
    index, of_edge = indexed(whole.curves), indexed(edge.curves)
    as_it_is = fit(edge.curves, edge.loop, index, whole.loop) if asked.fitted else None
    placement = as_it_is.placement if as_it_is else IN_PLACE
    rolled = reachable(drawing, part_sides(edge, of_edge, drawing, placement), edge.reach_um)
    target = rolled if asked.sharp_corners == "tell" else whole
    if as_it_is:
        placement = settled(edge, target, placement, asked.tolerance_um)
    laid = placed(target.curves, placement)
    there, back = directed(edge.curves, indexed(laid)), directed(laid, of_edge)
    slip = unit_slip(edge.curves, edge.loop, index, whole.loop, as_it_is)
    gouges = tuple(gouge for gouge in edge.gouges if gouge.depth_um > asked.tolerance_um)
    names = [slip.remark] if slip else _posed(placement, edge.curves, asked.tolerance_um)
    names += [Remark("lead-in-part", {"block": gouge.block, "depth": gouge.depth_um}) for gouge in gouges]
    return Comparison(
        edge=edge,
        drawing=drawing,
        target=target,
        laid=laid,
        asked=asked,
        placement=placement,
        scale=slip.scale if slip else 1.0,
        edge_to_drawing=there,
        drawing_to_edge=back,
        edge_side=edge_sides(edge, laid, there),
        drawing_side=drawing_sides(edge, back),
        gouges=gouges,
        unreachable=_where_laid(rolled, placement),
        names=tuple(names),
        notes=(*edge.notes, *_of_drawing(drawing), *_of_corners(target)),
    )


def _where_laid(rolled: Reachable, placement: Placement) -> tuple[Unreachable, ...]:
    """The places that the wire cannot reach, in the program's coordinates."""
    matrix, shift = turning(placement.turn_rad, mirror=placement.mirror), np.array(placement.shift_um)
    return tuple(
        place._replace(where_um=Point(*(matrix @ np.array(place.where_um) + shift).tolist()))
        for place in rolled.unreachable
    )


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


def _of_corners(target: Reachable) -> Iterator[Remark]:
    """That some of the drawing is not held against the edge."""
    if target.unreachable:
        deepest = max(corner.depth_um for corner in target.unreachable)
        yield Remark("sharp-corners", {"number": len(target.unreachable), "depth": deepest})


def _posed(placement: Placement, edge: Curves, tolerance_um: float) -> list[Remark]:
    """What is to be said of how the drawing had to be laid; a turn that moves no place past the tolerance is none."""
    names = []
    if placement.mirror:
        names.append(Remark("mirrored"))
    size = float(np.ptp(edge.start_um, axis=0).max())
    if abs(placement.turn_rad) * size > tolerance_um:
        names.append(Remark("turned", {"turn_deg": float(np.degrees(placement.turn_rad))}))
    return names
