"""The picture of the cut of a run."""

import numpy as np

from parser.geometry.curves import Floats
from parser.units import from_mm, mm
from sim.cut.pieces.pieces import Pieces
from sim.run.dryrun import DryRun, verdict
from sim.setup.scenario import Scenario
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.outlines import Bodies
from sim.show.pictures.cut.picture import draw_cut
from sim.show.pictures.cut.subject import Cut
from sim.show.words import Words
from sim.table.motion import origin_um
from sim.units import clock


def cut_picture(sheet: Sheet[AnyCanvas], run: DryRun, pieces: Pieces | None) -> AnyCanvas:
    """Draw the cut of a run, with the pieces that it frees where they are known."""
    scenario = run.scenario
    cut = Cut(
        toolpath=run.toolpath,
        kerf_um=scenario.wire.kerf_um,
        title=scenario.title,
        note=_note(run, sheet.say),
        trace=run.cut,
        contour=None if run.offset is None else run.offset.drawn,
        bodies=Bodies(scenario.work_um, [clamp.outline_um for clamp in scenario.clamps]),
        pieces=pieces,
        sizes=None if run.remains is None else run.remains.sizes,
        findings=run.findings,
        travel_um=_travel_um(run, scenario),
    )
    return draw_cut(sheet, cut)


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
        parts.append(say(f"cut.offset_{offset.side.name.lower()}", by=f"{mm(offset.by_um):g}"))
    return " · ".join(parts)
