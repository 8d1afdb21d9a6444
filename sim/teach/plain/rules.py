"""How an exercise is marked: what a lesson hands to its page, and by which `drycut class mark` marks again."""

from typing import NamedTuple

from sim.teach.plain.answers import (
    Question,
    block_share,
    end_question,
    fault_share,
    program_attempts_share,
    question_share,
    shape_at,
    step_question,
)
from sim.teach.plain.program import Target
from sim.teach.plain.tasks import seed_of_task, task_of


class FaultRule(NamedTuple):
    """Lines of a damaged program that are right answers, from 1, and what is wrong."""

    lines: list[int]
    group: str


class Rules(NamedTuple):
    """How an exercise is marked.

    Attributes
    ----------
    kind
        ``block``, ``program``, ``fault`` or ``predict``.
    ask
        Of ``predict``: ``end``, ``next-step``, ``falls`` or ``time``; else empty.
    shapes, tasks
        Shapes of blocks, in turn, and how many tasks there are.
    target, weights
        Of ``program``: what is to be cut, and the weights of its parts.
    faults
        Of ``fault``.
    question
        Of ``falls`` and ``time``.
    """

    kind: str
    ask: str
    shapes: list[str]
    tasks: int
    target: Target
    weights: list[float]
    faults: list[FaultRule]
    question: Question


def task_share(rules: Rules, seed: int, task: int, attempts: list[str]) -> float:
    """Share of a task, numbered from 0, that attempts earn; `seed` is that of the exercise in a sitting."""
    if rules.kind == "program":
        return program_attempts_share(rules.target, rules.weights, attempts)
    if rules.kind == "fault":
        return fault_share(rules.faults[task].lines, rules.faults[task].group, attempts)
    if rules.kind == "predict" and rules.ask not in ["end", "next-step"]:
        return question_share(rules.question, attempts)
    shape, own_seed = shape_at(rules.shapes, task), seed_of_task(seed, task)
    if rules.kind == "block":
        return block_share(task_of(shape, own_seed), attempts)
    if rules.ask == "end":
        return question_share(end_question(task_of(shape, own_seed)), attempts)
    return question_share(Question([step_question(shape, own_seed).right], 0.0), attempts)
