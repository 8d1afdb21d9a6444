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
from sim.cam.passes.passes import figure_cut
from sim.cam.path.drafted import draft_of_plan
from sim.cam.proof.proof import Proof, proved
from sim.cam.threads.threads import threads_of
from sim.convert.proof import proof as held_against
from sim.convert.wanted import Wanted, read_with, written
from sim.setup.making import Making
from sim.setup.scenario import Scenario
from sim.table.motion import Progress, silent


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
    path_um
        How far the path of its text lies off that which was planned.
    proof
        What its run shows; None where nobody asked for one.
    """

    data: bytes
    program: Program
    plan: CutPlan
    draft: Draft
    path_um: float
    proof: Proof | None = None


class NotMade(NamedTuple):
    """Why there is none, and as much of the plan as there is."""

    refusal: Refusal
    plan: CutPlan | None = None


def planned(path: Path, making: Making, scenario: Scenario) -> CutPlan:
    """What is to be cut, and how. CannotCutError where the drawing asks for what cannot be."""
    drawing = read_drawing(path, making.layer, making.gap_um)
    parts = parts_of(drawing)
    passes_um = making.passes_um or (scenario.wire.reach_um,)
    figures = with_sides(parts.figures, making)
    threads = threads_of(drawing, figures, making, max(passes_um))
    order = in_order(figures, threads, making)
    cuts = tuple(figure_cut(figures[one], threads[one], passes_um, making) for one in order)
    return CutPlan(drawing, making, passes_um, cuts, parts.left_out, parts.notes)


def made(path: Path, making: Making, wanted: Wanted, scenario: Scenario, progress: Progress = silent) -> Made | NotMade:
    """A program of a drawing, proved on the machine of a scenario.

    Raises FileUnreadableError and DrawingError where there is no drawing, SettingsError where the dialect cannot say
    what it needs.
    """
    done = unproved(path, making, wanted, scenario, progress)
    if isinstance(done, NotMade):
        return done
    return done._replace(proof=proved(done.program, done.plan, scenario, done.path_um, progress))


def unproved(
    path: Path, making: Making, wanted: Wanted, scenario: Scenario, progress: Progress = silent
) -> Made | NotMade:
    """A program as `made` gives it, before anything is run."""
    try:
        progress("drawing", 0, 1)
        plan = planned(path, making, scenario)
    except CannotCutError as error:
        return NotMade(error.refusal)
    draft = draft_of_plan(plan)
    text = written(draft, wanted)
    data = text.text.encode()
    program = load_program(data, f"{path.stem}.{wanted.language}", read_with(draft, wanted))
    return Made(data, program, plan, draft, held_against(draft, text, program.toolpath).off_um)
