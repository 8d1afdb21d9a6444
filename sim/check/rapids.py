"""Rapids of a program: through work that is not cut, and while compensation is on."""

from collections.abc import Iterator

import numpy as np

from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.along import places
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.contours import runs

_KERF_UM = 500.0
"""A rapid this near to a cut runs in its kerf: offsets and leads lie as far from the contour."""
_ON_ARC, _ON_WAY = 8, 9  # places on each arc of the contour behind, and on the way of a rapid


def rapid_findings(program: Program) -> Iterator[Finding]:
    """Findings ISO301 and ISO302, of programs whose dialect has rapids that need no stop before them."""
    if program.reading.spelling.rapid and program.toolpath.is_jump.any():
        yield from _through_work(program)
        yield from _compensated(program)


def _through_work(program: Program) -> Iterator[Finding]:
    """Finding ISO301 at the first rapid between two runs, with the wire threaded, that leaves what is cut."""
    toolpath = program.toolpath
    cut = runs(toolpath)
    begin = cut[:, 1]
    end = np.append(cut[1:, 0], len(toolpath))
    pauses = np.array([stop.after for stop in toolpath.stops if stop.kind == "pause"], dtype=np.int64)
    is_threaded = np.searchsorted(pauses, begin) == np.searchsorted(pauses, end, side="right")
    for number in np.flatnonzero(is_threaded & (begin < end)).tolist():
        first = int(cut[number, 0])
        near = toolpath.picked(np.arange(first, end[number]))  # alone: of a long program each look takes its time
        leaving = _leaving(near, *np.split(np.arange(len(near)), [begin[number] - first]))
        if leaving is not None:
            row = first + leaving
            way = float(toolpath.length_um[row])
            yield at_block(toolpath, program.lines, "ISO301", row, length=way, rapid=program.reading.spelling.rapid)


def _leaving(curves: Curves, cut: Ints, jumps: Ints) -> int | None:
    """The first of some rapids that leaves the kerf of the blocks cut before it, and what they enclose."""
    row = np.repeat(jumps, _ON_WAY)
    place = places(curves, row, np.tile(np.linspace(0.0, 1.0, _ON_WAY), len(jumps)))
    is_out = ~_is_enclosed(_outline(curves, cut), place)
    is_out[is_out] = _distance_um(curves, cut, place[is_out]) > _KERF_UM
    return int(row[np.argmax(is_out)]) if is_out.any() else None


def _outline(curves: Curves, cut: Ints) -> Floats:
    """Places (m, 2) along blocks: the starts of lines, and some on each arc."""
    count = np.where(curves.is_arc[cut], _ON_ARC, 1)
    before = np.repeat(np.cumsum(count) - count, count)
    share = (np.arange(len(before)) - before) / np.repeat(count, count)
    return places(curves, np.repeat(cut, count), share)


def _is_enclosed(outline: Floats, place: Floats) -> Bools:
    """Whether places (k, 2) lie within an outline (m, 2): a ray from one crosses the outline an odd number of times."""
    x, y = (outline[:, axis] - place[:, axis, None] for axis in range(2))
    to_x, to_y = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
    crosses = (y > 0.0) != (to_y > 0.0)
    is_left = (x * to_y > y * to_x) == (to_y > y)
    enclosed: Bools = (crosses & is_left).sum(axis=1) % 2 == 1
    return enclosed


def _distance_um(curves: Curves, row: Ints, place: Floats) -> Floats:
    """Distances (k,) of places (k, 2) from the nearest of some blocks."""
    x, y = (np.repeat(place[:, axis], len(row)) for axis in range(2))
    off, _ = distance_to_curves(curves, np.tile(row, len(place)), x, y)
    nearest: Floats = off.reshape(len(place), len(row)).min(axis=1)
    return nearest


def _compensated(program: Program) -> Iterator[Finding]:
    """Finding ISO302 at the first rapid while compensation is on, with how many follow."""
    toolpath = program.toolpath
    if toolpath.compensation is None:
        return
    row = np.flatnonzero(toolpath.is_jump & (toolpath.compensation.side != 0) & (toolpath.length_um > 0.0))
    if len(row):
        rapid = program.reading.spelling.rapid
        yield at_block(toolpath, program.lines, "ISO302", int(row[0]), more=len(row) - 1, rapid=rapid)
