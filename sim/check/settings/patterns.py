"""Patterns for paths, with the meaning that they have in the settings of ruff: ``*`` goes past slashes.

A pattern is held against the name of a file or folder alone, and against its path below the folder of the pattern.
"""

import re
from fnmatch import translate
from functools import cache
from pathlib import Path
from typing import NamedTuple

from parser.findings.errors import SettingsError

_PIECE = re.compile(r"(?:(?<=/)|\A)\*\*/|\*+|\[!?\]?[^\]]*\]|.", re.DOTALL)
_CLOSED = 2
"""Characters with which `fnmatch.translate` closes an expression."""


class PathPattern(NamedTuple):
    """A pattern as it was written, and the folder that its paths begin in; that has no link in it."""

    text: str
    folder: Path

    def matches(self, path: Path) -> bool:
        """Whether a path, which has no link in it but for its last part, is meant."""
        pattern = _compiled(self.text.removeprefix("./").rstrip("/"))
        if pattern.fullmatch(path.name) or pattern.fullmatch(path.as_posix()):
            return True
        below = path.is_relative_to(self.folder)
        return below and pattern.fullmatch(path.relative_to(self.folder).as_posix()) is not None


def pattern_list(value: object, folder: Path, where: str) -> tuple[PathPattern, ...]:
    """Patterns of a list of texts. SettingsError where it is none, or where one is empty."""
    if not isinstance(value, list) or not all(isinstance(text, str) and text.strip("./") for text in value):
        raise SettingsError("no-list-of-patterns", where=where, found=value)
    return tuple(PathPattern(text, folder) for text in value)


@cache
def _compiled(text: str) -> re.Pattern[str]:
    """Regular expression of a pattern: ``*`` and ``?`` mean any characters, ``**/`` any folders, ``[…]`` one of some.

    What stands between two stars is taken where it comes first: elsewhere it would leave less for the rest. So no
    pattern takes long.
    """
    pieces = [""]
    for match in _PIECE.finditer(text):
        piece = match[0]
        if piece.startswith("*"):
            pieces.append("(?:.*?/)??" if piece.endswith("/") else ".*?")
        else:
            pieces[-1] += translate(piece)[:-_CLOSED]
    first, *rest = pieces
    closed = [f"(?>{piece})" for piece in rest[:-1]]
    return re.compile("".join([first, *closed, *rest[-1:]]), re.DOTALL)
