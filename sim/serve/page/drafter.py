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
from parser.findings.errors import DrycutError, Message, SettingsError
from parser.program import load_program, moving
from parser.toolpath import Toolpath
from parser.units import from_mm
from sim.make.cam.maker import MadeProgram, made_program, remarked, wanted_of
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import FitRequest
from sim.measure.compare.starts import IN_PLACE, Placement
from sim.run.prepare import as_run
from sim.run.recording import stages_of
from sim.serve.page.answers import file_text, printable_entry, read_file
from sim.serve.page.child import PageRequest, do, telling
from sim.serve.page.form import number_of, offsets_um, scenario_of
from sim.serve.page.model import DraftedEntry, LookedEntry
from sim.setup.making import LANGUAGES as PROGRAM_LANGUAGES
from sim.setup.making import OR_NONE_MM, OVERCUT_MM, Making, ToMake, refuse_odd
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
    target = DrawingTarget(Path(request["drawing_file"]))
    drawing = read_drawing(target.file, gap_um=target.gap_um)
    placement, notes = _placement(request, drawing, target) if request["text"].strip() else (IN_PLACE, [])
    of_drawing = [Bilingual(*(remark_text(note, language) for language in LANGUAGES)) for note in drawing.notes]
    remarks = list(map(printable_entry, [*of_drawing, *notes]))
    looked: LookedEntry = {"unit": drawing.unit, "curves": drawing_columns(drawing, placement), "told": remarks}
    return _written_answer(request, looked)


def _make(request: PageRequest) -> dict[str, Any]:
    """Make a program of the drawing, and prove it by a run."""
    drawing, written = Path(request["drawing_file"]), request["language"]
    if written not in PROGRAM_LANGUAGES:
        raise SettingsError("no-program-language", languages=", ".join(PROGRAM_LANGUAGES), found=written[:40])
    file = drawing.with_suffix(f".{written}")
    to_make = ToMake()._replace(file=file, making=_making(request))
    scenario = scenario_of({**request, "offset_mm": "", "drawing_file": ""}, file)
    progress = telling(["drawing", "figures", "write", *stages_of(scenario), "comparison"])
    wanted = wanted_of(to_make, to_make.language, scenario)
    done = made_program(drawing, to_make.making, wanted, scenario, progress)
    if not isinstance(done, MadeProgram):
        why = printable_entry(why_refused(done.refusal))
        return _written_answer(request, {"program": None, "told": [why], "verdict": "fail"})
    lines = [Bilingual(*both) for both in zip(*(_summary(done, language) for language in LANGUAGES), strict=True)]
    data = done.data if done.is_proved else remarked(done, [*against(done, "en")], wanted).data
    drafted: DraftedEntry = {
        "program": file_text(file.name, read_file(data)),
        "told": list(map(printable_entry, lines)),
        "verdict": done.verdict,
    }
    return _written_answer(request, drafted)


def _making(request: PageRequest) -> Making:
    """How it is to be made. SettingsError for numbers out of their bounds."""
    passes, tab = offsets_um(request, OR_NONE_MM), request["tab_mm"]
    making = Making(passes_um=passes, tab_um=from_mm(number_of(tab, OVERCUT_MM, Message("name-tab"))) if tab else 0.0)
    refuse_odd(making, "the program")
    return making


def _summary(done: MadeProgram, language: Language) -> list[str]:
    """What there is to say of a program: whether it is proved, what speaks against it, what helps, what was chosen."""
    words = Words(language)
    proved = [words(f"program.verdict-{done.proof.verdict}")] if done.proof else []
    todo = advice(done, language, words("program.tab-control", label=words("open.tab")))
    checked = to_check(done.plan, language)
    return [*proved, *checked, *against(done, language), *todo, *told_lines(done.plan, language, _WIDE)]


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
