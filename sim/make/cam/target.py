"""What a made program is held against, its drawing unfitted, and how it is run for that.

What a program is held against: the contours of its drawing that are to be cut, as they are drawn, unfitted.

What a proof says: `Proof`, with the faults that it found by itself beside the findings of check and run.

How a written program is run for its proof: with the wire that cuts so, and its path in the middle of the table.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.drawing.model import SAME_WITHIN_UM, Drawing, DrawnLoop, Entity, running
from parser.findings.catalogue import Remark
from parser.findings.codes import Severity
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding, TightCorner, Value
from parser.geometry.curves import Curves, Floats, Ints, curves_between, extents, joined
from parser.toolpath import Point, Toolpath
from parser.units import mm
from sim.check.travel import middle_mm
from sim.make.cam.leaning import cosine_of, in_plane
from sim.make.cam.model import CutPlan, Figure, NotProved
from sim.measure.compare.result import Comparison
from sim.measure.compare.rings import polygon
from sim.run.dryrun import DryRun
from sim.setup.making import Making
from sim.setup.part import Offset, OffsetPass
from sim.setup.scenario import Scenario
from sim.setup.wire import SPARK_GAP_MM, Wire

Verdict = Literal["pass", "fail", "incomplete"]


class Fault(NamedTuple):
    """What a proof found wrong by itself.

    Attributes
    ----------
    name
        Of its text for people, ``program.fault-…``.
    values
        What fills the text; lengths in µm, those that end on ``_mm`` in mm.
    place_um
        Where it is seen; None where it has no one place.
    figure
        Number of the figure that it is of; 0 where it is of none.
    block
        Number of the block that it is of; 0 where it is of none.
    """

    name: str
    values: Mapping[str, Value] = MappingProxyType({})
    place_um: Point | None = None
    figure: int = 0
    block: int = 0


class Faces(NamedTuple):
    """The edge as cut at the upper and lower face of the work, beside the drawing, where the wire lags by less."""

    lag_um: float
    comparison: Comparison


class WallOff(NamedTuple):
    """How far the wall of a figure lies off at a height over the bottom of the work, and where; infinity: no wall."""

    figure: int
    z_um: float
    off_um: float
    where_um: Point


class Proof(NamedTuple):
    """What reading, checking and running a written program shows, beside its drawing.

    Attributes
    ----------
    run
        The run; None where the program could not be run at all.
    written_um
        How far the written path lies off that which was planned.
    path
        The edge beside the written path and the contours of the drawing that are to be cut; None where there is none.
    comparison
        The edge as cut beside the same contours; None where there is none.
    findings
        Of the check, the run and the comparison of the edge as cut.
    faults
        What the proof found wrong besides.
    unproved
        What could not be proved, and why: names of texts ``program.unproved-…``.
    notes
        What was assumed: names of texts ``program.proof-…``.
    wire
        What the program was run with.
    at_fault
        The figures that fail where others do not, each with what it fails by.
    faces
        The edge at the upper and lower face of the work; None where no lag is corrected, or none is known there.
    walls
        How far walls lie off at each height; empty of an upright wire.
    """

    run: DryRun | None
    written_um: float
    path: Comparison | None
    comparison: Comparison | None
    findings: tuple[Finding, ...]
    faults: tuple[Fault, ...]
    unproved: tuple[Remark, ...]
    notes: tuple[Remark, ...]
    wire: Wire
    at_fault: tuple[NotProved, ...] = ()
    faces: Faces | None = None
    walls: tuple[WallOff, ...] = ()

    @property
    def counting(self) -> tuple[Finding, ...]:
        """The findings that speak against the program: a made one has no warning either.

        But for corners that a wire cannot cut as the path has them, where the edge was held against the drawing.
        """
        is_held = self.comparison is not None
        grave = (finding for finding in self.findings if finding.severity is not Severity.NOTE)
        return tuple(each for each in grave if not (is_held and isinstance(each.fact, TightCorner)))

    @property
    def verdict(self) -> Verdict:
        """Whether the program may be written: ``incomplete`` where nothing is wrong, and not all could be proved."""
        if self.counting or self.faults:
            return "fail"
        return "incomplete" if self.unproved else "pass"

    @property
    def path_um(self) -> float | None:
        """How far the written path lies at most from the offset of the drawing, both ways; None where not known."""
        return None if self.path is None else self.path.max_um


_NEAR_UM = 1000.0
"""A figure's box may lie so far from that of its contour: what a wrong fit moves is told as a path that is off."""


class Target(NamedTuple):
    """The contours that are to be cut, k loops.

    Attributes
    ----------
    drawing
        They alone, their gaps bridged by lines.
    cut
        (k,) index of the plan's cut that each is of.
    shapes
        They as polygons.
    depth
        (k,) how many contours lie round each, cut or not.
    gap_um
        The largest gap that is bridged.
    """

    drawing: Drawing
    cut: Ints
    shapes: tuple[shapely.Polygon, ...]
    depth: Ints
    gap_um: float


def target_of(drawn: Drawing, plan: CutPlan) -> tuple[Target | None, tuple[Fault, ...]]:
    """The contours of a drawing that a plan cuts, None where it cuts none; and what of the two is not in the other."""
    closed = [loop for loop in drawn.loops if loop.closed]
    rings = [running(drawn.curves, loop.row, loop.backwards) for loop in closed]
    features = _features(rings)
    found = _nearest(_features([cut.figure.contour for cut in plan.cuts]), features)
    known = np.flatnonzero(found >= 0)
    once, first = np.unique(found[known], return_index=True)
    left_out = {each.entity for each in plan.left_out}
    uncut = np.setdiff1d(_nearest(_features([each.contour for each in plan.uncut]), features), [-1, *once.tolist()])
    missing = [
        at
        for at in np.setdiff1d(np.arange(len(closed)), [*once.tolist(), *uncut.tolist()]).tolist()
        if not _is_told(drawn, closed[at], left_out)
    ]
    faults = (
        *(_of_cut("stray", plan, at) for at in np.flatnonzero(found < 0).tolist()),
        *(_of_cut("twice", plan, at) for at in np.setdiff1d(known, known[first]).tolist()),
        *(_missing(drawn, closed[at]) for at in missing),
    )
    if not len(once):
        return None, faults
    shapes = [polygon(rings[at]) for at in once.tolist()]
    others = [
        *(polygon(rings[at]) for at in missing),
        *(shapely.make_valid(polygon(each.contour)) for each in plan.uncut if each.why != "frame"),
    ]
    loops = [closed[at] for at in once.tolist()]
    gap_um = max(loop.gap_um for loop in loops)
    depth = _depths([*shapes, *others])[: len(loops)]
    return Target(_only(drawn, loops), known[first], tuple(shapes), depth, gap_um), faults


def _depths(shapes: Sequence[shapely.Geometry]) -> Ints:
    """(k,) how many of the others lie round each: a place within it lies within them, and they are larger."""
    area = shapely.area(shapes)
    inner = np.asarray(shapely.point_on_surface(shapes), dtype=np.object_)
    shape, around = shapely.STRtree(shapes).query(inner, predicate="within")
    depth: Ints = np.bincount(shape[area[around] > area[shape]], minlength=len(shapes))
    return depth


def _features(contours: Sequence[Curves]) -> Floats:
    """(k, 5) of each contour: the box that it lies in, and the side of a square as large."""
    if not contours:
        return np.empty((0, 5))
    first = np.cumsum([0, *map(len, contours[:-1])])
    curves = joined(contours)
    low, high = extents(curves)
    start, end = curves.start_um, curves.end_um
    shift = np.repeat(start[first], np.diff(np.append(first, len(curves))), axis=0)
    x, y = (start - shift).T
    cross = x * (end - shift)[:, 1] - y * (end - shift)[:, 0]
    turn = np.where(curves.is_arc, curves.sweep_rad, 0.0)
    segment = np.where(curves.is_arc, curves.radius_um, 0.0) ** 2 * (turn - np.sin(turn))
    area = np.add.reduceat(0.5 * (cross + segment), first)
    lows, highs = np.minimum.reduceat(low, first), np.maximum.reduceat(high, first)
    return np.column_stack([lows, highs, np.sqrt(np.abs(area))])


def _nearest(of_cut: Floats, of_loop: Floats) -> Ints:
    """(c,) the loop that is most like each cut; −1 where none lies near."""
    found = np.full(len(of_cut), -1, dtype=np.int64)
    if not len(of_loop):
        return found
    tree = shapely.STRtree(np.asarray(shapely.points(of_loop[:, :2]), dtype=np.object_))
    cut, loop = tree.query(shapely.points(of_cut[:, :2]), predicate="dwithin", distance=_NEAR_UM)
    off = np.abs(of_cut[cut] - of_loop[loop]).max(axis=1)
    near = np.flatnonzero(off <= _NEAR_UM)
    order = near[np.argsort(-off[near], kind="stable")]  # the nearest is entered last
    found[cut[order]] = loop[order]
    return found


def _of_cut(name: str, plan: CutPlan, at: int) -> Fault:
    figure = plan.cuts[at].figure
    return Fault(name, {}, Point(*figure.contour.start_um[0].tolist()), figure.number)


def _is_told(drawn: Drawing, loop: DrawnLoop, told_entities: set[Entity]) -> bool:
    """Whether a contour is of entities that are left out, and told so."""
    return bool(told_entities) and {drawn.entities[int(at)] for at in drawn.entity[loop.row]} <= told_entities


def _missing(drawn: Drawing, loop: DrawnLoop) -> Fault:
    place = Point(*running(drawn.curves, loop.row[:1], loop.backwards[:1]).start_um[0].tolist())
    entity = drawn.entities[int(drawn.entity[loop.row[0]])]
    named = f"{entity.kind} {entity.handle}"
    return Fault("missing", {"entity": named, "x_mm": mm(place.x), "y_mm": mm(place.y)}, place)


def _only(drawn: Drawing, loops: Sequence[DrawnLoop]) -> Drawing:
    """A drawing of some loops alone, each of them bridged, its curves in running order."""
    rings = [_bridged(drawn, loop) for loop in loops]
    number = [len(ring) for ring, _ in rings]
    past = np.cumsum(number)
    entities, entity = np.unique(np.concatenate([of for _, of in rings]), return_inverse=True)
    return replace(
        drawn,
        curves=joined([ring for ring, _ in rings]),
        entity=entity.reshape(-1).astype(np.int64),
        entities=tuple(drawn.entities[at] for at in entities.tolist()),
        loops=tuple(
            DrawnLoop(np.arange(end - count, end), np.zeros(count, dtype=np.bool_), closed=True, gap_um=loop.gap_um)
            for loop, count, end in zip(loops, number, past.tolist(), strict=True)
        ),
        notes=(),
    )


def _bridged(drawn: Drawing, loop: DrawnLoop) -> tuple[Curves, Ints]:
    """A loop in running order with lines over its gaps, and the entity of each curve."""
    ring, entity = running(drawn.curves, loop.row, loop.backwards), drawn.entity[loop.row]
    if loop.gap_um <= SAME_WITHIN_UM:
        return ring, entity
    ahead = np.roll(ring.start_um, -1, axis=0)
    gap = np.flatnonzero(np.hypot(*(ahead - ring.end_um).T) > SAME_WITHIN_UM)
    lines = curves_between(ring.end_um[gap], ahead[gap], np.full((len(gap), 2), np.nan), np.zeros(len(gap)))
    order = np.argsort(np.concatenate([2 * np.arange(len(ring)), 2 * gap + 1]), kind="stable")
    return joined([ring, lines]).picked(order), np.concatenate([entity, entity[gap]])[order]


_SAME_UM = 1e-6
_WIDEST_GAP_UM = 100.0
"""A spark gap is 10 to 50 µm (docs/3b.md §5); an offset that leaves more is one for another wire."""


class AsRun(NamedTuple):
    """How a program is run.

    Attributes
    ----------
    scenario
        With the wire, and with the offset that the controller adds to a program on the contour itself.
    edge_um
        Of each cut, how far its path lies from the edge that it is to make; 0 for a program on the contour itself.
    notes
        What of it was assumed.
    unproved
        What no run can show.
    """

    scenario: Scenario
    edge_um: tuple[float, ...]
    notes: tuple[Remark, ...] = ()
    unproved: tuple[Remark, ...] = ()

    @property
    def is_one_edge(self) -> bool:
        """Whether one wire makes the edges of all cuts."""
        return max(self.edge_um, default=0.0) - min(self.edge_um, default=0.0) <= _SAME_UM

    @property
    def has_offset(self) -> bool:
        """Whether the path that runs lies beside the contours."""
        return self.scenario.offset is not None or min(self.edge_um, default=0.0) > 0.0


def least_um(figure: Figure, making: Making, reach_um: float) -> float:
    """The least offset that is asked for a figure: that of the pass that makes its edge."""
    return min(_passes_um(figure, making, reach_um))


def _passes_um(figure: Figure, making: Making, reach_um: float) -> tuple[float, ...]:
    """The offsets that are asked for a figure."""
    wishes = [
        layer.passes_um for layer in making.layers if layer.layer.lower() == figure.layer.lower() and layer.passes_um
    ]
    return (wishes[0] if wishes else making.passes_um) or (reach_um,)


def as_run(scenario: Scenario, plan: CutPlan, toolpath: Toolpath) -> AsRun:
    """How the program of a plan, whose path is read back as this one, is run: by a wire whose edge is the drawing's."""
    for_proof = replace(
        scenario, kerf=True, drawing=None, offset=None, quiz=(), expect=(), technology=None, material=None
    )
    for_proof = replace(for_proof, start_mm=scenario.start_mm or middle_mm(toolpath, scenario.machine.table))
    if plan.making.lag_um:
        for_proof = replace(for_proof, wire=replace(scenario.wire, lag=plan.making.lag_um))
    if toolpath.leans and for_proof.taper is not None:
        for_proof = replace(for_proof, taper=for_proof.taper._replace(angle_rad=None))
    reach_um = in_plane(scenario).wire.reach_um
    edge_um = tuple(least_um(cut.figure, plan.making, reach_um) for cut in plan.cuts)
    least = min(edge_um, default=reach_um)
    if least <= 0.0:
        return _by_controller(for_proof, plan, edge_um)
    wire = _wire(for_proof.wire, least * cosine_of(scenario))
    if wire is None:
        return AsRun(replace(for_proof, kerf=False), edge_um, (), (Remark("no-wire", {"offset": least}),))
    notes = (*_run_remarks(for_proof.wire, wire), *_lag_remarks(scenario, plan.making.lag_um))
    notes = (*notes, *_technology_remarks(scenario, plan))
    if plan.is_added:
        side = plan.cuts[0].side
        for_proof = replace(for_proof, offset=Offset((OffsetPass(least),), side))
        notes = (*notes, Remark("added", {"offset": least, "side": side.name.lower()}))
    how = AsRun(replace(for_proof, wire=wire), edge_um, notes)
    return how if how.is_one_edge else how._replace(unproved=(Remark("edges-differ"),))


def _by_controller(scenario: Scenario, plan: CutPlan, edge_um: tuple[float, ...]) -> AsRun:
    """A program on the contour itself: the controller adds the offset of the wire, to one side of all contours.

    It needs a lead-in to come to that side. Without one, or with figures to both sides, the path alone is run.
    """
    sides = {cut.side for cut in plan.cuts}
    if len(sides) != 1 or any(edge_um) or any(cut.thread.by == "contour" for cut in plan.cuts):
        return AsRun(replace(scenario, kerf=False), edge_um, (Remark("contour"),))
    reach_um = scenario.wire.reach_um
    offset = Offset((OffsetPass(reach_um),), next(iter(sides)))
    note = Remark("added", {"offset": reach_um, "side": offset.side.name.lower()})
    return AsRun(replace(scenario, offset=offset), edge_um, (note,))


def _wire(wire: Wire, reach_um: float) -> Wire | None:
    """The wire whose edge lies at an offset: the one of the scenario with another spark gap; None where none does."""
    if abs(wire.reach_um - reach_um) <= _SAME_UM:
        return wire
    gap_um = reach_um - wire.radius_um
    if not SPARK_GAP_MM.low <= mm(gap_um) or gap_um > _WIDEST_GAP_UM:
        return None
    try:
        return replace(wire, spark_gap_um=gap_um)
    except SettingsError:
        return None


def _lag_remarks(scenario: Scenario, lag_um: float) -> tuple[Remark, ...]:
    if not lag_um:
        return ()
    name = "lag-middle" if scenario.wire.face_share(scenario.thickness_mm) is None else "lag"
    return (Remark(name, {"lag": lag_um}),)


def _technology_remarks(scenario: Scenario, plan: CutPlan) -> tuple[Remark, ...]:
    """That a last pass leaves the edge off its contour, by what the technology knows of it; the worst of them alone."""
    if scenario.technology is None:
        return ()
    of_figures = {_passes_um(cut.figure, plan.making, scenario.wire.reach_um) for cut in plan.cuts}
    found = []
    for passes_um in sorted(of_figures):
        gap = scenario.technology_of(len(passes_um)).gap_um
        radius_um, offset_um = scenario.wire.radius_um, passes_um[-1]
        if not gap.least <= offset_um - radius_um <= gap.most:
            values = {"least": radius_um + gap.least, "most": radius_um + gap.most, "offset": offset_um}
            off_um = offset_um - radius_um - gap.value
            found.append((abs(off_um), Remark("technology", {**values, "number": len(passes_um), "off": off_um})))
    return (max(found, key=lambda each: each[0])[1],) if found else ()


def _run_remarks(usual: Wire, wire: Wire) -> tuple[Remark, ...]:
    if wire is usual:
        return ()
    return (Remark("wire", {"diameter": wire.diameter_um, "gap": wire.spark_gap_um, "offset": wire.reach_um}),)
