"""The quiz of a scenario: questions that the replay asks before blocks."""

from collections.abc import Iterable, Mapping
from typing import Any, Literal, NamedTuple, cast, get_args

import numpy as np

from parser.findings.errors import SettingsError
from parser.text.encoding import printable
from parser.toolpath import Toolpath
from sim.setup.toml.reader import Bound, number, refuse_unknown, text

About = Literal["quadrant", "count_axis", "turn", "count_length", "next_step", "end"]
"""What drycut asks about a block and answers from the program."""

_OF_WORDS: tuple[About, ...] = ("quadrant", "count_axis", "turn", "count_length", "next_step")
"""What is asked in the words by which a controller counts steps."""

BLOCK = Bound(1, 1e6)
ANSWERS = Bound(2, 6)
_FREE = ("ask", "ask_zh", "answers", "answers_zh", "right", "why", "why_zh")


class Said(NamedTuple):
    """A text in both languages."""

    en: str
    zh: str


class Written(NamedTuple):
    """A question written out: what is asked, the answers, which of them is right, from 0, and why."""

    ask: Said
    answers: tuple[Said, ...]
    right: int
    why: Said


class Question(NamedTuple):
    """A question before a block of the program, from 1.

    Attributes
    ----------
    block
        Its number.
    what
        What is asked about, or the question as it is written.
    where
        File and place of it, for complaints.
    """

    block: int
    what: About | Written
    where: str


def read_quiz(scenario: Mapping[str, Any], where: str) -> tuple[Question, ...]:
    """Tables ``[[quiz]]`` of a scenario, none where they are left out. SettingsError names file, question and key."""
    tables = scenario.get("quiz", [])
    if not isinstance(tables, list) or not all(isinstance(table, Mapping) for table in tables):
        raise SettingsError(f"{where}: quiz are tables, [[quiz]]; found {tables!r}")
    return tuple(_question(table, f"{where}: [[quiz]] {at}") for at, table in enumerate(tables, start=1))


def refuse_unanswerable(questions: Iterable[Question], toolpath: Toolpath) -> None:
    """SettingsError for the first question about a block that a program does not have, or that has no answer there."""
    for question in questions:
        rows = np.flatnonzero(toolpath.source.block == question.block)
        if not len(rows):
            last = int(toolpath.source.block[-1])
            raise SettingsError(f"{question.where}: block {question.block} is not in the program, which ends at {last}")
        row = int(rows[0])
        if question.what in _OF_WORDS and toolpath.words is None:
            raise SettingsError(f"{question.where}: the program has no words to ask about, but places alone (end)")
        if question.what == "turn" and not toolpath.is_arc[row]:
            raise SettingsError(f"{question.where}: block {question.block} is a line, and does not turn")
        if not isinstance(question.what, Written) and not toolpath.length_um[row] > 0.0:
            raise SettingsError(f"{question.where}: block {question.block} has no length, and nothing to ask about")


def _question(table: Mapping[str, Any], where: str) -> Question:
    refuse_unknown(table, ("block", "about", *_FREE), where)
    if "block" not in table:
        raise SettingsError(f"{where}: block is missing")
    block = _whole(table["block"], BLOCK, f"{where}: block")
    if "about" in table:
        return Question(block, _about(table, where), where)
    return Question(block, _written(table, where), where)


def _about(table: Mapping[str, Any], where: str) -> About:
    given = next((key for key in _FREE if key in table), None)
    if given:
        raise SettingsError(f"{where}: about asks a question of its own and takes no {given}")
    about, known = text(table, "about", where), get_args(About)
    if about not in known:
        raise SettingsError(f"{where}: about is one of {', '.join(known)}; found {about!r}")
    return cast("About", about)


def _written(table: Mapping[str, Any], where: str) -> Written:
    answers = _answers(table, "answers", where)
    chinese = _answers(table, "answers_zh", where) if "answers_zh" in table else answers
    if len(answers) != len(chinese):
        raise SettingsError(f"{where}: there are {len(answers)} answers and {len(chinese)} answers_zh")
    if "right" not in table:
        raise SettingsError(f"{where}: right is missing")
    return Written(
        ask=_said(table, "ask", where),
        answers=tuple(Said(*pair) for pair in zip(answers, chinese, strict=True)),
        right=_whole(table["right"], Bound(1, len(answers)), f"{where}: right") - 1,
        why=_said(table, "why", where),
    )


def _said(table: Mapping[str, Any], key: str, where: str) -> Said:
    """Text of a key, and of its Chinese one, in whose place the first may stand."""
    english = printable(text(table, key, where))
    return Said(english, printable(text(table, f"{key}_zh", where, default=english)))


def _answers(table: Mapping[str, Any], key: str, where: str) -> list[str]:
    value = table.get(key)
    if not isinstance(value, list) or not all(isinstance(answer, str) and answer for answer in value):
        raise SettingsError(f"{where}: {key} is a list of texts and must be given; found {value!r}")
    number(len(value), ANSWERS, f"{where}: the number of {key}")
    if len(set(value)) < len(value):
        raise SettingsError(f"{where}: {key} holds the same text twice")
    return [printable(answer) for answer in value]


def _whole(value: object, bound: Bound, where: str) -> int:
    if isinstance(value, float):
        raise SettingsError(f"{where} is a whole number; found {value:g}")
    return int(number(value, bound, where))
