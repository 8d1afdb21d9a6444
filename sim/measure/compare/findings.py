"""A cut beside its drawing: how far the edge that the wire left lies from it, and what is wrong as a whole."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from parser.dialect.at_block import at_block
from parser.drawing.model import Drawing
from parser.findings.catalogue import Remark
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding
from parser.program import Program
from parser.text.encoding import printable
from parser.units import mm
from sim.cut.remains import Remains
from sim.measure.compare.as_cut import edge_as_cut
from sim.measure.compare.compare import compare
from sim.measure.compare.compared_program import compare_program
from sim.measure.compare.result import Comparison, FitRequest, WorstPlace
from sim.measure.compare.tables import by_block, by_entity, corner_places
from sim.setup.part import DrawingTarget

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
    try:
        exact = compare_program(program.toolpath, remains.kerf.offset_um, drawing, fit_request)
    except SettingsError:  # no edge of its own
        return found
    known = {named.name for named in found.names}
    return replace(found, names=(*found.names, *(named for named in exact.names if named.name not in known)))


def drawing_findings(program: Program, found: Comparison | None) -> Iterator[Finding]:
    """3B601 for the worst place of each direction past the tolerance, and what is wrong as a whole or of one contour.

    3B603 notes sharp inside corners. A mirrored part within the tolerance is right once it is turned over: the summary
    and the report tell of it.
    """
    if found is None:
        yield Finding("3B602", {"what": "no-edge"})
        return
    for what, places in (("edge-off", by_block(found)), ("drawing-off", by_entity(found))):
        worst = max(places, key=lambda place: place.deviation_um)
        if worst.deviation_um > found.asked.tolerance_um:
            yield _off(program, found, what, worst)
    yield from _sharp_corners(program, found)
    if found.passes:
        return
    for named in found.names:
        if named.name in _WHOLE:
            yield Finding("3B602", {"what": named.name})
        elif named.name in _CONTOUR:
            yield _contour(program, found, named)


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
        return at_block(program.toolpath, program.lines, "3B605", row, tolerance=found.asked.tolerance_um, **values)
    return at_block(program.toolpath, program.lines, "3B604", row, what=named.name, **values)


def _row(program: Program, block: int) -> int:
    return int(np.flatnonzero(program.toolpath.source.block == block)[0])


def _off(program: Program, found: Comparison, what: str, place: WorstPlace) -> Finding:
    entity = found.drawing.entities[place.entity] if place.entity >= 0 else None
    return at_block(
        program.toolpath,
        program.lines,
        "3B601",
        _row(program, place.block),
        what=what,
        off=place.deviation_um,
        tolerance=found.asked.tolerance_um,
        x_mm=mm(place.where_um.x),
        y_mm=mm(place.where_um.y),
        entity=printable(f"{entity.kind} {entity.handle}") if entity else found.drawing.name,
    )
