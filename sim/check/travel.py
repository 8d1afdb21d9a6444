"""Ways of the table that nobody means: beyond its travel, and rapids through work that is not cut.

The table's travel: which block first leaves it.

Programs that ask for more than any table can do: numbers and steps beyond all bounds (3B206).

Rapids of a program: through work that is not cut, and while compensation is on.

Ways cut from one closed figure to another, where a pause and a jump were meant.

Stops before a part comes free: the tab that is left until then.
"""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from controller.stepping.steps import Steps, interpolate
from parser.controller_words import Axis
from parser.dialect.reader import at_block
from parser.findings.codes import Severity
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, TooLarge, WrongBlock, telling
from parser.geometry.along import places
from parser.geometry.curves import Bools, Curves, Floats, Ints, extents, is_inside, total_before
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.contours import runs
from parser.shape.loops import find_loops, loops_in_order
from parser.shape.passes import Pass, Passes
from parser.text.source import Field
from parser.toolpath import Toolpath
from parser.units import from_mm, mm

if TYPE_CHECKING:
    from sim.setup.machine.table import TableModel


MAX_STEPS = 300_000_000
"""Steps that one run takes: 240 m of path, two months of cutting; a word damaged to nine digits asks for more."""


def too_many_steps(program: Program, steps: Steps) -> list[Finding]:
    """Finding 3B206 where a program makes more steps than any table does."""
    if len(steps) <= MAX_STEPS:
        return []
    row = int(np.argmax(steps.count))
    of = program.toolpath, program.lines
    found = at_block(*of, "3B206", row, Field.COUNT, what="too-many-steps", limit=MAX_STEPS)
    return [found.with_fact(TooLarge())]


def refusal(program: Program, findings: Sequence[Finding]) -> ProgramError:
    """Error of a program that asks for more than any table can do, of which one of the findings tells."""
    finding, _ = next(telling(program.toolpath.source.names.named(findings), TooLarge))
    return ProgramError(finding, excerpt=program.excerpt(finding.line))


def refuse_too_large(program: Program) -> None:
    """ProgramError (3B206) for a program with numbers, or more steps, than any table does."""
    if any(telling(program.findings, TooLarge)):
        raise refusal(program, program.findings)
    beyond = too_many_steps(program, interpolate(program.toolpath))
    if beyond:
        raise refusal(program, beyond)


def travel_findings(
    program: Program, steps: Steps, table: "TableModel", start_um: tuple[float, float]
) -> list[Finding]:
    """Finding 3B401 for the first block that leaves the travel, as stepped from a start on the table."""
    toolpath = program.toolpath
    beyond = beyond_um(toolpath, steps, table, start_um)
    out = np.flatnonzero((beyond > ROUNDING_UM).any(axis=1))
    if not len(out):
        return []
    row = int(out[0])
    axis = int(np.argmax(beyond[row]))
    return [
        at_block(
            toolpath,
            program.lines,
            "3B401",
            row,
            x_mm=table.travel_x_mm,
            y_mm=table.travel_y_mm,
            axis=Axis(axis).name,
            by=float(beyond[row, axis]),
        )
    ]


def beyond_um(toolpath: Toolpath, steps: Steps, table: "TableModel", start_um: tuple[float, float]) -> Floats:
    """How far (n, 2) µm each block goes beyond the travel in X and Y, as stepped from a start on the table; ≤ 0 within.

    The table stands where the steps of earlier blocks left it, not where these should have ended.
    """
    low, high = extents(toolpath)
    shift = np.array(start_um) + steps.corner_um[:-1] - toolpath.start_um
    travel = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    beyond: Floats = np.maximum(-(low + shift), high + shift - travel)
    return beyond


def middle_mm(toolpath: Toolpath, table: "TableModel") -> tuple[float, float] | None:
    """Where a path begins, mm on the table, so that it lies in the middle of the travel; None without a path."""
    if not len(toolpath):
        return None
    low, high = extents(toolpath)
    ahead = toolpath.start_um[0] - 0.5 * (low.min(axis=0) + high.max(axis=0))
    x, y = (0.5 * np.array([table.travel_x_mm, table.travel_y_mm]) + mm(ahead)).tolist()
    return x, y


ROUNDING_UM = 0.5
"""Half a step: a path may go so far beyond the travel."""


_WIDEST_TAB = 0.25  # of the length of a loop: what is longer is no tab


def tab_stop_findings(program: Program, contour: Ints, passes: Passes) -> Iterator[Finding]:
    """Finding ISO309 at the first block behind a stop that leaves a tab; `contour` (n,) is each row's.

    The tab is the last part of a loop, or what a pass of its own cuts behind the passes along the edge.
    """
    after = np.array([stop.after for stop in program.toolpath.stops if stop.kind == "pause"], dtype=np.int64)
    if not program.reading.spelling.rapid or not len(after):
        return
    run_um = total_before(program.toolpath.length_um)
    tabs = {**_in_loops(program, contour, after), **_before_passes(passes, after)}
    for row, past in sorted(tabs.items()):
        if contour[row] >= 0:
            left = float(run_um[past] - run_um[row])
            yield at_block(program.toolpath, program.lines, "ISO309", row, left=left)


def _in_loops(program: Program, contour: Ints, after: Ints) -> dict[int, int]:
    """First rows behind stops within the last part of a loop, and one past its last row."""
    run_um = total_before(program.toolpath.length_um)
    after = after[(after > 0) & (after < len(contour))]
    after = after[(contour[after] >= 0) & (contour[after - 1] == contour[after])]
    loops = find_loops(program.toolpath, contour, np.array(sorted(set(contour[after].tolist())), dtype=np.int64))
    found = {}
    for number, first, last, _ in zip(*(column.tolist() for column in loops), strict=True):
        for row in after[contour[after] == number].tolist():
            left_um, whole_um = float(run_um[last + 1] - run_um[row]), float(run_um[last + 1] - run_um[first])
            if first < row <= last and left_um <= _WIDEST_TAB * whole_um:
                found[row] = last + 1
    return found


def _before_passes(passes: Passes, after: Ints) -> dict[int, int]:
    """First rows of passes over a tab with a stop between them and the pass before, and one past their last rows."""
    before: dict[int, Pass] = {}
    found = {}
    for pass_ in passes.passes:
        last = before.get(pass_.edge, pass_)
        if pass_.is_tab and not last.is_tab and ((after > last.last) & (after <= pass_.first)).any():
            found[pass_.first] = pass_.last + 1
        before[pass_.edge] = pass_
    return found


_APART_UM = 1000.0
"""Passes of one cut lie within the kerf of each other; figures this far apart are two."""


def uncut_jump_findings(program: Program, contour: Ints, passes: Passes) -> list[Finding]:
    """Finding 3B310 at the first line cut on the way from a closed figure to the next one.

    It is an error where the way first goes into the figure that is just closed: what is in there is free, and nobody
    cuts a slit from there. `contour` (n,) is each row's contour, −1 where it has none. By its hole the wire goes to the
    next pass over an edge.
    """
    toolpath = program.toolpath
    is_arc = toolpath.is_arc
    first, last = loops_in_order(toolpath, contour)
    encloses = _enclose(toolpath, first, last)
    first, last = first[encloses], last[encloses]
    found = []
    for here, there in zip(range(len(first) - 1), range(1, len(first)), strict=True):
        begin, arrival = int(last[here]) + 1, int(first[there])
        if contour[begin - 1] != contour[arrival] or arrival <= begin or is_arc[begin:arrival].any():
            continue
        around = passes.around(begin)
        if around and around[0].edge == around[1].edge:
            continue
        if _distance(toolpath, arrival, np.arange(first[here], begin)) > _APART_UM:
            way = float(toolpath.length_um[begin:arrival].sum())
            jump = program.reading.spelling.jump
            finding = at_block(toolpath, program.lines, "3B310", begin, length=way, jump=jump)
            into = _goes_into(toolpath, np.arange(first[here], begin), np.arange(begin, min(arrival, begin + _LEAD)))
            found.append(finding.with_fact(WrongBlock())._replace(graver=Severity.ERROR if into else None))
    return found


_LEAD = 8  # blocks of a lead-out, at most
_INTO_UM = 200.0
"""A way ends so far within a figure on purpose: overlaps of a pass are shorter, and not across it."""


def _goes_into(toolpath: Toolpath, figure: Ints, way: Ints) -> bool:
    """Whether one of the lines of a way ends within a closed figure; both are rows."""
    place = toolpath.end_um[way]
    for x, y in place[is_inside(toolpath.picked(figure), place)].tolist():
        off, _ = distance_to_curves(toolpath, figure, np.full(len(figure), x), np.full(len(figure), y))
        if float(off.min()) > _INTO_UM:
            return True
    return False


def _enclose(toolpath: Toolpath, first: Ints, last: Ints) -> Bools:
    """Which of k figures enclose anything: two lines there and back, such as the set-up of an offset, do not."""
    arcs = np.concatenate([[0], np.cumsum(toolpath.is_arc)])
    encloses: Bools = (last - first >= 2) | (arcs[last + 1] > arcs[first])
    return encloses


def _distance(toolpath: Toolpath, row: int, figure: Ints) -> float:
    """Distance µm of a row's start from the blocks of a figure."""
    x, y = toolpath.start_um[row]
    off, _ = distance_to_curves(toolpath, figure, np.full(len(figure), x), np.full(len(figure), y))
    return float(off.min())


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
