"""What people call the blocks of a program: by the labels of its listing where it has some, else by their numbers."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from parser.findings.findings import Finding
from parser.geometry.curves import Ints

_LONGEST: Final = 8
"""Characters of a label; a longer one has no room in tables and pictures, and its block is called by its number."""


class BlockNames:
    """Names of the blocks of a program.

    A block is called by its label, ``N18``. Where several blocks bear one label, the number of the block stands behind
    it: ``N3 (17)``. A block without a label is called by its number in the program, from 1: ``14``.

    Parameters
    ----------
    block
        (n,) int64, number of the block of each row; of a program that a controller adds rows to, several rows have one.
    label
        n labels as printed; empty where there is none.
    """

    def __init__(self, block: Ints, label: Sequence[str]) -> None:
        rows = zip(block.tolist(), label, strict=True) if any(label) else ()
        self._block = block
        self._label = {number: one for number, one in rows if one and len(one) <= _LONGEST}
        bearers = Counter(self._label.values())
        self._other: Mapping[int, str] = {
            number: one if bearers[one] == 1 else f"{one} ({number})" for number, one in self._label.items()
        }

    def __call__(self, number: int) -> str:
        """Name of the block of a number."""
        return self._other.get(number, str(number))

    def of_row(self, row: int) -> str:
        """Name of the block of a row, from 0. IndexError beyond the last row."""
        return self(int(self._block[row]))

    def at(self, place: int) -> str:
        """Name of the block in a place of the path, from 1, as reports count: rows that a controller adds count too."""
        return self.of_row(place - 1)

    def of_rows(self) -> list[str]:
        """Names of the blocks of all rows."""
        return [self(number) for number in self._block.tolist()]

    def label(self, row: int) -> str:
        """Label of the block of a row, where its number stands beside it; empty where there is none."""
        return self._label.get(int(self._block[row]), "")

    def named(self, findings: Iterable[Finding]) -> tuple[Finding, ...]:
        """Findings of the program, each with what the blocks are called that its texts may speak of."""
        return tuple(finding._replace(names=self._names_in(finding)) for finding in findings)

    @property
    def other(self) -> Mapping[int, str]:
        """Names of the blocks, by number, that are called otherwise than by their numbers."""
        return self._other

    def _names_in(self, finding: Finding) -> dict[int, str]:
        numbers = (finding.block, *finding.values.values())
        return {number: self._other[number] for number in numbers if isinstance(number, int) and number in self._other}
