"""What a cut leaves: its kerf, the pieces that come free and how they can move, and the sizes of what is kept."""

from dataclasses import dataclass

from parser.program import Program
from parser.shape.contours import Contour
from parser.toolpath import Toolpath
from sim.cut.kerf.swept import Kerf, kerf_of
from sim.cut.pieces.pieces import Material, Pieces, pieces_of
from sim.cut.play import Play, plays_of
from sim.cut.regions import cut_by_blocks
from sim.cut.sizes import Sizes, sizes_of
from sim.setup.scenario import Scenario
from sim.table.trace import Trace


@dataclass(frozen=True, slots=True, eq=False)
class Remains:
    """What a run leaves of the work.

    Attributes
    ----------
    kerf
        What the wire removed.
    pieces
        The frame, and what came free of it.
    plays
        How each of the pieces can move once it is free.
    sizes
        Of what is kept, as cut and nominal.
    """

    kerf: Kerf
    pieces: Pieces
    plays: tuple[Play, ...]
    sizes: Sizes


def remains_of(program: Program, trace: Trace, contours: tuple[Contour, ...], scenario: Scenario) -> Remains:
    """Kerf, pieces and sizes by where the wire really was; RegionError where they could not be worked out."""
    toolpath = program.toolpath
    with cut_by_blocks(1, len(toolpath)):
        kerf = kerf_of(toolpath, trace, contours, scenario.wire.reach_um)
        pieces = _pieces(kerf, toolpath, scenario)
        return Remains(
            kerf=kerf,
            pieces=pieces,
            plays=plays_of(pieces, scenario.wire.radius_um),
            sizes=sizes_of(toolpath, kerf, pieces, scenario.work_um),
        )


def pieces_left(
    remains: Remains | None, program: Program, trace: Trace, contours: tuple[Contour, ...], scenario: Scenario
) -> Pieces:
    """Pieces of a run: those of its remains, or worked out here where nobody asked for the remains.

    RegionError where they could not be worked out.
    """
    if remains is not None:
        return remains.pieces
    with cut_by_blocks(1, len(program.toolpath)):
        kerf = kerf_of(program.toolpath, trace, contours, scenario.wire.reach_um)
        return _pieces(kerf, program.toolpath, scenario)


def _pieces(kerf: Kerf, toolpath: Toolpath, scenario: Scenario) -> Pieces:
    pauses = [stop.after for stop in toolpath.stops if stop.kind == "pause"]
    return pieces_of(kerf, scenario.work_um, Material(scenario.thickness_mm, scenario.density_g_cm3), pauses)
