"""The tilted path: what a program tells of the wire's lean, to the contours of two planes and the ways of the guides.

With T the angle and p the height of the program plane above the lower one, the upper plane moves by ``(H − p) tan T``
to the side to which the wire leans, the lower one by ``p tan T`` to the other (EDM_NC, g5152.cpp; docs/taper.md).
"""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from controller.offset.shifted import rounds_of
from controller.taper.shifted_contour import Corner, Joints, ShiftedContour, shifted_contour
from parser.controller_words import Taper
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints, joined
from parser.geometry.ruled import Ruled
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.toolpath import Toolpath

_SAMPLES: Final = 33
"""Places of a row at which its lean is looked at, its ends among them: most rows lean most at an end."""


class Heights(NamedTuple):
    """Where planes and guides are, µm above the bottom of the work.

    Attributes
    ----------
    work_um
        Top of the work.
    program_um
        Program plane: there the wire is where the program says.
    lower_guide_um, upper_guide_um
        Guides of the wire: the lower one below 0, the upper one above the work.
    """

    work_um: float
    program_um: float
    lower_guide_um: float
    upper_guide_um: float

    @property
    def span_um(self) -> float:
        """From the lower guide to the upper one."""
        return self.upper_guide_um - self.lower_guide_um


class Turned(NamedTuple):
    """A row that turns over: its row of the toolpath, and the height at which nothing is left of it, µm."""

    row: int
    z_um: float


@dataclass(frozen=True, slots=True, eq=False)
class TiltedPath:
    """The way of a tilted wire in m rows.

    Attributes
    ----------
    ruled
        Contours at the bottom and at the top of the work.
    heights
        Planes and guides.
    source_row
        (m,) row of the toolpath that each row belongs to; a bridge at a corner to the row before it.
    loops
        Rows, one array for each contour that closes at the bottom and at the top.
    turned
        Rows that turn over within the work.
    angle_rad
        The largest angle that it was given; None along two contours.
    """

    ruled: Ruled
    heights: Heights
    source_row: Ints
    loops: tuple[Ints, ...]
    turned: tuple[Turned, ...]
    angle_rad: float | None

    @property
    def faces(self) -> tuple[Curves, Curves]:
        """The way of the wire at the bottom of the work, and at its top, (m,) rows each."""
        return self.ruled.lower, self.ruled.upper

    def axes_um(self, row: Ints, share: Floats) -> Floats:
        """X, Y, U and V (k, 4) µm at shares (k,) of rows (k,): the lower guide, and the upper one against it."""
        low, lean = self.ruled.wires(row, share)
        below = low + lean * (self.heights.lower_guide_um - self.ruled.lower_z_um)
        return np.concatenate([below, lean * self.heights.span_um], axis=1)

    def sampled_axes_um(self) -> tuple[Ints, Floats]:
        """Rows of the toolpath (k,), and X, Y, U and V (k, 4) µm there, at several places of each row of this path."""
        row, share = _sampled(len(self.ruled))
        return self.source_row[row], self.axes_um(row, share)

    def uv_um(self) -> "UVMost":
        """The most that the upper guide is moved against the lower one: across walls, and at all, as at corners."""
        row, share = _sampled(len(self.ruled))
        aside = self.axes_um(row, share)[:, 2:]
        across = np.abs((aside * self.ruled.across(row, share)).sum(axis=1))
        cuts = ~self.ruled.is_jump[row]
        side, corner = (float(column[cuts].max(initial=0.0)) for column in (across, np.hypot(*aside.T)))
        return UVMost(side, corner)

    def lean_most_rad(self) -> float:
        """The most by which the wire is tilted."""
        return float(np.arctan(self._leans().max(initial=0.0)))

    def most_leaning_row(self) -> int:
        """The row in which it is tilted most."""
        return int(np.argmax(self._leans().max(axis=1)))

    def across_rad(self) -> Floats:
        """(m,) by how much the wire leans across its wall in the middle of each row."""
        row, half = np.arange(len(self.ruled)), np.full(len(self.ruled), 0.5)
        lean = (self.ruled.leans(row, half) * self.ruled.across(row, half)).sum(axis=1)
        across: Floats = np.abs(np.arctan(lean))
        return across

    def wall_rad(self, rows: int) -> Floats:
        """(rows,) by how much the wire leans across the wall of each row of the toolpath, corners aside."""
        return self.across_rad()[np.searchsorted(self.source_row, np.arange(rows))]

    def _leans(self) -> Floats:
        """(m, s) tangents of the lean at some places of each row."""
        row, share = _sampled(len(self.ruled))
        leans: Floats = np.hypot(*self.ruled.leans(row, share).T).reshape(len(self.ruled), _SAMPLES)
        return leans


class UVMost(NamedTuple):
    """Most ways of the upper guide against the lower one, µm: across walls, and at all, as at sharp corners."""

    side_um: float
    corner_um: float


def section_toolpath(of: Toolpath, curves: Curves, source_row: Ints) -> Toolpath:
    """The way of the wire at a height as a toolpath, whose rows belong to rows (k,) of the programmed one."""
    after = np.searchsorted(source_row, [stop.after for stop in of.stops], side="left").tolist()
    return Toolpath(
        **{name: getattr(curves, name) for name in Curves.__slots__},
        printed_end_um=np.full((len(curves), 2), np.nan),
        words=None,
        source=of.source.picked(source_row),
        stops=tuple(stop._replace(after=rows) for stop, rows in zip(of.stops, after, strict=True)),
    )


class Lean(NamedTuple):
    """How the wire leans along n rows.

    Attributes
    ----------
    tangent
        (n,) of the angle by which its upper end leans to the left of travel; negative to the right, 0 upright.
    tilts
        (n,) rows that lead from one lean to another: from that of the row before to that of the row behind.
    """

    tangent: Floats
    tilts: Bools


def told_lean(taper: Taper, path: Curves) -> Lean:
    """The lean that a program tells block by block.

    The block that sets it up and the block that takes it back tilt the wire, as those of a compensation move it aside;
    arcs do not, and the wire then tilts where it stands. Between them each block leans by its own angle.
    """
    leans = taper.side != 0
    before = np.concatenate([[False], leans[:-1]])
    tilts = (leans != before) & (path.kind != CurveKind.ARC)
    return Lean(np.where(leans & ~tilts, taper.side * np.tan(taper.angle_rad), 0.0), tilts)


def figure_lean(toolpath: Toolpath, angle_rad: float, side: int) -> Lean:
    """The lean of a whole program, as controls of fast wire are given it beside the program.

    Each contour leans from its first block to its last; the block that leads to it tilts the wire, and the one that
    leads away. `side` is +1 where the upper end leans to the left of travel, −1 to the right.
    """
    tangent, tilts = np.zeros(len(toolpath)), np.zeros(len(toolpath), dtype=np.bool_)
    for begin, past, section in rounds_of(toolpath):
        tangent[section.first : section.last + 1] = side * np.tan(angle_rad)
        tilts[section.first - 1 : section.first] = section.first > begin
        tilts[section.last + 1 : section.last + 2] = section.last + 1 < past
    return Lean(tangent, tilts & (toolpath.kind == CurveKind.LINE))


def tilted(path: Curves, lean: Lean, heights: Heights, corner: Corner) -> TiltedPath:
    """The way of the wire whose program plane runs along a path."""
    walls = (lean.tangent != 0.0) & (path.kind != CurveKind.JUMP)
    joints, closings = _joints(path, walls)
    low, high = (
        shifted_contour(path, lean.tangent * walls * (z_um - heights.program_um), joints, lean.tilts, corner)
        for z_um in (0.0, heights.work_um)
    )
    lower, upper, source = _matched(low, high)
    turned = (*_turned(low, heights.program_um, 0.0), *_turned(high, heights.program_um, heights.work_um))
    ruled = Ruled(_kinds(lower, path, source), _kinds(upper, path, source), 0.0, heights.work_um)
    loops = tuple(rows_between(source, *closing) for closing in closings)
    angle_rad = float(np.arctan(np.abs(lean.tangent).max(initial=0.0)))
    return TiltedPath(ruled, heights, source, loops, turned, angle_rad)


def gap_um(curves: Curves, first: int, last: int) -> float:
    """From where a row ends to where another one starts."""
    return float(np.hypot(*(curves.end_um[last] - curves.start_um[first])))


def _joints(path: Curves, walls: Bools) -> tuple[Joints, list[tuple[int, int]]]:
    """Rows of walls that follow each other, those that close a contour with them; and the closed stretches."""
    inner = np.flatnonzero(walls[:-1] & walls[1:])
    early, late = inner.tolist(), (inner + 1).tolist()
    closings: list[tuple[int, int]] = []
    for first, last in _stretches(walls):
        if gap_um(path, first, last) <= CLOSED_WITHIN_UM and (last > first or path.is_arc[first]):
            closings.append((first, last))
            early.append(last)
            late.append(first)
    order = np.argsort(early, kind="stable")
    return Joints(*(np.array(rows, dtype=np.int64)[order] for rows in (early, late))), closings


def _stretches(chosen: Bools) -> list[tuple[int, int]]:
    """First and last of each stretch of neighbours that are chosen."""
    edge = np.flatnonzero(np.diff(np.concatenate([[False], chosen, [False]]).astype(np.int8)))
    return [(int(first), int(past) - 1) for first, past in edge.reshape(-1, 2)]


def _matched(low: ShiftedContour, high: ShiftedContour) -> tuple[Curves, Curves, Ints]:
    """Rows of both planes, bridges between them where either has one; and the row of the path of each."""
    has = low.bridged | high.bridged
    n = len(has)
    source = np.sort(np.concatenate([np.arange(n), np.flatnonzero(has)]))
    is_bridge = np.concatenate([[False], source[1:] == source[:-1]])
    at = np.where(is_bridge, source + n, source)
    lower, upper = (joined([of.curves, of.bridge]).picked(at) for of in (low, high))
    return lower, upper, source


def _kinds(made: Curves, path: Curves, source: Ints) -> Curves:
    """The rows, those of jumps as jumps."""
    made.kind[(path.kind == CurveKind.JUMP)[source]] = CurveKind.JUMP
    return made


def _turned(plane: ShiftedContour, program_um: float, z_um: float) -> list[Turned]:
    """Rows that turn over between the program plane and another one."""
    rows = np.flatnonzero(plane.vanish < 1.0)
    return [Turned(int(row), program_um + float(plane.vanish[row]) * (z_um - program_um)) for row in rows]


def rows_between(source: Ints, first: int, last: int) -> Ints:
    """Rows that belong to rows of the toolpath from the first to the last."""
    return np.flatnonzero((source >= first) & (source <= last))


def _sampled(rows: int) -> tuple[Ints, Floats]:
    """Each row at some shares."""
    share = np.linspace(0.0, 1.0, _SAMPLES)
    return np.repeat(np.arange(rows), _SAMPLES), np.tile(share, rows)
