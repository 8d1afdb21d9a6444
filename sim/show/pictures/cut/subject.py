"""What the picture of a cut shows, and the page that it is drawn on."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.shape.passes import Passes
from parser.toolpath import Toolpath
from parser.units import from_mm, mm
from sim.cut.pieces.pieces import Pieces
from sim.cut.sizes.sizes import Sizes
from sim.run.dryrun import DryRun, verdict
from sim.setup.scenario import Scenario
from sim.show.draw.canvas import Canvas
from sim.show.draw.labels import Room
from sim.show.draw.layout import Page
from sim.show.pictures.cut.outlines import Bodies
from sim.show.words import Words
from sim.table.motion import origin_um
from sim.table.trace import Trace
from sim.units import clock

NOTHING: Final = Bodies()


class Cut(NamedTuple):
    """A cut, known as far as it is; all in program coordinates.

    Attributes
    ----------
    toolpath
        The path of the wire's centre, at least one block.
    kerf_um
        Full width of the kerf, twice the sum of wire radius and spark gap; not negative.
    title, note
        Lines at the top; the middle of a line that is too long is left out.
    trace
        The way the wire took; where None the kerf lies around the path.
    passes
        Which blocks make each pass over an edge; None where every edge is cut once.
    contour
        What the program draws where a controller adds the offset; None where it runs as written.
    bodies
        The workpiece and the clamps; those near the path show.
    pieces, sizes
        What the cut leaves, and the sizes of what is kept, where they were worked out.
    findings
        What is wrong.
    travel_um
        The box that the table can reach, (2, 2): lowest and highest (x, y).
    """

    toolpath: Toolpath
    kerf_um: float
    title: str
    note: str = ""
    trace: Trace | None = None
    passes: Passes | None = None
    contour: Toolpath | None = None
    bodies: Bodies = NOTHING
    pieces: Pieces | None = None
    sizes: Sizes | None = None
    findings: Sequence[Finding] = ()
    travel_um: Floats | None = None


class Board(NamedTuple):
    """A page that is being drawn; what finds its place takes it out of `room`."""

    canvas: Canvas
    page: Page
    room: Room
    say: Words


def cut_of_run(run: DryRun, pieces: Pieces | None, say: Words) -> Cut:
    """The cut of a run, with the pieces that it frees where they are known."""
    scenario = run.scenario
    return Cut(
        toolpath=run.toolpath,
        kerf_um=scenario.wire.kerf_um,
        title=scenario.title,
        note=_note(run, say),
        trace=run.cut,
        passes=run.passes if run.has_trims else None,
        contour=None if run.offset is None else run.offset.passed.drawn,
        bodies=Bodies(scenario.work_um, [clamp.outline_um for clamp in scenario.clamps]),
        pieces=pieces,
        sizes=None if run.remains is None else run.remains.sizes,
        findings=run.findings,
        travel_um=_travel_um(run, scenario),
    )


def _travel_um(run: DryRun, scenario: Scenario) -> Floats:
    """The box that the table can reach, (2, 2), in program coordinates."""
    table = scenario.machine.table
    corner = np.array(origin_um(run.toolpath)) - scenario.start_um
    travel = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    return np.asarray(np.stack([corner, corner + travel]), dtype=np.float64)


def _note(run: DryRun, say: Words) -> str:
    """Verdict, blocks, length of the path and time in one line."""
    count, offset = len(run.toolpath), run.scenario.offset
    parts = [
        say(f"findings.{verdict(run.findings)}"),
        say("cut.blocks_1" if count == 1 else "cut.blocks", count=count),
        f"{mm(float(run.toolpath.length_um.sum())):.1f} mm",
        clock(run.ran_s),
    ]
    if offset is not None:
        by = ", ".join(f"{mm(one.by_um):g}" for one in offset.passes)
        parts.append(say(f"cut.offset_{offset.side.name.lower()}", by=by))
    return " · ".join(parts)
