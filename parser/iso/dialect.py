"""The reader of ISO, as the door of the parser asks for it."""

import re

from parser.dialect.reader import Choices, Marks, ReadText
from parser.text.encoding import narrow

# A line of words with G and a number among the first ones; B begins the numbers of 3B.
_LIKE_A_BLOCK = re.compile(r"(?im)^[ \t/]*+(?:[AC-FH-Z][ \t]*+[-+]?[\d.]++[ \t]*+)*+G[ \t]*+\d")


class Iso:
    """G-code as wire-cut machines are told it, in the dialects that have a profile (docs/iso.md)."""

    name = "ISO"
    suffixes = (".iso", ".nc", ".cnc")
    own_marks = Marks()
    block_words = ()

    def recognises(self, text: str) -> bool:
        """Whether a text holds a line with a G word, or what was meant for one."""
        return bool(_LIKE_A_BLOCK.search(narrow(text)))

    def read(self, text: str, choices: Choices) -> ReadText:
        """What a text says. ProgramError (ISO100) where it holds no block, or those of a mill."""
        from parser.iso.reading import read_iso  # noqa: PLC0415 - programs of 3B need none of it, and start sooner

        return read_iso(text, choices)


ISO = Iso()
