"""Model of ``drycut.index/1`` (docs/batch.md)."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    Code,
    Count,
    Document,
    Judgement,
    Law,
    Ordinal,
    SeverityName,
    Size,
    Text,
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


class IndexRowEntry(TypedDict):
    """A program, and what came of it."""

    file: Text
    title: str
    title_zh: str | None
    verdict: Annotated[str, one_of("pass", "fail", "refused", "fault")]
    to_check: bool
    message: str | None
    findings: list[FindingCountEntry]
    time_s: Size | None
    max_um: Size | None
    drawing_um: Size | None
    folder: Text | None
    from_cache: bool


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
            {"message": Text, "time_s": None, "max_um": None, "folder": None, "from_cache": Literal[False]},
        ),
    ),
)
