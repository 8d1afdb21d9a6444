"""Where words stand in the text of a block that findings of the path point at."""

import re
from collections.abc import Mapping

from parser.text.source import Field, Span

_REMARK = re.compile(r"\([^)]*\)?|;.*", re.DOTALL)
_NUMBER = r"\s*[-+]?[\d.]+"
_WORDS: Mapping[Field, re.Pattern[str]] = {
    Field.X: re.compile(f"X{_NUMBER}", re.IGNORECASE),
    Field.Y: re.compile(f"Y{_NUMBER}", re.IGNORECASE),
    Field.SENSE: re.compile(r"G\s*0*[23](?![\d.])", re.IGNORECASE),
    Field.SIDE: re.compile(r"G\s*0*4[012](?![\d.])", re.IGNORECASE),
    Field.REGISTER: re.compile(r"[DH]\s*\d+", re.IGNORECASE),
}


def fields_of(block: str) -> dict[Field, Span]:
    """Where the words of a block stand that say one of these; those that are written, outside of remarks."""
    bare = _REMARK.sub(lambda remark: " " * len(remark[0]), block)
    found = {field: word.search(bare) for field, word in _WORDS.items()}
    return {field: match.span() for field, match in found.items() if match}
