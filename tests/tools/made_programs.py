"""Programs made of drawings for tests: a plate with a round and a square hole, its plan, and proofs of what is made."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from runs import plain_scenario

from parser.drawing.read import read_drawing
from parser.geometry.curves import Curves
from parser.program import load_program
from sim.make.cam.compensated_draft import draft_of_plan
from sim.make.cam.model import CutPlan, FigureCut
from sim.make.cam.planned import PlanRequest, planned
from sim.make.cam.proof import ToProve, proved
from sim.make.cam.proof_model import Proof
from sim.make.cam.visits import visited
from sim.make.conversion_proof import proof as held_against
from sim.make.wanted import Wanted, read_with, written
from sim.setup.making import Making
from sim.setup.scenario import Scenario

WIDTH, HEIGHT = 12.0, 6.0
"""Sides of the plate, mm: small, as a run costs what its way is long."""
TO_3B = Wanted("3b")


def plate(space: Modelspace) -> None:
    """An outline of 12 × 6 mm, a hole of R 1.5 at (3, 3), and a square one of 3 mm about (8.5, 3)."""
    space.add_lwpolyline([(0, 0), (WIDTH, 0), (WIDTH, HEIGHT), (0, HEIGHT)], close=True)
    space.add_circle((3, 3), 1.5)
    space.add_lwpolyline([(7, 1.5), (10, 1.5), (10, 4.5), (7, 4.5)], close=True)


def plate_file(folder: Path, draw: Callable[[Modelspace], object] = plate) -> Path:
    return drawn(folder, draw)


def plan_of(path: Path, making: Making | None = None, scenario: Scenario | None = None) -> CutPlan:
    return planned(PlanRequest(path, making or Making(), scenario or plain_scenario()))


def with_cuts(plan: CutPlan, cuts: Sequence[FigureCut]) -> CutPlan:
    """The plan with other cuts, one behind the other."""
    return plan._replace(**visited(cuts, plan.making)._asdict())


def proof_of(
    plan: CutPlan,
    path: Path,
    wanted: Wanted = TO_3B,
    scenario: Scenario | None = None,
    mend: Callable[[str], str] = str,
) -> Proof:
    """The proof of what is written of a plan, its text changed by `mend`; the drawing is read from its file."""
    draft = draft_of_plan(plan)
    text = written(draft, wanted)
    program = load_program(mend(text.text).encode(), f"made.{wanted.language}", read_with(draft, wanted))
    held = held_against(draft, text, program.toolpath)
    drawing = read_drawing(path, plan.making.layer, plan.making.gap_um)
    return proved(ToProve(program, plan, drawing, held, wanted.bound_um), scenario or plain_scenario())


def with_cut(plan: CutPlan, number: int, change: Callable[[FigureCut], FigureCut]) -> CutPlan:
    """The plan with the cut of one figure changed, found by the number of the figure."""
    cuts = [change(cut) if cut.figure.number == number else cut for cut in plan.cuts]
    return plan._replace(cuts=tuple(cuts))


def moved(curves: Curves, x_um: float, y_um: float) -> Curves:
    by = np.array([x_um, y_um])
    return replace(curves, start_um=curves.start_um + by, end_um=curves.end_um + by, center_um=curves.center_um + by)
