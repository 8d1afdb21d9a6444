"""The quiz of a scenario: questions that the replay asks before blocks."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, NamedTuple, get_args

import numpy as np

from parser.findings.catalogue import Bilingual
from parser.findings.errors import Message, SettingsError
from parser.text.encoding import printable
from parser.toolpath import Toolpath
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Name, OneOf, ValueKind, Whole
from sim.setup.toml.reader import Bound, number, refuse_unknown, tables

About = Literal["quadrant", "count_axis", "turn", "count_length", "next_step", "end"]
"""What drycut asks about a block and answers from the program."""

_OF_WORDS: tuple[About, ...] = ("quadrant", "count_axis", "count_length", "next_step")
"""What is asked in the words by which a controller counts steps."""

BLOCK = Bound(1, 1e6)
ANSWERS = Bound(2, 6)


class WrittenQuestion(NamedTuple):
    """A question written out: what is asked, the answers, which of them is right, from 0, and why."""

    ask: Bilingual
    answers: tuple[Bilingual, ...]
    right: int
    why: Bilingual


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
    what: About | WrittenQuestion
    where: str


class _Answers(ValueKind):
    """Answers to choose from."""

    name = "answers"
    bound = ANSWERS

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> list[str]:
        """The answers."""
        value = table.get(key)
        if not isinstance(value, list) or not all(isinstance(answer, str) and answer for answer in value):
            raise SettingsError("no-list-of-texts", where=where, key=key, found=value)
        number(len(value), ANSWERS, Message("name-number", where=where, key=key))
        if len(set(value)) < len(value):
            raise SettingsError("same-text-twice", where=where, key=key)
        return value

    def inside(self, value: Any) -> list[str]:
        """Without control characters."""
        return [printable(answer) for answer in value]

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        length = {"minItems": int(ANSWERS.low), "maxItems": int(ANSWERS.high)}
        return {"type": "array", "uniqueItems": True, **length, "items": {"type": "string", "minLength": 1}}


def _of_written(get: Callable[[WrittenQuestion], Any]) -> Callable[[Question], Any]:
    """How something of a question that is written out is found; the others have none of it."""
    return lambda question: get(question.what) if isinstance(question.what, WrittenQuestion) else None


_BLOCK = Key("block", Whole(BLOCK))
_ABOUT = Key(
    "about",
    OneOf(get_args(About)),
    default=None,
    get=lambda question: None if isinstance(question.what, WrittenQuestion) else question.what,
)
_RIGHT = Key("right", Whole(Bound(1, ANSWERS.high)), get=_of_written(lambda written: written.right + 1))
_ANSWERS, _ANSWERS_ZH = (
    Key("answers", _Answers(), get=_of_written(lambda written: [answer.en for answer in written.answers])),
    Key("answers_zh", _Answers(), default=None, get=_of_written(lambda written: [a.zh for a in written.answers])),
)
_ASK, _ASK_ZH, _WHY, _WHY_ZH = (
    Key("ask", Name(), get=_of_written(lambda written: written.ask.en)),
    Key("ask_zh", Name(), default=None, get=_of_written(lambda written: written.ask.zh)),
    Key("why", Name(), get=_of_written(lambda written: written.why.en)),
    Key("why_zh", Name(), default=None, get=_of_written(lambda written: written.why.zh)),
)
_FREE = (_ASK, _ASK_ZH, _ANSWERS, _ANSWERS_ZH, _RIGHT, _WHY, _WHY_ZH)
QUIZ = Section("quiz", (_BLOCK, _ABOUT, *_FREE), fills="quiz", form="list")


def read_quiz(scenario: Mapping[str, Any], where: str) -> tuple[Question, ...]:
    """Tables ``[[quiz]]`` of a scenario, none where they are left out. SettingsError names file, question and key."""
    return tuple(
        _question(table, f"{where}: {QUIZ.header} {at}") for at, table in enumerate(tables(scenario, "quiz", where), 1)
    )


def _question(table: Mapping[str, Any], where: str) -> Question:
    refuse_unknown(table, (key.name for key in QUIZ.keys), where)
    block = _BLOCK.read(table, where)
    if _ABOUT.name not in table:
        return Question(block, _written(table, where), where)
    given = next((key.name for key in _FREE if key.name in table), None)
    if given:
        raise SettingsError("about-takes-no-key", where=where, given=given)
    return Question(block, _ABOUT.read(table, where), where)


def _written(table: Mapping[str, Any], where: str) -> WrittenQuestion:
    """A question that is written out; the English text stands where the Chinese one is left out."""
    answers = _ANSWERS.read(table, where)
    chinese = _ANSWERS_ZH.read(table, where) or answers
    if len(answers) != len(chinese):
        raise SettingsError("answers-differ-in-number", where=where, answers=len(answers), chinese=len(chinese))
    ask, why = _ASK.read(table, where), _WHY.read(table, where)
    right = Whole(Bound(1, len(answers))).checked(table, _RIGHT.name, where)
    return WrittenQuestion(
        ask=Bilingual(ask, _ASK_ZH.read(table, where) or ask),
        answers=tuple(Bilingual(*pair) for pair in zip(answers, chinese, strict=True)),
        right=int(right) - 1,
        why=Bilingual(why, _WHY_ZH.read(table, where) or why),
    )


def refuse_unanswerable(questions: Iterable[Question], toolpath: Toolpath) -> None:
    """SettingsError for the first question about a block that a program does not have, or that has no answer there."""
    for question in questions:
        rows = np.flatnonzero(toolpath.source.block == question.block)
        if not len(rows):
            last = int(toolpath.source.block[-1])
            raise SettingsError("no-such-block", where=question.where, block=question.block, last=last)
        row = int(rows[0])
        if question.what in _OF_WORDS and toolpath.words is None:
            raise SettingsError("no-words-to-ask-about", where=question.where)
        if question.what == "turn" and not toolpath.is_arc[row]:
            raise SettingsError("line-does-not-turn", where=question.where, block=question.block)
        if not isinstance(question.what, WrittenQuestion) and not toolpath.length_um[row] > 0.0:
            raise SettingsError("block-without-length", where=question.where, block=question.block)
