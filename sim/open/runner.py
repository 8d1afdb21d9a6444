"""The process of one run: what is asked comes as JSON on stdin, how far it is goes as lines of JSON to stdout.

It is a process of its own so that it can be ended at any moment, and so that the page stays in hand meanwhile.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from parser.files.reading import read_bytes, read_stdin
from parser.findings.errors import DrycutError, SettingsError
from parser.program import load_program, moving
from parser.units import from_mm
from sim.jobs.run_into import run_into, stages_of_files
from sim.run.findings import verdict
from sim.setup.machine.machine import load_machine, machine_names
from sim.setup.part import SIDES, Offset, OffsetPass
from sim.setup.program_section import OR_NONE_MM
from sim.setup.scenario import THICKNESS_MM, Scenario, load_scenario
from sim.setup.toml.reader import Bound, number
from sim.setup.wire import WIRE_DIAMETER_MM
from sim.show.terminal.printer import write

_STEPS: Final = 100
"""Of a stage, that are told."""


def main() -> None:
    """Run what is asked; the last line says what came of it."""
    asked = json.loads(read_stdin())
    try:
        _tell(done=_run(asked, Path(asked["file"]), Path(asked["folder"])))
    except DrycutError as error:
        _tell(wrong=str(error))


def scenario_of(asked: dict[str, str], file: Path) -> Scenario:
    """The scenario of a file with the values of the page; empty texts leave the usual ones.

    SettingsError for a value out of its bounds, or one that is no number.
    """
    scenario = load_scenario(file)
    if asked["machine"]:
        if asked["machine"] not in machine_names():  # a page names no file of the disk
            raise SettingsError(f"machine {asked['machine'][:40]!r} is not shipped")
        scenario = replace(scenario, machine=load_machine(asked["machine"]), machine_by_default=False)
    if asked["thickness_mm"]:
        scenario = replace(scenario, thickness_mm=_number(asked, "thickness_mm", THICKNESS_MM))
    if asked["wire_mm"]:
        wire = replace(scenario.wire, diameter_um=from_mm(_number(asked, "wire_mm", WIRE_DIAMETER_MM)))
        scenario = replace(scenario, wire=wire)
    if asked["offset_mm"]:
        offset_mm = _number(asked, "offset_mm", OR_NONE_MM)
        side = SIDES["left" if asked["side"] == "left" else "right"]
        scenario = replace(scenario, offset=Offset((OffsetPass(from_mm(offset_mm)),), side) if offset_mm else None)
    return replace(scenario, kerf=True)


def _run(asked: dict[str, str], file: Path, folder: Path) -> dict[str, Any]:
    scenario = scenario_of(asked, file)
    stages = list(stages_of_files(scenario, trace=False))
    told = ("", -1)

    def progress(stage: str, done: int, total: int) -> None:
        nonlocal told
        now = stage, _STEPS * done // total if total else _STEPS
        if now != told:
            told = now
            at = stages.index(stage) if stage in stages else len(stages) - 1
            _tell(stage=stage, at=at, of=len(stages), share=now[1] / _STEPS)

    program = moving(load_program(read_bytes(file), file.name, scenario.choices))
    run = run_into(folder, program, scenario, progress)
    return {"verdict": verdict(run.findings), "machine": scenario.machine.name}


def _number(asked: dict[str, str], name: str, bound: Bound) -> float:
    try:
        value = float(asked[name])
    except ValueError:
        raise SettingsError(f"{name} is a number, not {asked[name][:40]!r}") from None
    return number(value, bound, name)


def _tell(**values: Any) -> None:
    write(f"{json.dumps(values)}\n", "json")


if __name__ == "__main__":
    main()
