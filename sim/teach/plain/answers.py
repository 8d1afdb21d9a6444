"""Answers of a sitting: attempts at each task, and the share of it that they earn. A second try counts half."""

from typing import NamedTuple

from sim.teach.plain.blocks import folded
from sim.teach.plain.marks import words_mark
from sim.teach.plain.program import Target, program_mark, program_share, written_of
from sim.teach.plain.stepping import Stepper, Way, after_steps, next_way
from sim.teach.plain.tasks import Task, chosen, next_seed, task_of

MOST_TRIES = 2
WAYS = ["+X", "-X", "+Y", "-Y"]
"""Steps to choose from."""
_MOST_STEPS = 12


class Question(NamedTuple):
    """What is asked for in numbers: those that are right, and how far each may be off."""

    right: list[float]
    within: float


class StepQuestion(NamedTuple):
    """A block that stands after some steps, and which of `WAYS` comes next, from 0."""

    task: Task
    steps: int
    stepper: Stepper
    right: int


def shape_at(shapes: list[str], task: int) -> str:
    """The shape of a task, numbered from 0: the shapes take turns."""
    return shapes[task % len(shapes)]


def step_question(shape: str, seed: int) -> StepQuestion:
    """A question for the next step, by a seed."""
    task = task_of(shape, seed)
    steps = chosen(next_seed(next_seed(seed)), 1, _MOST_STEPS)
    stepper = after_steps(task.block, steps)
    way = next_way(task.block, stepper)
    return StepQuestion(task, steps, stepper, way_number(way))


def way_number(way: Way) -> int:
    """Which of `WAYS` a step is, from 0."""
    if way.x != 0:
        return 0 if way.x > 0 else 1
    return 2 if way.y > 0 else 3


def end_question(task: Task) -> Question:
    """Where the block of a task ends, in mm, to 2 µm."""
    return Question([task.end.x / 1000.0, task.end.y / 1000.0], 0.0020001)


def share_of(shares: list[float]) -> float:
    """The share that attempts earn: the best of the first one and half of the second one."""
    best = 0.0
    for number in range(min(MOST_TRIES, len(shares))):
        best = max(best, shares[number] / (number + 1))
    return best


def block_share(task: Task, attempts: list[str]) -> float:
    """Share of a block that was to be written."""
    return share_of([words_mark(task, text).share for text in attempts])


def program_attempts_share(target: Target, weights: list[float], attempts: list[str]) -> float:
    """Share of a program in 3B that was to be written."""
    shares = [program_share(program_mark(target, written_of(text, target.thread)), weights) for text in attempts]
    return share_of(shares)


def fault_share(lines: list[int], group: str, attempts: list[str]) -> float:
    """Share of a fault that was to be found; an attempt is its line and what is wrong, as ``12 axis``."""
    shares: list[float] = []
    for attempt in attempts:
        words = attempt.split(" ")
        numbers = numbers_of(words[0])
        is_line = len(numbers) == 1 and numbers[0] in lines
        is_group = len(words) == 2 and words[1] == group
        shares.append((0.5 if is_line else 0.0) + (0.5 if is_group else 0.0))
    return share_of(shares)


def question_share(question: Question, attempts: list[str]) -> float:
    """Share of a question in numbers: all or nothing."""
    shares: list[float] = []
    for attempt in attempts:
        numbers = numbers_of(attempt)
        wrong = 0
        for number in range(min(len(numbers), len(question.right))):
            wrong += 0 if abs(numbers[number] - question.right[number]) <= question.within else 1
        shares.append(1.0 if wrong == 0 and len(numbers) == len(question.right) else 0.0)
    return share_of(shares)


def numbers_of(text: str) -> list[float]:
    """Numbers of a text with blanks, commas or semicolons between them; none where one of them cannot be read."""
    numbers: list[float] = []
    for word in folded(text).replace(",", " ").replace(";", " ").split(" "):
        if len(word) > 0:
            if not _is_number(word):
                return []
            numbers.append(float(word))
    return numbers


def _is_number(word: str) -> bool:
    """Whether a word is digits with at most one point between them, and a sign before them."""
    start = 1 if word[0] in "+-" else 0
    points, digits = 0, 0
    for number in range(start, len(word)):
        points += 1 if word[number] == "." else 0
        digits += 1 if "0" <= word[number] <= "9" else 0
    return 0 < digits <= 15 and points <= 1 and digits + points + start == len(word)
