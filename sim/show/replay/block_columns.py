"""Columns of a replay's document: the blocks, exact and in words, and the plan along them."""

from typing import Any

import numpy as np

from controller.motion.plan import Plan
from controller.stepping.words import words_of
from parser.program import Program
from parser.told.step_words import Axis, StepWords
from sim.rounded import column
from sim.run.dryrun import DryRun
from sim.show.replay.curve_columns import exact_columns


def block_columns(run: DryRun) -> dict[str, list[Any]]:
    """Columns of n blocks, one entry a block; `place_*`, `first_step` and `border_s` have n + 1."""
    return {
        **exact_columns(run.toolpath),
        **_words(words_of(run.toolpath)),
        **_source(run.program),
        "first_step": [0, *np.cumsum(run.stepped.count).tolist()],
        "border_s": column(run.border_s),
    }


def plan_columns(plan: Plan) -> dict[str, list[Any] | None]:
    """Columns of p phases, `t_s` with p + 1; no `jerk_um_s3` where there is none."""
    return {
        "t_s": column(plan.time_s, 9),
        "speed_um_s": column(plan.speed_um_s),
        "acceleration_um_s2": column(plan.acceleration_um_s2),
        "jerk_um_s3": column(plan.jerk_um_s3) if plan.jerk_um_s3.any() else None,
    }


def _words(words: StepWords) -> dict[str, list[Any]]:
    """What the controller counts by: words of the program, or its own."""
    return {
        "word_x_um": words.x_um.tolist(),
        "word_y_um": words.y_um.tolist(),
        "count_um": words.count_um.tolist(),
        "count_axis": [Axis(axis).name for axis in words.count_axis.tolist()],
        "quadrant": words.quadrant.tolist(),
        "turn": words.turn.tolist(),
    }


def _source(program: Program) -> dict[str, list[Any]]:
    """Each block's number and name in the program, its line from 1, its first character in that from 0, its length."""
    source = program.toolpath.source
    _, first = program.lines.places(source.span[:, 0])
    return {
        "number": source.block.tolist(),
        "line": source.line.tolist(),
        "character": (first - 1).tolist(),
        "characters": (source.span[:, 1] - source.span[:, 0]).tolist(),
        "name": source.names.of_rows(),
        "label": [source.names.label(row) for row in range(len(program.toolpath))],
    }
