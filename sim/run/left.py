"""What a run leaves, worked out as far as its scenario asks: kerf, pieces and sizes, and the cut beside its drawing."""

from typing import Final, NamedTuple

from parser.drawing.model import Drawing
from parser.findings.findings import Finding
from parser.program import Program
from parser.shape.contours import Contour
from sim.base.progress import Progress
from sim.check.result import CheckState
from sim.cut.pieces.findings import piece_findings, region_finding
from sim.cut.regions import RegionError
from sim.cut.remains import Remains, remains_of
from sim.measure.compare.findings import compare_cut, drawing_findings
from sim.measure.compare.result import Comparison
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario
from sim.table.trace import Trace

_REMAINS: Final = "check-remains"  # the check of what a cut leaves, which only a run makes


class Left(NamedTuple):
    """What a cut leaves, beside the drawing; None where nobody asked, or where no region could be worked out.

    `findings` are those about it, and `state` says how far the check of it came.
    """

    remains: Remains | None
    comparison: Comparison | None
    findings: list[Finding]
    state: CheckState


def drawing_of(target: DrawingTarget | None) -> Drawing | None:
    """The drawing that a cut is held against, None where there is none; DrawingError where it cannot be read."""
    if target is None:
        return None
    from parser.drawing.read import read_drawing  # noqa: PLC0415 - most runs have no drawing, and ezdxf loads for 0.3 s

    return read_drawing(target.file, layer=target.layer, gap_um=target.gap_um)


def left_of(  # noqa: PLR0913, PLR0917 - all that is known of the cut, and whom it tells
    program: Program,
    cut: Trace,
    contours: tuple[Contour, ...],
    scenario: Scenario,
    drawing: Drawing | None,
    progress: Progress,
    *,
    is_whole: bool,
) -> Left:
    """What a cut leaves, as far as the scenario asks for it.

    A run that is not whole, since it ended early, is not held against the drawing: all that differs comes of that.
    """
    target = scenario.drawing
    if not scenario.kerf and target is None:
        return Left(None, None, [], CheckState(_REMAINS, "not asked", "reason-no-kerf"))
    progress("kerf", 0, 1)
    try:
        remains = remains_of(program, cut, contours, scenario)
    except RegionError as error:
        state = CheckState(_REMAINS, "incomplete", "reason-no-region")
        return Left(None, None, [region_finding(program, error)], state)
    found = piece_findings(program, remains.pieces)
    if target is None or drawing is None:
        return Left(remains, None, found, CheckState(_REMAINS))
    if not is_whole:
        return Left(remains, None, found, CheckState(_REMAINS, "incomplete", "reason-ended"))
    progress("comparison", 0, 1)
    comparison = compare_cut(program, remains, drawing, target)
    return Left(remains, comparison, [*found, *drawing_findings(program, comparison)], CheckState(_REMAINS))
