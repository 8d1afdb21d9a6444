"""The process of plans: what would be cut of a drawing, without its proof, again for each change of what is asked."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from parser.findings.catalogue import LANGUAGES, Bilingual
from parser.shape.contours import runs
from parser.shape.passes import find_passes, leads_of
from parser.units import mm
from sim.base.units import place
from sim.make.cam.maker import MadeProgram, unproved
from sim.measure.compare.starts import Placement, placed
from sim.serve.page.answers import printable_entry
from sim.serve.page.child import PageRequest, do_each
from sim.serve.page.making import asked_of, by_controls
from sim.serve.page.model import PlannedEntry, PlannedFigureEntry
from sim.show.refusals import why_refused
from sim.show.replay.tape import exact_columns
from sim.show.terminal.program import to_check
from sim.show.texts import bilingual
from sim.show.texts.phrases import numbered


def _plan(request: PageRequest) -> dict[str, Any]:
    """Plan a program of the drawing. What was found goes into the file that was asked for."""
    done = unproved(*asked_of(request))
    entry: PlannedEntry
    if isinstance(done, MadeProgram):
        entry = _entry(done, _placement(request["placement"]))
    else:
        entry = {"why": printable_entry(by_controls(why_refused(done.refusal)))}
    Path(request["result_file"]).write_text(json.dumps(entry), encoding="utf-8")
    return {}


def _placement(text: str) -> Placement:
    """How the page has the drawing lie beneath its program."""
    laid = json.loads(text)
    x, y = map(float, laid["shift_um"])
    return Placement(float(laid["turn_rad"]), (x, y), mirror=bool(laid["mirror"]))


def _entry(done: MadeProgram, placement: Placement) -> PlannedEntry:
    path = done.wire_way
    rows, cuts = runs(path).tolist(), done.plan.cuts
    at_um = placed(path, placement).start_um
    figures: list[PlannedFigureEntry] = [
        {"number": cut.figure.number, "first": first, "past": past, "thread_um": place(at_um[first])}
        for cut, (first, past) in zip(cuts, rows, strict=False)
        if len(rows) == len(cuts)
    ]
    passes = find_passes(path)
    is_lead = leads_of(passes, path) if passes.passes else np.zeros(len(path), dtype=np.bool_)
    length = f"{mm(float(path.length_um[~path.is_jump].sum())):.3f}"
    sum_ = bilingual("open.planned", figures=numbered({"figure": len(cuts)}), length=length)
    checked = zip(*(to_check(done.plan, language) for language in LANGUAGES), strict=True)
    return {
        "path": exact_columns(placed(path, placement)),
        "is_lead": is_lead.tolist(),
        "figures": figures,
        "told": [*map(printable_entry, [sum_, *(by_controls(Bilingual(*both)) for both in checked)])],
    }


if __name__ == "__main__":
    do_each(_plan)
