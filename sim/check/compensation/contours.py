"""The compensated path beside the contours that it runs along: what stays, what is gouged, what falls apart.

The compensated path held against the contours that it runs along.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from controller.offset.chain import OffsetPath, RowOrigin
from controller.offset.gouges import TOLERANCE_UM, Gouge, approaches, uncut_um
from controller.offset.reach import reach
from controller.offset.shifted import NOTHING_UM, OffsetSection, Side
from controller.offset.stretches import Alarm, AlarmKind
from parser.dialect.reader import at_block
from parser.findings.findings import Finding
from parser.geometry.along import along_um
from parser.geometry.curves import Bools, Curves, Ints, joined
from parser.program import Program
from parser.text.source import Field
from sim.check.compensation.rounds import CompensatedRound, contour_of, parts_of
from sim.check.offset import PassOverRound, beside_round, gouge_finding, loop_finding, rows_beside, uncut_finding


class CompensatedStretch(NamedTuple):
    """A stretch held against its contour: what it is, the contour, and what became of it."""

    run: CompensatedRound
    contour: Curves
    offset_round: PassOverRound


def compensated_stretches(
    curves: Curves, path: OffsetPath, rounds: Sequence[CompensatedRound]
) -> tuple[CompensatedStretch, ...]:
    """The stretches of a program's `curves` held against their contours.

    Most leave nothing and gouge nothing. A path that comes to every block, and too near to none, goes through every
    part of what the wire can reach: there is one closed path, and nothing to be worked out.
    """
    contours = [contour_of(curves, compensated_round.round.section) for compensated_round in rounds]
    is_near = _come_near(path, rounds, contours)
    found = []
    for compensated_round, contour, near in zip(rounds, contours, is_near.tolist(), strict=True):
        section = compensated_round.round.section
        counted = compensated_round.is_nearest and section.closed
        low, high = np.searchsorted(path.vanished, (section.first, section.last + 1))
        if near or low < high:
            over = beside_round(contour, path, compensated_round.round, compensated_round.distances, counted=counted)
        else:
            over = PassOverRound(np.zeros(0), (), 1 if counted else None)
        found.append(CompensatedStretch(compensated_round, contour, over))
    return tuple(found)


def _come_near(path: OffsetPath, rounds: Sequence[CompensatedRound], contours: Sequence[Curves]) -> Bools:
    """(k,) whether the path along a round comes nearer to its contour than it may."""
    is_near = np.zeros(len(rounds), dtype=np.bool_)
    if not rounds:
        return is_near
    rows = [rows_beside(path, compensated_round.round) for compensated_round in rounds]
    own, other = _numbered(rows), _numbered([np.arange(len(contour)) for contour in contours])
    below_um = np.array([compensated_round.kerf_um for compensated_round in rounds]) - TOLERANCE_UM
    close = approaches(joined(contours), path.curves.picked(np.concatenate(rows)), float(below_um.max()))
    of = own[close.path_row]
    is_near[of[(of == other[close.row]) & (close.distance_um < below_um[of])]] = True
    return is_near


def _numbered(parts: Sequence[Ints]) -> Ints:
    """Of the members of all parts, one behind the other, the number of the part of each."""
    return np.repeat(np.arange(len(parts)), [len(part) for part in parts])


SEEN_UM = 1.0
"""What stays, or is cut, by less is not seen on the part: a step."""
_LEFT_UM = 5.0  # along a block that the wire does not come to: less, of a contour in many small blocks, is no fault


class _NoPlace(NamedTuple):
    """Rows of the contour at which the controller stops, and those that have no place though they leave little."""

    stops: set[int]
    unseen: set[int]


def contour_findings(
    program: Program, path: OffsetPath, stretches: Sequence[CompensatedStretch], alarms: Sequence[Alarm]
) -> Iterator[Finding]:
    """What the path makes of the contours, under the codes of an offset, 3B501 to 3B504, and ISO512 and ISO514."""
    without = _without_place(program, path, alarms)
    for compensated_stretch in stretches:
        yield from _uncut(program, path, compensated_stretch, without)
        if compensated_stretch.offset_round.loops not in (None, 1):
            yield loop_finding(
                program,
                compensated_stretch.run.round.section.first,
                int(compensated_stretch.offset_round.loops or 0),
                compensated_stretch.run.by_um,
            )
        if compensated_stretch.run.part_side == compensated_stretch.run.side:
            row, words = compensated_stretch.run.round.begin, _side_words(compensated_stretch.run)
            yield at_block(program.toolpath, program.lines, "ISO512", row, Field.SIDE, **words)
    runs = _by_edge([compensated_stretch.run for compensated_stretch in stretches])
    for compensated_stretch in stretches:
        if (
            compensated_stretch.run.is_nearest
            and compensated_stretch.run.round.section.closed
            and not compensated_stretch.run.at_jump
        ):
            yield from _stub(program, path, compensated_stretch, runs[compensated_stretch.run.along.edge])
    for run, gouge in _told_gouges(stretches):
        row = int(path.source_row[gouge.path_row])
        if row != run.wedge and not _is_mark(program, run, gouge):  # ISO509 tells of a wedge
            yield gouge_finding(program, (row, gouge.row), gouge, run.kerf_um)


def _without_place(program: Program, path: OffsetPath, alarms: Sequence[Alarm]) -> _NoPlace:
    """An inner arc as large as the offset leaves nothing, and makes other controllers stop: it is told too."""
    gone = [alarm for alarm in alarms if alarm.kind in (AlarmKind.TOO_SMALL, AlarmKind.VANISHED)]
    small = {each.row for each in gone if each.kind is AlarmKind.TOO_SMALL}
    seen = {row for row in small if program.toolpath.length_um[row] > _LEFT_UM}
    return _NoPlace({each.row for each in gone if each.stops}, seen | _between_apart(path))


def _by_edge(runs: Sequence[CompensatedRound]) -> dict[int, list[CompensatedRound]]:
    by_edge: dict[int, list[CompensatedRound]] = {}
    for run in runs:
        by_edge.setdefault(run.along.edge, []).append(run)
    return by_edge


def _uncut(
    program: Program, path: OffsetPath, compensated_stretch: CompensatedStretch, without: _NoPlace
) -> Iterator[Finding]:
    """Blocks that the wire does not come to: where the controller stops, and those that the nearest pass leaves."""
    section, run = compensated_stretch.run.round.section, compensated_stretch.run
    vanished = path.vanished[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))]
    passed = set(_missed(path, compensated_stretch).tolist()) - set(vanished.tolist()) if run.is_nearest else set()
    missed = np.array(sorted(passed), dtype=np.int64)
    nearby = path.curves.picked(rows_beside(path, run.round))
    left_um = [
        *compensated_stretch.offset_round.left_um,
        *uncut_um(compensated_stretch.contour, nearby, run.by_um, missed - section.first),
    ]
    for row, left in zip([*vanished.tolist(), *missed.tolist()], left_um, strict=True):
        is_left = run.is_nearest and (left > _LEFT_UM or row in without.unseen)
        if program.toolpath.length_um[row] > NOTHING_UM and (row in without.stops or is_left):
            yield uncut_finding(program, row, float(left), run.distances, stops=row in without.stops)


def _between_apart(path: OffsetPath) -> set[int]:
    """Rows that vanish between blocks that do not meet, such as the floor of a groove narrower than the kerf."""
    bridge = np.flatnonzero((path.made == RowOrigin.BRIDGE) & ~path.curves.is_arc & (path.curves.length_um > _LEFT_UM))
    inner = bridge[(bridge > 0) & (bridge < len(path.made) - 1)].tolist()
    return {row for at in inner for row in range(int(path.source_row[at - 1]) + 1, int(path.source_row[at + 1]))}


def _missed(path: OffsetPath, compensated_stretch: CompensatedStretch) -> Ints:
    """Lines beside which the path runs nowhere, though it has a block for them: corners before and behind take it all.

    Where a step is lower than the offset, the wire turns about its foot before it comes to the step itself.
    """
    section = compensated_stretch.run.round.section
    rows = _path_rows(path, section)
    moved = rows[path.made[rows] == RowOrigin.SHIFTED]
    row = path.source_row[moved] - section.first
    low, high = (
        along_um(compensated_stretch.contour, row, end[moved]) for end in (path.curves.start_um, path.curves.end_um)
    )
    missed: Ints = section.first + row[(high - low <= NOTHING_UM) & ~compensated_stretch.contour.is_arc[row]]
    return missed


def _path_rows(path: OffsetPath, section: OffsetSection) -> Ints:
    """Rows of the path that are made of the blocks of a section."""
    return np.arange(*np.searchsorted(path.source_row, (section.first, section.last + 1)).tolist())


def _side_words(run: CompensatedRound) -> dict[str, str]:
    words = {Side.LEFT: "G41", Side.RIGHT: "G42"}
    return {"side": words[run.side], "other": words[Side(-run.side)]}


def _stub(
    program: Program, path: OffsetPath, compensated_stretch: CompensatedStretch, runs: Sequence[CompensatedRound]
) -> Iterator[Finding]:
    """Material that stays where a loop begins and ends (ISO514), though a wire could cut it."""
    run = compensated_stretch.run
    if _closes(path, run):
        return
    ends = _beside_joint(compensated_stretch.contour, run.by_um)
    row = np.arange(len(ends))
    near = [each.round for each in runs if each.by_um == run.kerf_um]
    cut = path.curves.picked(np.concatenate([rows_beside(path, each) for each in near]))
    left_um = uncut_um(ends, cut, run.by_um, row)
    if left_um.max() <= SEEN_UM:
        return
    reached = [loop.curves for loop in reach(compensated_stretch.contour, run.by_um, run.side).loops]
    if reached:
        stays_um = float((left_um - uncut_um(ends, joined(reached), run.by_um, row)).max())
        if stays_um > SEEN_UM:
            values = {"left": stays_um, "offset": run.by_um}
            yield at_block(program.toolpath, program.lines, "ISO514", run.round.section.first, **values)


def _closes(path: OffsetPath, run: CompensatedRound) -> bool:
    """Whether the path along a loop ends where it begins, so that nothing stays between both."""
    section = run.round.section
    rows = _path_rows(path, section)
    if not len(rows):
        return True
    gap = path.curves.end_um[rows[-1]] - path.curves.start_um[rows[0]]
    return float(np.hypot(*gap)) <= SEEN_UM


def _beside_joint(contour: Curves, by_um: float) -> Curves:
    """A closed contour within an offset of where it begins and ends: beyond that, corners leave material too."""
    row = np.array([0, len(contour) - 1])
    length_um = contour.length_um[row]
    reach_um = np.minimum(length_um, by_um)
    first_um = np.array([0.0, length_um[1] - reach_um[1]])
    return parts_of(contour, row, first_um, first_um + reach_um)


def _is_mark(program: Program, run: CompensatedRound, gouge: Gouge) -> bool:
    """Whether a gouge is no more than the mark that stays where a contour begins and ends.

    Where a jump leads to it under compensation, controllers differ in the corner that jump and contour make: ISO302.
    """
    section = run.round.section
    if run.at_jump:
        x, y = program.toolpath.start_um[section.first]
        return bool(np.hypot(gouge.place_um.x - x, gouge.place_um.y - y) <= 2.0 * run.by_um)
    return section.closed and gouge.row in (section.first, section.last) and gouge.depth_um <= SEEN_UM


def _told_gouges(stretches: Sequence[CompensatedStretch]) -> Iterator[tuple[CompensatedRound, Gouge]]:
    """Gouges, each place of an edge once: of the pass that comes nearest, the first one of several.

    A lead-in and a lead-out that cross the contour at one place are told as one.
    """
    gouges: dict[int, list[tuple[CompensatedRound, Gouge]]] = {}
    for compensated_stretch in sorted(stretches, key=lambda compensated_stretch: compensated_stretch.run.by_um):
        on_edge = gouges.setdefault(compensated_stretch.run.along.edge, [])
        for gouge in compensated_stretch.offset_round.gouges:
            if not any(_is_told(compensated_stretch.run, gouge, run, earlier) for run, earlier in on_edge):
                on_edge.append((compensated_stretch.run, gouge))
    for on_edge in gouges.values():
        yield from on_edge


def _is_told(run: CompensatedRound, gouge: Gouge, other: CompensatedRound, earlier: Gouge) -> bool:
    """Whether a gouge is at the place of an earlier one: of another pass over the edge, or into the same block."""
    (x, y), (was_x, was_y) = gouge.place_um, earlier.place_um
    is_near = np.hypot(x - was_x, y - was_y) <= 2.0 * run.by_um
    return bool(is_near and (run is not other or gouge.row == earlier.row))
