"""A mender: what a dialect knows of writing one field of a block otherwise."""

from typing import NamedTuple, Protocol

from parser.controller_words import Axis
from parser.findings.findings import Edit
from parser.text.source import Field
from parser.toolpath import Toolpath


class Mend(NamedTuple):
    """A field of a block, and what it would say, as the dialect writes it, such as ``24900`` or ``GX``."""

    field: Field
    text: str


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

    @property
    def mend(self) -> Mend:
        """What would close the contour."""
        return Mend(self.field, self.other)


class Mender(Protocol):
    """What checks ask of a dialect whose blocks may be mended, by the rows of a toolpath that its reader made."""

    def suspects(self, toolpath: Toolpath, first_row: int, past_row: int) -> tuple[Suspect, ...]:
        """The likeliest blocks that keep the contour from `first_row` up to but without `past_row` open, best first."""

    def one_slips(self, toolpath: Toolpath, first_row: int, past_row: int, most: int) -> tuple[Suspect, ...]:
        """At most so many slips of one word with which the contour ends where it was to end, likeliest first."""

    def printed_mends(self, toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
        """The likeliest mends with which a row ends where it is printed to end, best first."""

    def is_misprint(self, toolpath: Toolpath, row: int) -> bool | None:
        """Whether the end printed beside a row is wrong and not its block; None where nothing tells."""

    def ends_as_printed(self, toolpath: Toolpath, row: int) -> bool:
        """Whether a row ends where it is printed to end; False where nothing is printed beside it."""

    def turned(self, toolpath: Toolpath, row: int) -> Mend:
        """The mend with which the arc in a row starts where it does and runs the other way round."""

    def label_slips(self, toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
        """Other labels than the ruled one, in which the label of a row may have one wrong sign, that obey the rule."""

    def other_labels(self, toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
        """The other labels that the arc in a row may have."""

    def counted_on(self, axis: Axis) -> Mend:
        """The mend with which a block counts on an axis."""

    def counting(self, count_um: int) -> Mend:
        """The mend with which a block counts so many µm."""

    def edit(self, toolpath: Toolpath, row: int, mend: Mend) -> Edit:
        """What a mend changes in the program's text. ValueError where the block in the row has no such field."""

    def mends_text(self, mends: tuple[Mend, ...]) -> str:
        """Mends of one block for people, so that they see which fields are meant."""
