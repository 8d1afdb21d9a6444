"""Model of ``card`` of the report: what a program in C asked of the card (docs/libges.md)."""

from typing import Annotated, TypedDict

from parser.documents import (
    Count,
    Ordinal,
    Size,
    between,
    matching,
    of_length,
    one_of,
)


class ProgramEndEntry(TypedDict):
    """How a program for the card ended."""

    code: int | None
    signal: str | None
    is_stopped: bool


class RefusalEntry(TypedDict):
    """A refused call that the program did not look at, and what it went on with."""

    line: Ordinal
    call: str
    code: int
    then: str


class LimitStopEntry(TypedDict):
    """A motion that a limit switch ended, of which the program did not ask."""

    line: Ordinal
    t_s: Size
    axis: Annotated[int, between(1, 4)]
    limit: Annotated[str, one_of("positive", "negative")]
    then: str | None


class ShortSleepEntry(TypedDict):
    """A sleep that was over before the axes stood, and the calls that were refused for that."""

    line: Ordinal
    slept_s: Size
    needed_s: Size
    refused: Annotated[list[str], of_length(1)]


class CardEntry(TypedDict):
    """What a program asked of the card, and how it ended; times s on the card's clock."""

    ended: ProgramEndEntry
    calls: Count
    asked: Count
    time_s: Size
    went_on_s: Size | None
    places: list[Annotated[list[int], of_length(4, 4)]]
    status: Annotated[str, matching(r"^[0-9a-f]{4,8}$")]
    refused: Count
    refused_unread: list[RefusalEntry]
    ended_on_limit: list[LimitStopEntry]
    sleeps_too_short: list[ShortSleepEntry]
