"""Marks of a class: hand-ins marked again by the rules of the lesson, whatever marks they claim.

What is wrong most often, for the next lesson; and who was wrong in the same way as somebody else.

What marking a class comes to: its marks, what is wrong most often, who is alike, and what could not be read.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from parser.findings.catalogue import Bilingual
from sim.teach.handins import HandIn
from sim.teach.lesson import Numbers
from sim.teach.plain.answers import shape_at
from sim.teach.plain.marks import words_mark
from sim.teach.plain.program import PARTS, ProgramMark, parts_of, program_mark, program_share, written_of
from sim.teach.plain.rules import Rules, task_share
from sim.teach.plain.tasks import seed_of, seed_of_task, task_of

_CLAIMED_WITHIN = 0.02
"""Points by which a page's own sum may be off for rounding."""
_ALIKE = 3
"""So many answers that are wrong in the same letters are told."""


class Slip(NamedTuple):
    """What is wrong: in which exercise, from 0, and what of it: a word, a part, a kind of fault; empty where all is."""

    exercise: int
    what: str


class PupilMark(NamedTuple):
    """Marks of a pupil.

    Attributes
    ----------
    name, group
        As handed in.
    seed
        By which the numbers of the tasks are chosen, whatever the file says.
    shares
        Of each task of each exercise, from 0 to 1.
    points
        Of each exercise.
    seconds
        Of each exercise, as the file has it.
    slips
        What is wrong in the best attempts.
    is_changed
        Whether the file claims other points than its answers earn.
    is_of_other
        Whether its numbers are those of another name or class.
    """

    name: str
    group: str
    seed: int
    shares: tuple[tuple[float, ...], ...]
    points: tuple[float, ...]
    seconds: tuple[float, ...]
    slips: tuple[Slip, ...]
    is_changed: bool
    is_of_other: bool

    @property
    def sum(self) -> float:
        """Of all exercises."""
        return sum(self.points)


class Alike(NamedTuple):
    """Two pupils, by their numbers from 0, and how many wrong answers they have in common, letter by letter."""

    this: int
    other: int
    answers: int


class Unread(NamedTuple):
    """A file that is no hand-in of the lesson: its name, and why, as `HandInError` has it."""

    name: str
    why: str


class ClassResult(NamedTuple):
    """A class that was marked.

    Attributes
    ----------
    title
        Of the lesson.
    exercises, points, rules
        What each exercise is called, its points, and how it is marked.
    hand_ins, marks
        Of each pupil, by class and name.
    common
        What is wrong, and of how many pupils, the commonest first.
    alike
        Pupils whose wrong answers are the same.
    unread
        Files that could not be read.
    """

    title: Bilingual
    exercises: tuple[Bilingual, ...]
    points: tuple[float, ...]
    rules: tuple[Rules, ...]
    hand_ins: tuple[HandIn, ...]
    marks: tuple[PupilMark, ...]
    common: tuple[tuple[Slip, int], ...]
    alike: tuple[Alike, ...]
    unread: tuple[Unread, ...]

    @property
    def most(self) -> float:
        """Points of the whole lesson."""
        return sum(self.points)


class Marking(NamedTuple):
    """By what a lesson is marked: its numbers, its seed, and of each exercise its points and its rules."""

    numbers: Numbers
    seed: int
    points: tuple[float, ...]
    rules: tuple[Rules, ...]

    def seed_of(self, who: str) -> int:
        """The seed of a pupil's sitting by name and class as typed, a blank between, as the page chooses it."""
        return seed_of(f"{self.seed} {who}" if self.numbers == "own" else f"{self.seed}")


def marked(marking: Marking, hand_in: HandIn) -> PupilMark:
    """A hand-in, marked by the numbers that its name and class have."""
    seed = marking.seed_of(hand_in.who)
    shares, points, slips = [], [], list[Slip]()
    for at, (rules, most) in enumerate(zip(marking.rules, marking.points, strict=True)):
        own = seed_of_task(seed, at)
        answers = hand_in.answers[at]
        shares.append(tuple(_share(rules, own, task, attempts) for task, attempts in enumerate(answers)))
        points.append(most * sum(shares[-1]) / rules.tasks)
        slips += [
            Slip(at, what) for task, attempts in enumerate(answers) for what in _slips(rules, own, task, attempts)
        ]
    claimed = np.abs(np.array(points) - np.array(hand_in.points)).max(initial=0.0) > _CLAIMED_WITHIN
    return PupilMark(
        name=hand_in.name,
        group=hand_in.group,
        seed=seed,
        shares=tuple(shares),
        points=tuple(points),
        seconds=hand_in.seconds,
        slips=tuple(slips),
        is_changed=bool(claimed),
        is_of_other=hand_in.seed != seed,
    )


def _share(rules: Rules, seed: int, task: int, attempts: tuple[str, ...]) -> float:
    """Share of a task. Programs are marked once for all who wrote the same."""
    if rules.kind != "program":
        return task_share(rules, seed, task, list(attempts))
    marks = [_program_mark(_Target(rules), text) for text in attempts]
    shares = [program_share(mark, rules.weights) for mark in marks]
    return max((share / number for number, share in enumerate(shares, 1)), default=0.0)


class _Target:
    """Rules of a program, as a key of marks that were worked out."""

    def __init__(self, rules: Rules) -> None:
        self.target = rules.target

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Target) and self.target is other.target

    def __hash__(self) -> int:
        return id(self.target)


@lru_cache(maxsize=4096)
def _program_mark(of: _Target, text: str) -> ProgramMark:
    return program_mark(of.target, written_of(text, of.target.thread))


def _slips(rules: Rules, seed: int, task: int, attempts: tuple[str, ...]) -> Iterator[str]:
    """What is wrong in the last attempt at a task; one that was not tried has none."""
    if not attempts:
        return
    last = attempts[-1]
    if rules.kind == "block":
        mark = words_mark(task_of(shape_at(rules.shapes, task), seed_of_task(seed, task)), last)
        rights = {"x": mark.x, "y": mark.y, "count": mark.count_length, "axis": mark.axis, "sense": mark.sense}
        yield from (word for word, is_right in rights.items() if not is_right)
    elif rules.kind == "program":
        parts = parts_of(_program_mark(_Target(rules), last))
        yield from (part for part, is_right in zip(PARTS, parts, strict=True) if is_right == 0)
    elif task_share(rules, seed, task, [last]) < 1.0:
        yield rules.faults[task].group if rules.kind == "fault" else rules.ask


def commonest(marks: Sequence[PupilMark]) -> list[tuple[Slip, int]]:
    """What is wrong, by how many pupils, the commonest first."""
    counts = Counter(slip for mark in marks for slip in set(mark.slips))
    return sorted(counts.items(), key=lambda item: (-item[1], item[0]))


def alike(marking: Marking, hand_ins: Sequence[HandIn], marks: Sequence[PupilMark]) -> list[Alike]:
    """Pupils with at least three answers that are wrong in the same letters, most of these first.

    Right answers may be the same. Of two who were asked by the same numbers, or for the same program, it counts what
    both answered wrongly and in the same letters; an answer that more than a tenth of a class has in common is a
    common slip, and counts for nothing. `marks` are those of the hand-ins, in the same order.
    """
    wrong: dict[tuple[int, int, str], list[int]] = defaultdict(list)
    for pupil, (hand_in, mark) in enumerate(zip(hand_ins, marks, strict=True)):
        for at, task, text in _wrong(marking, hand_in, mark):
            wrong[at, task, text].append(pupil)
    most = max(2, len(hand_ins) // 10)
    pairs: Counter[tuple[int, int]] = Counter()
    for pupils in wrong.values():
        if 1 < len(set(pupils)) <= most:
            pairs.update(combinations(sorted(set(pupils)), 2))
    found = [Alike(*pair, count) for pair, count in pairs.items() if count >= _ALIKE]
    return sorted(found, key=lambda pair: (-pair.answers, pair.this, pair.other))


def _is_typed(rules: Rules) -> bool:
    """Whether answers are typed: of a few to choose from, many people choose the same wrong one."""
    return rules.kind in {"block", "program"} or rules.ask in {"end", "time"}


def _wrong(marking: Marking, hand_in: HandIn, mark: PupilMark) -> Iterator[tuple[int, int, str]]:
    """Attempts that are wrong: exercise and task, from 0, and the attempt without blanks.

    What a task with one attempt earned stands in its mark: a program from a folder may be of any dialect.
    """
    for at, (rules, answers) in enumerate(zip(marking.rules, hand_in.answers, strict=True)):
        own = seed_of_task(mark.seed, at)
        if not _is_typed(rules):
            continue
        for task, attempts in enumerate(answers):
            for text in dict.fromkeys(attempts):
                earned = mark.shares[at][task] if len(attempts) == 1 else _share(rules, own, task, (text,))
                if earned < 1.0:
                    yield at, task, "".join(text.split())
