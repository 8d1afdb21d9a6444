"""What is wrong with a lean: blocks that turn over, ways and angles that the machine does not have, uneven pieces."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from controller.taper.tilted import TiltedPath, section_toolpath
from parser.dialect.reader import at_block
from parser.findings.codes import Severity
from parser.findings.findings import Finding, Value
from parser.geometry.ruled import uneven_partners
from parser.program import Program
from parser.shape.contours import contour_rows
from parser.shape.passes import find_passes
from parser.toolpath import Toolpath
from parser.units import from_mm, mm
from sim.check.crossings import find_crossings
from sim.check.lean import Offsets
from sim.check.travel import ROUNDING_UM
from sim.setup.machine.guides import Guides
from sim.setup.machine.table import TableModel

_HAIR_UM: Final = 1.0
"""By so much a path may leave the travel: the lower guide stands at whole steps."""
_OFFSET_UM: Final = 1.0
"""Offsets that differ by less are one."""


def taper_findings(
    program: Program,
    path: TiltedPath,
    guides: Guides,
    table: TableModel | None = None,
    start_um: tuple[float, float] | None = None,
) -> Iterator[Finding]:
    """Findings 3B701 to 3B704, 3B706, 3B709 and 3B710, each at the first block that it is about, and how many more.

    `start_um` is the place of the program's start on the table, None where no table is known.
    """
    yield from _turned(program, path)
    yield from _guides(program, path, guides)
    if table is not None and start_um is not None:
        yield from _travel(program, path, table, start_um)
    yield from _uneven(program, path)
    yield from _crossing(program, path)


def not_widened(program: Program, angle_rad: float, reach_um: float) -> Iterator[Finding]:
    """3B708: the path has the offset of an upright wire in it, half a kerf, and leans by an angle throughout."""
    header_um = program.header.get("offset_um")
    needed_um = reach_um / float(np.cos(angle_rad))
    if not isinstance(header_um, float) or needed_um - header_um <= _OFFSET_UM:
        return
    if abs(header_um - reach_um) < _OFFSET_UM:
        off_um = needed_um - header_um
        yield _at(program, "3B708", 0, offset_mm=mm(header_um), off=off_um, needed_mm=mm(needed_um))


def top_offset_findings(program: Program, offsets: Offsets) -> Iterator[Finding]:
    """3B712: the offset does to the contour at the top what it does not to the lower one; at its first block."""
    plane, top = offsets
    if plane is None or top is None:
        return
    below = {found.block for found in plane.findings}
    new = [found for found in top.findings if found.severity is not Severity.NOTE and found.block not in below]
    if not new:
        return
    worst = next((found for found in new if found.severity is Severity.ERROR), new[0])
    row = int(np.argmax(program.toolpath.source.block == worst.block))
    found = _at(program, "3B712", row, other=worst.code, more=len(new) - 1)
    yield found._replace(graver=worst.severity if worst.severity is Severity.ERROR else None)


def _turned(program: Program, path: TiltedPath) -> Iterator[Finding]:
    """3B701: nothing is left of a block at a height within the work."""
    rows = list(dict.fromkeys(turned.row for turned in path.turned))
    if not rows:
        return
    row = rows[0]
    z_um = next(turned.z_um for turned in path.turned if turned.row == row)
    arc = bool(program.toolpath.is_arc[row])
    values: dict[str, Value] = {"z_mm": mm(z_um), "off_mm": mm(abs(z_um - path.heights.program_um))}
    what = "turned-arc" if arc else "turned-line"
    size_um = float(program.toolpath.radius_um[row] if arc else program.toolpath.length_um[row])
    yield _at(program, "3B701", row, **values, what=what, size=size_um, more=len(rows) - 1)


def _guides(program: Program, path: TiltedPath, guides: Guides) -> Iterator[Finding]:
    """3B702, 3B703 and 3B710: U, V or the angle go farther than the machine does."""
    row, axes = path.sampled_axes_um()
    reach = axes[:, 2:]
    if guides.travel_u_um == 0.0 or guides.travel_v_um == 0.0:
        yield _at(program, "3B710", int(row[np.argmax(np.hypot(*reach.T))]))
        return
    for axis, travel_um in enumerate((guides.travel_u_um, guides.travel_v_um)):
        beyond = np.flatnonzero(np.abs(reach[:, axis]) > (travel_um or np.inf) / 2.0 + ROUNDING_UM)
        if travel_um is not None and len(beyond):
            most = float(np.abs(reach[:, axis]).max())
            yield _at(
                program, "3B702", int(row[beyond[0]]), axis="UV"[axis], most_mm=mm(most), travel_mm=mm(travel_um / 2.0)
            )
            break
    lean = path.lean_most_rad()
    if guides.most_rad is not None and lean > guides.most_rad + 1e-9:
        worst = int(path.source_row[path.most_leaning_row()])
        yield _at(program, "3B703", worst, angle_deg=np.degrees(lean), most_deg=np.degrees(guides.most_rad))


def _travel(program: Program, path: TiltedPath, table: TableModel, start_um: tuple[float, float]) -> Iterator[Finding]:
    """3B704: the lower guide leaves the travel of X and Y, where the path of the program plane does not."""
    row, axes = path.sampled_axes_um()
    shift = np.array(start_um) - program.toolpath.start_um[0]
    travel = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    on_table = axes[:, :2] + shift
    beyond = np.maximum(-on_table, on_table - travel).max(axis=1)
    out = np.flatnonzero(beyond > _HAIR_UM)
    if not len(out):
        return
    own = program.toolpath.end_um + shift
    if (np.maximum(-own, own - travel).max(axis=1) > _HAIR_UM).any():
        return  # 3B401 says it
    yield _at(
        program,
        "3B704",
        int(row[out[0]]),
        by_mm=mm(float(beyond.max())),
        wide_mm=table.travel_x_mm,
        deep_mm=table.travel_y_mm,
    )


def _uneven(program: Program, path: TiltedPath) -> Iterator[Finding]:
    """3B706: one of two blocks that are run together is far longer than the other, by the size of their contours.

    A block that stands at a corner while its partner moves is meant so.
    """
    if path.angle_rad is not None:
        return
    rows, n = np.concatenate([np.zeros(0, dtype=np.int64), *path.loops]), len(program.toolpath)
    lower, upper = (np.bincount(path.source_row[rows], of.length_um[rows], n).astype(np.float64) for of in path.faces)
    found = np.flatnonzero(uneven_partners(lower, upper))
    if len(found):
        row = int(found[0])
        values = {"lower_mm": mm(float(lower[row])), "upper_mm": mm(float(upper[row]))}
        yield _at(program, "3B706", row, **values, more=len(found) - 1)


def _crossing(program: Program, path: TiltedPath) -> Iterator[Finding]:
    """3B709: the wire runs over its own way at the bottom or the top, and does not in the program plane.

    A block that turns over does so too, and is told by that.
    """
    if path.turned or _first_crossing(program.toolpath) is not None:
        return
    for z_um, curves in zip((0.0, path.heights.work_um), path.faces, strict=True):
        row = _first_crossing(section_toolpath(program.toolpath, curves, path.source_row))
        if row is not None:
            yield _at(program, "3B709", int(path.source_row[row]), z_mm=mm(z_um))
            return


def _first_crossing(toolpath: Toolpath) -> int | None:
    """The first row in which a path crosses itself; None where it does not."""
    crossings = find_crossings(toolpath, contour_rows(toolpath), find_passes(toolpath))
    firsts = [each.first.later_row for each in crossings if each.first is not None]
    return min(firsts, default=None)


def _at(program: Program, code: str, row: int, **values: Value) -> Finding:
    return at_block(program.toolpath, program.lines, code, row, **values)
