"""Findings about the shape of contours: crossings, senses of arcs, corners tighter than the wire."""

import math
from dataclasses import dataclass

import numpy as np

from parser.dialect.reader import at_block
from parser.findings.codes import Severity
from parser.findings.findings import Fact, Finding, OddShape, TightCorner, Value
from parser.geometry.curves import Ints
from parser.program import Program
from parser.shape.passes import Passes
from parser.text.source import Field
from parser.toolpath import Toolpath
from sim.check.shape.corners import tight_corners
from sim.check.shape.crossings import find_crossings
from sim.check.shape.senses import retraced_arcs, reversed_arcs


@dataclass(frozen=True, slots=True)
class ReversedArc(Fact):
    """The arc would fit its neighbours if it ran the other way round; `word` is what its sense would say, ``SR3``."""

    word: str


def sense_findings(program: Program, contour: Ints) -> list[Finding]:
    """Arcs that would fit their neighbours the other way round: 3B306, and 3B211 for the major arc of a circle.

    A pass back begins with the arc that the pass there ended with, and is meant to turn: each is looked at by itself.
    """
    toolpath = program.toolpath
    contour = _by_side(toolpath, contour)
    found = [_reversed(program, row) for row in retraced_arcs(toolpath, contour).tolist()]
    arcs = reversed_arcs(toolpath, contour)
    for row, is_major, at_both_ends, sweep, other_sweep in zip(*(column.tolist() for column in arcs), strict=True):
        graver = Severity.ERROR if at_both_ends else None
        if is_major:
            written, other = _senses(program, row)
            degrees = {"sweep": round(abs(math.degrees(sweep))), "minor": round(abs(math.degrees(other_sweep)))}
            values: dict[str, Value] = {"written": written, "other": other, **degrees}
            finding = at_block(toolpath, program.lines, "3B211", row, Field.SENSE, **values)
        else:
            finding = _reversed(program, row)
        found.append(finding._replace(graver=graver))
    return found


def _by_side(toolpath: Toolpath, contour: Ints) -> Ints:
    """Contour numbers (n,) that begin anew where compensation changes sides, and stay −1."""
    compensation = toolpath.compensation
    if compensation is None:
        return contour
    changes = np.diff(contour, prepend=-1) != 0
    changes |= np.diff(compensation.side * np.where(compensation.by_um < 0.0, -1, 1), prepend=0) != 0
    return np.where(contour >= 0, np.cumsum(changes), -1)


def _reversed(program: Program, row: int) -> Finding:
    written, other = _senses(program, row)
    word = other if program.mender is None else program.mender.turned(program.toolpath, row).text
    values = {"written": written, "other": other, "word": word}
    return at_block(program.toolpath, program.lines, "3B306", row, Field.SENSE, **values).with_fact(ReversedArc(word))


def _senses(program: Program, row: int) -> tuple[str, str]:
    """The sense of the arc in a row and the other one, as the dialect writes them."""
    spelling = program.reading.spelling
    both = spelling.clockwise, spelling.counter_clockwise
    return both if program.toolpath.turn[row] < 0 else both[::-1]


def crossing_findings(program: Program, contour: Ints, passes: Passes) -> tuple[list[Finding], bool]:
    """The first crossing of each contour with itself (3B307), and whether all pairs of blocks were looked at."""
    crossings = find_crossings(program.toolpath, contour, passes)
    found = []
    for each_crossing in crossings:
        if each_crossing.first is not None:
            later, earlier, (x, y) = each_crossing.first
            values: dict[str, Value] = {
                "crossing": later + 1,
                "other": earlier + 1,
                "x": x,
                "y": y,
                "more": each_crossing.crossings - 1,
            }
            crossing = at_block(program.toolpath, program.lines, "3B307", later, **values)
            found.append(crossing.with_fact(OddShape()))
    return found, all(each_crossing.is_complete for each_crossing in crossings)


def corner_findings(program: Program, contour: Ints, passes: Passes, offset_um: float) -> list[Finding]:
    """Arcs that a wire of this offset cannot cut as drawn (3B305)."""
    toolpath = program.toolpath
    rows = tight_corners(toolpath, contour, passes, offset_um, program.reading.is_drawing)
    if toolpath.words is not None:
        rows = rows[toolpath.words.radius_um[rows] < 0]  # those of 4B are 3B216
    return [
        at_block(
            toolpath, program.lines, "3B305", row, radius=float(toolpath.radius_um[row]), offset=offset_um
        ).with_fact(TightCorner())
        for row in rows.tolist()
    ]
