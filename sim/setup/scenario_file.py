"""The scenario of a run as its file would give it: what a folder needs beside the program to run the same again."""

import math
from typing import Any

from parser.text.encoding import printable
from sim.setup.expectations import Expectation
from sim.setup.machine.machine_file import in_mm, outline_mm
from sim.setup.quiz import Question, Written
from sim.setup.scenario import Scenario
from sim.setup.toml.writer import Section
from sim.setup.wire import Wire, WireForces

MACHINE_FILE = "machine.toml"


def scenario_sections(scenario: Scenario) -> list[tuple[str, Section]]:
    """Sections of the scenario file that asks for the same run, on the machine of ``machine.toml``."""
    return [
        ("", _whole(scenario)),
        ("[wire]", _wire(scenario.wire)),
        ("[work]", _work(scenario)),
        ("[offset]", _offset(scenario)),
        ("[drawing]", _drawing(scenario)),
        *(
            ("[[clamps]]", {"name": clamp.name, "outline_mm": outline_mm(clamp.outline_um)})
            for clamp in scenario.clamps
        ),
        *(("[[quiz]]", _question(question)) for question in scenario.quiz),
        ("[expect]", {expected.path: wanted(expected) for expected in scenario.expect}),
    ]


def wanted(expected: Expectation) -> Any:
    """What an expectation asks for, as its file says it."""
    if not expected.is_range:
        return expected.value
    return {key: end for key, end in zip(("min", "max"), expected.value, strict=True) if math.isfinite(end)}


def _whole(scenario: Scenario) -> Section:
    start = {} if scenario.start_mm is None else {"start_mm": list(scenario.start_mm)}
    return {
        "title": scenario.title,
        "provenance": scenario.provenance,
        "program": printable(scenario.program.name),
        "machine": MACHINE_FILE,
        **start,
        "open": scenario.may_stay_open,
        "trace_spacing_um": scenario.trace_spacing_um,
        "kerf": scenario.kerf,
    }


def _wire(wire: Wire) -> Section:
    lag = wire.lag
    forces = lag._asdict() if isinstance(lag, WireForces) else {"lag_um": lag}
    return {
        "diameter_mm": in_mm(wire.diameter_um),
        "spark_gap_mm": in_mm(wire.spark_gap_um),
        **{key: value for key, value in forces.items() if value is not None},
    }


def _work(scenario: Scenario) -> Section:
    outline = {} if scenario.work_um is None else {"outline_mm": outline_mm(scenario.work_um)}
    return {"thickness_mm": scenario.thickness_mm, "density_g_cm3": scenario.density_g_cm3, **outline}


def _offset(scenario: Scenario) -> Section:
    offset = scenario.offset
    return {} if offset is None else {"by_mm": in_mm(offset.by_um), "side": offset.side.name.lower()}


def _drawing(scenario: Scenario) -> Section:
    asked = scenario.drawing
    if asked is None:
        return {}
    told = {**asked._asdict(), "file": printable(asked.file.name)}
    return {
        key: printable(value) if isinstance(value, str) else value for key, value in told.items() if value is not None
    }


def _question(question: Question) -> Section:
    what = question.what
    if not isinstance(what, Written):
        return {"block": question.block, "about": what}
    return {
        "block": question.block,
        "ask": what.ask.en,
        "ask_zh": what.ask.zh,
        "answers": [answer.en for answer in what.answers],
        "answers_zh": [answer.zh for answer in what.answers],
        "right": what.right + 1,
        "why": what.why.en,
        "why_zh": what.why.zh,
    }
