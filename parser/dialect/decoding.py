"""A block as its controller decodes it: its words in order, each with the field that it sets, and the fields set.

The fields are those of the buffer that a CNC course puts between decoding and compensation (docs/iso.md §8).
"""

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from parser.text.source import Span

UNREAD = "unread"
"""In place of a field: what stands there is no word, and the motion of its block is not known."""


class DecodeStep(NamedTuple):
    """One word decoded.

    Attributes
    ----------
    order
        From 1, in the order of the words.
    word
        As written; empty for a line's end that closes a block without a sign of its own.
    column
        Of its first character in its line, from 1.
    field
        The field that it sets, such as ``COOR[1]``, ``G0.D5`` or ``F``; a register, such as ``H1``. Of what sets none,
        the name of its form, such as ``function``, or `UNREAD`.
    value
        What the field becomes; lengths in µm. None for a register that is set to a sum of others, and for what sets no
        field.
    """

    order: int
    word: str
    column: int
    field: str
    value: float | None


class InForce(NamedTuple):
    """What holds while a block runs, given by itself or by one before it.

    Attributes
    ----------
    motion, distance, side
        As words: ``G01``, ``G90``, ``G41``; the motion is empty before the first one, the side ``G40`` without one.
    register, offset_um
        Register of the offset without leading zeros, such as ``D1``, and its value; empty before the first one, and
        None where it is not known.
    f
        Feed as written; None before the first one.
    """

    motion: str
    distance: str
    side: str
    register: str
    offset_um: float | None
    f: float | None


class DecodedBlock(NamedTuple):
    """The buffer of one block once it is read: what the block gives itself, and nothing that it takes over.

    Attributes
    ----------
    line, span
        Its line from 1, and its place in the text.
    number, number_bcd
        Behind N, plain and in binary-coded decimal: 12 and 0x12; None where there is none.
    coor_um
        Dimension words by their letters, µm.
    f, s, t, d, h
        Numbers behind these letters, as written; None where there are none.
    g0
        G words as flags: bit 0 G00, 1 G01, 2 G02, 3 G03, 4 G06, 5 G91, bits 7 and 6 01 G41 and 10 G42.
    g, m
        Numbers of all its G words and of its M words, in order.
    others
        All other words by their letters.
    steps
        In order; the last one closes the block.
    in_force
        As the block runs for the first time; None where it never runs.
    """

    line: int
    span: Span
    number: int | None
    number_bcd: int | None
    coor_um: Mapping[str, float]
    f: float | None
    s: float | None
    t: float | None
    d: float | None
    h: float | None
    g0: int
    g: tuple[float, ...]
    m: tuple[float, ...]
    others: Mapping[str, float]
    steps: tuple[DecodeStep, ...]
    in_force: InForce | None


class Decoder(Protocol):
    """Decodes the blocks of a program that was read, when somebody asks to see it."""

    def blocks(self) -> tuple[DecodedBlock, ...]:
        """All blocks, in file order."""
