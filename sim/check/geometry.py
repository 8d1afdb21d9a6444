"""Findings about the shape of contours: crossings, senses of arcs, corners tighter than the wire.

Corners too tight for the wire: arcs of a radius that no path with the wire's offset can have.

Arcs that look reversed: SR written for NR, or the other way.

Such an arc keeps its ends and runs round the other side of the circle. Its tangents at both ends point the other way
exactly, so a smooth joint with a neighbour becomes a cusp; no closure sees it (docs/3b.md §4). Where it is a part of a
circle that is cut in several arcs, one part of the circle is cut there and back and the rest never.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import at_block
from parser.findings.codes import Severity
from parser.findings.findings import Fact, Finding, OddShape, TightCorner, Value
from parser.geometry.along import Directions, directions, places
from parser.geometry.curves import Bools, Floats, Ints
from parser.program import Program
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.shape.loops import find_loops, is_circle
from parser.shape.passes import Passes
from parser.text.source import Field
from parser.toolpath import Toolpath
from sim.check.crossings import find_crossings

ROUNDING_UM = 5.0
"""A small arc in whole µm, begun where the last block ended, is some µm off its radius."""


def tight_corners(toolpath: Toolpath, contour_of_row: Ints, passes: Passes, offset_um: float, is_drawing: bool) -> Ints:
    """Rows (k,) of arcs too small for the offset.

    Parameters
    ----------
    contour_of_row
        (n,) contour number of each row, −1 on jumps; see `parser.shape.contours`.
    passes
        Those of the toolpath.
    offset_um
        Of the wire's centre from the part: wire radius and spark gap.
    is_drawing
        Whether the path is the drawing's contour; else it is that of the wire's centre.

    Notes
    -----
    The wire's centre runs round an outer corner of the part with R + f, about a centre on the part's side: never less
    than f. On an inner corner it runs with R − f, which may be anything. On a drawing it is the other way round: an
    inner corner, its centre on the scrap's side, has to be R ≥ f. Without a lead-in the sides are not known, and a
    small arc may be either.
    """
    small = toolpath.is_arc & (contour_of_row >= 0) & (np.nan_to_num(toolpath.radius_um) < offset_um - ROUNDING_UM)
    row = np.flatnonzero(small)
    if not len(row):
        return row
    of = passes.of_row[row]
    side = np.array([pass_.part_side if pass_.number == 1 else 0 for pass_ in passes.passes] + [0])[
        of
    ]  # on leads the last
    center_side = np.sign(toolpath.sweep_rad[row])
    wrong_side = -side if is_drawing else side
    tight: Ints = row[(side != 0) & (center_side == wrong_side)]
    return tight


_CUSP_RAD = np.radians(178.0)
_LEAST_CUSP_RAD = np.radians(172.0)
_ROUNDING_UM = 3.0  # by which ends and centres in whole µm tilt the tangents of short blocks
_NO_WORSE_RAD = np.radians(85.0)
_LEAST_FORWARD = 0.09  # cosine of a break that is smaller than that: of these the angle is not worked out
_SAME_CIRCLE_UM = 10.0
_ON_CIRCLE_UM = 1.5  # ends in whole µm, and a middle between them
# Of circles cut there and back, at most: whole µm may miss as much where the counted axis stands still.
_SLACK_UM, _SLACK_RAD = 20.0, 0.1


class ReversedArcs(NamedTuple):
    """Arcs (k,) that would fit the blocks beside them if they ran the other way round.

    Attributes
    ----------
    row
        Their rows.
    is_major
        True on arcs of more than a half turn: the smaller arc between the same ends fits.
    at_both_ends
        Whether there is a cusp at both ends: no part is drawn so.
    sweep_rad, other_sweep_rad
        Signed sweep as programmed, and the one that fits.
    """

    row: Ints
    is_major: Bools
    at_both_ends: Bools
    sweep_rad: Floats
    other_sweep_rad: Floats


class _Chain(NamedTuple):
    """Blocks (m,) of a length, by their rows, each with its neighbours as indices into the chain.

    The first and the last of a contour are neighbours; `joined` is False before a block that does not begin where its
    neighbour ends.
    """

    row: Ints
    before: Ints
    after: Ints
    joined: Bools


class _Joints(NamedTuple):
    """Joints (m,) of blocks.

    Attributes
    ----------
    break_rad
        By how much the direction breaks; 0 where it breaks less than `_NO_WORSE_RAD`, which nobody asks for.
    is_cusp, retraces
        Whether it is a cusp, and whether the path runs back there the way it came.
    """

    break_rad: Floats
    is_cusp: Bools
    retraces: Bools


def reversed_arcs(toolpath: Toolpath, contour_of_row: Ints) -> ReversedArcs:
    """Arcs of the contours (n,), −1 on jumps, that look reversed, in the order they are cut."""
    row, at_both_ends = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.bool_)
    if toolpath.is_arc.any():
        ways, chain = directions(toolpath), _chain(toolpath, contour_of_row)
        row, at_both_ends = _suspects(toolpath, chain, ways)
        if len(row):
            # A loop's last block goes over into its first one, not into the lead-out.
            wanted = np.flatnonzero(np.bincount(contour_of_row[row]))
            chain = _with_loops(toolpath, chain, contour_of_row, wanted)
            row, at_both_ends = _suspects(toolpath, chain, ways)
    sweep = toolpath.sweep_rad[row]
    return ReversedArcs(row, toolpath.is_major[row], at_both_ends, sweep, sweep - 2.0 * np.pi * np.sign(sweep))


def retraced_arcs(toolpath: Toolpath, contour_of_row: Ints) -> Ints:
    """Rows (k,) at which the arcs of a circle turn back, if they are one turn long in all but only go there and back.

    Two passes there and back make two turns. A slit that happens to be half a circle is not told from a fault.

    Parameters
    ----------
    contour_of_row
        (n,) contour number of each row, −1 on jumps; see `parser.shape.contours`.
    """
    row = np.flatnonzero(toolpath.is_arc & (contour_of_row >= 0))
    if len(row) < 2:
        return row[:0]
    center, radius, sweep = toolpath.center_um[row], toolpath.radius_um[row], toolpath.sweep_rad[row]
    off = np.fmax(np.hypot(*np.diff(center, axis=0).T), np.abs(np.diff(radius)))
    follows = (np.diff(row) == 1) & (np.diff(contour_of_row[row]) == 0) & (off <= _SAME_CIRCLE_UM)
    begins = np.append(True, ~follows)
    of = np.cumsum(begins) - 1
    turns_round = ~begins & (np.sign(sweep) != np.sign(np.roll(sweep, 1)))
    arc_um = sweep * radius
    first = np.flatnonzero(begins)
    slack = np.minimum(_SLACK_UM, _SLACK_RAD * radius[first])
    there_and_back = np.abs(np.bincount(of, arc_um)) <= slack
    one_turn = np.abs(np.bincount(of, np.abs(arc_um)) - 2.0 * np.pi * radius[first]) <= slack
    once = np.bincount(of, turns_round) == 1
    found: Ints = row[turns_round & (there_and_back & one_turn & once)[of]]
    return found


def _chain(toolpath: Toolpath, contour_of_row: Ints) -> _Chain:
    row = np.flatnonzero((contour_of_row >= 0) & (toolpath.length_um > 0.0))
    contour = contour_of_row[row]
    begins = np.diff(contour, prepend=-1) != 0
    first = np.flatnonzero(begins)
    last = np.append(first[1:] - 1, len(row) - 1)[: len(first)]
    before, after = np.arange(len(row)) - 1, np.arange(len(row)) + 1
    before[first], after[last] = last, first
    gap = toolpath.start_um[row[first]] - toolpath.end_um[row[last]]
    joined = ~begins
    joined[first] = np.hypot(gap[:, 0], gap[:, 1]) <= CLOSED_WITHIN_UM
    return _Chain(row, before, after, joined)


def _with_loops(toolpath: Toolpath, chain: _Chain, contour_of_row: Ints, wanted: Ints) -> _Chain:
    """The chain with the ends of the loops of the contours `wanted` made neighbours, where these do meet."""
    loops = find_loops(toolpath, contour_of_row, wanted)
    place = np.full(len(toolpath), -1, dtype=np.int64)
    place[chain.row] = np.arange(len(chain.row))
    gap = toolpath.end_um[loops.last] - toolpath.start_um[loops.first]
    meet = np.hypot(gap[:, 0], gap[:, 1]) <= CLOSED_WITHIN_UM
    first, last = place[loops.first[meet]], place[loops.last[meet]]
    real = (first >= 0) & (last >= 0)  # not of length 0
    before, after, joined = chain.before.copy(), chain.after.copy(), chain.joined.copy()
    before[first[real]], after[last[real]], joined[first[real]] = last[real], first[real], True
    return chain._replace(before=before, after=after, joined=joined)


def _suspects(toolpath: Toolpath, chain: _Chain, ways: Directions) -> tuple[Ints, Bools]:
    """Arcs, as rows (k,), that the other way round would turn every cusp smooth and no joint worse.

    And whether (k,) there is a cusp at both ends.
    """
    before = _joints(toolpath, chain.row[chain.before], chain.row, ways)
    after = _joints(toolpath, chain.row, chain.row[chain.after], ways)
    joined = chain.joined, chain.joined[chain.after]
    cusp = before.is_cusp & joined[0], after.is_cusp & joined[1]
    suspect = (toolpath.is_arc & ~is_circle(toolpath))[chain.row] & (cusp[0] | cusp[1])
    suspect &= ~joined[0] | (before.break_rad >= _NO_WORSE_RAD)
    suspect &= ~joined[1] | (after.break_rad >= _NO_WORSE_RAD)
    # The way back along a lead-in or a slit begins with a cusp too.
    back = before.retraces | after.retraces
    suspect &= ~back & ~(cusp[0] & back[chain.before]) & ~(cusp[1] & back[chain.after])
    # Where the block across a cusp is as much a suspect, it is the tip of a crescent or of a star.
    cusps = np.where(suspect, cusp[0].astype(np.int64) + cusp[1], 0)
    suspect &= ~(cusp[0] & (cusps[chain.before] >= cusps)) & ~(cusp[1] & (cusps[chain.after] >= cusps))
    return chain.row[suspect], (cusp[0] & cusp[1])[suspect]


def _joints(toolpath: Toolpath, this: Ints, other: Ints, ways: Directions) -> _Joints:
    """Joints from the rows `one` (m,) to the rows `other` (m,)."""
    arriving, leaving = ways.arriving.take(this, axis=0), ways.leaving.take(other, axis=0)
    forward = arriving[:, 0] * leaving[:, 0] + arriving[:, 1] * leaving[:, 1]
    break_rad = np.zeros(len(this))
    wide = np.flatnonzero(forward < _LEAST_FORWARD)
    cross = arriving[wide, 0] * leaving[wide, 1] - arriving[wide, 1] * leaving[wide, 0]
    break_rad[wide] = np.arctan2(np.abs(cross), forward[wide])
    is_cusp, retraces = np.zeros(len(this), dtype=np.bool_), np.zeros(len(this), dtype=np.bool_)
    back = np.flatnonzero(break_rad >= _LEAST_CUSP_RAD)
    this, other = this[back], other[back]
    is_cusp[back] = break_rad[back] >= _CUSP_RAD - _tilt_rad(toolpath, this, other)
    off = toolpath.center_um[this] - toolpath.center_um[other]
    larger = np.abs(toolpath.radius_um[this] - toolpath.radius_um[other])
    same_circle = (np.hypot(off[:, 0], off[:, 1]) <= _SAME_CIRCLE_UM) & (larger <= _SAME_CIRCLE_UM)
    both_arcs = toolpath.is_arc[this] & toolpath.is_arc[other]
    same_circle[both_arcs] |= _lies_on(toolpath, this[both_arcs], other[both_arcs])
    retraces[back] = same_circle | (~toolpath.is_arc[this] & ~toolpath.is_arc[other])
    return _Joints(break_rad, is_cusp, retraces)


def _lies_on(toolpath: Toolpath, this: Ints, other: Ints) -> Bools:
    """(m,) whether the shorter one of two arcs that meet at a cusp lies on the circle of the longer one.

    Whole µm move the centre of an arc of 25 µm and R 1.4 mm by 14 µm, and the arc itself by less than 1 µm.
    """
    is_first = toolpath.length_um[this] < toolpath.length_um[other]
    short, long = np.where(is_first, this, other), np.where(is_first, other, this)
    tip = np.where(is_first[:, None], toolpath.start_um[this], toolpath.end_um[other])
    middle = places(toolpath, short, np.full(len(short), 0.5))
    off = [np.hypot(*(place - toolpath.center_um[long]).T) - toolpath.radius_um[long] for place in (tip, middle)]
    on: Bools = np.abs(off).max(axis=0, initial=0.0) <= _ON_CIRCLE_UM
    return on


def _tilt_rad(toolpath: Toolpath, this: Ints, other: Ints) -> Floats:
    """Tilt of joints (m,) by rounding. A circle's tangent is as uncertain as its centre; a line's as its ends."""
    scale = (np.fmin(toolpath.radius_um[row], toolpath.length_um[row]) for row in (this, other))
    return _ROUNDING_UM / np.minimum(*scale)


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
