"""Model of ``drycut.check/1`` (docs/check.md)."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    AssumptionEntry,
    BlockCountsEntry,
    CheckVerdict,
    Code,
    Count,
    DialectName,
    Document,
    Encoding,
    Ordinal,
    Point,
    SeverityName,
    Size,
    Text,
    Version,
    matching,
    of_length,
    one_of,
)


class SilencedEntry(TypedDict):
    """How many findings were silenced, by what; and checks that did not end, as the baseline has it."""

    options: Count
    settings: Count
    remarks: Count
    baseline: Count
    checks: Count


class CheckEntry(TypedDict):
    """How far a check came, and why it is not complete."""

    name: Annotated[str, matching(r"^check-[a-z-]+$")]
    title: Text
    state: Annotated[str, one_of("complete", "incomplete", "known", "not asked")]
    reason: Annotated[str, matching(r"^reason-[a-z-]+$")] | None
    reason_text: Text | None


class CoverageEntry(TypedDict):
    """How far the checks of a file came."""

    blocks: BlockCountsEntry
    checks: list[CheckEntry]


class ProgrammedEntry(TypedDict):
    """What the program asks for: curves, length and extent."""

    lines: Count
    arcs: Count
    rapids: Count
    cut_length_um: Size | None
    box_um: Annotated[list[float], of_length(4, 4)] | None
    first_um: Point | None
    last_um: Point | None


class EditEntry(TypedDict):
    """Characters of the file to be replaced, and by what."""

    first: Count
    past: Count
    text: str


class FindingEntry(TypedDict):
    """What is wrong, with places, values and how it is mended."""

    code: Code
    severity: SeverityName
    title: Text
    found: str
    expected: str
    machine: str
    hint: str
    message: Text
    line: Ordinal | None
    column: Ordinal | None
    end_column: Ordinal | None
    block: Ordinal | None
    block_name: Text | None
    values: dict[str, str | float | None]
    fixable: bool
    edits: list[EditEntry]


class FileEntry(TypedDict):
    """A file, and what was found in it."""

    name: Text
    encoding: Encoding | None
    dialect: DialectName | None
    assumptions: list[AssumptionEntry]
    verdict: CheckVerdict
    to_check: bool
    settings_file: Text | None
    silenced: SilencedEntry
    coverage: CoverageEntry
    length_um: Size | None
    steps: Count
    programmed: ProgrammedEntry | None
    findings: list[FindingEntry]


FileCountsEntry = TypedDict(
    "FileCountsEntry",
    {
        "checked": Count,
        "pass": Count,
        "fail": Count,
        "incomplete": Count,
        "to_check": Count,
    },
)


class SeverityCountsEntry(TypedDict):
    """Findings of each severity."""

    error: Count
    warning: Count
    note: Count


class TotalsEntry(TypedDict):
    """What is summed over all files."""

    files: FileCountsEntry
    findings: SeverityCountsEntry
    codes: dict[Code, Ordinal]
    fixable: Count
    silenced: SilencedEntry
    blocks: BlockCountsEntry
    length_um: Size | None
    steps: Count


class CheckDocument(TypedDict):
    """Files and what was found in them, ``drycut check --format json``."""

    schema: Literal["drycut.check/1"]
    drycut: Version
    language: Annotated[str, one_of("en", "zh")]
    files: list[FileEntry]
    totals: TotalsEntry
    verdict: CheckVerdict


CHECK: Final = Document(CheckDocument, "docs/check.md")
