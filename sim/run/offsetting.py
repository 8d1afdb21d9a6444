"""The offset that a controller adds to a program on the drawing's contour: its path, and what cannot be cut so."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from controller.offset.compensate import compensate
from controller.offset.gouges import TOLERANCE_UM, Gouge, gouges
from controller.offset.path import Made, OffsetPath, offset_toolpath
from controller.offset.reach import reach
from controller.offset.sections import OffsetSection, sections_of
from controller.offset.shifted import closed_contour
from controller.offset.uncut import uncut_um
from parser.findings.findings import Finding, file_order
from parser.geometry.curves import Curves, Floats
from parser.program import Program
from parser.shape.contours import runs
from parser.toolpath import Toolpath
from sim.check.offset import gouge_findings, loop_findings, uncut_findings
from sim.setup.part import Offset


@dataclass(frozen=True, slots=True, eq=False)
class Offsetting:
    """What became of a program under an offset.

    Attributes
    ----------
    drawn
        The program's own toolpath, which runs along the drawing's contour.
    program
        The program with the offset path as its toolpath.
    path
        The offset path, and where its rows come from.
    left_um
        (v,) float64, material that stays at each row that vanished.
    gouges
        Where the wire cuts into the contour; rows of the contour are rows of the program as read.
    loops
        How many closed paths each closed section of the contour allows without a gouge.
    findings
        3B501 to 3B504, in file order.
    """

    drawn: Toolpath
    program: Program
    path: OffsetPath
    left_um: Floats
    gouges: tuple[Gouge, ...]
    loops: tuple[int, ...]
    findings: tuple[Finding, ...]


def offsetting(program: Program, offset: Offset) -> Offsetting:
    """Run a program's toolpath through the controller's compensation."""
    drawn = program.toolpath
    sections = sections_of(drawn)
    path = compensate(drawn, sections, offset.by_um, offset.side)
    parts = [_beside_section(drawn, path, *one, offset) for one in zip(sections, _beside(path, drawn), strict=True)]
    left_um = np.concatenate([np.zeros(0), *(one.left_um for one in parts)])
    met = tuple(gouge for one in parts for gouge in one.gouges)
    closed = {section: one.loops for section, one in zip(sections, parts, strict=True) if one.loops is not None}
    found = [
        *uncut_findings(program, offset, path.vanished, left_um),
        *gouge_findings(program, offset, path, met),
        *loop_findings(program, offset, closed),
    ]
    return Offsetting(
        drawn=drawn,
        program=replace(program, toolpath=offset_toolpath(drawn, path)),
        path=path,
        left_um=left_um,
        gouges=met,
        loops=tuple(closed.values()),
        findings=tuple(sorted(found, key=file_order)),
    )


class _Beside(NamedTuple):
    """What the offset path leaves and gouges beside one section; how many loops that allows, None where it is open."""

    left_um: Floats
    gouges: list[Gouge]
    loops: int | None


def _beside_section(drawn: Curves, path: OffsetPath, section: OffsetSection, beside: slice, offset: Offset) -> _Beside:
    """What the rows `beside` of the path do to a section of what is drawn."""
    contour = drawn.picked(slice(section.first, section.last + 1))
    # Leads of an open section are left out: where it has none of its own, they begin and end on it.
    near = np.arange(beside.start, beside.stop)[section.closed | (path.made[beside] != Made.LEAD)]
    curves = path.curves.picked(near)
    if section.closed:
        contour = closed_contour(contour)
    met = [g for g in gouges(contour, curves, offset.by_um, offset.side) if not _is_overhang(contour, section, g)]
    gone = path.vanished[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] - section.first
    return _Beside(
        left_um=uncut_um(contour, curves, offset.by_um, gone),
        gouges=[g._replace(row=section.first + g.row, path_row=int(near[g.path_row])) for g in met],
        loops=len(reach(contour, offset.by_um, offset.side).loops) if section.closed else None,
    )


def _is_overhang(contour: Curves, section: OffsetSection, gouge: Gouge) -> bool:
    """Whether no more is cut than what the ends of a contour miss each other by, where they meet.

    Whole µm never close a contour exactly. Ends that lie side by side are joined midway, which cuts into one of them.
    """
    gap_um = float(np.hypot(*(contour.end_um[-1] - contour.start_um[0])))
    return section.closed and gouge.row in (0, len(contour) - 1) and gouge.depth_um <= gap_um + TOLERANCE_UM


def _beside(path: OffsetPath, drawn: Toolpath) -> Iterator[slice]:
    """Rows of the offset path that cut in each contour, one contour after the other."""
    for begin, past in runs(drawn).tolist():
        yield slice(*np.searchsorted(path.source_row, (begin, past)).tolist())
