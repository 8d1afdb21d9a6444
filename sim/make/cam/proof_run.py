"""How a written program is run for its proof: with the wire that cuts so, its path in the middle of the table."""

from dataclasses import replace
from typing import NamedTuple

from parser.findings.catalogue import Remark
from parser.findings.errors import SettingsError
from parser.toolpath import Toolpath
from parser.units import mm
from sim.check.travel import middle_mm
from sim.make.cam.lean.angle import cosine_of, in_plane
from sim.make.cam.model import CutPlan, Figure
from sim.setup.making import Making
from sim.setup.part import Offset, OffsetPass
from sim.setup.scenario import Scenario
from sim.setup.wire import SPARK_GAP_MM, Wire

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
        radius_um, offset_um = scenario.wire.radius_um, passes_um[-1] * cosine_of(scenario)  # of an upright wire
        if not gap.least <= offset_um - radius_um <= gap.most:
            values = {"least": radius_um + gap.least, "most": radius_um + gap.most, "offset": offset_um}
            off_um = offset_um - radius_um - gap.value
            found.append((abs(off_um), Remark("technology", {**values, "number": len(passes_um), "off": off_um})))
    return (max(found, key=lambda each: each[0])[1],) if found else ()


def _run_remarks(usual: Wire, wire: Wire) -> tuple[Remark, ...]:
    if wire is usual:
        return ()
    return (Remark("wire", {"diameter": wire.diameter_um, "gap": wire.spark_gap_um, "offset": wire.reach_um}),)
