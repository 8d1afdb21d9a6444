"""The picture of a path by itself, with what the check finds on it: no table runs for it, and no engine is loaded."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from controller.taper.tilted import TiltedPath
from parser.findings.catalogue import Language
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.program import Program
from parser.shape.passes import find_passes
from parser.toolpath import Toolpath
from parser.units import from_mm, mm
from sim.check.compensation.check import compensation_of, is_known
from sim.check.offset import Offsetting
from sim.run.findings import outcome
from sim.run.prepare import checked_for, in_file_order, prepare, tilt_findings
from sim.setup.scenario import Scenario
from sim.show.draw import style
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.picture import draw_cut
from sim.show.pictures.cut.subject import Bodies, Cut
from sim.show.texts import Words
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
        say(f"findings.{outcome(findings)}"),
        say("cut.blocks_1" if count == 1 else "cut.blocks", count=count),
        f"{mm(float(toolpath.length_um.sum())):.1f} mm",
        ran,
    ]
    if offset is not None:
        by = ", ".join(f"{round(mm(pass_.by_um), 4):g}" for pass_ in offset.passes)
        parts.append(say(f"cut.offset_{offset.side.name.lower()}", by=by))
    return " · ".join(parts)


class Programmed(NamedTuple):
    """A program as it is to run, before anything moves.

    Attributes
    ----------
    program
        The program, its toolpath the one that is to run.
    scenario
        Machine, wire and work.
    offset
        What the controller's compensation made of it; None where it runs as written.
    findings
        Of the check that every run begins with.
    tilt
        The way of a wire that leans; None of an upright one.
    is_contour
        Whether it is the contour alone: it compensates by what nobody tells, so its wire runs nobody knows where.
    """

    program: Program
    scenario: Scenario
    offset: Offsetting | None
    findings: tuple[Finding, ...]
    tilt: TiltedPath | None = None
    is_contour: bool = False


def programmed(program: Program, scenario: Scenario) -> Programmed:
    """Check a program, and add its offset or that of its scenario.

    Raises what `sim.run.prepare.prepare` does, but takes a program whose own offset nobody tells: its contour is known.
    """
    compensation = compensation_of(program.toolpath)
    if compensation is not None and not is_known(compensation):
        checked, _ = checked_for(program, scenario)
        return Programmed(program, scenario, None, checked.findings, is_contour=True)
    ready = prepare(program, scenario)
    findings = in_file_order(ready, tuple(tilt_findings(ready, scenario)))
    return Programmed(ready.program, scenario, ready.offset, findings, ready.tilt)


def draw_path(sheet: Sheet[AnyCanvas], path: Programmed) -> AnyCanvas:
    """Draw a path as it is programmed."""
    return draw_cut(sheet, cut_of_path(path, sheet.say))


def cut_of_path(path: Programmed, say: Words) -> Cut:
    """A cut of which no more is known than its program, machine and wire; a contour alone has no kerf either."""
    toolpath, scenario = path.program.toolpath, path.scenario
    has_kerf = not path.is_contour
    ran = say("cut.not_run") if has_kerf else f"{say('cut.not_run')} · {say('cut.contour_alone')}"
    passes = find_passes(toolpath) if path.offset is None else path.offset.edge_passes
    return Cut(
        toolpath=toolpath,
        kerf_um=scenario.wire.kerf_um if has_kerf else 0.0,
        title=scenario.title_in(say.language),
        note=note_of(toolpath, path.offset, path.findings, ran, say),
        passes=passes if has_kerf and any(pass_.number > 1 for pass_ in passes.passes) else None,
        leads=(passes.of_row < 0) & ~toolpath.is_jump if has_kerf else None,
        contour=None if path.offset is None else path.offset.passed.drawn,
        bodies=bodies_of(scenario),
        findings=path.findings,
        travel_um=travel_um(toolpath, scenario),
        faces=None if path.tilt is None else path.tilt.faces,
    )


PATH: Final = "path"
"""Name of this picture, as ``drycut draw --picture`` takes it."""


class PathAlone(NamedTuple):
    """A program of which nothing but `PATH` is to be drawn; see `sim.show.pictures.files.Drawable`."""

    programmed: Programmed

    def title_in(self, language: Language) -> str:
        """Title of its scenario in a language."""
        return self.programmed.scenario.title_in(language)

    def least_px(self, name: str) -> int:
        """How narrow the picture can be: it has a thumbnail."""
        return style.LEAST_THUMBNAIL

    def draw(self, name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas:
        """The page, drawn."""
        return draw_path(sheet, self.programmed)
