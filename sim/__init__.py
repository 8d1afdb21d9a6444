"""The dry run of wire-cut EDM programs: the door for those who import drycut (docs/python.md).

``from sim import read_program, check_program, dry_run``: each name is loaded when it is asked for, so that a check
loads no engine and a run no pictures. What is not named here may change without notice.
"""

import importlib
from typing import TYPE_CHECKING, Any

from parser import __version__ as __version__

if TYPE_CHECKING:
    from parser.dialect.choices import Choices
    from parser.drawing.read import read_drawing
    from parser.findings.catalogue import texts
    from parser.findings.errors import DrycutError
    from parser.findings.findings import Finding
    from parser.program import Program, parse_program, read_program
    from sim.check.batch import check_program
    from sim.check.result import CheckResult
    from sim.check.settings import CheckSettings
    from sim.jobs.run_into import run_into
    from sim.jobs.trace_file import StoredTrace, read_trace
    from sim.measure.compare.compared_program import compare_program
    from sim.run.dryrun import DryRun
    from sim.run.findings import verdict
    from sim.run.recording import recorded
    from sim.run.report import build_report
    from sim.run.running import dry_run
    from sim.setup.machine.machine import load_machine
    from sim.setup.part import DrawingTarget, Offset, OffsetPass
    from sim.setup.scenario import Scenario, load_scenario
    from sim.setup.wire import Wire

__all__ = [
    "CheckResult",
    "CheckSettings",
    "Choices",
    "DrawingTarget",
    "DryRun",
    "DrycutError",
    "Finding",
    "Offset",
    "OffsetPass",
    "Program",
    "Scenario",
    "StoredTrace",
    "Wire",
    "build_report",
    "check_program",
    "compare_program",
    "dry_run",
    "load_machine",
    "load_scenario",
    "parse_program",
    "read_drawing",
    "read_program",
    "read_trace",
    "recorded",
    "run_into",
    "texts",
    "verdict",
]

_HOMES = {
    "CheckResult": "sim.check.result",
    "CheckSettings": "sim.check.settings",
    "Choices": "parser.dialect.choices",
    "DrawingTarget": "sim.setup.part",
    "DryRun": "sim.run.dryrun",
    "DrycutError": "parser.findings.errors",
    "Finding": "parser.findings.findings",
    "Offset": "sim.setup.part",
    "OffsetPass": "sim.setup.part",
    "Program": "parser.program",
    "Scenario": "sim.setup.scenario",
    "StoredTrace": "sim.jobs.trace_file",
    "Wire": "sim.setup.wire",
    "build_report": "sim.run.report",
    "check_program": "sim.check.batch",
    "compare_program": "sim.measure.compare.compared_program",
    "dry_run": "sim.run.running",
    "load_machine": "sim.setup.machine.machine",
    "load_scenario": "sim.setup.scenario",
    "parse_program": "parser.program",
    "read_drawing": "parser.drawing.read",
    "read_program": "parser.program",
    "read_trace": "sim.jobs.trace_file",
    "recorded": "sim.run.recording",
    "run_into": "sim.jobs.run_into",
    "texts": "parser.findings.catalogue",
    "verdict": "sim.run.findings",
}


def __getattr__(name: str) -> Any:
    """A name of the door, loaded from the room that it lives in. AttributeError where there is no such name."""
    if name not in _HOMES:
        raise AttributeError(f"module 'sim' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
