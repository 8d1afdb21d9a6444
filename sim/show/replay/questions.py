"""A question as a replay's document holds it, and those that a scenario asks."""

from typing import Any

import numpy as np

from controller.stepping.pulses import Pulses
from parser.text.source import Field
from parser.told.step_words import StepWords
from sim.run.dryrun import DryRun
from sim.setup.quiz import About, Question, WrittenQuestion
from sim.show.replay.answers import written_out
from sim.show.replay.asked_block import asked_block

_HIDDEN: dict[About, tuple[Field, ...]] = {
    "quadrant": (Field.AXIS, Field.SENSE),
    "count_axis": (Field.AXIS, Field.COUNT),
    "turn": (Field.SENSE,),
    "count_length": (Field.COUNT,),
    "next_step": (),
    "end": (),
}
"""Fields of its block that would tell the answer."""


def question_entries(run: DryRun, steps: Pulses, words: StepWords) -> list[dict[str, Any]]:
    """Questions of the scenario in the order of their rows.

    Those that this run has no answer to are left out: of blocks that vanish under an offset, of the first step where
    the card interpolates.
    """
    entries = [_of_scenario(run, steps, words, question) for question in run.scenario.quiz]
    return sorted((entry for entry in entries if entry is not None), key=lambda entry: int(entry["row"]))


def _of_scenario(run: DryRun, steps: Pulses, words: StepWords, question: Question) -> dict[str, Any] | None:
    rows = np.flatnonzero(run.toolpath.source.block == question.block)
    if not len(rows):
        return None
    row, what = int(rows[0]), question.what
    if isinstance(what, WrittenQuestion):
        return entry_of(run, row, what, None)
    written = answered(run, steps, words, row, what)
    return written and entry_of(run, row, written, what)


def entry_of(run: DryRun, row: int, written: WrittenQuestion, about: str | None) -> dict[str, Any]:
    """A question about the block in a row; its kind is None where a scenario has its own."""
    source = run.toolpath.source
    return {
        "row": row,
        "block": int(source.block[row]),
        "name": source.names.of_row(row),
        "about": about,
        "ask": written.ask._asdict(),
        "answers": [answer._asdict() for answer in written.answers],
        "right": written.right,
        "why": written.why._asdict(),
        "hidden": _hidden(run, row, about),
    }


def _hidden(run: DryRun, row: int, about: str | None) -> list[tuple[int, int]]:
    """First character in the block's text, and one past the last, of what would tell the answer."""
    source = run.toolpath.source
    if about == "end":  # programs print it behind the block
        first, past = source.span[row].tolist()
        line_end = source.text.find("\n", past)
        return [(past - first, (line_end if line_end >= 0 else len(source.text)) - first)]
    fields = source.fields_of(source.block_text(row))
    wanted = next((of for kind, of in _HIDDEN.items() if kind == about), ())
    return sorted(fields[one] for one in wanted if one in fields)


def answered(run: DryRun, steps: Pulses, words: StepWords, row: int, about: About) -> WrittenQuestion | None:
    """A question about the block in a row; None where it makes no step, or has nothing of the kind."""
    first = int(run.stepped.count[:row].sum())
    if not run.stepped.count[row] or first >= len(steps.t_s):
        return None
    block = asked_block(run, words, row, (int(steps.x_um[first]), int(steps.y_um[first])))
    if about == "turn" and not block.is_arc:
        return None
    if about == "next_step" and run.scenario.machine.controller.interpolation != "point-by-point":
        return None
    return written_out(about, block)
