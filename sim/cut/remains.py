"""What a cut leaves: its kerf, the pieces that come free and how they can move, and the sizes of what is kept."""

from dataclasses import dataclass
from functools import cached_property

from parser.geometry.curves import Floats
from parser.program import Program
from parser.shape.contours import Contour
from parser.toolpath import Toolpath
from sim.cut.kerf.swept import Kerf, kerf_of
from sim.cut.pieces.pieces import Material, Pieces, pieces_of
from sim.cut.play import Play, plays_of
from sim.cut.regions import cut_by_blocks
from sim.cut.sizes import Sizes, sizes_of
from sim.cut.wire_rows import wire_rows
from sim.setup.scenario import Scenario
from sim.table.trace import Trace


@dataclass(frozen=True, eq=False)
class Remains:
    """What a run leaves of the work.

    Attributes
    ----------
    toolpath, scenario
        What was run, and how.
    kerf
        What the wire removed.
    pieces
        The frame, and what came free of it.
    """

    toolpath: Toolpath
    scenario: Scenario
    kerf: Kerf
    pieces: Pieces

    @cached_property
    def plays(self) -> tuple[Play, ...]:
        """How each of the pieces can move once it is free; RegionError where that could not be worked out."""
        with cut_by_blocks(1, len(self.toolpath)):
            return plays_of(self.pieces, self.scenario.wire.radius_um)

    @cached_property
    def sizes(self) -> Sizes:
        """Sizes of what is kept, as cut and nominal; RegionError where they could not be worked out."""
        with cut_by_blocks(1, len(self.toolpath)):
            spread_um = wire_rows(self.toolpath, self.scenario).spread_um
            return sizes_of(self.toolpath, self.kerf, self.pieces, self.scenario.work_um, spread_um)

    def measured(self) -> "Remains":
        """The same, its plays and its sizes worked out; RegionError where they could not be."""
        _ = self.plays, self.sizes
        return self


def remains_of(
    program: Program, trace: Trace, contours: tuple[Contour, ...], scenario: Scenario, reach_um: Floats
) -> Remains:
    """Kerf and pieces by where the wire really was; RegionError where they could not be worked out.

    `reach_um` (n,) is half the width of the kerf in each row.
    """
    toolpath = program.toolpath
    with cut_by_blocks(1, len(toolpath)):
        kerf = kerf_of(toolpath, trace, contours, reach_um, wire_rows(toolpath, scenario).reach_um)
        return Remains(toolpath, scenario, kerf, _pieces(kerf, toolpath, scenario))


def pieces_left(
    program: Program, trace: Trace, contours: tuple[Contour, ...], scenario: Scenario, reach_um: Floats
) -> Pieces:
    """Pieces of a cut of which nobody asked for the remains; RegionError where they could not be worked out."""
    with cut_by_blocks(1, len(program.toolpath)):
        kerf = kerf_of(program.toolpath, trace, contours, reach_um)
        return _pieces(kerf, program.toolpath, scenario)


def _pieces(kerf: Kerf, toolpath: Toolpath, scenario: Scenario) -> Pieces:
    pauses = [stop.after for stop in toolpath.stops if stop.kind == "pause"]
    return pieces_of(kerf, scenario.work_um, Material(scenario.thickness_mm, scenario.density_g_cm3), pauses)
