"""The plan of a drawing: what is cut, from where, in which order and passes; what cannot be cut stays uncut."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from sim.base.progress import Progress, silent
from sim.make.cam.apart import moved_apart
from sim.make.cam.chosen import USUAL_LEAD_UM
from sim.make.cam.contacts import walls
from sim.make.cam.coreless import coreless
from sim.make.cam.facing import Facing
from sim.make.cam.lean.angle import in_plane, lean_of, wall_shift_um
from sim.make.cam.lean.two_drawings import facings_of
from sim.make.cam.model import (
    CannotCutError,
    CutPlan,
    Figure,
    FigureCut,
    NotProved,
    Parts,
    Refusal,
    Thread,
)
from sim.make.cam.nest import InKerf, cut_in_kerf, nests_of, refuse_misfits
from sim.make.cam.order import in_order
from sim.make.cam.parts import parts_of, refuse_strange_layers, with_sides
from sim.make.cam.passes import figure_cut, offsets_of
from sim.make.cam.picks import spare_notes
from sim.make.cam.threads import thread_notes, threads_of
from sim.make.cam.visits import visited
from sim.setup.making import Making
from sim.setup.scenario import Scenario


class PlanRequest(NamedTuple):
    """What is asked for: of which drawing, how, on whose machine, whom it tells, and what failed a proof.

    `at_fault` are figures that stay uncut, `with_core` numbers of holes that keep their cores, `whole` those of parts
    that are cut all round, whatever edges they have in common.
    """

    path: Path
    making: Making
    scenario: Scenario
    progress: Progress = silent
    at_fault: tuple[NotProved, ...] = ()
    with_core: frozenset[int] = frozenset()
    whole: frozenset[int] = frozenset()


def planned(request: PlanRequest, fit_um: float | None = None) -> CutPlan:
    """What is to be cut, and how, with arcs fitted within `fit_um`, else the tolerance of the path.

    Figures that cannot be cut stay uncut, as long as others can. CannotCutError where none can, or where the drawing
    asks for what cannot be.
    """
    path, making, given, progress, at_fault, with_core, whole = request
    scenario = in_plane(given)
    progress("drawing", 0, 1)
    fit_um = making.tolerance_um if fit_um is None else fit_um
    drawing = read_drawing(path, making.layer, making.gap_um, fit_um=fit_um, unit=making.unit)
    drawing = as_cut(drawing, making, scenario)
    progress("figures", 0, 1)
    refuse_misfits(making, _passes_um(making, scenario)[0])
    parts = parts_of(drawing, making)
    refuse_strange_layers(parts.figures, making)
    parts = parts.without(at_fault)
    facings = _facings(parts, making, fit_um, all_cut=not (making.picks or at_fault))
    moved_um = max((each.most_aside_um() for each in facings.values()), default=wall_shift_um(scenario))
    while True:
        try:
            plan = _plan_of(drawing, parts, making, scenario, whole, moved_um)
            plan = coreless(plan, with_core) if making.no_core else plan
            cuts, visits = visited(plan.cuts, making)
            faced = tuple(facings[cut.figure.number] for cut in cuts) if facings else ()
            return plan._replace(cuts=cuts, visits=visits, taper=lean_of(given), facings=faced)
        except CannotCutError as error:
            rest = parts.without(error.refusals)
            if len(rest.figures) in {0, len(parts.figures)}:
                raise
            parts = rest


def _facings(parts: Parts, making: Making, fit_um: float, *, all_cut: bool) -> dict[int, Facing]:
    """The figures with their partners in the drawing of the top, by their numbers; none without such a drawing."""
    if making.upper is None:
        return {}
    above = read_drawing(making.upper, making.layer, making.gap_um, fit_um=fit_um, unit=making.unit)
    return facings_of(parts.figures, parts_of(above, making._replace(picks=())).figures, all_cut=all_cut)


def as_cut(drawing: Drawing, making: Making, scenario: Scenario) -> Drawing:
    """A drawing as it is cut: with touching parts moved apart where their common edges are to be cut once."""
    by_um = _passes_um(making, scenario)[0]
    return moved_apart(drawing, 2.0 * by_um) if making.common_edges and by_um > 0.0 else drawing


def _passes_um(making: Making, scenario: Scenario) -> tuple[float, ...]:
    return making.passes_um or (scenario.wire.reach_um,)


def _plan_of(  # noqa: PLR0913, PLR0917 - what is cut, how, and how its walls lean
    drawing: Drawing, parts: Parts, making: Making, scenario: Scenario, whole: frozenset[int], moved_um: float
) -> CutPlan:
    """How some parts are cut, whose walls lie by as much beside them at other heights.

    CannotCutError where they cannot be, or some of them.
    """
    passes_um = _passes_um(making, scenario)
    figures = with_sides(parts.figures, making)
    widest_um = [max(offsets_of(figure, passes_um, making)) for figure in figures]
    notes = (*parts.notes, *walls(figures, widest_um, scenario.wire.reach_um))
    nests = nests_of(figures, making, passes_um[0], whole)
    in_kerf = {at: each.thread for at, each in nests.in_kerf.items()}
    threads = _threads(drawing, figures, making, moved_um, max(widest_um), in_kerf)
    notes += (*nests.notes, *thread_notes(figures, threads, making))
    notes += tuple(spare_notes(drawing, list(zip(figures, threads, strict=True)), making.spared))
    order = nests.in_order(in_order(figures, threads, making))
    ways = [nests.in_kerf.get(each) if threads[each].by == "kerf" else None for each in order]
    cuts = _cuts([(figures[each], threads[each]) for each in order], ways, passes_um, making)
    return CutPlan(drawing, making, passes_um, cuts, parts.uncut, parts.left_out, notes)


def _threads(  # noqa: PLR0913, PLR0917 - as `threads_of` has them, with the lean
    drawing: Drawing,
    figures: Sequence[Figure],
    making: Making,
    moved_um: float,
    widest_um: float,
    in_kerf: Mapping[int, Thread],
) -> tuple[Thread, ...]:
    """Where figures are threaded. CannotCutError where there is no room.

    Where walls lean, contours come nearer to thread points at other heights, and a lead that is shorter than that cuts
    into the part. Where there is no room for as much, the proof says whether it does.
    """
    if moved_um:
        longer = making if making.lead_um is not None else making._replace(lead_um=USUAL_LEAD_UM + moved_um)
        with suppress(CannotCutError):
            return threads_of(drawing, figures, longer, widest_um + moved_um, in_kerf)
    return threads_of(drawing, figures, making, widest_um, in_kerf)


def _cuts(
    threaded: Sequence[tuple[Figure, Thread]],
    in_kerf: Sequence[InKerf | None],
    passes_um: tuple[float, ...],
    making: Making,
) -> tuple[FigureCut, ...]:
    """How figures are cut from their threads, or in the kerf of others. CannotCutError with all that cannot be."""
    cuts, refusals = list[FigureCut](), list[Refusal]()
    for (figure, thread), way in zip(threaded, in_kerf, strict=True):
        try:
            if way is None:
                cuts.append(figure_cut(figure, thread, passes_um, making))
            else:
                cuts.append(cut_in_kerf(figure, way, passes_um[0], making))
        except CannotCutError as error:
            if not error.refusals:
                raise
            refusals += error.refusals
    if refusals:
        raise CannotCutError(*refusals)
    return tuple(cuts)
