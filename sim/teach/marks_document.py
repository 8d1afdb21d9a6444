"""Model of ``drycut.marks/1`` (docs/class.md), and a marked class as such a document."""

import json
from typing import Final, Literal, TypedDict

from parser import __version__
from parser.documents import Count, Document, Ordinal, SaidEntry, Size, Text, Version
from sim.teach.marking import ClassResult

_DIGITS: Final = 3


class SlipEntry(TypedDict):
    """What is wrong in an exercise: a word of a block, a part of a program, a kind of fault, what was asked."""

    exercise: Ordinal
    what: Text


class PupilEntry(TypedDict):
    """Marks of a pupil, and what is to be known of the hand-in."""

    name: Text
    group: str
    points: list[Size]
    sum: Size
    seconds: list[Size]
    changed: bool
    of_other: bool
    slips: list[SlipEntry]


class CommonEntry(TypedDict):
    """What is wrong, and of how many pupils."""

    exercise: Ordinal
    what: Text
    pupils: Ordinal


class AlikeEntry(TypedDict):
    """Two pupils, by their numbers in `pupils` from 1, and how many wrong answers they have in common."""

    this: Ordinal
    other: Ordinal
    answers: Count


class UnreadEntry(TypedDict):
    """A file that was not marked, and why."""

    file: str
    why: Text


class MarksDocument(TypedDict):
    """A marked class, ``drycut class mark --json``."""

    schema: Literal["drycut.marks/1"]
    drycut: Version
    lesson: SaidEntry
    points: list[Size]
    pupils: list[PupilEntry]
    common: list[CommonEntry]
    alike: list[AlikeEntry]
    unread: list[UnreadEntry]


MARKS: Final = Document(MarksDocument, "docs/class.md")


def marks_document(result: ClassResult) -> MarksDocument:
    """A marked class as a document."""
    return {
        "schema": "drycut.marks/1",
        "drycut": __version__,
        "lesson": {"en": result.title.en, "zh": result.title.zh},
        "points": list(result.points),
        "pupils": [
            {
                "name": mark.name,
                "group": mark.group,
                "points": [round(each, _DIGITS) for each in mark.points],
                "sum": round(mark.sum, _DIGITS),
                "seconds": list(mark.seconds),
                "changed": mark.is_changed,
                "of_other": mark.is_of_other,
                "slips": [{"exercise": slip.exercise + 1, "what": slip.what} for slip in mark.slips],
            }
            for mark in result.marks
        ],
        "common": [
            {"exercise": slip.exercise + 1, "what": slip.what, "pupils": count} for slip, count in result.common
        ],
        "alike": [{"this": pair.this + 1, "other": pair.other + 1, "answers": pair.answers} for pair in result.alike],
        "unread": [{"file": each.name, "why": each.why} for each in result.unread],
    }


def marks_text(result: ClassResult) -> str:
    """The document as a file has it."""
    return json.dumps(marks_document(result), ensure_ascii=False, indent=2) + "\n"
