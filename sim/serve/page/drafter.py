"""The process of a drawing: it is laid beneath a program, or a program is made of it.

A drawing may be huge or hostile: its process can be ended at any moment. What it found is a file of JSON, which may be
large.
"""

import json
from pathlib import Path
from typing import Any, Final

from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from parser.findings.catalogue import LANGUAGES, Bilingual, Language, remark_text
from parser.findings.errors import DrycutError
from parser.program import load_program, moving
from parser.toolpath import Toolpath
from sim.make.cam.maker import MadeProgram, made_program, remarked
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import FitRequest
from sim.measure.compare.starts import IN_PLACE, Placement
from sim.run.prepare import as_run
from sim.run.recording import stages_of
from sim.serve.page.answers import file_text, printable_entry, read_file
from sim.serve.page.child import PageRequest, do, telling
from sim.serve.page.form import scenario_of
from sim.serve.page.making import asked_of, by_controls, target_of
from sim.serve.page.model import DraftedEntry, LookedEntry
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario
from sim.show.refusals import why_refused
from sim.show.replay.tape import drawing_columns
from sim.show.terminal.program import advice, against, to_check, told_lines
from sim.show.texts import Words

_WIDE: Final = 100_000
"""Cells of a line that is not to be broken."""


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
    return _written_answer(request, looked)


def _make(request: PageRequest) -> dict[str, Any]:
    """Make a program of the drawing, and prove it by a run."""
    drawing, making, wanted, scenario = asked_of(request)
    progress = telling(["drawing", "figures", "write", *stages_of(scenario), "comparison"])
    done = made_program(drawing, making, wanted, scenario, progress)
    if not isinstance(done, MadeProgram):
        why = printable_entry(by_controls(why_refused(done.refusal)))
        return _written_answer(request, {"program": None, "told": [why], "verdict": "fail"})
    both_lines = zip(*(_summary(done, language) for language in LANGUAGES), strict=True)
    lines = [by_controls(Bilingual(*both)) for both in both_lines]
    data = done.data if done.is_proved else remarked(done, [*against(done, "en")], wanted).data
    drafted: DraftedEntry = {
        "program": file_text(f"{drawing.stem}.{wanted.language}", read_file(data)),
        "told": list(map(printable_entry, lines)),
        "verdict": done.verdict,
    }
    return _written_answer(request, drafted)


def _summary(done: MadeProgram, language: Language) -> list[str]:
    """What there is to say of a program: whether it is proved, what speaks against it, what helps, what was chosen."""
    words = Words(language)
    proved = [words(f"program.verdict-{done.proof.verdict}")] if done.proof else []
    todo = advice(done, language, words("program.tab-control", label=words("open.tab")))
    checked = [*to_check(done.plan, language)]
    first = [*checked, *proved] if done.is_proved else [*proved, *checked]
    return [*first, *against(done, language), *todo, *told_lines(done.plan, language, _WIDE)]


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
    return as_run(program, scenario.offset).toolpath


def _written_answer(request: PageRequest, found: LookedEntry | DraftedEntry) -> dict[str, Any]:
    """Nothing: what was found goes into the file that was asked for."""
    Path(request["result_file"]).write_text(json.dumps(found), encoding="utf-8")
    return {}


if __name__ == "__main__":
    do({"look": _look, "program": _make})
