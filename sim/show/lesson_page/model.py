"""What the page of a lesson hands over to its script."""

from typing import Any, TypedDict

from parser.documents import SaidEntry


class RulesEntry(TypedDict):
    """How an exercise is marked: `sim.teach.plain.rules.Rules`, its named tuples as objects."""

    kind: str
    ask: str
    shapes: list[str]
    tasks: int
    target: dict[str, Any]
    weights: list[float]
    faults: list[dict[str, Any]]
    question: dict[str, Any]


class ExerciseEntry(TypedDict):
    """An exercise: what it is called, its points, and how it is marked.

    `program` and `feed_mm_min` are what it asks about, `offset_um` and `is_inside` what it wants of a program.
    """

    title: SaidEntry
    points: float
    rules: RulesEntry
    program: str
    feed_mm_min: float
    offset_um: float
    is_inside: bool


class LessonEntry(TypedDict):
    """A lesson: its digest, by which a hand-in names it, whether numbers are a pupil's own, and its exercises."""

    lesson: str
    title: SaidEntry
    numbers: str
    seed: int
    exercises: list[ExerciseEntry]
