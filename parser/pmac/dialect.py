"""The reader of PMAC motion programs, as the door of the parser asks for it."""

import re

from parser.dialect.reader import Choices, Marks, ReadText
from parser.text.encoding import narrow

_OPENS = re.compile(r"(?i)(?:^|[\r\n])[ \t]*OPEN[ \t]+PROG[ \t]*\d")


class Pmac:
    """Motion programs of Turbo PMAC and Power PMAC (docs/pmac.md)."""

    name = "PMAC"
    suffixes = (".pmc",)
    own_marks = Marks()
    block_words = ()

    def recognises(self, text: str) -> bool:
        """Whether a text opens the buffer of a motion program."""
        return bool(_OPENS.search(narrow(text)))

    def read(self, text: str, choices: Choices) -> ReadText:
        """What a text says. ProgramError (3B100) where no motion program of it moves anything."""
        from parser.pmac.reading import read_pmac  # noqa: PLC0415 - other programs need none of it, and start sooner

        return read_pmac(text)


PMAC = Pmac()
