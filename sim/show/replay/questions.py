"""The questions of a quiz as a replay's document holds them."""

from typing import Any

import numpy as np

from controller.stepping.pulses import Pulses
from sim.run.dryrun import DryRun
from sim.setup.quiz import About, Question, WrittenQuestion
from sim.show.replay.answers import written_out
from sim.show.replay.asked_block import asked_block


def question_entries(run: DryRun, steps: Pulses) -> list[dict[str, Any]]:
    """Questions of the scenario in the order of their rows.

    Those that this run has no answer to are left out: of blocks that vanish under an offset, of the first step where
    the card interpolates.
    """
    entries = [_entry(run, steps, question) for question in run.scenario.quiz]
    return sorted((entry for entry in entries if entry is not None), key=lambda entry: int(entry["row"]))


def _entry(run: DryRun, steps: Pulses, question: Question) -> dict[str, Any] | None:
    rows = np.flatnonzero(run.toolpath.source.block == question.block)
    if not len(rows):
        return None
    row = int(rows[0])
    what = question.what
    written = what if isinstance(what, WrittenQuestion) else _answered(run, steps, row, what)
    if written is None:
        return None
    return {
        "row": row,
        "block": question.block,
        "about": None if isinstance(what, WrittenQuestion) else what,
        "ask": written.ask._asdict(),
        "answers": [answer._asdict() for answer in written.answers],
        "right": written.right,
        "why": written.why._asdict(),
    }


def _answered(run: DryRun, steps: Pulses, row: int, about: About) -> WrittenQuestion | None:
    """A question about the block in a row; None where it makes no step, or has nothing of the kind."""
    first = int(run.stepped.count[:row].sum())
    if not run.stepped.count[row] or first >= len(steps.t_s):
        return None
    block = asked_block(run, row, (int(steps.x_um[first]), int(steps.y_um[first])))
    if about == "turn" and not block.is_arc:
        return None
    if about == "next_step" and run.scenario.machine.controller.interpolation != "point-by-point":
        return None
    return written_out(about, block)
