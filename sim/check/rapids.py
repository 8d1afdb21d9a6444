"""Rapids of a program: through work that is not cut, and while compensation is on."""

from collections.abc import Iterator

import numpy as np

from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.contours import runs
from parser.toolpath import Toolpath

_KERF_UM = 500.0
"""A rapid this near to a cut runs in its kerf: offsets and leads lie as far from the contour."""
_PER_ROW, _ON_WAY = 8, 9  # places on each block of the contour behind, and on the way of a rapid


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
        row = _leaving(toolpath, np.arange(*cut[number]), np.arange(begin[number], end[number]))
        if row is not None:
            way = float(toolpath.length_um[row])
            yield at_block(toolpath, program.lines, "ISO301", row, length=way, rapid=program.reading.spelling.rapid)


def _leaving(toolpath: Toolpath, cut: Ints, jumps: Ints) -> int | None:
    """The first of some rapids that leaves the kerf of the blocks cut before it, and what they enclose."""
    outline = places(toolpath, np.repeat(cut, _PER_ROW), np.tile(np.arange(_PER_ROW) / _PER_ROW, len(cut)))
    for row in jumps.tolist():
        for place in places(toolpath, np.full(_ON_WAY, row), np.linspace(0.0, 1.0, _ON_WAY)):
            if not (_is_enclosed(outline, place) or _distance_um(toolpath, cut, place) <= _KERF_UM):
                return int(row)
    return None


def _is_enclosed(outline: Floats, place: Floats) -> bool:
    """Whether a place (2,) lies within an outline (m, 2): a ray from it crosses the outline an odd number of times."""
    off = outline - place
    after = np.roll(off, -1, axis=0)
    crosses = (off[:, 1] > 0.0) != (after[:, 1] > 0.0)
    side = off[:, 0] * after[:, 1] - off[:, 1] * after[:, 0]
    return bool((crosses & ((side > 0.0) == (after[:, 1] > off[:, 1]))).sum() % 2)


def _distance_um(toolpath: Toolpath, row: Ints, place: Floats) -> float:
    off, _ = distance_to_curves(toolpath, row, np.full(len(row), place[0]), np.full(len(row), place[1]))
    return float(off.min())


def _compensated(program: Program) -> Iterator[Finding]:
    """Finding ISO302 at the first rapid while compensation is on, with how many follow."""
    toolpath = program.toolpath
    if toolpath.compensation is None:
        return
    row = np.flatnonzero(toolpath.is_jump & (toolpath.compensation.side != 0) & (toolpath.length_um > 0.0))
    if len(row):
        rapid = program.reading.spelling.rapid
        yield at_block(toolpath, program.lines, "ISO302", int(row[0]), more=len(row) - 1, rapid=rapid)
