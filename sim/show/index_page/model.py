"""Models of the index of a shop: ``drycut.index/1`` (docs/batch.md), and what its page is handed."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    Code,
    Count,
    Document,
    Judgement,
    Law,
    Ordinal,
    SaidEntry,
    SeverityName,
    Size,
    Text,
    of_length,
    one_of,
)

CountsEntry = TypedDict(
    "CountsEntry",
    {
        "programs": Count,
        "pass": Count,
        "fail": Count,
        "to_check": Count,
        "refused": Count,
        "fault": Count,
        "from_cache": Count,
        "errors": Count,
        "warnings": Count,
        "notes": Count,
    },
)


class FindingCountEntry(TypedDict):
    """How many findings a code has."""

    code: Code
    severity: SeverityName
    count: Ordinal


class _ResultEntry(TypedDict):
    """What index and page both tell of a program."""

    file: Text
    title: str
    title_zh: str | None
    to_check: bool
    findings: list[FindingCountEntry]
    time_s: Size | None
    time_least_s: Size | None
    time_most_s: Size | None
    max_um: Size | None
    drawing_um: Size | None
    folder: Text | None
    from_cache: bool


class IndexRowEntry(_ResultEntry):
    """A program, and what came of it."""

    verdict: Annotated[str, one_of("pass", "fail", "refused", "fault")]
    message: str | None


class IndexDocument(TypedDict):
    """The index of a shop's programs, ``index.json``."""

    schema: Literal["drycut.index/1"]
    drycut: Text
    counts: CountsEntry
    programs: list[IndexRowEntry]


INDEX: Final = Document(
    IndexDocument,
    "docs/batch.md",
    (
        Law(
            IndexRowEntry,
            "verdict",
            Judgement,
            {"message": None, "time_s": float, "max_um": float, "folder": str},
            {
                "message": Text,
                "time_s": None,
                "time_least_s": None,
                "time_most_s": None,
                "max_um": None,
                "folder": None,
                "from_cache": Literal[False],
            },
        ),
    ),
)

VerdictName = Annotated[str, one_of("pass", "to-check", "incomplete", "fail", "refused", "fault")]
"""Verdict of a program as people are told it; a check alone may be incomplete."""


class ProgramEntry(_ResultEntry):
    """A program as the page has it; what its run tells is null where there is none.

    `title_zh` is there where that is another one, findings have the worst first. `drawing_um` is how far the cut is off
    the drawing that it was held against, `folder` that of its files, beside the page.
    """

    verdict: VerdictName
    message: Annotated[SaidEntry | None, "why there is no report"]
    time: Annotated[str, "in hours, minutes and seconds; empty where nothing ran"]
    time_within: Annotated[str, "its least and its most, as long; empty without an interval"]
    worst_um: Annotated[float | None, "that from the drawing, else that of the wire"]
    picture: Annotated[str, "data of an SVG path"]


class IndexEntry(TypedDict):
    """All of a shop."""

    programs: list[ProgramEntry]
    titles: Annotated[dict[str, SaidEntry], "of the codes that occur"]
    box: Annotated[list[int], of_length(2, 2), "width and height of the pictures"]
