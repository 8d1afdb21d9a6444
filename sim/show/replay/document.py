"""All that the replay's page needs, as plain data."""

from typing import Any

from parser.program import Program
from parser.text.encoding import printable
from sim import __version__
from sim.run.course import ran
from sim.run.dryrun import verdict
from sim.run.recording import Recording
from sim.show.replay.block_columns import block_columns, plan_columns
from sim.show.replay.happenings import contour_entries, finding_entries, loss_entry, stop_entries
from sim.show.replay.questions import question_entries
from sim.show.replay.scene import piece_entries, scene
from sim.show.replay.tape import tape
from sim.table.motion import origin_um

SCHEMA = "drycut.replay/1"


def replay_document(recording: Recording) -> dict[str, Any]:
    """Document of a recorded run as lists, dicts, texts, numbers and None; rows of blocks count from 0.

    Where a servo tripped, steps, samples and the duration end there.
    """
    run, made = recording.run, ran(recording)
    return {
        "schema": SCHEMA,
        "drycut": __version__,
        "title": run.scenario.title,
        "provenance": run.scenario.provenance,
        "verdict": verdict(run.findings),
        "duration_s": made.duration_s,
        "program": _program(run.program),
        **scene(run),
        "blocks": block_columns(run, len(made.steps.t_s)),
        "plan": plan_columns(run.plan),
        "stops": stop_entries(run),
        "contours": contour_entries(run),
        "findings": finding_entries(run),
        "losses": [loss_entry(loss) for loss in run.losses],
        "tripped": None if run.tripped is None else loss_entry(run.tripped),
        "pieces": piece_entries(recording.pieces),
        "quiz": question_entries(run, made.steps),
        "tape": tape(made.steps, origin_um(run.toolpath), made.trace),
    }


def _program(program: Program) -> dict[str, Any]:
    """Name and lines, with every character in its place; what cannot be printed is replaced."""
    lines = range(1, program.lines.line(max(len(program.text) - 1, 0)) + 1)
    return {
        "name": printable(program.name),
        "dialect": program.reading.dialect,
        "lines": [printable(program.excerpt(line)) for line in lines],
    }
