"""The process of a drawing: it is laid beneath a program, or a program is made of it.

A drawing may be huge or hostile: its process can be ended at any moment. What it found is a file of JSON, which may be
large.
"""

import json
import re
from pathlib import Path
from typing import Any, Final

from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from parser.findings.catalogue import LANGUAGES, Bilingual, Language, remark_text
from parser.findings.errors import DrycutError, Message, SettingsError
from parser.program import load_program, moving
from parser.text.encoding import narrow
from parser.toolpath import Point, Toolpath
from parser.units import from_mm, mm
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
from sim.setup.part import DRAWING_UNITS, GAP_UM, DrawingTarget
from sim.setup.picks import pick_of
from sim.setup.scenario import Scenario
from sim.setup.toml.reader import PLACE_MM, Bound
from sim.setup.wire import WIRE_LAG_UM
from sim.show.refusals import why_refused
from sim.show.replay.tape import drawing_columns
from sim.show.terminal.program import advice, against, to_check, told_lines
from sim.show.texts import Words

_JOIN_MM: Final = Bound(mm(GAP_UM.low), mm(GAP_UM.high))
"""Of the gap whose ends are joined."""
_WIDE: Final = 100_000
"""Cells of a line that is not to be broken."""


def _look(request: PageRequest) -> dict[str, Any]:
    """Read the drawing, and lay it beneath the program of the page as a run with it would."""
    target = _target(request)
    drawing = read_drawing(target.file, gap_um=target.gap_um, unit=target.unit)
    placement, notes = _placement(request, drawing, target) if request["text"].strip() else (IN_PLACE, [])
    of_drawing = [Bilingual(*(remark_text(note, language) for language in LANGUAGES)) for note in drawing.notes]
    remarks = [printable_entry(_by_controls(each)) for each in (*of_drawing, *notes)]
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


def _target(request: PageRequest) -> DrawingTarget:
    """The drawing as the page has it read. SettingsError for a gap or a unit that is none."""
    target = DrawingTarget(Path(request["drawing_file"]), unit=request["unit"] or None)
    if target.unit not in {None, *DRAWING_UNITS}:
        raise SettingsError("no-drawing-unit", units=", ".join(DRAWING_UNITS), found=request["unit"][:40])
    join = request["join_mm"].strip()
    return target._replace(gap_um=from_mm(number_of(join, _JOIN_MM, Message("name-gap")))) if join else target


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
        why = printable_entry(_by_controls(why_refused(done.refusal)))
        return _written_answer(request, {"program": None, "told": [why], "verdict": "fail"})
    both_lines = zip(*(_summary(done, language) for language in LANGUAGES), strict=True)
    lines = [_by_controls(Bilingual(*both)) for both in both_lines]
    data = done.data if done.is_proved else remarked(done, [*against(done, "en")], wanted).data
    drafted: DraftedEntry = {
        "program": file_text(file.name, read_file(data)),
        "told": list(map(printable_entry, lines)),
        "verdict": done.verdict,
    }
    return _written_answer(request, drafted)


def _making(request: PageRequest) -> Making:
    """How it is to be made. SettingsError for numbers out of their bounds."""
    passes, tab, lag = offsets_um(request, OR_NONE_MM), request["tab_mm"], request["led_um"]
    making = Making(
        unit=_target(request).unit,
        gap_um=_target(request).gap_um,
        picks=tuple(pick_of(each.strip(), "the program") for each in request["picks"].split(";") if each.strip()),
        starts_um=tuple(_place_um(each) for each in request["starts"].split(";") if each.strip()),
        passes_um=passes,
        tab_um=from_mm(number_of(tab, OVERCUT_MM, Message("name-tab"))) if tab else 0.0,
        lag_um=number_of(lag, WIRE_LAG_UM, Message("name-lag")) if lag else 0.0,
        no_core=request["no_core"] == "yes",
        common_edges=request["common_edges"] == "yes",
    )
    refuse_odd(making, "the program")
    return making


def _place_um(text: str) -> Point:
    """A thread point as the page says it, mm. SettingsError where it is no place."""
    numbers = [number_of(each, PLACE_MM, Message("name-start")) for each in narrow(text).split(",")]
    if len(numbers) != 2:
        raise SettingsError("no-thread-point", found=text.strip()[:40])
    return Point(*map(from_mm, numbers))


def _summary(done: MadeProgram, language: Language) -> list[str]:
    """What there is to say of a program: whether it is proved, what speaks against it, what helps, what was chosen."""
    words = Words(language)
    proved = [words(f"program.verdict-{done.proof.verdict}")] if done.proof else []
    todo = advice(done, language, words("program.tab-control", label=words("open.tab")))
    checked = [*to_check(done.plan, language)]
    first = [*checked, *proved] if done.is_proved else [*proved, *checked]
    return [*first, *against(done, language), *todo, *told_lines(done.plan, language, _WIDE)]


_CONTROLS: Final = {
    "--gap": "open.join",
    "--pick": "open.picks",
    "--drawing-unit": "open.unit",
    "--lag": "open.lag",
    "--tab": "open.tab",
    "--no-core": "open.no-core",
    "--common-edges": "open.common-edges",
    "--pass": "open.passes",
    r"--start X,Y \S+ --thread-layer": "open.starts",
    r"--start(?: X,Y)?": "open.starts",
}
"""Options of the command line that the page has a control for, as they are named in texts, and its label."""


def _by_controls(said: Bilingual) -> Bilingual:
    """What is said, with the labels of the page's controls in place of options."""
    for option, label in _CONTROLS.items():
        said = Bilingual(
            *(
                re.sub(rf"{option}(?![\w-])", f"“{Words(language)(label)}”", text)
                for text, language in zip(said, LANGUAGES, strict=True)
            )
        )
    return said


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
