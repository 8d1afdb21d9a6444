"""Findings about passes over one edge: offsets, what they leave, the tab, and where one does not follow the others.

All is measured from path to path. Which of them is the right one the program does not tell; that a later pass comes
nearer to the part, and that none comes nearer than the last, it does.

Passes of a program that compensates: each is to follow the contour of the others, as it is programmed.

How far the wire then runs from the part, the compensated path tells (sim/check/passes.py).
"""

from collections.abc import Iterator

import numpy as np

from parser.dialect.reader import at_block
from parser.findings.findings import Finding, OddShape
from parser.geometry.along import directions
from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.parallel_runs import BESIDE_UM
from parser.shape.passes import WIDEST_TAB, Pass, Passes, row_shifts_um
from parser.toolpath import Toolpath
from sim.setup.wire import DEFAULT_WIRE

_SAME_UM = 10.0  # passes at one offset may lie so far apart: ends in whole µm drift along many small arcs
_RISES_UM = 0.5  # offsets that a program tells are exact
_DEEPER_UM = 20.0  # of single blocks, of which each has a drift of its own
_OTHER_SIDE = 1.8  # offsets that a pass lies aside of another one: no trim takes nearly all of a kerf
_TURNED_RAD = np.radians(300.0)
"""A figure that is left open turns nearly all round; a path that is open by its nature turns back at most."""
_MIDDLE, _STEP_UM = 0.25, 100.0  # a tab comes so near the middle between its ends; leads leave from the ends


def pass_findings(program: Program, contour: Ints, passes: Passes, offset_um: float | None) -> list[Finding]:
    """Findings 3B312 to 3B314 and 3B316 of the edges that are cut by several passes.

    `contour` (n,) is each row's, −1 where it is not judged; `offset_um` is the distance of the wire's centre from the
    edge. Where no wire is known it is None, and no band between two passes is told (3B313).
    """
    judged = _judged(contour, passes)
    found: list[Finding] = []
    for several in judged:
        for of in _main_and_tab(several):
            found += _offsets(program, of, offset_um)
    return [*found, *(_deeper(program, passes, judged) if judged else ())]


def tab_findings(program: Program, contour: Ints, passes: Passes) -> list[Finding]:
    """Finding 3B315 of each edge that is cut by several passes, and whose tab nothing cuts."""
    edges = (_main_and_tab(several) for several in _judged(contour, passes))
    return [found for main, tab in edges if not tab for found in _uncut_tab(program, main)]


def asked_pass_findings(program: Program, passes: Passes, offset_um: float) -> list[Finding]:
    """Findings 3B312 and 3B313 of passes by a controller that added the offsets of a scenario.

    It keeps to one side of the material, which no direction can have wrong (3B316).
    """
    several = _by_edge(Passes(tuple(pass_._replace(part_side=0) for pass_ in passes.passes), passes.of_row))
    return [found for of in several for found in _offsets(program, of, offset_um)]


def _judged(contour: Ints, passes: Passes) -> list[list[Pass]]:
    """Passes over each edge that is cut by several, and that is judged."""
    return [several for several in _by_edge(passes) if contour[several[0].first] >= 0]


def _main_and_tab(passes: list[Pass]) -> tuple[list[Pass], list[Pass]]:
    """Passes along an edge, and those over its tab."""
    main, tab = ([pass_ for pass_ in passes if pass_.is_tab == is_tab] for is_tab in (False, True))
    return main, tab


def _by_edge(passes: Passes) -> list[list[Pass]]:
    """Passes over each edge that is cut by several."""
    of_edge: dict[int, list[Pass]] = {}
    for pass_ in passes.passes:
        of_edge.setdefault(pass_.edge, []).append(pass_)
    return [several for several in of_edge.values() if len(several) > 1]


def _offsets(program: Program, passes: list[Pass], offset_um: float | None) -> Iterator[Finding]:
    """Passes over one edge that lie farther from the part than an earlier one, or so much nearer that it is wrong."""
    nearest = passes[:1]
    for pass_ in passes[1:]:
        other, values = nearest[0], {"number": pass_.number, "other": nearest[0].number}
        by = other.shift_um - pass_.shift_um
        turned = pass_.is_back != other.is_back and pass_.part_side != 0
        if by < -(_SAME_UM if pass_.told_um is None else _RISES_UM):
            yield at_block(program.toolpath, program.lines, "3B312", pass_.first, by=-by, **values)
        elif turned and by > _OTHER_SIDE * (DEFAULT_WIRE.reach_um if offset_um is None else offset_um):
            yield at_block(program.toolpath, program.lines, "3B316", pass_.first, by=by, **values)
        elif offset_um is not None and by > 2.0 * offset_um + _SAME_UM:
            left, kerf = by - 2.0 * offset_um, 2.0 * offset_um
            yield at_block(program.toolpath, program.lines, "3B313", pass_.first, by=by, left=left, kerf=kerf, **values)
            nearest = [pass_]
        elif by > 0.0:
            nearest = [pass_]


def _deeper(program: Program, passes: Passes, judged: list[list[Pass]]) -> Iterator[Finding]:
    """Of each earlier pass the block that comes nearer to the part than the last one, where that is not all of it."""
    shift_um = row_shifts_um(program.toolpath, passes)
    for each in (each for several in judged for each in several):
        rows = slice(each.first, each.last + 1)
        of_pass = _led_to(shift_um[rows], program.toolpath.length_um[rows])
        if each.shift_um < -_SAME_UM or np.isnan(of_pass).all():
            continue
        row = each.first + int(np.nanargmin(of_pass))
        by = float(-np.nanmin(of_pass))
        if by > _DEEPER_UM:
            found = at_block(program.toolpath, program.lines, "3B314", row, number=each.number, by=by)
            yield found.with_fact(OddShape())


def _led_to(shift_um: Floats, length_um: Floats) -> Floats:
    """Shifts (n,) of the rows of a pass, those left out, as NaN, that lie deeper than they are long between two others.

    A path comes no deeper than it is long, so that such a row has the wrong one of the last pass beside it: a piece of
    some µm at a corner is nearly as much beside the one as beside the other.
    """
    known = np.flatnonzero(~np.isnan(shift_um))
    shift = shift_um[known]
    neighbour_um = np.minimum(np.append(np.inf, shift[:-1]), np.append(shift[1:], np.inf))
    is_odd = (-shift > length_um[known]) & (neighbour_um >= -_DEEPER_UM) & np.isfinite(neighbour_um)
    led = shift_um.copy()
    led[known[is_odd]] = np.nan
    return led


def _uncut_tab(program: Program, main: list[Pass]) -> Iterator[Finding]:
    """A tab that passes over all the rest of a figure leave, and that no later block cuts."""
    toolpath, last = program.toolpath, main[-1]
    start, end = toolpath.start_um[last.first], toolpath.end_um[last.last]
    gap = float(np.hypot(*(end - start)))
    length = float(toolpath.length_um[last.first : last.last + 1].sum())
    if any(each.is_closed for each in main) or gap > WIDEST_TAB * length:
        return
    if abs(_turned_rad(toolpath, last)) < _TURNED_RAD or _is_cut(program.toolpath, last):
        return
    blocks = {"first": main[0].first + 1, "last": last.last + 1}
    pause = program.reading.spelling.pause
    yield at_block(toolpath, program.lines, "3B315", last.last, **blocks, gap=gap, pause=pause)


def _turned_rad(toolpath: Toolpath, pass_: Pass) -> float:
    """Angle that the heading turns along a pass, positive counter-clockwise."""
    ways = directions(toolpath)
    before, after = ways.arriving[pass_.first : pass_.last], ways.leaving[pass_.first + 1 : pass_.last + 1]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return float(
        toolpath.sweep_rad[pass_.first : pass_.last + 1].sum() + np.arctan2(cross, (before * after).sum(1)).sum()
    )


def _is_cut(toolpath: Toolpath, pass_: Pass) -> bool:
    """Whether a block behind the last pass may cut the tab: it comes by its middle, or another contour comes near."""
    start, end = toolpath.start_um[pass_.first], toolpath.end_um[pass_.last]
    x, y = (0.5 * (start + end)).tolist()
    gap = float(np.hypot(*(end - start)))
    later = np.arange(pass_.last + 1, len(toolpath))
    later = later[~toolpath.is_jump[later]]
    off, _ = distance_to_curves(toolpath, later, np.full(len(later), x), np.full(len(later), y))
    own = np.append(toolpath.is_jump[pass_.last :], True)
    same = later < pass_.last + int(np.argmax(own))
    return bool((off <= np.where(same, _MIDDLE * gap + _STEP_UM, 0.5 * gap + BESIDE_UM)).any())


_STRAY_UM = 20.0
"""Contours of two passes in whole µm, each from its own start, drift apart by less."""


def followed_findings(program: Program, contour: Ints, passes: Passes) -> Iterator[Finding]:
    """Finding ISO306 at the block of an earlier pass that lies farthest from the contour of the last over its edge.

    `contour` (n,) is each row's, −1 where it is not judged.
    """
    if program.toolpath.compensation is None or len(passes.passes) < 2:
        return
    off_um = np.abs(row_shifts_um(program.toolpath, passes))
    for pass_ in passes.passes:
        of_pass = off_um[pass_.first : pass_.last + 1]
        if contour[pass_.first] < 0 or np.isnan(of_pass).all():
            continue
        row = pass_.first + int(np.nanargmax(of_pass))
        if off_um[row] > _STRAY_UM:
            yield at_block(program.toolpath, program.lines, "ISO306", row, number=pass_.number, by=float(off_um[row]))
