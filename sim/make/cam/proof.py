"""The proof of a written program: read back, checked, run on the machine, path and edge held against the drawing.

What falls, and when: of each figure its slug or its part, at the end of its own cut, and nothing besides.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely

from parser.drawing.model import Drawing
from parser.findings.catalogue import Remark
from parser.findings.errors import ProgramError, SettingsError
from parser.findings.findings import Finding, OfAddedOffset, WithoutOffset
from parser.geometry.along import outline, places
from parser.geometry.curves import Bools, Ints
from parser.program import Program
from parser.shape.contours import runs
from parser.toolpath import Point, Toolpath
from parser.units import mm
from sim.base.progress import Progress, silent
from sim.cut.pieces.pieces import Piece, Pieces
from sim.make.cam.lean.walls import ruled_walls_off, wall_faults, walls_off
from sim.make.cam.model import CutPlan, FigureCut, NotProved
from sim.make.cam.parts import with_sides
from sim.make.cam.proof_model import Faces, Fault, Proof, WallOff
from sim.make.cam.proof_run import AsRun, as_run
from sim.make.cam.target import Target, closed_shapes, target_of
from sim.make.cam.visits import figure_rows
from sim.make.conversion_proof import Proof as Written
from sim.measure.compare.compare import compare_program
from sim.measure.compare.findings import by_block, by_entity, compare_cut, drawing_findings
from sim.measure.compare.result import Comparison, FitRequest
from sim.measure.compare.waste import with_waste
from sim.run.dryrun import DryRun
from sim.run.running import dry_run
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario

_CRUMB_UM2 = 2000.0
"""Of less than 0.001 mm² nothing is told when it falls (`sim.cut.pieces`); twice that has fallen."""


def side_faults(plan: CutPlan, target: Target, toolpath: Toolpath) -> Iterator[Fault]:
    """Figures of which the wire runs on the other side than is asked for, by how the contours lie in each other.

    More than half of the path to a figure and round it lies within the contour of the drawing, or outside of it.
    """
    wanted, of_figure = _within(plan, target), figure_rows(toolpath, plan)
    for loop, at in enumerate(target.cut.tolist()):
        first = of_figure[at][0][0]
        rows = toolpath.picked(np.concatenate([np.arange(*span) for span in of_figure[at]]))
        middle = shapely.points(places(rows, np.arange(len(rows)), np.full(len(rows), 0.5)))
        inside = shapely.contains(target.shapes[loop], middle)
        if (2.0 * float(rows.length_um[inside].sum()) > float(rows.length_um.sum())) != bool(wanted[loop]):
            yield Fault("side", {}, Point(*rows.start_um[0].tolist()), plan.cuts[at].figure.number, first + 1)


def _within(plan: CutPlan, target: Target) -> Bools:
    """(k,) whether the wire is to run within each contour: by its depth, and as is asked for."""
    figures = [
        plan.cuts[at].figure._replace(runs_inside=bool(deep % 2), kind="hole" if deep % 2 else "outline")
        for at, deep in zip(target.cut.tolist(), target.depth.tolist(), strict=True)
    ]
    return np.array([figure.runs_inside for figure in with_sides(figures, plan.making)])


def fall_faults(plan: CutPlan, target: Target, pieces: Pieces, reach_um: float) -> Iterator[Fault]:
    """Figures of which nothing falls, or something else than should, or by another figure's cut."""
    fallen: dict[int, list[Piece]] = {}
    for piece in pieces.freed:
        if not piece.is_scrap:
            fallen.setdefault(plan.of_contour[piece.freed.contour - 1], []).append(piece)
    wanted = _within(plan, target)
    for loop, at in enumerate(target.cut.tolist()):
        cut, found = plan.cuts[at], fallen.pop(at, [])
        kind = "slug" if wanted[loop] else "part"
        most_um = max((pass_.by_um for pass_ in cut.passes), default=0.0) or reach_um
        left = target.shapes[loop]
        left = left.buffer(-most_um - reach_um) if kind == "slug" else left
        place = Point(*cut.figure.contour.start_um[0].tolist())
        if cut.is_coreless:
            if found:
                yield Fault("core", {"number": len(found)}, found[0].freed.wire_um, cut.figure.number)
        elif not found and left.area > _CRUMB_UM2:
            yield Fault(f"no-{kind}", {}, place, cut.figure.number)
        elif any(piece.kind != kind for piece in found):
            yield Fault(f"not-{kind}", {}, place, cut.figure.number)
        elif len(found) > max(_pieces_of(left, cut, reach_um), 1):
            yield Fault("pieces", {"number": len(found)}, place, cut.figure.number)
    for at, found in fallen.items():
        yield Fault("pieces", {"number": len(found)}, found[0].freed.wire_um, plan.cuts[at].figure.number)


def _pieces_of(left: shapely.Geometry, cut: FigureCut, reach_um: float) -> int:
    """In how many pieces what is left falls, where its leads may part it: they may reach across a narrow slug."""
    leads = [lead for pass_ in cut.passes for lead in (pass_.into, pass_.out) if len(lead)]
    ways = [shapely.LineString(np.concatenate([outline(lead), lead.end_um[-1:]])) for lead in leads]
    return int(shapely.get_num_geometries(shapely.difference(left, shapely.union_all(ways).buffer(reach_um))))


_MEASURED_UM = 0.05
"""A comparison of exact paths is right to 0.01 µm, and fillets of a drawing to 0.02 µm."""


class ToProve(NamedTuple):
    """What is proved: a program that was read back, the plan that it was written of, and its drawing, unfitted.

    `written` says how far the program's path lies off the plan's, of which whole steps explain `rounding_um`.
    `wire_way` is where the wire is to cut, where the program leads guides that it lags behind; else None. `above` is
    the drawing of the top, unfitted; None of one drawing.
    """

    program: Program
    plan: CutPlan
    drawn: Drawing
    written: Written
    rounding_um: float
    wire_way: Toolpath | None = None
    above: Drawing | None = None


def proved(given: ToProve, scenario: Scenario, progress: Progress = silent) -> Proof:
    """Run a program on the machine of a scenario, and hold its path and what it cuts against the drawing."""
    plan = given.plan
    how = as_run(scenario, plan, given.program.toolpath)
    target, missing = target_of(given.drawn, plan)
    faults = (*_written_faults(given), *missing)
    none = Proof(None, given.written.off_um, None, None, (), faults, how.unproved, how.notes, how.scenario.wire)
    try:
        run = dry_run(given.program, how.scenario, progress, measured=False)
    except ProgramError as error:
        return none._replace(findings=(*error.others, error.finding))
    except SettingsError as error:
        return none._replace(unproved=(*how.unproved, Remark("run", {"why": error.message})))
    progress("comparison", 0, 1)
    of_run, notes = _of_run(run, how)
    by_cut = _by_cut(given, run)
    ran = none._replace(run=run, findings=of_run, faults=(*faults, *by_cut), notes=(*how.notes, *notes))
    ran = ran._replace(unproved=(*how.unproved, *_unlooked(run)))
    if target is None or by_cut:
        return ran
    path, of_path = _path(given, target, run, how)
    cut, of_cut = _as_cut(given, target, run, how)
    walls = tuple(_walls(given, target, run, how))
    faces = _faces(given, target, scenario, how)
    done = ran._replace(
        path=path,
        comparison=cut,
        findings=(*ran.findings, *of_cut.findings),
        faults=(*ran.faults, *of_path.faults, *of_cut.faults, *wall_faults(walls, plan.making.held_to_um)),
        unproved=(*ran.unproved, *of_path.unproved, *of_cut.unproved),
        walls=walls,
        notes=(*ran.notes, *_of_faces(faces)),
        faces=faces,
    )
    return done._replace(at_fault=_at_fault(done, run, of_cut.findings, plan))


def _walls(given: ToProve, target: Target, run: DryRun, how: AsRun) -> Iterator[WallOff]:
    """How far the walls of a leaning cut lie off at all heights; none of an upright one."""
    if run.tilted is None:
        return
    if given.above is None:
        yield from walls_off(run.tilted, given.plan, target)
        return
    yield from ruled_walls_off(run.tilted, given.plan, target, closed_shapes(given.above), how.scenario.wire.reach_um)


def _of_run(run: DryRun, how: AsRun) -> tuple[tuple[Finding, ...], tuple[Remark, ...]]:
    """The findings of a run, and what is to be known to run the program so: of 4B, that its offset is worked in."""
    is_4b = any(isinstance(each.fact, WithoutOffset) for each in run.checked)
    if not is_4b or how.scenario.offset is not None or not how.has_offset:
        return run.findings, ()
    return tuple(finding for finding in run.findings if not isinstance(finding.fact, OfAddedOffset)), (
        Remark("worked-in"),
    )


def _at_fault(proof: Proof, run: DryRun, of_cut: tuple[Finding, ...], plan: CutPlan) -> tuple[NotProved, ...]:
    """The figures that fail a proof where others do not, by its faults and by the findings `of_cut` on their edges.

    None where anything else speaks against the program: that is of no one figure. Where an edge of each is off, those
    count alone whose own path is at fault: a figure that is cut wrong may spoil the edge of another.
    """
    others = [finding for finding in proof.counting if finding not in of_cut]
    if proof.verdict != "fail" or others or not all(fault.figure for fault in proof.faults):
        return ()
    cut_of, by_number = _cut_of_block(run.toolpath, plan), {cut.figure.number: cut.figure for cut in plan.cuts}
    what = {plan.cuts[cut_of[each.block]].figure.number: each.code for each in proof.counting}
    of_path = {fault.figure: fault.name for fault in reversed(proof.faults)}
    what |= of_path
    if len(what) == len(by_number):
        what = of_path
    if len(what) == len(by_number):
        return ()
    return tuple(NotProved(number, what[number]) for number in sorted(what))


class _Found(NamedTuple):
    """What one look at a program finds."""

    faults: tuple[Fault, ...] = ()
    findings: tuple[Finding, ...] = ()
    unproved: tuple[Remark, ...] = ()


def _written_faults(given: ToProve) -> tuple[Fault, ...]:
    """That reading gives something else than was planned."""
    off_um, differs = given.written
    if differs:
        return (Fault("differs", {"what": differs}),)
    return (Fault("written", {"off": off_um, "bound": given.rounding_um}),) if off_um > given.rounding_um else ()


def _of_faces(faces: Faces | None) -> tuple[Remark, ...]:
    if faces is None:
        return ()
    return (Remark("faces", {"lag": faces.lag_um, "off": faces.comparison.max_um}),)


def _by_cut(given: ToProve, run: DryRun) -> tuple[Fault, ...]:
    """That the program has more contours than the plan, or fewer."""
    found, wanted = len(runs(run.toolpath)), len(given.plan.of_contour)
    return () if found == wanted else (Fault("contours", {"found": found, "wanted": wanted}),)


def _unlooked(run: DryRun) -> Iterator[Remark]:
    """Checks that did not come to their end."""
    for check in run.coverage.checks:
        if check.state == "incomplete":
            yield Remark("check", {"check": check.name, "reason": check.reason})


def _path(given: ToProve, target: Target, run: DryRun, how: AsRun) -> tuple[Comparison | None, _Found]:
    """The path held against the offset of the drawing: as it is written where the controller adds the offset.

    It may lie off by the tolerance of the fit, by what rounding to steps moves it, and by gaps of the drawing. Of a
    program for a wire that lags it is the way of the wire, written as the program is, from which that was worked out.
    """
    on_contour = min(how.edge_um, default=0.0) <= 0.0
    toolpath = given.wire_way or (given.program.toolpath if on_contour else run.toolpath)
    making, written = given.plan.making, given.written
    rounding_um = min(written.off_um, given.rounding_um)
    bound_um = making.tolerance_um + rounding_um + target.gap_um + target.drawing.flatten_um + _MEASURED_UM
    faults: list[Fault] = []
    first: Comparison | None = None
    for by_um in sorted(set(how.edge_um)):
        try:
            found = compare_program(toolpath, max(by_um, 0.0), target.drawing, FitRequest(bound_um, fitted=False))
        except SettingsError as error:
            return first, _Found(tuple(faults), (), (Remark("path", {"why": error.message}),))
        first = first or found
        faults += _off_faults(given, toolpath, found, np.array(how.edge_um) == by_um)
    return first, _Found(tuple(faults))


def _off_faults(given: ToProve, toolpath: Toolpath, found: Comparison, of_cut: Bools) -> Iterator[Fault]:
    """The worst place of the path past its bound, both ways, and leads that cut into parts, of some of the cuts.

    Blocks are named where they are those of the program.
    """
    number, names_blocks = _cut_of_block(toolpath, given.plan), given.wire_way is None
    bound_um = found.request.tolerance_um
    for name, deviations in (("path", by_block(found)), ("uncut", by_entity(found))):
        here = [
            deviation
            for deviation in deviations
            if of_cut[number[deviation.block]] and deviation.deviation_um > bound_um
        ]
        if not here:
            continue
        worst = max(here, key=lambda each: each.deviation_um)
        at = number[worst.block]
        values = {"off": worst.deviation_um, "bound": bound_um, **_mm(worst.where_um)}
        yield Fault(name, values, worst.where_um, given.plan.cuts[at].figure.number, worst.block * names_blocks)
    for gouge in found.gouges:
        at = number[gouge.block]
        if of_cut[at]:
            values = {"depth": gouge.depth_um, **_mm(gouge.where_um)}
            yield Fault("lead", values, gouge.where_um, given.plan.cuts[at].figure.number, gouge.block * names_blocks)


def _cut_of_block(toolpath: Toolpath, plan: CutPlan) -> Ints:
    """Index of the cut that each block is of, by its number; of a jump that of the cut behind it."""
    block = toolpath.source.block
    contour = np.searchsorted(runs(toolpath)[:, 1], np.arange(len(toolpath)), side="right")
    of_block = np.zeros(int(block.max(initial=0)) + 1, dtype=np.int64)
    of_block[block] = np.array(plan.of_contour)[np.minimum(contour, len(plan.of_contour) - 1)]
    return of_block


def _mm(place: Point) -> dict[str, float]:
    return {"x_mm": mm(place.x), "y_mm": mm(place.y)}


def _as_cut(given: ToProve, target: Target, run: DryRun, how: AsRun) -> tuple[Comparison | None, _Found]:
    """The edge as cut, after steps and table, and what falls."""
    faults = [*side_faults(given.plan, target, run.toolpath)] if how.has_offset else []
    if run.remains is None or run.ended is not None:  # what an early end leaves uncut is no fault of its own
        return None, _Found(tuple(faults))
    reach_um = how.scenario.wire.reach_um
    pieces = with_waste(run.remains.pieces, target.shapes, 2.0 * reach_um)
    faults += fall_faults(given.plan, target, pieces, reach_um)
    if not how.is_one_edge:
        return None, _Found(tuple(faults))
    found = compare_cut(run.program, run.remains, target.drawing, _held_to(given, target))
    return found, _Found(tuple(faults), tuple(drawing_findings(run.program, found)))


def _held_to(given: ToProve, target: Target) -> DrawingTarget:
    return DrawingTarget(Path(target.drawing.name), tolerance_um=given.plan.making.held_to_um, fit=False)


def _faces(given: ToProve, target: Target, scenario: Scenario, how: AsRun) -> Faces | None:
    """The edge at the faces of the work, by a run with the lag there; None where that is not known."""
    lag_um, share = given.plan.making.lag_um, scenario.wire.face_share(scenario.thickness_mm)
    if not lag_um or share is None or not how.is_one_edge:
        return None
    face_wire = replace(how.scenario.wire, lag=share * lag_um)
    run = dry_run(given.program, replace(how.scenario, wire=face_wire), measured=False)
    if run.remains is None or run.ended is not None:
        return None
    found = compare_cut(run.program, run.remains, target.drawing, _held_to(given, target))
    return None if found is None else Faces(share * lag_um, found)
