"""Facts: what a finding tells the checks and mends that come after it, as types.

The texts of a finding are made from its values; nothing is decided by them, nor by its code. Where a later check or a
mend depends on what a check found, that check gives its finding a fact. A fact that only one room takes stands beside
the check that gives it.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

from parser.findings.findings import Fact, Finding

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
