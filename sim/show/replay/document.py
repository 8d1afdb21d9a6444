"""The replay's page: all that it needs as plain data, and one file that plays it with nothing to load or install."""

from pathlib import Path
from typing import Any

from parser import __version__
from parser.program import Program
from parser.text.encoding import printable
from sim.run.course import course_of, passes_of
from sim.run.findings import verdict
from sim.run.recording import Recording
from sim.show.draw.tones import tones_of
from sim.show.html.environment import rendered
from sim.show.html.packed import packed
from sim.show.keys import OF_PAGE, actions_of
from sim.show.replay.block_columns import block_columns, plan_columns
from sim.show.replay.decoding import decoding
from sim.show.replay.happenings import (
    contour_entries,
    ending_entry,
    finding_entry,
    loss_entry,
    pass_entries,
    stop_entry,
)
from sim.show.replay.quiz import quiz_of
from sim.show.replay.scene import piece_entry, scene
from sim.show.replay.tape import tape
from sim.show.words.phrases import machine_name
from sim.table.trace import origin_um

SCHEMA = "drycut.replay/1"

_ASSETS = Path(__file__).with_name("assets")


def replay_page(recording: Recording) -> str:
    """HTML of ``replay.html`` for a recorded run."""
    tones = tones_of(one for one, _ in passes_of(recording.run))
    document, machine = _handed_over(replay_document(recording)), machine_name(recording.run.scenario.machine)
    values = {"document": document, "machine": machine, "tones": tones}
    return rendered(_ASSETS, "replay.html.j2", **values, keys=OF_PAGE, actions=actions_of(OF_PAGE))


def _handed_over(document: dict[str, Any]) -> dict[str, Any]:
    """A document as the page has it, the long columns of blocks and plan packed.

    The lines of the program are not: a browser that is too old to unpack them lists them all the same.
    """
    columns = {
        key: {name: value and packed(value) for name, value in document[key].items()} for key in ("blocks", "plan")
    }
    return {**document, **columns}


def replay_document(recording: Recording) -> dict[str, Any]:
    """Document of a recorded run as lists, dicts, texts, numbers and None; rows of blocks count from 0.

    Where the machine stopped early, steps, samples and the duration end there.
    """
    run, course = recording.run, course_of(recording)
    return {
        "schema": SCHEMA,
        "drycut": __version__,
        "title": run.scenario.title,
        "provenance": run.scenario.provenance,
        "verdict": verdict(run.findings),
        "duration_s": course.duration_s,
        "program": _program(run.program),
        **scene(run),
        "has_jumps": bool(run.toolpath.is_jump.any()),
        "blocks": block_columns(run),
        "decoding": decoding(run),
        "plan": plan_columns(run.plan),
        "stops": [stop_entry(one.what) for one in course.stops],
        "contours": contour_entries(run.whole_contours),
        "passes": pass_entries(course.passes),
        "findings": [finding_entry(one) for one in course.findings],
        "losses": [loss_entry(one.what) for one in course.losses],
        "ended": None if run.ended is None else ending_entry(run.ended),
        "pieces": [piece_entry(one) for one in course.pieces],
        "quiz": quiz_of(run, course.steps),
        "tape": tape(course.steps, origin_um(run.toolpath), course.trace, course.across.row),
    }


def _program(program: Program) -> dict[str, Any]:
    """Name and lines, with every character in its place; what cannot be printed is replaced."""
    lines = range(1, program.lines.line(max(len(program.text) - 1, 0)) + 1)
    return {
        "name": printable(program.name),
        "dialect": program.reading.dialect,
        "is_worded": program.toolpath.words is not None,
        "lines": [printable(program.excerpt(line)) for line in lines],
    }
