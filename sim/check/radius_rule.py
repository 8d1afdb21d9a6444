"""What the rule of 4B does to a contour: it lengthens and shortens R, and leaves lines as they are (docs/3b.md §6).

That is the true offset only where every joint is tangent, and where the marks D and DD say how the arcs turn.
"""

from collections.abc import Iterator

import numpy as np

from parser.controller_words import StepWords
from parser.dialect.reader import at_block
from parser.findings.findings import Finding, OfAddedOffset
from parser.geometry.along import Directions, directions, headings_at
from parser.geometry.curves import Floats, Ints
from parser.geometry.near import distinct
from parser.program import Program
from parser.shape.loops import are_there_and_back, find_loops
from parser.shape.passes import Passes
from parser.toolpath import Toolpath
from sim.check.geometry import ROUNDING_UM, tight_corners

USUAL_OFFSET_UM = 100.0
"""Offset of the usual wire, for which a shift is told where no other is known (docs/3b.md §5)."""

_TANGENT_RAD = np.radians(0.5)  # at f = 0.1 mm the neighbours then miss each other by 0.9 µm
_ROUNDING_UM = 3.0  # by which ends and centres in whole µm tilt the tangents of short blocks
_WHOLE_TURN_RAD = 0.1  # of an outline that does not cross itself
_RADIUS_UM = 0.5  # R is written in whole µm
_MARKS = {1: "D", 2: "DD"}


def radius_rule_findings(program: Program, contour: Ints, offset_um: float | None) -> Iterator[Finding]:
    """Joints that are no tangents (3B214) and marks against the turn (3B215) of closed outlines in 4B.

    `contour` (n,) is each row's contour, −1 where it has none. Of each outline the first is named. `offset_um` is what
    the controller adds; None where that is not known.
    """
    words = program.toolpath.words
    if words is None:
        return
    shift_um = USUAL_OFFSET_UM if offset_um is None else offset_um
    numbers = distinct(contour[(contour >= 0) & (words.radius_um >= 0)])
    if not len(numbers):
        return
    loops = find_loops(program.toolpath, contour, numbers)
    ways = directions(program.toolpath)
    wide = ~are_there_and_back(program.toolpath, loops.first, loops.last)
    for first, last in zip(loops.first[wide].tolist(), loops.last[wide].tolist(), strict=True):
        rows = np.arange(first, last + 1)
        rows = rows[program.toolpath.length_um[rows] > 0.0]
        if (words.radius_um[rows] >= 0).all():
            turn = _turns(program.toolpath, ways, rows)
            yield from _sharp(program, rows, turn, shift_um)
            yield from _mismarked(program, words, rows, turn)


def vanishing_findings(program: Program, contour: Ints, passes: Passes, offset_um: float) -> list[Finding]:
    """Arcs in 4B of which the offset leaves no radius (3B216): those about a centre on the side of the waste."""
    toolpath, words = program.toolpath, program.toolpath.words
    if words is None:
        return []
    rows = tight_corners(toolpath, contour, passes, offset_um + ROUNDING_UM + _RADIUS_UM, is_drawing=True)
    return [
        at_block(toolpath, program.lines, "3B216", row, radius=float(toolpath.radius_um[row]), offset=offset_um)
        for row in rows.tolist()
        if words.radius_um[row] >= 0
    ]


def _turns(toolpath: Toolpath, ways: Directions, rows: Ints) -> Floats:
    """(m,) signed angle from each of the rows of an outline into the next, the first behind the last."""
    arriving, leaving = ways.arriving[rows], np.roll(ways.leaving[rows], -1, axis=0)
    if toolpath.is_arc[rows[-1]]:  # it may run on past the place where the outline closes
        arriving[-1] = headings_at(toolpath, rows[-1:], toolpath.start_um[rows[:1]])[0]
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    turns: Floats = np.arctan2(cross, (arriving * leaving).sum(axis=1))
    return turns


def _sharp(program: Program, rows: Ints, turn: Floats, shift_um: float) -> Iterator[Finding]:
    toolpath = program.toolpath
    scale = np.fmin(toolpath.radius_um[rows], toolpath.length_um[rows])
    slack = _ROUNDING_UM / np.minimum(scale, np.roll(scale, -1))
    sharp = np.flatnonzero(np.abs(turn) > _TANGENT_RAD + slack)
    if not len(sharp):
        return
    at = int(sharp[0])
    row, after = int(rows[at]), int(np.roll(rows, -1)[at])
    angle = float(np.abs(turn[at]))
    found = at_block(
        toolpath,
        program.lines,
        "3B214",
        after,
        other=int(toolpath.source.block[row]),
        angle=float(np.degrees(angle)),
        offset=shift_um,
        shift=2.0 * shift_um * float(np.sin(angle / 2.0)),
        more=len(sharp) - 1,
    )
    yield found.with_fact(OfAddedOffset())


def _mismarked(program: Program, words: StepWords, rows: Ints, turn: Floats) -> Iterator[Finding]:
    """An outline run counter-clockwise turns so along its convex arcs, D, and the other way along the others, DD.

    Where all or most marks say the opposite, they are taken to mean the opposite: what D means is recalled.
    """
    toolpath = program.toolpath
    whole = float(turn.sum() + toolpath.sweep_rad[rows].sum())
    if abs(abs(whole) - 2.0 * np.pi) > _WHOLE_TURN_RAD:
        return
    marked = (words.turn[rows] != 0) & (words.curve[rows] > 0)
    ruled = np.where(words.turn[rows] == np.sign(whole), 1, 2)
    if 2 * int((marked & (words.curve[rows] != ruled)).sum()) > int(marked.sum()):
        ruled = 3 - ruled
    wrong = np.flatnonzero(marked & (words.curve[rows] != ruled))
    if not len(wrong):
        return
    at = int(wrong[0])
    yield at_block(
        toolpath,
        program.lines,
        "3B215",
        int(rows[at]),
        written=_MARKS[int(words.curve[rows[at]])],
        ruled=_MARKS[int(ruled[at])],
        more=len(wrong) - 1,
    )
