"""A cut beside its drawing: how far the edge that the wire left lies from it, and what is wrong as a whole.

The worst places of a comparison, and its deviations by block and by entity of the drawing.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import at_block
from parser.drawing.model import Drawing, running
from parser.findings.catalogue import Remark
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding
from parser.geometry.curves import Floats, Ints
from parser.program import Program
from parser.text.encoding import printable
from parser.toolpath import Point
from parser.units import mm
from sim.cut.pieces.pieces import Pieces
from sim.cut.remains import Remains
from sim.measure.compare.compare import compare, compare_program
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.result import Comparison, CornerPlace, FitRequest, WorstPlace
from sim.measure.compare.rings import edge_as_cut, polygon
from sim.measure.compare.starts import placed
from sim.measure.compare.waste import with_waste
from sim.setup.part import DrawingTarget

_MOST_PLACES = 10
_APART = 0.02  # of the edge's extent: worst places lie no nearer to each other


class _Rows(NamedTuple):
    """Largest deviations (m,) of curves, leads among them, as the columns of `WorstPlace`."""

    deviation_um: Floats
    side: Floats
    where_um: Floats
    block: Ints
    entity: Ints
    measured_from: tuple[str, ...]

    def and_(self, others: "_Rows") -> "_Rows":
        """These and others behind them."""
        return _Rows(
            np.concatenate([self.deviation_um, others.deviation_um]),
            np.concatenate([self.side, others.side]),
            np.concatenate([self.where_um, others.where_um]),
            np.concatenate([self.block, others.block]),
            np.concatenate([self.entity, others.entity]),
            self.measured_from + others.measured_from,
        )

    def place(self, at: int) -> WorstPlace:
        """The entry `at`."""
        return WorstPlace(
            deviation_um=float(self.deviation_um[at]),
            side=int(self.side[at]),
            where_um=Point(*self.where_um[at].tolist()),
            block=int(self.block[at]),
            entity=int(self.entity[at]),
            measured_from=self.measured_from[at],
        )


def worst_places(of: Comparison) -> tuple[WorstPlace, ...]:
    """Up to ten of the largest deviations, apart from each other, the largest first."""
    from_edge, from_drawing = _from_edge(of), _from_drawing(of)
    rows = from_edge.and_(from_drawing)
    apart = _APART * float(np.ptp(of.edge.curves.start_um, axis=0).max())
    left = rows.deviation_um.copy()
    places: list[WorstPlace] = []
    while len(places) < _MOST_PLACES and left.max() >= 0.0:
        worst = int(np.argmax(left))
        places.append(rows.place(worst))
        left[np.hypot(*(rows.where_um - rows.where_um[worst]).T) <= apart] = -1.0
    return tuple(places)


def corner_places(of: Comparison) -> tuple[CornerPlace, ...]:
    """The sharp inside corners that the wire cannot reach, in the order of the drawing's curves."""
    if not of.unreachable:
        return ()
    near = nearest(indexed(of.edge.curves), np.array([corner.where_um for corner in of.unreachable]))
    return tuple(
        CornerPlace(corner.where_um, corner.depth_um, corner.angle_rad, block, corner.entity)
        for corner, block in zip(of.unreachable, of.edge.block[near.row].tolist(), strict=True)
    )


def by_block(of: Comparison) -> tuple[WorstPlace, ...]:
    """The largest deviation of the edge of each block that has one, in the order of the blocks."""
    rows = _from_edge(of)
    return tuple(rows.place(at) for at in _largest_of_each(rows.block, rows.deviation_um))


def by_entity(of: Comparison) -> tuple[WorstPlace, ...]:
    """The largest distance of each entity of the drawing from the edge, in the order of the entities."""
    rows = _from_drawing(of)
    return tuple(rows.place(at) for at in _largest_of_each(rows.entity, rows.deviation_um))


def _largest_of_each(key: Ints, deviation: Floats) -> list[int]:
    order = np.lexsort((np.arange(len(key)), -deviation, key))
    first: list[int] = order[np.diff(key[order], prepend=-2) != 0].tolist()
    return first


def _from_edge(of: Comparison) -> _Rows:
    there, gouges = of.edge_to_drawing, of.gouges
    return _Rows(
        np.append(there.max_um, [gouge.depth_um for gouge in gouges]),
        np.append(of.edge_side, np.full(len(gouges), -1.0)),
        np.concatenate([there.where_um, np.array([gouge.where_um for gouge in gouges]).reshape(-1, 2)]),
        np.append(of.edge.block, np.array([gouge.block for gouge in gouges], dtype=np.int64)),
        np.append(of.target.entity[there.other], np.full(len(gouges), -1)),
        ("edge",) * len(there.max_um) + ("lead",) * len(gouges),
    )


def _from_drawing(of: Comparison) -> _Rows:
    back = of.drawing_to_edge
    block = of.edge.block[back.other]
    names = ("drawing",) * len(back.max_um)
    return _Rows(back.max_um, of.drawing_side, back.where_um, block, of.target.entity, names)


_WHOLE = ("unit-slip", "mirrored", "wrong-side", "offset-missing")
"""What may be wrong with a whole program; terms of the catalogue."""
_CONTOUR = ("contour-wrong-side", "contour-offset-missing", "contour-shifted")
"""And with one contour of several."""


def compare_cut(program: Program, remains: Remains, drawing: Drawing, target: DrawingTarget) -> Comparison | None:
    """The edge as cut beside the drawing; None where nothing came free, so that there is no edge.

    Whether the offset is wrong is told by the exact path, which has another side.
    """
    edge = edge_as_cut(program.toolpath, remains.kerf, remains.pieces)
    if edge is None:
        return None
    fit_request = FitRequest(target.tolerance_um, target.fit, target.sharp_corners)
    found = compare(edge, drawing, fit_request)
    if found.passes:
        return found
    of_parts = edge_as_cut(program.toolpath, remains.kerf, _with_waste(remains, drawing, found))
    if of_parts is not None and len(of_parts.curves) < len(edge.curves):
        found = compare(of_parts, drawing, fit_request)
        if found.passes:
            return found
    try:
        exact = compare_program(program.toolpath, remains.kerf.offset_um, drawing, fit_request)
    except SettingsError:  # no edge of its own
        return found
    known = {named.name for named in found.names}
    return replace(found, names=(*found.names, *(named for named in exact.names if named.name not in known)))


def _with_waste(remains: Remains, drawing: Drawing, found: Comparison) -> Pieces:
    """The pieces, with what lies between the parts of a drawing as waste."""
    rings = [running(drawing.curves, loop.row, loop.backwards) for loop in drawing.loops if loop.closed]
    drawn = [polygon(placed(ring, found.placement)) for ring in rings]
    return with_waste(remains.pieces, drawn, 2.0 * remains.kerf.offset_um)


def drawing_findings(program: Program, found: Comparison | None) -> Iterator[Finding]:
    """3B601 for the worst place of each direction past the tolerance, and what is wrong as a whole or of one contour.

    3B603 notes sharp inside corners. A mirrored part within the tolerance is right once it is turned over: the summary
    and the report tell of it.
    """
    if found is None:
        yield Finding("3B602", {"what": "no-edge"})
        return
    for what, place in _past_tolerance(found):
        yield _off(program, found, what, place)
    yield from _sharp_corners(program, found)
    if found.passes:
        return
    for named in found.names:
        if named.name in _WHOLE:
            yield Finding("3B602", {"what": named.name})
        elif named.name in _CONTOUR:
            yield _contour(program, found, named)


def top_findings(program: Program, found: Comparison | None) -> Iterator[Finding]:
    """3B711 for the worst place of each direction past the tolerance, at the top of the work."""
    if found is None:
        return
    for what, place in _past_tolerance(found):
        yield _off(program, found, what, place, at_top=True)


def _past_tolerance(found: Comparison) -> Iterator[tuple[str, WorstPlace]]:
    """The worst place of each direction, by its term, where that lies past the tolerance."""
    for what, places in (("edge-off", by_block(found)), ("drawing-off", by_entity(found))):
        worst = max(places, key=lambda place: place.deviation_um)
        if worst.deviation_um > found.request.tolerance_um:
            yield what, worst


def _sharp_corners(program: Program, found: Comparison) -> Iterator[Finding]:
    """3B603 of the deepest of the corners that the wire cannot reach."""
    corners = corner_places(found)
    if not corners:
        return
    deepest = max(corners, key=lambda corner: corner.depth_um)
    yield at_block(
        program.toolpath,
        program.lines,
        "3B603",
        _row(program, deepest.block),
        number=len(corners),
        depth=deepest.depth_um,
        reach=found.edge.reach_um,
        angle_deg=float(np.degrees(deepest.angle_rad)),
        x_mm=mm(deepest.where_um.x),
        y_mm=mm(deepest.where_um.y),
    )


def _contour(program: Program, found: Comparison, named: Remark) -> Finding:
    """3B604 or 3B605 of a contour, at its first block."""
    values = dict(named.values)
    row = _row(program, int(values["first"]))
    if named.name == "contour-shifted":
        return at_block(program.toolpath, program.lines, "3B605", row, tolerance=found.request.tolerance_um, **values)
    return at_block(program.toolpath, program.lines, "3B604", row, what=named.name, **values)


def _row(program: Program, block: int) -> int:
    return int(np.flatnonzero(program.toolpath.source.block == block)[0])


def _off(program: Program, found: Comparison, what: str, place: WorstPlace, *, at_top: bool = False) -> Finding:
    entity = found.drawing.entities[place.entity] if place.entity >= 0 else None
    return at_block(
        program.toolpath,
        program.lines,
        "3B711" if at_top else "3B601",
        _row(program, place.block),
        what=what,
        off=place.deviation_um,
        tolerance=found.request.tolerance_um,
        x_mm=mm(place.where_um.x),
        y_mm=mm(place.where_um.y),
        entity=printable(f"{entity.kind} {entity.handle}") if entity else found.drawing.name,
    )
