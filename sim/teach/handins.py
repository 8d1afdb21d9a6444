"""Hand-ins: the files that pupils hand in, read as if each were made to do harm."""

import json
from typing import Annotated, Any, Final, Literal, NamedTuple, TypedDict, get_args

from parser.documents import Document, Size, Text, between, matching
from parser.text.encoding import printable
from sim.teach.plain.answers import MOST_TRIES
from sim.teach.plain.blocks import MOST_CHARACTERS

_Schema = Literal["drycut.hand-in/1"]
SCHEMA: Final = get_args(_Schema)[0]
"""Of hand-ins; another one cannot be read."""
SUFFIX = ".drycut.json"
MOST_BYTES = 4_000_000
_MOST_NAME = 40
_MOST_SECONDS = 1e6


class HandInDocument(TypedDict):
    """What a pupil hands in, ``NAME.drycut.json``, as the page of a lesson writes it."""

    schema: _Schema
    lesson: Annotated[str, matching("^[0-9a-f]{16}$")]
    name: Text
    group: Text
    seed: Annotated[int, between(1, 2**31 - 2)]
    answers: list[list[list[str]]]
    points: list[Size]
    seconds: list[Size]


HAND_IN: Final = Document(HandInDocument, "docs/class.md")


class HandInError(Exception):
    """A file that is no hand-in of this lesson.

    Attributes
    ----------
    why
        ``too-long``, ``no-json``, ``no-hand-in``, ``schema``, ``other-lesson`` or ``no-name``.
    """

    def __init__(self, why: str) -> None:
        super().__init__(why)
        self.why = why


class HandIn(NamedTuple):
    """What a pupil handed in.

    Attributes
    ----------
    name, group
        Of the pupil, and of the class, for people to read.
    who
        Both as they were typed: the page chooses its numbers by these letters, of which some may not be printable.
    seed
        By which the numbers of the tasks were chosen, as the file has it.
    answers
        Attempts at each task of each exercise, two at the most.
    points
        What the page gave for each exercise, as the file has it.
    seconds
        How long each exercise took, as the file has it.
    """

    name: str
    group: str
    who: str
    seed: int
    answers: tuple[tuple[tuple[str, ...], ...], ...]
    points: tuple[float, ...]
    seconds: tuple[float, ...]


def read_hand_in(data: bytes, lesson: str, tasks: tuple[int, ...]) -> HandIn:
    """A hand-in of a lesson, by its digest and how many tasks each exercise has. HandInError for anything else."""
    if len(data) > MOST_BYTES:
        raise HandInError("too-long")
    try:
        content = json.loads(data.decode("utf-8-sig"), parse_constant=_refused)
    except (ValueError, RecursionError):
        raise HandInError("no-json") from None
    if not isinstance(content, dict):
        raise HandInError("no-hand-in")
    if content.get("schema") != SCHEMA:
        raise HandInError("schema")
    if content.get("lesson") != lesson:
        raise HandInError("other-lesson")
    seed = content.get("seed")
    if not isinstance(seed, int) or isinstance(seed, bool):
        raise HandInError("no-hand-in")
    name, group = content.get("name"), content.get("group")
    return HandIn(
        name=_name(name),
        group=_name(group),
        who=f"{name} {group}",
        seed=seed,
        answers=_answers(content.get("answers"), tasks),
        points=_numbers(content.get("points"), len(tasks), _MOST_SECONDS),
        seconds=_numbers(content.get("seconds"), len(tasks), _MOST_SECONDS),
    )


def _refused(_: str) -> float:
    raise HandInError("no-json")


def _name(value: Any) -> str:
    name = printable(value).strip() if isinstance(value, str) else ""
    if not 0 < len(name) <= _MOST_NAME:
        raise HandInError("no-name")
    return name


def _answers(value: Any, tasks: tuple[int, ...]) -> tuple[tuple[tuple[str, ...], ...], ...]:
    rows = _list(value, len(tasks))
    return tuple(
        tuple(_attempts(attempts) for attempts in _list(row, count)) for row, count in zip(rows, tasks, strict=True)
    )


def _attempts(value: Any) -> tuple[str, ...]:
    if not isinstance(value, list) or len(value) > MOST_TRIES:
        raise HandInError("no-hand-in")
    if not all(isinstance(text, str) and len(text) <= MOST_CHARACTERS for text in value):
        raise HandInError("no-hand-in")
    return tuple(value)


def _numbers(value: Any, count: int, most: float) -> tuple[float, ...]:
    numbers = _list(value, count)
    if not all(isinstance(each, int | float) and not isinstance(each, bool) and 0 <= each <= most for each in numbers):
        raise HandInError("no-hand-in")
    return tuple(float(each) for each in numbers)


def _list(value: Any, count: int) -> list[Any]:
    if not isinstance(value, list) or len(value) != count:
        raise HandInError("no-hand-in")
    return value
