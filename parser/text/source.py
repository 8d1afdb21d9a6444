"""Where the blocks of a program stand in its text, and the fields in a block, whatever the dialect."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from parser.geometry.curves import Ints
from parser.text.block_names import BlockNames

Span = tuple[int, int]
"""First character, and one past the last."""


class Field(StrEnum):
    """What a field of a block says, whatever letter it stands behind."""

    X = "x"
    Y = "y"
    COUNT = "count"
    RADIUS = "radius"
    AXIS = "axis"
    SENSE = "sense"
    SIDE = "side"
    REGISTER = "register"

    @property
    def term(self) -> str:
        """Its term of the catalogue."""
        return f"field-{self.value}"


def no_fields(text: str) -> Mapping[Field, Span]:
    """Where the fields of a block stand that nobody can point at: nowhere."""
    return {}


@dataclass(frozen=True, eq=False)
class Source:
    """Where each row stands in the program text.

    Attributes
    ----------
    text
        The whole program.
    block
        (n,) int64, number of each block in the program, from 1; rows that a controller adds bear that of the block
        they belong to.
    span
        (n, 2) int64, first character and one past the last of each block.
    line
        (n,) int64, from 1.
    label
        n labels as printed, such as ``N3``; empty where there is none.
    fields_of
        Where the fields stand in the text of a block, as its reader finds them; those that are written.
    """

    text: str
    block: Ints
    span: Ints
    line: Ints
    label: tuple[str, ...]
    fields_of: Callable[[str], Mapping[Field, Span]] = no_fields

    @cached_property
    def names(self) -> BlockNames:
        """What people call its blocks; worked out once."""
        return BlockNames(self.block, self.label)

    def picked(self, row: Ints) -> "Source":
        """The source of the rows `row`."""
        label = tuple(self.label[at] for at in row.tolist())
        return Source(self.text, self.block[row], self.span[row], self.line[row], label, self.fields_of)

    def block_text(self, row: int) -> str:
        """Text of the block in a row (from 0), as written."""
        return self.text[slice(*self.span[row].tolist())]

    def field(self, row: int, field: Field) -> Span | None:
        """Where a field of the block in a row (from 0) stands; None where the block has none of the kind."""
        within = self.fields_of(self.block_text(row)).get(field)
        first = int(self.span[row, 0])
        return within and (first + within[0], first + within[1])
