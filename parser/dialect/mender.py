"""A mender: what a dialect knows of writing one field of a block otherwise."""

from typing import NamedTuple, Protocol

from parser.text.source import Field
from parser.toolpath import Toolpath


class Suspect(NamedTuple):
    """A block that may be the damaged one.

    Attributes
    ----------
    row
        Of the toolpath, from 0.
    field
        The field that may be written wrong.
    written, other
        What stands there, and what would close the contour, as the dialect writes it, such as ``24900`` or ``GX``.
    """

    row: int
    field: Field
    written: str
    other: str


class PrintedMend(NamedTuple):
    """A field, and what it would say, as the dialect writes it, so that its block ends where it is printed to end."""

    field: Field
    text: str


class Mender(Protocol):
    """What checks ask of a dialect whose blocks may be mended, by the rows of a toolpath that its reader made."""

    def suspects(self, toolpath: Toolpath, first_row: int, past_row: int) -> tuple[Suspect, ...]:
        """The likeliest blocks that keep the contour from `first_row` up to but without `past_row` open, best first."""

    def printed_mends(self, toolpath: Toolpath, row: int) -> tuple[PrintedMend, ...]:
        """The likeliest mends of a block that ends elsewhere than printed, at most one a field."""

    def is_misprint(self, toolpath: Toolpath, row: int) -> bool | None:
        """Whether the end printed beside a row is wrong and not its block; None where nothing tells."""

    def ends_as_printed(self, toolpath: Toolpath, row: int) -> bool:
        """Whether a row ends where it is printed to end; False where nothing is printed beside it."""
