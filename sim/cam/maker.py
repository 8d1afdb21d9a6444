"""A drawing to a proved program: `made`, the one way in."""

from pathlib import Path
from typing import NamedTuple

from parser.drawing.read import read_drawing
from parser.program import Program, load_program
from parser.write.draft import Draft
from sim.cam.model import CannotCutError, CutPlan, Refusal
from sim.cam.order.order import in_order
from sim.cam.order.sides import with_sides
from sim.cam.parts.parts import parts_of
from sim.cam.parts.walls import walls
from sim.cam.passes.around import offsets_of
from sim.cam.passes.passes import figure_cut
from sim.cam.path.drafted import draft_of_plan
from sim.cam.path.kept import added_draft, kept_draft
from sim.cam.proof.proof import Given, proved
from sim.cam.proof.result import Proof
from sim.cam.threads.threads import thread_notes, threads_of
from sim.cam.tolerances import fit_share_um
from sim.convert.proof import Proof as Written
from sim.convert.proof import proof as held_against
from sim.convert.wanted import Wanted, begun, encoded, read_with, written
from sim.setup.making import Making
from sim.setup.scenario import Scenario
from sim.table.progress import Progress, silent


class Made(NamedTuple):
    """A program that was made of a drawing.

    Attributes
    ----------
    data
        Bytes of its text.
    program
        What reading them gives.
    plan, draft
        What it was written of.
    written
        How far the path of its text lies off that which was planned, and what else of it is not the same.
    proof
        What its run shows; None where nobody asked for one.
    """

    data: bytes
    program: Program
    plan: CutPlan
    draft: Draft
    written: Written
    proof: Proof | None = None


class NotMade(NamedTuple):
    """Why there is none, and as much of the plan as there is."""

    refusal: Refusal
    plan: CutPlan | None = None


def planned(path: Path, making: Making, scenario: Scenario, progress: Progress = silent) -> CutPlan:
    """What is to be cut, and how. CannotCutError where the drawing asks for what cannot be."""
    progress("drawing", 0, 1)
    drawing = read_drawing(path, making.layer, making.gap_um, fit_um=fit_share_um(making.tolerance_um))
    progress("figures", 0, 1)
    parts = parts_of(drawing, making)
    passes_um = making.passes_um or (scenario.wire.reach_um,)
    figures = with_sides(parts.figures, making)
    widest_um = [max(offsets_of(figure, passes_um, making)) for figure in figures]
    notes = (*parts.notes, *walls(figures, widest_um, scenario.wire.reach_um))
    threads = threads_of(drawing, figures, making, max(passes_um))
    notes += thread_notes(figures, threads, making)
    order = in_order(figures, threads, making)
    cuts = tuple(figure_cut(figures[one], threads[one], passes_um, making) for one in order)
    return CutPlan(drawing, making, passes_um, cuts, parts.left_out, notes)


def made(path: Path, making: Making, wanted: Wanted, scenario: Scenario, progress: Progress = silent) -> Made | NotMade:
    """A program of a drawing, proved on the machine of a scenario.

    Raises FileUnreadableError and DrawingError where there is no drawing, SettingsError where the dialect cannot say
    what it needs.
    """
    done = unproved(path, making, wanted, scenario, progress)
    if isinstance(done, NotMade):
        return done
    return done._replace(proof=proved(_given(path, done, wanted), scenario, progress))


def unproved(
    path: Path, making: Making, wanted: Wanted, scenario: Scenario, progress: Progress = silent
) -> Made | NotMade:
    """A program as `made` gives it, before anything is run."""
    try:
        plan = planned(path, making, scenario, progress)
        plan = plan._replace(is_added=wanted.keeps and wanted.language == "4b" and any(plan.passes_um))
        progress("write", 0, 1)
        draft = begun(_drafted(plan, wanted), wanted)
    except CannotCutError as error:
        return NotMade(error.refusal)
    text = written(draft, wanted)
    told = text.text.encode(wanted.encoding, "replace")
    program = load_program(told, f"{path.stem}.{wanted.language}", read_with(draft, wanted))
    return Made(encoded(text.text, wanted), program, plan, draft, held_against(draft, text, program.toolpath))


def _drafted(plan: CutPlan, wanted: Wanted) -> Draft:
    """What is written of a plan. CannotCutError where the controller cannot add its offsets."""
    if not wanted.keeps or not any(plan.passes_um):
        return draft_of_plan(plan)
    wishes = tuple(wish._replace(passes_um=(0.0,) * len(wish.passes_um)) for wish in plan.making.layers)
    making = plan.making._replace(layers=wishes)
    nothing = (0.0,) * len(plan.passes_um)
    on_contour = tuple(figure_cut(cut.figure, cut.thread, nothing, making) for cut in plan.cuts)
    return (
        added_draft(plan, on_contour) if wanted.iso is None else kept_draft(plan, on_contour, wanted.iso.profile.rules)
    )


def _given(path: Path, done: Made, wanted: Wanted) -> Given:
    """What is proved: with the drawing as it is drawn, read again where arcs were fitted to it."""
    plan = done.plan
    is_fitted = plan.drawing.fit is not None
    drawn = read_drawing(path, plan.making.layer, plan.making.gap_um) if is_fitted else plan.drawing
    return Given(done.program, plan, drawn, done.written, wanted.bound_um)
