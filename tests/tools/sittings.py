"""Sittings of pupils who know more or less: answers to all tasks of a lesson, by a seed."""

import functools
import json
import tempfile
from pathlib import Path
from random import Random
from typing import Any

from sim.jobs.class_marks import class_result, marking_of
from sim.jobs.lessons import lesson_of
from sim.make.lessons import ReadyLesson
from sim.show.class_page.page import written
from sim.show.lesson_page import lesson_page
from sim.show.lesson_page.page import lesson_entry
from sim.teach.handins import SCHEMA
from sim.teach.marking import ClassResult
from sim.teach.plain.answers import end_question, shape_at, step_question
from sim.teach.plain.tasks import seed_of_task, task_of

LESSONS = Path(__file__).parents[2] / "sim" / "teach" / "lessons"
PROGRAMS = {
    "hole": "B7900 B0 B7900 GX L1\nB7900 B0 B31600 GY NR1\nB7900 B0 B7900 GX L3\nDD",
    "opening": """B4900B0B4900GXL1
B0B2900B2900GYL2
B9800B0B9800GXL3
B0B5800B5800GYL4
B9800B0B9800GXL1
B0B2900B2900GYL2
B4900B0B4900GXL3
DD""",
}
"""Right programs of the drawings of lessons."""


@functools.cache
def ready(name: str) -> ReadyLesson:
    return lesson_of(LESSONS / name / "lesson.toml")


@functools.cache
def page(name: str) -> str:
    return lesson_page(ready(name))


def hand_in_of(lesson: ReadyLesson, name: str, skill: float, group: str = "1 班") -> dict[str, Any]:
    """What a pupil hands in who answers right with a chance of `skill`; its points are to be filled in."""
    marking, chance = marking_of(lesson), Random(name)
    seed = marking.seed_of(f"{name} {group}")
    answers = [
        [
            _attempts(right_answer(lesson, at, task, seed_of_task(seed, at)), chance, skill)
            for task in range(rules.tasks)
        ]
        for at, rules in enumerate(marking.rules)
    ]
    seconds = [chance.randint(30, 600) for _ in answers]
    entry = {"schema": SCHEMA, "lesson": lesson_entry(lesson)["lesson"], "name": name, "group": group, "seed": seed}
    return {**entry, "answers": answers, "points": [0.0] * len(answers), "seconds": seconds}


def _attempts(right: str, chance: Random, skill: float) -> list[str]:
    if chance.random() < 0.05:
        return []
    attempts: list[str] = []
    for _ in range(2):
        is_right = chance.random() < skill
        attempts.append(right if is_right else _damaged(right, chance))
        if is_right:
            break
    return attempts


def right_answer(lesson: ReadyLesson, at: int, task: int, seed: int) -> str:
    """A right answer to a task; `seed` is that of its exercise."""
    rules = lesson.exercises[at].rules
    if rules.kind == "program":
        drawing = lesson.exercises[at].exercise.drawing.stem  # type: ignore[union-attr]
        return PROGRAMS.get(drawing, PROGRAMS["hole"])
    if rules.kind == "fault":
        return f"{rules.faults[task].lines[0]} {rules.faults[task].group}"
    if rules.kind == "predict" and rules.ask in {"falls", "time"}:
        return f"{rules.question.right[0]:.2f}"
    shape, own = shape_at(rules.shapes, task), seed_of_task(seed, task)
    if rules.kind == "block":
        return written(task_of(shape, own))
    if rules.ask == "end":
        return ", ".join(f"{value:g}" for value in end_question(task_of(shape, own)).right)
    return str(step_question(shape, own).right)


def _damaged(text: str, chance: Random) -> str:
    """An answer with a slip: a letter that is another one, is missing or stands twice."""
    at = chance.randrange(len(text))
    letter = chance.choice((chance.choice("0123456789XYBGLNSR \n;D.-"), "", text[at] * 2))
    return text[:at] + letter + text[at + 1 :]


def text_of(hand_in: dict[str, Any]) -> bytes:
    return json.dumps(hand_in, ensure_ascii=False).encode()


@functools.cache
def marked_class(pupils: int) -> ClassResult:
    """A class that did the first lesson: one of them changed his marks, and two are wrong in the same letters."""
    lesson = ready("1-first-blocks")
    with tempfile.TemporaryDirectory() as folder:
        for number in range(pupils):
            hand_in = hand_in_of(lesson, f"学生{number}", 0.3 + 0.05 * (number % 12))
            if number in {1, 2}:
                hand_in["answers"][2] = [["1, 2"], ["3, 4"], ["5, 6"]]
            (Path(folder) / f"{number:03}.drycut.json").write_bytes(text_of(hand_in))
        (Path(folder) / "damaged.drycut.json").write_text("{", "utf-8")
        return class_result(lesson, Path(folder))
