"""The quiz of a replay: what its scenario asks, and sets of questions that any program answers."""

from collections import Counter
from random import Random
from typing import Any, Final, get_args

import numpy as np

from controller.stepping.pulses import Pulses
from controller.stepping.words import words_of
from parser.told.step_words import StepWords
from sim.run.dryrun import DryRun
from sim.setup.quiz import About
from sim.show.replay.of_run import questions_of
from sim.show.replay.questions import answered, entry_of, question_entries

SETS: Final = 99
"""Sets of questions, by number from 1: a class that is told one has the same questions."""
IN_A_SET: Final = 10
_MOST_BLOCKS: Final = 30


def quiz_of(run: DryRun, steps: Pulses) -> dict[str, Any]:
    """``quiz`` of a replay's document: the scenario's `own` questions, a `pool` of others, and `sets` of those."""
    words = words_of(run.toolpath)
    pool = _pool(run, steps, words)
    return {"own": question_entries(run, steps, words), "pool": pool, "sets": sets_of(pool)}


def sets_of(pool: list[dict[str, Any]]) -> list[list[int]]:
    """For each set the indices of its questions, in the order of their rows; none where the pool is empty."""
    return [_set(pool, number) for number in range(1, SETS + 1)] if pool else []


def _pool(run: DryRun, steps: Pulses, words: StepWords) -> list[dict[str, Any]]:
    """Questions of every kind about blocks that are spread over the program, by their rows."""
    cut = np.flatnonzero(~run.toolpath.is_jump & (run.stepped.count > 0))
    rows = cut[np.unique(np.linspace(0, len(cut) - 1, min(len(cut), _MOST_BLOCKS)).astype(np.int64))].tolist()
    of_blocks = ((row, about, answered(run, steps, words, row, about)) for row in rows for about in _kinds(run))
    entries = [entry_of(run, row, written, about) for row, about, written in of_blocks if written is not None]
    entries += [entry_of(run, one.row, one.written, one.about) for one in questions_of(run)]
    return sorted(entries, key=lambda entry: int(entry["row"]))


def _kinds(run: DryRun) -> tuple[About, ...]:
    """What can be asked about a block: of words where the program has them, of places where no offset moves them."""
    if run.offset is not None:
        return ("quadrant", "turn") if run.toolpath.words is not None else ("turn",)
    every: tuple[About, ...] = get_args(About)
    return every if run.toolpath.words is not None else ("turn", "end")


def _set(pool: list[dict[str, Any]], number: int) -> list[int]:
    """Questions of as many kinds about as many blocks as there are, the others left to chance."""
    chance = Random(number)  # noqa: S311 - the same for all who are told the number
    order = sorted(range(len(pool)), key=lambda _: chance.random())
    chosen: list[int] = []
    kinds: Counter[str] = Counter()
    blocks: Counter[int] = Counter()
    while order and len(chosen) < IN_A_SET:
        best = min(order, key=lambda at: (kinds[pool[at]["about"]], blocks[pool[at]["block"]]))
        order.remove(best)
        chosen.append(best)
        kinds[pool[best]["about"]] += 1
        blocks[pool[best]["block"]] += 1
    return sorted(chosen)
