"""The dry run of wire-cut EDM programs: the door for those who import drycut (docs/python.md).

``from drycut import read_program, check_program, dry_run``: each name is loaded when it is asked for, so that a check
loads no engine and a run no pictures. What is not named here may change without notice.
"""

import importlib
from typing import TYPE_CHECKING, Any

from drycut.clash import refuse_strangers

if TYPE_CHECKING:
    from parser import __version__ as __version__
    from parser.dialect.reader import Choices
    from parser.drawing.read import read_drawing
    from parser.findings.catalogue import texts
    from parser.findings.errors import DrycutError
    from parser.findings.findings import Finding
    from parser.program import Program, parse_program, read_program
    from parser.write.iso import iso_choices
    from sim.check.file_check import check_program
    from sim.check.own_checks import OwnCheck, OwnCode, OwnFinding, OwnTexts
    from sim.check.result import CheckResult
    from sim.check.settings import CheckSettings
    from sim.jobs.run_into import run_into
    from sim.jobs.trace_file import StoredTrace, read_trace
    from sim.make.cam.maker import MadeProgram as Made
    from sim.make.cam.maker import NotMade
    from sim.make.cam.maker import made_program as make_program
    from sim.make.convert import Converted, Refused
    from sim.make.convert import converted as convert_program
    from sim.make.wanted import Wanted
    from sim.measure.compare.compare import compare_program
    from sim.measure.compare.result import Comparison
    from sim.run.dryrun import DryRun
    from sim.run.findings import verdict
    from sim.run.recording import recorded
    from sim.run.report import build_report
    from sim.run.running import dry_run
    from sim.setup.machine.machine import load_machine
    from sim.setup.making import Making
    from sim.setup.part import DrawingTarget, Offset, OffsetPass
    from sim.setup.scenario import Scenario, load_scenario
    from sim.setup.wire import Wire
    from sim.show.pictures.files import PictureFiles, write_pictures
    from sim.show.pictures.gallery import subject_of

__all__ = [
    "CheckResult",
    "CheckSettings",
    "Choices",
    "Comparison",
    "Converted",
    "DrawingTarget",
    "DryRun",
    "DrycutError",
    "Finding",
    "Made",
    "Making",
    "NotMade",
    "Offset",
    "OffsetPass",
    "OwnCheck",
    "OwnCode",
    "OwnFinding",
    "OwnTexts",
    "PictureFiles",
    "Program",
    "Refused",
    "Scenario",
    "StoredTrace",
    "Wanted",
    "Wire",
    "build_report",
    "check_program",
    "compare_program",
    "convert_program",
    "dry_run",
    "iso_choices",
    "load_machine",
    "load_scenario",
    "make_program",
    "parse_program",
    "read_drawing",
    "read_program",
    "read_trace",
    "recorded",
    "run_into",
    "subject_of",
    "texts",
    "verdict",
    "write_pictures",
]

_HOMES = {
    "CheckResult": "sim.check.result",
    "CheckSettings": "sim.check.settings",
    "Choices": "parser.dialect.reader",
    "Comparison": "sim.measure.compare.result",
    "Converted": "sim.make.convert",
    "DrawingTarget": "sim.setup.part",
    "DryRun": "sim.run.dryrun",
    "DrycutError": "parser.findings.errors",
    "Finding": "parser.findings.findings",
    "Made": "sim.make.cam.maker:MadeProgram",
    "Making": "sim.setup.making",
    "NotMade": "sim.make.cam.maker",
    "Offset": "sim.setup.part",
    "OffsetPass": "sim.setup.part",
    "OwnCheck": "sim.check.own_checks",
    "OwnCode": "sim.check.own_checks",
    "OwnFinding": "sim.check.own_checks",
    "OwnTexts": "sim.check.own_checks",
    "PictureFiles": "sim.show.pictures.files",
    "Program": "parser.program",
    "Refused": "sim.make.convert",
    "Scenario": "sim.setup.scenario",
    "StoredTrace": "sim.jobs.trace_file",
    "Wanted": "sim.make.wanted",
    "Wire": "sim.setup.wire",
    "__version__": "parser",
    "build_report": "sim.run.report",
    "check_program": "sim.check.file_check",
    "compare_program": "sim.measure.compare.compare",
    "convert_program": "sim.make.convert:converted",
    "dry_run": "sim.run.running",
    "iso_choices": "parser.write.iso",
    "load_machine": "sim.setup.machine.machine",
    "load_scenario": "sim.setup.scenario",
    "make_program": "sim.make.cam.maker:made_program",
    "parse_program": "parser.program",
    "read_drawing": "parser.drawing.read",
    "read_program": "parser.program",
    "read_trace": "sim.jobs.trace_file",
    "recorded": "sim.run.recording",
    "run_into": "sim.jobs.run_into",
    "subject_of": "sim.show.pictures.gallery",
    "texts": "parser.findings.catalogue",
    "verdict": "sim.run.findings",
    "write_pictures": "sim.show.pictures.files",
}


def __getattr__(name: str) -> Any:
    """A name of the door, loaded from the room that it lives in.

    AttributeError where there is no such name; ImportError where another package stands in the place of one of ours.
    """
    if name not in _HOMES:
        raise AttributeError(f"module 'drycut' has no attribute {name!r}")
    refuse_strangers()
    module, _, own = _HOMES[name].partition(":")
    return getattr(importlib.import_module(module), own or name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
