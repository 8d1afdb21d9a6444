"""What a tilted wire leaves: its cut at several heights, and pieces that reach through all of them.

At each height the wire's way is a contour of its own (`Ruled.section`), and the kerf there reaches to both sides
of it by more than that of an upright wire: a round wire that leans by T across its wall cuts an ellipse, 1 / cos T as
wide.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final, Literal, NamedTuple

import numpy as np

from controller.taper.tilted import TiltedPath, section_toolpath
from parser.geometry.curves import Floats, Ints, extents
from parser.program import Program
from parser.shape.contours import Contour, find_contours
from parser.toolpath import Toolpath
from parser.units import mm
from sim.cut.pieces.pieces import Piece, Pieces
from sim.cut.regions import RegionError
from sim.cut.remains import Remains, pieces_left, remains_of
from sim.cut.wire_lag import bowed
from sim.cut.wire_rows import WireRows
from sim.setup.scenario import Scenario
from sim.table.tilted import FourAxes
from sim.table.trace import Trace

_SHARES: Final = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Heights at which a cut is looked at, as shares of the work; the program plane comes to them."""
_OF_VOLUME: Final = (0.0, 0.5, 1.0)
"""Heights that Simpson's rule asks for."""
_ALIKE: Final = 1e-6
_MM3_PER_UM3: Final = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Section:
    """The cut at a height.

    Attributes
    ----------
    z_um
        Above the bottom of the work.
    toolpath
        The wire's way, its blocks those of the program.
    reach_um
        (n,) half the width of the kerf in each of its rows.
    programmed_um2
        Area within the closed contours of the wire's way.
    low_um, high_um
        Corners of the box about these, (2,).
    off_um
        The most by which the wire was off its wall, across it, by table and head.
    trace
        Where the wire was over time; rows are those of `toolpath`.
    pieces
        What comes free there; None where nobody asked, or where that could not be worked out.
    """

    z_um: float
    toolpath: Toolpath
    reach_um: Floats
    programmed_um2: float
    low_um: Floats
    high_um: Floats
    off_um: float
    trace: Trace
    pieces: Pieces | None

    @property
    def piece_mm2(self) -> float | None:
        """Area of all that comes free there; None where that is not known."""
        return None if self.pieces is None else sum(piece.area_mm2 for piece in self.pieces.freed)

    def contours(self) -> tuple[Contour, ...]:
        """The contours of the wire's way."""
        path = self.toolpath
        return find_contours(path, np.rint(np.concatenate([path.start_um[:1], path.end_um])).astype(np.int64))

    def remains(self, program: Program, scenario: Scenario) -> Remains:
        """What is left there of the cut of a program. RegionError where that could not be worked out."""
        of_height = replace(program, toolpath=self.toolpath)
        return remains_of(of_height, self.trace, self.contours(), scenario, self.reach_um)


class Solid(NamedTuple):
    """A piece that comes free through the whole of the work.

    Attributes
    ----------
    kind
        Part or slug.
    volume_mm3, mass_g
        Of it, by the areas at bottom, middle and top.
    larger
        Which end of it is the larger one.
    drops
        Whether it can fall out downwards: it is nowhere larger than below.
    """

    kind: Literal["part", "slug"]
    volume_mm3: float
    mass_g: float
    larger: Literal["top", "bottom", "neither"]
    drops: bool


@dataclass(frozen=True, slots=True, eq=False)
class TiltedCut:
    """A cut with a tilted wire.

    Attributes
    ----------
    axes
        How its guides moved, and along what.
    sections
        From the bottom of the work to its top.
    programmed_mm3
        Volume within the closed contours of the wire's way.
    solids
        Pieces; empty where no pieces are known, or not the same ones at all heights.
    """

    axes: FourAxes
    sections: tuple[Section, ...]
    programmed_mm3: float
    solids: tuple[Solid, ...]

    @property
    def path(self) -> TiltedPath:
        """The way of the wire."""
        return self.axes.path

    @property
    def piece_mm3(self) -> float | None:
        """Volume of all pieces; None where they are not known."""
        return sum(solid.volume_mm3 for solid in self.solids) if self.solids else None


def tilted_cut(program: Program, axes: FourAxes, scenario: Scenario, wire: WireRows, *, kerf: bool) -> TiltedCut:
    """The cut of a wire between guides that moved so; with `kerf` its pieces too.

    `wire` is an upright one in each row of the toolpath.
    """
    path, share = axes.path, axes.shares()
    work_um = path.heights.work_um
    heights = sorted({*(share * work_um for share in _SHARES), path.heights.program_um})
    across = path.ruled.across(axes.lower.row, share)
    moved = _Moved(program, axes, share, across, path.across_rad(), wire)
    sections = tuple(_section(moved, z_um, scenario if kerf else None) for z_um in heights)
    volume = sum(abs(path.ruled.volume_um3(loop, 0.0, work_um)) for loop in path.loops) * _MM3_PER_UM3
    pieces = {section.z_um: section.pieces for section in sections}
    is_alike = len({None if found is None else len(found.freed) for found in pieces.values()}) == 1
    through = [pieces[share * work_um] for share in _OF_VOLUME] if is_alike else [None]
    return TiltedCut(axes, sections, volume, _solids(through, work_um, scenario))


def solids_of(cut: TiltedCut, program: Program, scenario: Scenario) -> tuple[Solid, ...]:
    """The pieces of a cut of a program as solids, where nobody had asked for those of its sections."""
    work_um = cut.path.heights.work_um
    at = {section.z_um: section for section in cut.sections}
    return _solids([_pieces(program, at[share * work_um], scenario) for share in _OF_VOLUME], work_um, scenario)


def weighed(pieces: Pieces, solids: Sequence[Solid]) -> Pieces:
    """Pieces in the program plane with the masses of the solids that they are of, where these are as many."""
    if len(solids) != len(pieces.freed):
        return pieces
    freed = (piece._replace(mass_g=solid.mass_g) for piece, solid in zip(pieces.freed, solids, strict=True))
    return pieces._replace(freed=tuple(freed))


class _Moved(NamedTuple):
    """A wire that moved along its program.

    Attributes
    ----------
    program, axes
        What it cut, and how its guides moved.
    share, across
        (n,) shares of rows at the samples of the lower guide, and (n, 2) directions across the walls there.
    wall_rad
        (m,) by how much it leans across the wall of each row of its path.
    wire
        An upright one in each row of the toolpath.
    """

    program: Program
    axes: FourAxes
    share: Floats
    across: Floats
    wall_rad: Floats
    wire: WireRows


def _section(moved: _Moved, z_um: float, scenario: Scenario | None) -> Section:
    """The cut at a height, with its pieces where a scenario says out of what."""
    program, path = moved.program, moved.axes.path
    curves, row = path.ruled.section(z_um)
    programmed = sum(abs(path.ruled.area_um2(loop, z_um)) for loop in path.loops)
    closed = curves.picked(np.isin(row, np.concatenate([np.zeros(0, dtype=np.int64), *path.loops])))
    low, high = extents(closed if len(closed) else curves)
    source = path.source_row[row]
    toolpath = section_toolpath(program.toolpath, curves, source)
    wire_um = moved.axes.wire_um(z_um)
    trace = _trace(moved, wire_um, toolpath, row)
    reach = moved.wire.reach_um[source] / np.cos(moved.wall_rad)[row]
    off = _off_um(moved, wire_um, z_um)
    found = Section(z_um, toolpath, reach, programmed, low.min(axis=0), high.max(axis=0), off, trace, None)
    return found if scenario is None else replace(found, pieces=_pieces(program, found, scenario))


def _trace(moved: _Moved, wire_um: Floats, toolpath: Toolpath, row: Ints) -> Trace:
    """The trace of a straight wire (n, 2) at a height, by the rows of the section there; bowed back where it lags."""
    lower, rows = moved.axes.lower, len(moved.axes.path.ruled)
    first, count = np.searchsorted(row, np.arange(rows)), np.bincount(row, minlength=rows)[lower.row]
    chord = np.minimum((moved.share * count).astype(np.int64), count - 1)
    trace = Trace(lower.t_s, wire_um, wire_um, wire_um, first[lower.row] + chord)
    return bowed(trace, toolpath, moved.wire.lag_um[moved.axes.path.source_row[row]])


def _off_um(moved: _Moved, wire_um: Floats, z_um: float) -> float:
    """The most by which a straight wire (n, 2) was off its wall at a height, across it."""
    path, row = moved.axes.path, moved.axes.lower.row
    off = wire_um - path.ruled.places(row, moved.share, z_um)
    return float(np.abs((off * moved.across).sum(axis=1)).max(initial=0.0))


def _pieces(program: Program, section: Section, scenario: Scenario) -> Pieces | None:
    """What comes free of a cut by where the wire was at a height."""
    of_height = replace(program, toolpath=section.toolpath)
    try:
        return pieces_left(of_height, section.trace, section.contours(), scenario, section.reach_um)
    except RegionError:
        return None


def _solids(through: Sequence[Pieces | None], work_um: float, scenario: Scenario) -> tuple[Solid, ...]:
    """The pieces at bottom, middle and top as solids, where all of them have as many."""
    known = [pieces.freed for pieces in through if pieces is not None]
    if len(known) < len(through) or len({len(freed) for freed in known}) != 1:
        return ()
    return tuple(_solid(pieces, mm(work_um), scenario) for pieces in zip(*known, strict=True))


def _solid(pieces: tuple[Piece, ...], height_mm: float, scenario: Scenario) -> Solid:
    low, middle, high = (piece.area_mm2 for piece in pieces)
    volume = height_mm * (low + 4.0 * middle + high) / 6.0
    alike = abs(high - low) <= _ALIKE * max(high, low)
    larger: Literal["top", "bottom", "neither"] = "neither" if alike else "top" if high > low else "bottom"
    mass = volume * scenario.density_g_cm3 * 1e-3
    return Solid(pieces[0].kind, volume, mass, larger, drops=larger != "top")
