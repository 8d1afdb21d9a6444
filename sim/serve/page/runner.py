"""The process of a run, and of what is made of it.

It is a process of its own so that it can be ended at any moment, and so that the page stays in hand meanwhile. A run is
a job; so are a film and the pictures of a run, which make it again: the same run, since the same input gives the same.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from parser.files import read_bytes
from parser.findings.catalogue import Language
from parser.findings.errors import Message, SettingsError
from parser.program import Program, load_program, moving
from sim.base.progress import Progress, silent
from sim.check.file_check import settings_near
from sim.check.settings import CheckSettings
from sim.jobs.drills_into import drills_into
from sim.jobs.run_into import run_into, stages_of_files
from sim.run.findings import outcome
from sim.run.recording import Recording, recorded, stages_of
from sim.run.running import dry_run
from sim.serve.page.answers import found_in, pages_of
from sim.serve.page.child import Job, PageRequest, do, telling
from sim.serve.page.form import number_of, scenario_of
from sim.serve.page.model import RanEntry
from sim.setup.scenario import Scenario, load_scenario
from sim.setup.toml.reader import Bound
from sim.show.draw.sheet import SIZES_PX
from sim.show.film.screen import Look
from sim.show.film.writers import FORMATS, format_of, write_film
from sim.show.pictures.files import PictureFiles, write_pictures
from sim.show.pictures.gallery import PICTURES, subject_of
from sim.show.texts.phrases import machine_name
from sim.teach import drills as drill_set

_MOST_FOUND: Final = 200
"""Findings of a run that the page lists; its report has all."""
_FILM_PX: Final = (960, 540)
_FILM_FPS: Final = 20
_FILM_S: Final = Bound(0.5, 600.0)
_LEAST: Final = b"G21\nG92 X0 Y0\nG01 X1. Y0\nX1. Y1.\nX0 Y0\nM02\n"
_SETS: Final = Bound(1.0, float(drill_set.MOST_SETS))


def _run(request: PageRequest) -> RanEntry:
    """Run, with the files of every run."""
    scenario = scenario_of(request, Path(request["file"]))
    progress = telling(stages_of_files(scenario, trace=False))
    program = _program(request, scenario)
    run = run_into(request["folder"], program, scenario, progress)
    found = [finding for finding in run.findings if finding not in run.checked]
    return {
        "verdict": outcome(run.findings),
        "machine": machine_name(scenario.machine).entry(),
        "findings": found_in(program.text, found[:_MOST_FOUND]),
        "pages": pages_of(found[:_MOST_FOUND]),
    }


def _film(request: PageRequest) -> dict[str, Any]:
    """Make a film of the run."""
    if f".{request['form']}" not in FORMATS:  # nor does a page say in which folder
        raise SettingsError("no-film-format", formats=", ".join(FORMATS), found=request["form"][:40])
    file = Path(request["folder"]) / f"film.{request['form']}"
    seconds = number_of(request["seconds"], _FILM_S, Message("name-film-length"))
    look = Look(*_FILM_PX, "light", _language(request))
    format_of(file, seconds, _FILM_FPS, look)  # what cannot be is told before the run
    with _again(request, "film") as (recording, progress):
        write_film(file, recording, seconds, _FILM_FPS, look, progress)
    return {}


def _pictures(request: PageRequest) -> dict[str, Any]:
    """Draw all pictures of the run."""
    files = PictureFiles(Path(request["folder"]), {name: f"{name}.png" for name in PICTURES})
    with _again(request, "pictures") as (recording, progress):
        progress("pictures", 0, 1)
        write_pictures(subject_of(recording), files, SIZES_PX["screen"], "light", _language(request))
    return {}


def _drills(request: PageRequest) -> dict[str, Any]:
    """Make the fault drills of a set of the program that ran."""
    number = int(number_of(request["set"], _SETS, Message("name-set")))
    progress = telling(["drills"])
    progress("drills", 0, 1)
    program = _program(request, scenario_of(request, Path(request["file"])))
    wanted = drill_set.DrillRequest(number)
    drills = drill_set.drills_of(program, CheckSettings.reading(program.choices), wanted)
    drills_into(Path(request["folder"]), program, drills, number)
    return {}


_JOBS: Final[Mapping[str, Job]] = {
    "run": _run,
    "film": _film,
    "pictures": _pictures,
    "drills": _drills,
}


@contextmanager
def _again(request: PageRequest, last: str) -> Iterator[tuple[Recording, Progress]]:
    """The run once more with all its steps, and who is told of the stages: its own and the last one."""
    scenario = scenario_of(request, Path(request["file"]))
    progress = telling([*stages_of(scenario), last])
    with recorded(_program(request, scenario), scenario, progress) as recording:
        yield recording, progress


def _program(request: PageRequest, scenario: Scenario) -> Program:
    """The program, read with the settings near the file that it comes from, as its check on the page is."""
    file, near = Path(request["file"]), request["near_file"]
    choices = settings_near(file.name, Path(near))[0].choices if near else scenario.choices
    return moving(load_program(read_bytes(file), file.name, choices))


def _language(request: PageRequest) -> Language:
    return "zh" if request["language"] == "zh" else "en"


def _warm_up() -> None:
    """Run the least program there is: so all that a run needs is loaded, compiled loops too."""
    scenario = replace(load_scenario(Path("least.iso")), kerf=True)
    dry_run(moving(load_program(_LEAST, scenario.program.name, scenario.choices)), scenario, silent)


if __name__ == "__main__":
    do(_JOBS, _warm_up)
