"""The offset that a controller adds to a program on the drawing's contour: its path, and what cannot be cut so."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from controller.offset.compensate import compensate
from controller.offset.gouges import TOLERANCE_UM, Gouge, gouges
from controller.offset.path import Made, OffsetPath
from controller.offset.reach import reach
from controller.offset.sections import Section
from controller.offset.shifted import closed_contour
from controller.offset.toolpath import offset_toolpath
from controller.offset.uncut import uncut_um
from parser.findings.findings import Finding, file_order
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats
from parser.program import Program
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.shape.contours import contour_rows
from parser.shape.loops import find_loops
from parser.threeb.at_block import at_block
from parser.toolpath import Toolpath
from parser.units import mm
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
    held = [_held(drawn, path, *one, offset) for one in zip(sections, _beside(path, drawn), strict=True)]
    result = Offsetting(
        drawn=drawn,
        program=replace(program, toolpath=offset_toolpath(drawn, path)),
        path=path,
        left_um=np.concatenate([np.zeros(0), *(one.left_um for one in held)]),
        gouges=tuple(gouge for one in held for gouge in one.gouges),
        loops=tuple(one.loops for one in held if one.loops is not None),
        findings=(),
    )
    closed = [section for section in sections if section.closed]
    found = sorted(_findings(program, offset, result, closed), key=file_order)
    return replace(result, findings=tuple(found))


class _Held(NamedTuple):
    """The offset path beside one section, held against all of it; loops are None where it does not close."""

    left_um: Floats
    gouges: list[Gouge]
    loops: int | None


def _held(drawn: Curves, path: OffsetPath, section: Section, beside: slice, offset: Offset) -> _Held:
    """Hold the rows `beside` of the path against a section of what is drawn."""
    contour = drawn.picked(slice(section.first, section.last + 1))
    # Leads of an open section are left out: where it has none of its own, they begin and end on it.
    near = np.arange(beside.start, beside.stop)[section.closed | (path.made[beside] != Made.LEAD)]
    curves = path.curves.picked(near)
    if section.closed:
        contour = closed_contour(contour)
    met = [g for g in gouges(contour, curves, offset.by_um, offset.side) if not _is_overhang(contour, section, g)]
    gone = path.vanished[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] - section.first
    return _Held(
        left_um=uncut_um(contour, curves, offset.by_um, gone),
        gouges=[g._replace(row=section.first + g.row, path_row=int(near[g.path_row])) for g in met],
        loops=len(reach(contour, offset.by_um, offset.side).loops) if section.closed else None,
    )


def _is_overhang(contour: Curves, section: Section, gouge: Gouge) -> bool:
    """Whether no more is cut than what the ends of a contour miss each other by, where they meet.

    Whole µm never close a contour exactly. Ends that lie side by side are joined midway, which cuts into one of them.
    """
    gap_um = float(np.hypot(*(contour.end_um[-1] - contour.start_um[0])))
    return section.closed and gouge.row in (0, len(contour) - 1) and gouge.depth_um <= gap_um + TOLERANCE_UM


def _beside(path: OffsetPath, drawn: Toolpath) -> Iterator[slice]:
    """Rows of the offset path that cut in each contour, one contour after the other."""
    for begin, past in _contours(drawn):
        yield slice(*np.searchsorted(path.source_row, (begin, past)).tolist())


def _contours(toolpath: Toolpath) -> list[tuple[int, int]]:
    """First row of each contour, and one past its last."""
    is_cut = np.concatenate([[False], ~toolpath.is_jump, [False]])
    edges: list[list[int]] = np.flatnonzero(is_cut[1:] != is_cut[:-1]).reshape(-1, 2).tolist()
    return [(begin, past) for begin, past in edges]


def sections_of(toolpath: Toolpath) -> tuple[Section, ...]:
    """The blocks of each contour that run along the drawing: its loop, without the lead-in and the lead-out.

    As many blocks as lead in may lead out behind the loop; more of them run along the contour once more. A contour
    without a loop, such as a parting cut, is drawn from its first block to its last.
    """
    contours = _contours(toolpath)
    loops = find_loops(toolpath, contour_rows(toolpath), np.arange(len(contours)))
    loop_of = {number: at for at, number in enumerate(loops.contour.tolist())}
    found = []
    for number, (begin, past) in enumerate(contours):
        end, at = past - 1, loop_of.get(number)
        if at is None:
            found.append(Section(begin, end, closed=False))
            continue
        first, last = int(loops.first[at]), int(loops.last[at])
        leads = first - begin
        again = end - last > max(leads, 1)
        closes = np.hypot(*(toolpath.end_um[last] - toolpath.start_um[first])) <= CLOSED_WITHIN_UM
        found.append(Section(first, end - leads if again else last, closed=bool(closes and not again)))
    return tuple(found)


def _findings(program: Program, offset: Offset, made: Offsetting, closed: list[Section]) -> Iterator[Finding]:
    drawn, lines = program.toolpath, program.lines
    gone = made.path.vanished
    middle_mm = mm(places(drawn, gone, np.full(len(gone), 0.5)))
    for row, left_um, (x_mm, y_mm) in zip(gone.tolist(), made.left_um.tolist(), middle_mm.tolist(), strict=True):
        values = {"offset": offset.by_um, "left": left_um, "x_mm": x_mm, "y_mm": y_mm}
        radius_um = float(drawn.radius_um[row])
        if drawn.is_arc[row] and radius_um <= offset.by_um and drawn.sweep_rad[row] * offset.side > 0.0:
            yield at_block(drawn, lines, "3B501", row, radius=radius_um, **values)
        elif left_um > TOLERANCE_UM:
            yield at_block(drawn, lines, "3B502", row, **values)
    for gouge in made.gouges:
        x_mm, y_mm = mm(gouge.place_um.x), mm(gouge.place_um.y)
        other = int(drawn.source.block[gouge.row])
        row = int(made.path.source_row[gouge.path_row])
        yield at_block(
            drawn, lines, "3B503", row, other=other, depth=gouge.depth_um, offset=offset.by_um, x_mm=x_mm, y_mm=y_mm
        )
    for section, loops in zip(closed, made.loops, strict=True):
        if loops != 1:
            yield at_block(drawn, lines, "3B504", section.first, loops=loops, offset=offset.by_um)
