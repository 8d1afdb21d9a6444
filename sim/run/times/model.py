"""Model of ``drycut.time/1`` (docs/time.md)."""

from typing import Annotated, Literal, TypedDict

from parser.documents import Count, Document, Ordinal, Positive, Size, Text, Version, between, of_length, one_of


class MinutesEntry(TypedDict):
    """A time with its interval; `level` says how sure it is."""

    least: Size
    middle: Size
    most: Size
    level: Annotated[float, between(0, 1)]


class TermEntry(TypedDict):
    """A part of the middle; what is learned from a shop's cuts may be below 0."""

    name: Annotated[str, one_of("cut", "jumps", "threading", "pierce", "corners", "reversals", "breaks", "learned")]
    minutes: float
    grade: Annotated[str, one_of("measured", "set", "assumed")]
    times: Count | None


class CostItemEntry(TypedDict):
    """A part of a cost, to the cent."""

    name: Annotated[str, one_of("hours", "wire", "power", "set-up")]
    amount: Size


class CostEntry(TypedDict):
    """What the middle costs, and the sums of the least and the most."""

    currency: Text
    items: list[CostItemEntry]
    total: Size
    least: Size
    most: Size


class EstimateEntry(TypedDict):
    """How long it takes, of what that is made, and what it costs."""

    minutes: MinutesEntry
    from_cuts: Count
    terms: list[TermEntry]
    cost: CostEntry | None
    notes: list[Text]


class ProgramTimeEntry(EstimateEntry):
    """One program."""

    program: Text
    length_mm: Size
    height_mm: Positive
    passes: Ordinal


class LogEntry(TypedDict):
    """The log of the shop's own cuts: how many rows were taken and how many are not cut yet, heights and passes."""

    file: Text
    cuts: Count
    not_cut: Count
    heights_mm: Annotated[list[float], of_length(2, 2)] | None
    passes: list[Ordinal]


class TimeDocument(EstimateEntry):
    """All programs together, and one by one."""

    schema: Literal["drycut.time/1"]
    drycut: Version
    programs: Annotated[list[ProgramTimeEntry], of_length(1)]
    log: LogEntry | None


TIME = Document(TimeDocument, "docs/time.md")
