"""Whether offsets, trims and a tolerance fit the kerfs of their passes, as a technology has them."""

from collections.abc import Callable, Iterator, Sequence

from parser.dialect.reader import at_block
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.program import Program
from parser.shape.passes import Pass
from parser.units import mm
from sim.check.kerf_offsets import Reach, misfit
from sim.measure.compare.findings import by_block, by_entity
from sim.measure.compare.result import Comparison
from sim.measure.passes import PassFigures

_NOTHING_UM = 0.5
"""Less than that no trim takes off: the steps of a table are 1 µm."""


def offset_findings(
    program: Program,
    figures: Sequence[PassFigures],
    reach_um: Floats,
    spread_um: Floats,
    offset_of: Callable[[Pass], float | None],
) -> Iterator[Finding]:
    """Finding 3B607 of each pass that leaves an edge beside the contour, 3B608 of each trim that takes nothing.

    Parameters
    ----------
    figures
        What the passes came to.
    reach_um, spread_um
        (n,) half the width of the kerf of each row, and (n, 2) by how much it may be less, below 0, and more.
    offset_of
        The offset from the contour that a pass was given; None where nobody says it.
    """
    for each in figures:
        pass_, offset_um = each.of, offset_of(each.of)
        reach = Reach(float(reach_um[pass_.first]), *spread_um[pass_.first].tolist())
        found = None if offset_um is None else misfit(program, pass_, offset_um, reach)
        if found is not None:
            yield found
        if pass_.number > 1 and each.stock is not None and each.stock.mean_um <= _NOTHING_UM and not pass_.is_tab:
            yield _at(program, "3B608", pass_, number=pass_.number, taken=each.stock.mean_um)


def tolerance_findings(program: Program, found: Comparison, within_um: float) -> Iterator[Finding]:
    """Finding 3B606 where a cut keeps its tolerance at the middle of the gap's interval, ± `within_um`, and not at all.

    A wider or narrower kerf moves every edge by as much, and the worst place with it.
    """
    worst = max((*by_block(found), *by_entity(found)), key=lambda place: place.deviation_um)
    tolerance_um, off_um, (x_um, y_um) = found.request.tolerance_um, worst.deviation_um, worst.where_um
    if off_um <= tolerance_um < off_um + within_um:
        values = {"off": off_um, "within": within_um, "most": off_um + within_um, "tolerance": tolerance_um}
        yield Finding("3B606", {**values, "x_mm": mm(x_um), "y_mm": mm(y_um)})


def _at(program: Program, code: str, pass_: Pass, **values: float) -> Finding:
    return at_block(program.toolpath, program.lines, code, pass_.first, **values)
