"""Where the keys of a TOML file stand, as ``file:line:column``: its library does not tell."""

import re
from typing import Final

_HEAD: Final = re.compile(r"[ \t]*\[\[?([^\[\]]+)\]\]?[ \t]*(?:#.*)?$")
_WORD = r"""(?:"[^"\n]*"|'[^'\n]*'|[\w-]+)"""
_KEY: Final = re.compile(rf"[ \t]*({_WORD}(?:[ \t]*\.[ \t]*{_WORD})*)[ \t]*=")
_PART: Final = re.compile(r"""[ \t]*(?:"([^"\n]*)"|'([^'\n]*)'|([\w-]+))[ \t]*(?:\.|$)""")


class KeyPlaces:
    """Places of the keys in a text of TOML, of which the file is called `name`."""

    def __init__(self, name: str, text: str) -> None:
        self._name = name
        self._places: dict[tuple[str, ...], tuple[int, int]] = {}
        section: tuple[str, ...] = ()
        for number, line in enumerate(text.split("\n"), start=1):
            head, key = _HEAD.match(line), _KEY.match(line)
            if head:
                section = _parts(head[1])
                self._places.setdefault(section, (number, line.index("[") + 1))
            elif key:
                self._places.setdefault((*section, *_parts(key[1])), (number, key.start(1) + 1))

    def of(self, *keys: str) -> str:
        """``makino.toml:7:1``: the place of a key, or of the nearest table around it that has one; else the file."""
        for length in range(len(keys), 0, -1):
            if keys[:length] in self._places:
                line, column = self._places[keys[:length]]
                return f"{self._name}:{line}:{column}"
        return self._name


def _parts(key: str) -> tuple[str, ...]:
    """The parts of a key with dots."""
    return tuple("".join(quoted) for quoted in _PART.findall(key))
