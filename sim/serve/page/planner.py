"""The process of a drawing on the page: it is laid beneath a program, and what would be cut of it is planned.

It does one after the other, so that each takes no more than the work itself. A drawing may be huge or hostile: the
process can be ended at any moment. What it found is a file of JSON, which may be large.
"""

import json
from typing import Any

import numpy as np

from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from parser.findings.catalogue import LANGUAGES, Bilingual, remark_text
from parser.findings.errors import DrycutError
from parser.geometry.curves import Bools, Ints
from parser.program import load_program, moving
from parser.shape.passes import find_passes, own_numbers
from parser.toolpath import Toolpath
from parser.units import mm
from sim.base.units import place
from sim.make.cam.maker import MadeProgram, unproved
from sim.make.cam.model import FigureCut
from sim.make.cam.visits import Spans, figure_rows
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import FitRequest
from sim.measure.compare.starts import IN_PLACE, Placement, placed, turning
from sim.run.prepare import as_run_in
from sim.serve.page.answers import leads_shown, printable_entry
from sim.serve.page.child import PageRequest, do_each, written
from sim.serve.page.form import scenario_of
from sim.serve.page.making import asked_of, by_controls, target_of
from sim.serve.page.model import LookedEntry, PlannedEntry, PlannedFigureEntry
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario
from sim.show.refusals import why_refused
from sim.show.replay.tape import drawing_columns, exact_columns
from sim.show.terminal.program import to_check
from sim.show.texts import bilingual
from sim.show.texts.phrases import numbered


def _look(request: PageRequest) -> dict[str, Any]:
    """Read the drawing, and lay it beneath the program of the page as a run with it would."""
    target = target_of(request)
    drawing = read_drawing(target.file, gap_um=target.gap_um, unit=target.unit)
    placement, notes = _placement(request, drawing, target) if request["text"].strip() else (IN_PLACE, [])
    of_drawing = [Bilingual(*(remark_text(note, language) for language in LANGUAGES)) for note in drawing.notes]
    remarks = [printable_entry(by_controls(each)) for each in (*of_drawing, *notes)]
    looked: LookedEntry = {
        "unit": drawing.unit,
        "curves": drawing_columns(drawing, placement),
        "placement": {
            "turn_rad": placement.turn_rad,
            "shift_um": list(placement.shift_um),
            "mirror": placement.mirror,
        },
        "told": remarks,
    }
    return written(request, looked)


def _placement(request: PageRequest, drawing: Drawing, target: DrawingTarget) -> tuple[Placement, list[Bilingual]]:
    """Where the drawing lies beneath the program; as it is, with the reason, where its edge cannot be told."""
    try:
        scenario = scenario_of({**request, "drawing_file": ""}, target.file.with_suffix(""))
        path = _path(request, scenario)
        how = FitRequest(target.tolerance_um, target.fit, target.sharp_corners)
        return compare_program(path, scenario.wire.reach_um, drawing, how).placement, []
    except DrycutError as error:
        return IN_PLACE, [error.in_both()]


def _path(request: PageRequest, scenario: Scenario) -> Toolpath:
    """The path of the page's program, as the controller makes it."""
    program = moving(load_program(request["text"].encode("utf-8", "replace"), request["name"], scenario.choices))
    return as_run_in(program, scenario).toolpath


def _plan(request: PageRequest) -> dict[str, Any]:
    """Plan a program of the drawing. What was found goes into the file that was asked for."""
    done = unproved(*asked_of(request))
    entry: PlannedEntry
    if isinstance(done, MadeProgram):
        entry = _entry(done, _laid(request["placement"]))
    else:
        entry = {"why": printable_entry(by_controls(why_refused(done.refusal)))}
    return written(request, entry)


def _laid(text: str) -> Placement:
    """How the page has the drawing lie beneath its program."""
    laid = json.loads(text)
    x, y = map(float, laid["shift_um"])
    return Placement(float(laid["turn_rad"]), (x, y), mirror=bool(laid["mirror"]))


def _entry(done: MadeProgram, placement: Placement) -> PlannedEntry:
    path = done.wire_way
    cuts = done.plan.cuts
    rows = list(zip(cuts, figure_rows(path, done.plan), strict=False))
    laid = placed(path, placement)
    figures = [_figure(cut, spans, place(laid.start_um[spans[0][0]]), placement) for cut, spans in rows]
    length = f"{mm(float(path.length_um[~path.is_jump].sum())):.3f}"
    sum_ = bilingual("open.planned", figures=numbered({"figure": len(cuts)}), length=length)
    checked = zip(*(to_check(done.plan, language) for language in LANGUAGES), strict=True)
    row_pass, is_left = _passes_of_rows(path, rows, placement)
    return {
        "path": exact_columns(laid),
        "is_lead": leads_shown(path),
        "row_pass": row_pass.tolist(),
        "is_left": is_left.tolist(),
        "figures": figures,
        "told": [*map(printable_entry, [sum_, *(by_controls(Bilingual(*both)) for both in checked)])],
    }


def _figure(cut: FigureCut, spans: Spans, thread_um: list[float], placement: Placement) -> PlannedFigureEntry:
    """How a figure is cut, as it lies beneath the program."""
    entry, turn = cut.thread.entry, turning(placement.turn_rad, mirror=placement.mirror).T
    tab = cut.passes[0].along.end_um[-1] if cut.cut_off else None
    return {
        "number": cut.figure.number,
        "spans": [list(span) for span in spans],
        "thread_um": thread_um,
        "entry_um": place(np.array(entry.place_um) @ turn + placement.shift_um),
        "out": (np.array(entry.out) @ turn).tolist(),
        "is_ccw": cut.is_ccw,
        "is_inside": cut.figure.runs_inside,
        "tab_um": None if tab is None else place(tab @ turn + placement.shift_um),
    }


def _passes_of_rows(path: Toolpath, rows: list[tuple[FigureCut, Spans]], placement: Placement) -> tuple[Ints, Bools]:
    """Which pass of its figure each row (n,) is of, from 1, else 0, and whether the waste is on its left.

    What is cut of a tab counts as the last pass.
    """
    passes = find_passes(path)
    number = np.append(own_numbers(passes), 0)[passes.of_row]
    is_tab = np.array([*(each.is_tab for each in passes.passes), False])[passes.of_row]
    is_left = np.array([*(each.is_back for each in passes.passes), False])[passes.of_row]
    for cut, (first, past) in ((cut, span) for cut, spans in rows for span in spans):
        last = len(cut.passes)
        number[first:past] = np.where(is_tab[first:past], last, np.minimum(number[first:past], last))
        is_left[first:past] ^= (cut.side > 0) != placement.mirror
    return number, is_left


if __name__ == "__main__":
    do_each({"look": _look, "plan": _plan})
