"""Findings: what is wrong with a program, as data with a stable code; `parser.findings.catalogue` has their texts."""

from collections import Counter
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from parser.findings.codes import CODES, Severity

Value = str | int | float

NO_NAMES: Mapping[int, str] = {}
"""Of blocks that people call by their numbers; no mapping proxy, which cannot go to another process."""


class Edit(NamedTuple):
    """A certain mend: the characters `first` up to but without `past` of the text become `text`."""

    first: int
    past: int
    text: str


class Fact:
    """Base of what a finding tells later checks and mends: see `parser.findings.facts`."""

    __slots__ = ()


class Finding(NamedTuple):
    """One thing that is wrong, and where.

    Attributes
    ----------
    code
        Key of `CODES`, and name of its page in the catalogue.
    values
        What fills the placeholders of the page's texts; lengths in µm.
    span
        First character and one past the last, in the text of the program; (0, 0) where no place is meant.
    line, column
        Place of the first character, counted from 1; 0 where the whole program is meant.
    block
        Block number counted from 1; 0 where no one block is meant.
    edits
        What certainly mends it, all together; empty where nothing is certain.
    fact
        What later checks and mends take from it; None where none asks.
    graver
        Severity of this one, where it is graver than that of its code.
    is_uncertain
        Whether its hint would not be enough, or another word is as likely: no word is advised then.
    names
        What the listing calls blocks that its texts may speak of, by number; others are called by their numbers.
    """

    code: str
    values: Mapping[str, Value] = MappingProxyType({})
    span: tuple[int, int] = (0, 0)
    line: int = 0
    column: int = 0
    block: int = 0
    edits: tuple[Edit, ...] = ()
    fact: Fact | None = None
    graver: Severity | None = None
    is_uncertain: bool = False
    names: Mapping[int, str] = NO_NAMES

    @property
    def severity(self) -> Severity:
        """Severity that the table gives this code, or a graver one of its own."""
        return self.graver or CODES[self.code].severity

    @property
    def spoils(self) -> bool:
        """Whether it is a warning to look at before the cut: the part is scrap where that was not meant so."""
        return self.severity is Severity.WARNING and CODES[self.code].spoils

    @property
    def block_name(self) -> str:
        """What people call its block; empty where no one block is meant."""
        return self.names.get(self.block, str(self.block)) if self.block else ""

    @property
    def place_mm(self) -> tuple[float, float] | None:
        """Place on the part, mm, that the finding itself names; None where findings of its code name none."""
        if not CODES[self.code].placed:
            return None
        return float(self.values["x_mm"]), float(self.values["y_mm"])

    def with_fact(self, fact: Fact) -> "Finding":
        """The finding with a fact for later checks and mends."""
        return self._replace(fact=fact)


class Count(NamedTuple):
    """How many findings there are of a code; those that are graver than their code are counted by themselves."""

    code: str
    severity: Severity
    n: int

    @property
    def text(self) -> str:
        """The code, and how many there are of it where it is more than one: ``3B305 ×4``."""
        return self.code if self.n == 1 else f"{self.code} ×{self.n}"


def counted(findings: Iterable[Finding]) -> tuple[Count, ...]:
    """How many findings there are of each code, the worst severity first, then by code."""
    counts = Counter((finding.severity, finding.code) for finding in findings)
    worst_first = tuple(Severity)
    of_each = (Count(code, severity, n) for (severity, code), n in counts.items())
    return tuple(sorted(of_each, key=lambda each: (worst_first.index(each.severity), each.code)))


def compatible(edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """Edits in the order of their places; of two that touch the same characters the first counts."""
    chosen: list[Edit] = []
    for edit in sorted(set(edits)):
        if not chosen or edit.first >= chosen[-1].past:
            chosen.append(edit)
    return tuple(chosen)


def edited(text: str, edits: Iterable[Edit]) -> str:
    """Text with its `compatible` edits made."""
    parts, at = [], 0
    for edit in compatible(edits):
        parts += [text[at : edit.first], edit.text]
        at = edit.past
    return "".join([*parts, text[at:]])


def file_order(finding: Finding) -> tuple[int, int, int, str]:
    """Sort key: by place in the file, then by block and code."""
    return finding.line, finding.column, finding.block, finding.code
