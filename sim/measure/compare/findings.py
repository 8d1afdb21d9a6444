"""A cut beside its drawing: how far the edge that the wire left lies from it, and what is wrong as a whole."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from parser.dialect.at_block import at_block
from parser.drawing.model import Drawing
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding
from parser.program import Program
from parser.text.encoding import printable
from parser.units import mm
from sim.cut.pieces.pieces import Pieces
from sim.measure.compare.as_cut import edge_as_cut
from sim.measure.compare.compare import compare
from sim.measure.compare.compared_program import compare_program
from sim.measure.compare.result import Comparison, WorstPlace
from sim.measure.compare.tables import by_block, by_entity
from sim.setup.part import DrawingTarget

_WHOLE = ("unit-slip", "mirrored", "wrong-side", "offset-missing")
"""What may be wrong with a whole program; terms of the catalogue."""


def compare_cut(
    program: Program, pieces: Pieces, offset_um: float, drawing: Drawing, target: DrawingTarget
) -> Comparison | None:
    """The edge as cut beside the drawing; None where nothing came free, so that there is no edge.

    Whether the offset is wrong is told by the exact path, which has another side.
    """
    edge = edge_as_cut(program.toolpath, pieces)
    if edge is None:
        return None
    found = compare(edge, drawing, target.tolerance_um, fitted=target.fit)
    if found.passes:
        return found
    try:
        exact = compare_program(program.toolpath, offset_um, drawing, target.tolerance_um, fitted=target.fit)
    except SettingsError:  # no edge of its own
        return found
    known = {named.name for named in found.names}
    return replace(found, names=(*found.names, *(named for named in exact.names if named.name not in known)))


def drawing_findings(program: Program, found: Comparison | None) -> Iterator[Finding]:
    """3B601 for the worst place of each direction past the tolerance, 3B602 for each thing wrong as a whole.

    A mirrored part within the tolerance is right once it is turned over: the summary and the report tell of it.
    """
    if found is None:
        yield Finding("3B602", {"what": "no-edge"})
        return
    for what, places in (("edge-off", by_block(found)), ("drawing-off", by_entity(found))):
        worst = max(places, key=lambda place: place.deviation_um)
        if worst.deviation_um > found.tolerance_um:
            yield _off(program, found, what, worst)
    for named in found.names:
        if named.name in _WHOLE and not found.passes:
            yield Finding("3B602", {"what": named.name})


def _off(program: Program, found: Comparison, what: str, place: WorstPlace) -> Finding:
    entity = found.drawing.entities[place.entity] if place.entity >= 0 else None
    row = int(np.flatnonzero(program.toolpath.source.block == place.block)[0])
    return at_block(
        program.toolpath,
        program.lines,
        "3B601",
        row,
        what=what,
        off=place.deviation_um,
        tolerance=found.tolerance_um,
        x_mm=mm(place.where_um.x),
        y_mm=mm(place.where_um.y),
        entity=printable(f"{entity.kind} {entity.handle}") if entity else found.drawing.name,
    )
