"""The process of one job: what is asked comes as JSON on stdin, how far it is goes as lines of JSON to stdout.

It is a process of its own so that it can be ended at any moment, and so that the page stays in hand meanwhile. A run is
a job; so are a film and the pictures of a run, which make it again: the same run, since the same input gives the same.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from parser.files.reading import read_bytes, read_stdin
from parser.findings.catalogue import Language
from parser.findings.errors import DrycutError, SettingsError
from parser.program import Program, load_program, moving
from parser.units import from_mm
from sim.jobs.run_into import run_into, stages_of_files
from sim.run.findings import verdict
from sim.run.recording import Recording, recorded, stages_of
from sim.setup.machine.machine import load_machine, machine_names
from sim.setup.part import SIDES, Offset, OffsetPass
from sim.setup.program_section import OR_NONE_MM
from sim.setup.scenario import THICKNESS_MM, Scenario, load_scenario
from sim.setup.toml.reader import Bound, number
from sim.setup.wire import WIRE_DIAMETER_MM
from sim.show.draw.sheet import SIZES_PX
from sim.show.film.film import format_of, write_film
from sim.show.film.screen import Look
from sim.show.film.writers import FORMATS
from sim.show.pictures.files import PictureFiles, write_pictures
from sim.show.pictures.gallery import PICTURES, subject_of
from sim.show.terminal.printer import write
from sim.table.progress import Progress

_STEPS: Final = 100
"""Of a stage, that are told."""
_FILM_PX: Final = (960, 540)
_FILM_FPS: Final = 20
_FILM_S: Final = Bound(0.5, 600.0)


def main() -> None:
    """Do what is asked; the last line says what came of it."""
    asked = json.loads(read_stdin())
    try:
        _tell(done=_JOBS[asked["job"]](asked))
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


def _run(asked: dict[str, str]) -> dict[str, Any]:
    """Run, with the files of every run."""
    scenario = scenario_of(asked, Path(asked["file"]))
    progress = _telling(stages_of_files(scenario, trace=False))
    run = run_into(asked["folder"], _program(asked, scenario), scenario, progress)
    return {"verdict": verdict(run.findings), "machine": scenario.machine.name}


def _film(asked: dict[str, str]) -> dict[str, Any]:
    """Make a film of the run."""
    if f".{asked['form']}" not in FORMATS:  # nor does a page say in which folder
        raise SettingsError(f"films are {', '.join(FORMATS)}, not {asked['form'][:40]!r}")
    file, seconds = Path(asked["folder"]) / f"film.{asked['form']}", _number(asked, "seconds", _FILM_S)
    look = Look(*_FILM_PX, "light", _language(asked))
    format_of(file, seconds, _FILM_FPS, look)  # what cannot be is told before the run
    with _again(asked, "film") as (recording, progress):
        write_film(file, recording, seconds, _FILM_FPS, look, progress)
    return {}


def _pictures(asked: dict[str, str]) -> dict[str, Any]:
    """Draw all pictures of the run."""
    files = PictureFiles(Path(asked["folder"]), {name: f"{name}.png" for name in PICTURES})
    with _again(asked, "pictures") as (recording, progress):
        progress("pictures", 0, 1)
        write_pictures(subject_of(recording), files, SIZES_PX["screen"], "light", _language(asked))
    return {}


_JOBS: Final[Mapping[str, Callable[[dict[str, str]], dict[str, Any]]]] = {
    "run": _run,
    "film": _film,
    "pictures": _pictures,
}


@contextmanager
def _again(asked: dict[str, str], last: str) -> Iterator[tuple[Recording, Progress]]:
    """The run once more with all its steps, and who is told of the stages: its own and the last one."""
    scenario = scenario_of(asked, Path(asked["file"]))
    progress = _telling([*stages_of(scenario), last])
    with recorded(_program(asked, scenario), scenario, progress) as recording:
        yield recording, progress


def _program(asked: dict[str, str], scenario: Scenario) -> Program:
    file = Path(asked["file"])
    return moving(load_program(read_bytes(file), file.name, scenario.choices))


def _telling(stages: list[str]) -> Progress:
    """Tells of the progress through these stages, by the hundredth of each."""
    told = ("", -1)

    def progress(stage: str, done: int, total: int) -> None:
        nonlocal told
        now = stage, _STEPS * done // total if total else _STEPS
        if now != told:
            told = now
            at = stages.index(stage) if stage in stages else len(stages) - 1
            _tell(stage=stage, at=at, of=len(stages), share=now[1] / _STEPS)

    return progress


def _language(asked: dict[str, str]) -> Language:
    return "zh" if asked["language"] == "zh" else "en"


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
