"""A program made of a drawing, on the terminal: its figures, or why there is none."""

from collections.abc import Iterator
from pathlib import Path

from parser.findings.catalogue import Language
from parser.text.encoding import printable
from sim.cam.maker import NotMade
from sim.show.terminal.wrap import wrapped
from sim.show.words import Words
from sim.show.words.words import said

_INDENT = "    "


def made_lines(out: Path, language: Language, width: int) -> Iterator[str]:
    """What was written, in lines of `width` cells."""
    yield from wrapped(Words(language)("program.written", out=printable(str(out))), width, "", _INDENT)


def not_made_lines(refused: NotMade, name: str, language: Language, width: int) -> Iterator[str]:
    """Why nothing was written, in lines of `width` cells."""
    why = said(f"program.refused-{refused.refusal.why}")
    yield from wrapped(Words(language)("program.not-written", name=printable(name), why=why), width, "", _INDENT)
