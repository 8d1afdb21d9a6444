"""One program of a shop, as a worker runs it: bytes come in and bytes go out, for the worker may be another machine."""

import threading
import traceback
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

from parser.findings.catalogue import Language
from parser.findings.errors import DrawingError, DrycutError, ProgramError
from parser.findings.findings import counted
from parser.program import load_program, moving
from sim.base.files import scratch
from sim.base.rounded import rounded
from sim.base.workers.makers import Maker, refuse_other_makers
from sim.jobs.index import Row
from sim.jobs.run_into import FILES, run_into
from sim.run.dryrun import DryRun
from sim.run.findings import to_check, verdict
from sim.setup.scenario import Scenario
from sim.show.index_page.page import thumbnail
from sim.show.texts.phrases import same

_BY_ITSELF: Final = threading.Lock()  # workers of a cluster may have several threads, and pygame knows one


class Task(NamedTuple):
    """A program to run.

    Attributes
    ----------
    name, data
        Name of its file, as shown, and its bytes.
    scenario
        What it is run with.
    drawing
        Bytes of the scenario's drawing; None without one.
    made_by
        What its bytes must come from: `made_by` of who asks for them.
    language
        Of its picture; its pages are in both.
    is_made
        Whether its bytes were made of the drawing, so that they belong to its files.
    """

    name: str
    data: bytes
    scenario: Scenario
    drawing: bytes | None
    made_by: Maker
    language: Language
    is_made: bool = False


class Done(NamedTuple):
    """What came of it: its row of the index, its files by their names, and the traceback of a fault of drycut."""

    row: Row
    files: Mapping[str, bytes]
    fault: str = ""


def run_task(task: Task) -> Done:
    """Run a program. Whatever is wrong with it is told in its row.

    ClusterError where this worker would make other bytes than the one who asks.
    """
    refuse_other_makers(task.made_by)
    try:
        with _BY_ITSELF, scratch() as folder:
            return _run(task, folder)
    except ProgramError as error:
        row = Row("refused", task.scenario.title, error.in_both(), counted((*error.others, error.finding)))
        return Done(row, {})
    except DrycutError as error:
        return Done(Row("refused", task.scenario.title, error.in_both()), {})
    except Exception:
        return fault_of(task.scenario.title, traceback.format_exc())


def fault_of(title: str, told_text: str) -> Done:
    """A program at which drycut itself failed; the last line of what is told stands in its row."""
    return Done(Row("fault", title, same(told_text.strip().splitlines()[-1])), {}, told_text)


def _run(task: Task, folder: Path) -> Done:
    """Run a program into a folder, and take its files from there."""
    made = folder / "made"
    scenario = _with_drawing(task, folder)
    try:
        program = moving(load_program(task.data, task.name, scenario.choices))
        run = run_into(made, program, scenario, language=task.language)
    except DrawingError as error:  # people know the drawing by where it stands
        here, own = _places_of_drawing(scenario, task.scenario)
        raise DrawingError(error.message.with_values(lambda value: own if str(value) == here else value)) from None
    extra = {task.scenario.program.name: task.data} if task.is_made else {}
    return Done(_row(run), {**{name: (made / name).read_bytes() for name in FILES if (made / name).exists()}, **extra})


def _with_drawing(task: Task, folder: Path) -> Scenario:
    """The scenario with its drawing in a folder, under its own name."""
    own = task.scenario.drawing
    if own is None or task.drawing is None:
        return task.scenario
    here = folder / "drawing" / own.file.name
    here.parent.mkdir()
    here.write_bytes(task.drawing)
    return replace(task.scenario, drawing=own._replace(file=here))


def _places_of_drawing(here: Scenario, own: Scenario) -> tuple[str, str]:
    return str(here.drawing and here.drawing.file), str(own.drawing and own.drawing.file)


def _row(run: DryRun) -> Row:
    """The row of a run, its figures those of ``report.json``."""
    return Row(
        verdict(run.findings),
        run.scenario.title,
        findings=counted(run.findings),
        time_s=rounded(run.ran_s),
        max_um=rounded(run.deviations.wire.max_um),
        to_check=to_check(run.findings),
        drawing_um=None if run.comparison is None else rounded(run.comparison.max_um),
        picture=thumbnail(run.toolpath),
    )
