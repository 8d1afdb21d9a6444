"""Linetypes that are broken: centre lines, hidden edges and the like, which are no contours."""

import tomllib
from functools import cache
from pathlib import Path

from ezdxf.document import Drawing as Document
from ezdxf.entities.ltype import Linetype

_ELEMENT = 49  # group code of a dash, above 0, or a gap, below 0


class Linetypes:
    """Which of the linetypes of a document are broken, by their names in small letters."""

    def __init__(self, document: Document) -> None:
        self._broken = {entry.dxf.name.lower(): _has_gaps(entry) for entry in document.linetypes}

    def is_broken(self, name: str) -> bool:
        """Whether lines of this type have gaps; by the name alone where the document does not say what it is."""
        if name not in self._broken:
            self._broken[name] = _sounds_broken(name)
        return self._broken[name]


def _has_gaps(entry: Linetype) -> bool:
    return any(code == _ELEMENT and value < 0.0 for code, value in entry.pattern_tags.tags)


def _sounds_broken(name: str) -> bool:
    names = _names()
    return any(part in name for part in names["broken"]) and not any(part in name for part in names["whole"])


@cache
def _names() -> dict[str, list[str]]:
    return tomllib.loads(Path(__file__).with_name("linetypes.toml").read_text(encoding="utf-8"))
