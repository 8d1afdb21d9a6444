"""Words of the pictures in English and Chinese, from the files ``*.toml`` beside this module."""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from parser.findings.catalogue import Language

FOLDER = Path(__file__).parent
_FILES = ("common", "cut", "deviation", "film", "motion")


class Words(NamedTuple):
    """The texts of pictures in one language."""

    language: Language

    def __call__(self, key: str, **values: object) -> str:
        """Text of a key, filled with values. KeyError where there is no such text."""
        return texts()[key][self.language].format(**values)


@cache
def texts() -> Mapping[str, Mapping[Language, str]]:
    """All texts: key to language to template. ValueError where two files hold one key."""
    found: dict[str, Mapping[Language, str]] = {}
    for file in (FOLDER / f"{name}.toml" for name in _FILES):
        read = tomllib.loads(file.read_text(encoding="utf-8"))
        twice = found.keys() & read.keys()
        if twice:
            raise ValueError(f"{file.name} holds texts of another file again: {sorted(twice)}")
        found |= read
    return found
