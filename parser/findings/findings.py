"""Findings: what is wrong with a program, as data with a stable code, and the facts that they hand to others.

Findings: what is wrong with a program, as data with a stable code; `parser.findings.catalogue` has their texts.

Facts: what a finding tells the checks and mends that come after it, as types.

The texts of a finding are made from its values; nothing is decided by them, nor by its code. Where a later check or a
mend depends on what a check found, that check gives its finding a fact. A fact that only one room takes stands beside
the check that gives it.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple, TypeVar

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
    """Base of what a finding tells later checks and mends: see `parser.findings.findings`."""

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
    """Edits in the order of their places; of two that touch the same characters the first counts.

    What begins a line stands behind what ends the one before it at the same place.
    """
    chosen: list[Edit] = []
    for edit in sorted(set(edits), key=lambda edit: (edit.first, edit.past, edit.text[:1] in {"\r", "\n"}, edit.text)):
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


F = TypeVar("F", bound=Fact)


def telling(findings: Iterable[Finding], kind: type[F]) -> Iterator[tuple[Finding, F]]:
    """The findings whose fact is of a kind, each with its fact."""
    for finding in findings:
        if isinstance(finding.fact, kind):
            yield finding, finding.fact


@dataclass(frozen=True, slots=True)
class DamagedBlock(Fact):
    """A block stands there that cannot be read; the path is not known around it."""


@dataclass(frozen=True, slots=True)
class ReadAs(Fact):
    """It says how the text was read where that was open: people are told so in one line, with what speaks for it."""


@dataclass(frozen=True, slots=True)
class TooLarge(Fact):
    """The program asks for more than any table can do: its path is not worked out."""


@dataclass(frozen=True, slots=True)
class NotSimulated(Fact):
    """The program asks for something that is not simulated; `otherwise` where it moves along another path by that."""

    otherwise: bool


@dataclass(frozen=True, slots=True)
class WithoutOffset(Fact):
    """The program's controller adds an offset, and the path is without it."""


@dataclass(frozen=True, slots=True)
class Leans(Fact):
    """The wire leans, and nobody says how high the work is."""


@dataclass(frozen=True, slots=True)
class Stands(Fact):
    """The block makes no step. Where its partner in another contour moves, this end of the wire stands at a corner."""


@dataclass(frozen=True, slots=True)
class OfAddedOffset(Fact):
    """It tells what the offset of the program's controller does; nothing where that adds none."""


@dataclass(frozen=True, slots=True)
class NoEnd(Fact):
    """The program ends without an end code."""


@dataclass(frozen=True, slots=True)
class WrongLabel(Fact):
    """A block on an axis bears the label of the quadrant beside it; `ruled` is what the trade writes, ``L2``.

    `others` are the other labels of which it may be a slip as well, such as ``SR3`` of ``NR3``.
    """

    ruled: str
    others: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class WrongBlock(Fact):
    """The block is wrong in a way that may be why its contour does not close: no other block is suspected then."""


@dataclass(frozen=True, slots=True)
class DoubtfulEnd(WrongBlock):
    """The block was meant to end elsewhere than it is read to: its end proves nothing, nor do its joints."""


@dataclass(frozen=True, slots=True)
class PrintedElsewhere(DoubtfulEnd):
    """The end that is printed beside the block is another."""


@dataclass(frozen=True, slots=True)
class CountedElsewhere(DoubtfulEnd):
    """The count length of a line does not fit its X and Y."""


@dataclass(frozen=True, slots=True)
class OddShape(Fact):
    """A contour runs there as no drawing has it: a wrong word may be why."""


@dataclass(frozen=True, slots=True)
class OddOrder(Fact):
    """A block may be lost, doubled or in another place: no word is suspected then."""


@dataclass(frozen=True, slots=True)
class TightCorner(Fact):
    """An arc is smaller than the wire's offset: what edge comes of it a comparison with the drawing says better."""
