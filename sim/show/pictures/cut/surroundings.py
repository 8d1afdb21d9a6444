"""What stands about a cut on its page: the bodies on the table, how far that reaches, and the line under the title."""

from collections.abc import Sequence

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from parser.units import from_mm, mm
from sim.check.beside import Offsetting
from sim.run.findings import verdict
from sim.setup.scenario import Scenario
from sim.show.pictures.cut.outlines import Bodies
from sim.show.words import Words
from sim.table.trace import origin_um


def bodies_of(scenario: Scenario) -> Bodies:
    """The workpiece and the clamps of a scenario."""
    return Bodies(scenario.work_um, [clamp.outline_um for clamp in scenario.clamps])


def travel_um(toolpath: Toolpath, scenario: Scenario) -> Floats:
    """The box that the table can reach, (2, 2), in program coordinates."""
    table = scenario.machine.table
    corner = np.array(origin_um(toolpath)) - scenario.start_um
    travel = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    return np.asarray(np.stack([corner, corner + travel]), dtype=np.float64)


def note_of(toolpath: Toolpath, offset: Offsetting | None, findings: Sequence[Finding], ran: str, say: Words) -> str:
    """Verdict, blocks, length of the path, how long it `ran`, and its offset, in one line."""
    count = len(toolpath)
    parts = [
        say(f"findings.{verdict(findings)}"),
        say("cut.blocks_1" if count == 1 else "cut.blocks", count=count),
        f"{mm(float(toolpath.length_um.sum())):.1f} mm",
        ran,
    ]
    if offset is not None:
        by = ", ".join(f"{round(mm(one.by_um), 4):g}" for one in offset.passes)
        parts.append(say(f"cut.offset_{offset.side.name.lower()}", by=by))
    return " · ".join(parts)
