"""A made program with remarks in its header: what speaks against one that is written all the same."""

from collections.abc import Sequence

from parser.program import load_program
from parser.text.encoding import printable
from sim.make.cam.maker import Made
from sim.make.convert.wanted import Wanted, encoded, read_with

_LONGEST = 120
"""Characters of a remark: what a controller shows in a line (assumed)."""


def remarked(done: Made, texts: Sequence[str], wanted: Wanted) -> Made:
    """The same program with remark lines behind its first line, one for each text; the same blocks are read back.

    Letters that the encoding of the program does not have become question marks.
    """
    lines = [_remark(text, is_iso=wanted.iso is not None) for text in texts]
    first, newline, rest = done.program.text.partition(wanted.newline)
    text = newline.join([first, *lines, rest])
    told = text.encode(wanted.encoding, "replace")
    program = load_program(told, done.program.name, read_with(done.draft, wanted))
    return done._replace(data=encoded(text, wanted), program=program)


def _remark(text: str, *, is_iso: bool) -> str:
    """One line: what could end a remark, or begin a header or a word to drycut in it, is taken out."""
    plain = printable(" ".join(text.split())).replace("µ", "u").replace("=", " ").replace(";", ",")
    plain = f"not proved: {plain}"[:_LONGEST]
    return "(" + plain.replace("(", "[").replace(")", "]") + ")" if is_iso else f"// {plain}"
