"""Findings on the offset that a controller adds, that of the header beside it, and what each leaves of a contour.

A path beside its contour: what an offset makes of a program, whoever asks for it, and what it leaves and gouges.

Findings on the offset that a controller adds: what it leaves uncut, gouges, contours that it closes or divides.

The offset that the header gives, held against the wire, and against what the controller adds besides.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from controller.offset.chain import OffsetPath, RowOrigin
from controller.offset.gouges import TOLERANCE_UM, Gouge, gouges, uncut_um
from controller.offset.passes import NoWayBack, PassedPath
from controller.offset.reach import reach
from controller.offset.shifted import OffsetSection, Round, Side
from parser.dialect.reader import at_block
from parser.findings.findings import Fact, Finding, Value
from parser.geometry.along import places
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.program import Program
from parser.shape.passes import Passes
from parser.toolpath import Toolpath
from parser.units import mm
from sim.setup.part import Offset


class PassBeside(NamedTuple):
    """One pass: the least distance of the wire's centre from the contour, and whether it runs against the first one."""

    by_um: float
    is_back: bool


@dataclass(frozen=True, slots=True, eq=False)
class Offsetting:
    """What became of a program under an offset.

    Attributes
    ----------
    passed
        The program's own toolpath, which runs along the drawing's contour, in the passes that are run.
    program
        The program with the offset path as its toolpath.
    path
        The offset path, and which row of the passes each of its rows comes from.
    side
        Side of the contour in the first pass, along its cutting direction.
    passes
        The passes over each contour; where contours differ, as far as the one with the most.
    edge_passes
        Which rows of the path make each pass over an edge.
    left_um
        (v,) float64, material beyond that of its pass that stays at each row that vanished.
    gouges
        Where the wire cuts into the contour; rows of the contour are rows of the passes.
    loops
        How many closed paths each closed section of the contour allows without a gouge, at the least offset.
    findings
        On all of this, in file order.
    """

    passed: PassedPath
    program: Program
    path: OffsetPath
    side: Side
    passes: tuple[PassBeside, ...]
    edge_passes: Passes
    left_um: Floats
    gouges: tuple[Gouge, ...]
    loops: tuple[int, ...]
    findings: tuple[Finding, ...]

    @property
    def by_um(self) -> float:
        """Least offset: of the pass that makes the edge."""
        return min(pass_.by_um for pass_ in self.passes)

    @property
    def pass_of_row(self) -> Ints:
        """(m,) pass of each row of the path, from 0; −1 where it belongs to none, as a jump."""
        return self.passed.number[self.path.source_row]


class Distances(NamedTuple):
    """How a pass keeps beside a contour.

    Attributes
    ----------
    by_um
        How far the wire's centre is from it.
    kerf_um
        How near it may come: a wide pass leaves stock, and gouges only with the kerf of the pass at the least offset.
    side
        On which side, in the direction of the pass.
    """

    by_um: float
    kerf_um: float
    side: Side


class PassOverRound(NamedTuple):
    """What a pass over one round does to its contour.

    Attributes
    ----------
    left_um
        (v,) material left at each row that vanished, in their order.
    gouges
        Where it cuts in, in rows of the whole path and contour.
    loops
        How many closed paths the contour allows; None where nobody asks.
    """

    left_um: Floats
    gouges: tuple[Gouge, ...]
    loops: int | None


def beside_round(contour: Curves, path: OffsetPath, round_: Round, run: Distances, *, counted: bool) -> PassOverRound:
    """What a pass over a round does to the `contour` of its section; `counted` asks for the closed paths as well."""
    section = round_.section
    near = rows_beside(path, round_)
    curves = path.curves.picked(near)
    met = [g for g in gouges(contour, curves, run.kerf_um, run.side) if not _is_overhang(contour, round_, g)]
    gone = path.vanished[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] - section.first
    return PassOverRound(
        left_um=uncut_um(contour, curves, run.by_um, gone),
        gouges=tuple(g._replace(row=section.first + g.row, path_row=int(near[g.path_row])) for g in met),
        loops=len(reach(contour, run.by_um, run.side).loops) if counted else None,
    )


def rows_beside(path: OffsetPath, round_: Round) -> Ints:
    """Rows of the path that come from a round. Leads of an open section are left out: they may begin and end on it."""
    rows = np.arange(*np.searchsorted(path.source_row, round_[:2]).tolist())
    near: Ints = rows[round_.section.closed | (path.made[rows] != RowOrigin.LEAD)]
    return near


def _is_overhang(contour: Curves, round_: Round, gouge: Gouge) -> bool:
    """Whether no more is cut than what the ends of a contour miss each other by, where they meet.

    Whole µm never close a contour exactly. Ends that lie side by side are joined midway, which cuts into one of them.
    """
    gap_um = float(np.hypot(*(contour.end_um[-1] - contour.start_um[0])))
    return round_.section.closed and gouge.row in (0, len(contour) - 1) and gouge.depth_um <= gap_um + TOLERANCE_UM


@dataclass(frozen=True, slots=True)
class InPass(Fact):
    """The finding is about one pass over its block: `number`, from 0."""

    number: int


def no_way_back(program: Program, stuck: NoWayBack) -> Finding:
    """Finding 3B505 on a pass that cannot begin where the one before it ended."""
    drawn = program.toolpath
    first, last = (int(drawn.source.block[row]) for row in (stuck.round.begin, stuck.round.past - 1))
    values = {"first": first, "last": last, "before": stuck.number, "number": stuck.number + 1, "gap": stuck.gap_um}
    return at_block(drawn, program.lines, "3B505", stuck.round.past - 1, **values)


def uncut_findings(
    program: Program, offset: Offset, passed: PassedPath, gone: Ints, left_um: Floats
) -> Iterator[Finding]:
    """Findings at the rows `gone` (v,) of the passes, along which `left_um` (v,) of material stay.

    3B501 at an inner arc no larger than the offset, 3B502 where some material stays along another block. Only what all
    passes at the least offset leave stays on the part.
    """
    run = Distances(offset.by_um, offset.by_um, offset.side)
    nearest = [number for number, pass_ in enumerate(offset.passes) if pass_.by_um == offset.by_um]
    last = np.isin(passed.number[gone], nearest)
    rows, of, times = np.unique(passed.row[gone[last]], return_inverse=True, return_counts=True)
    least = np.full(len(rows), np.inf)
    np.minimum.at(least, of, left_um[last])
    stays = times == len(nearest)
    rows, least = rows[stays], least[stays]
    fact = InPass(nearest[0])
    for row, left in zip(rows.tolist(), least.tolist(), strict=True):
        if left > TOLERANCE_UM or _is_small_arc(program.toolpath, row, run):
            yield uncut_finding(program, row, left, run).with_fact(fact)


def uncut_finding(program: Program, row: int, left_um: float, run: Distances, *, stops: bool = False) -> Finding:
    """Finding 3B501 or 3B502 at a row that vanished in a pass; whether the controller `stops` there."""
    drawn, by_um = program.toolpath, run.by_um
    (x_mm, y_mm), radius_um = mm(places(drawn, np.array([row]), np.full(1, 0.5)))[0].tolist(), drawn.radius_um[row]
    values: dict[str, Value] = {"offset": by_um, "left": left_um, "x_mm": x_mm, "y_mm": y_mm}
    values["act"] = "compensation-stops" if stops else "compensation-leaves-out"
    if _is_small_arc(drawn, row, run):
        return at_block(drawn, program.lines, "3B501", row, radius=float(radius_um), **values)
    return at_block(drawn, program.lines, "3B502", row, **values)


def _is_small_arc(drawn: Toolpath, row: int, run: Distances) -> bool:
    """Whether a row is an inner arc with a radius no larger than the offset."""
    return bool(drawn.is_arc[row] and drawn.radius_um[row] <= run.by_um and drawn.sweep_rad[row] * run.side > 0.0)


def gouge_findings(
    program: Program, offset: Offset, passed: PassedPath, path: OffsetPath, gouges: Iterable[Gouge]
) -> Iterator[Finding]:
    """Finding 3B503 for each place where the wire cuts into the contour of the program as read.

    Where several passes cut into one block beside the same other, only the pass that cuts deepest is told.
    """
    by_blocks: dict[tuple[int, int], dict[int, list[Gouge]]] = {}
    for gouge in gouges:
        row, number = path.source_row[gouge.path_row], int(passed.number[gouge.row])
        pair = int(passed.row[row]), int(passed.row[gouge.row])
        by_blocks.setdefault(pair, {}).setdefault(number, []).append(gouge)
    for (row, into), by_pass in by_blocks.items():
        deepest = max(by_pass, key=lambda number: max(gouge.depth_um for gouge in by_pass[number]))
        for gouge in by_pass[deepest]:
            number = deepest + 1 if len(offset.passes) > 1 else 0
            yield gouge_finding(program, (row, into), gouge, offset.by_um, number).with_fact(InPass(deepest))


def gouge_finding(program: Program, rows: tuple[int, int], gouge: Gouge, by_um: float, number: int = 0) -> Finding:
    """Finding 3B503 where the wire cuts beside the first of two rows into the other.

    `number` is that of its pass, 0 of the only one.
    """
    drawn, (row, into) = program.toolpath, rows
    values = {
        "other": int(drawn.source.block[into]),
        "pass": number,
        "depth": gouge.depth_um,
        "offset": by_um,
        "x_mm": mm(gouge.place_um.x),
        "y_mm": mm(gouge.place_um.y),
    }
    return at_block(drawn, program.lines, "3B503", row, **values)


def loop_findings(
    program: Program, offset: Offset, passed: PassedPath, loops: Mapping[OffsetSection, int]
) -> Iterator[Finding]:
    """Finding 3B504 at each closed section that does not allow one closed path without a gouge, but none or several.

    The sections are those of a pass at the least offset.
    """
    for section, count in loops.items():
        if count != 1:
            first = int(passed.row[[section.first, section.last]].min())
            yield loop_finding(program, first, count, offset.by_um)


def loop_finding(program: Program, first: int, loops: int, by_um: float) -> Finding:
    """Finding 3B504 at the first row of a contour that allows so many closed paths without a gouge."""
    return at_block(program.toolpath, program.lines, "3B504", first, loops=loops, offset=by_um)


_HEADER_TOLERANCE_UM = 5.0
"""Within this the gap of a wire is not known (docs/3b.md §5: 0.005 to 0.025 mm)."""


def header_offset_findings(
    program: Program, passes: Passes, reach_um: float | None, added_um: float | None
) -> list[Finding]:
    """No offset in the path at all (3B111), another than the wire needs (3B112), one that is added twice (3B506).

    `reach_um` is how far from the wire's centre it cuts, `added_um` what the controller adds; None where that is not
    known. Programs of several passes have one offset in
    their header and several in their paths: they are not judged.
    """
    offset_um, span = program.header.get("offset_um"), program.reading.offset_span
    if not isinstance(offset_um, float) or span is None or _is_four_b(program).any():
        return []
    values: dict[str, Value] = {"header": abs(offset_um)}
    if added_um is not None:
        values["added"] = added_um
        return [program.lines.finding("3B506", span, 0, **values)] if offset_um != 0.0 else []
    if reach_um is None or not _one_pass(passes):
        return []
    values["reach"] = reach_um
    if offset_um == 0.0:
        return [program.lines.finding("3B111", span, 0, **values)]
    differs = abs(abs(offset_um) - reach_um) > _HEADER_TOLERANCE_UM
    return [program.lines.finding("3B112", span, 0, **values)] if differs else []


def _is_four_b(program: Program) -> Bools:
    words = program.toolpath.words
    return np.zeros(1, dtype=np.bool_) if words is None else words.radius_um >= 0


def _one_pass(passes: Passes) -> bool:
    """Whether there are closed contours alone, and each is cut once."""
    return bool(passes.passes) and all(pass_.is_closed and pass_.number == 1 for pass_ in passes.passes)
