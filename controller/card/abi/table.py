"""The table of the functions of the card's library, and the C that is made of it.

The functions of the card's library, read from their table: ``ge-functions.csv``, as the vendor's header has them.

All that is in C is made of this table; a test holds it against the Python functions of the card.

C made of the table: the header ``ges.h``, and the source of the library with a line for each function.
"""

import csv
import hashlib
import re
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Final, NamedTuple

FOLDER: Final = Path(__file__).parent
_PARAMETER: Final = re.compile(r"\s*([\w ]+?)\s*(\*?)\s*(\w+)(?:=.+)?\s*")
_PLACE: Final = "pnt"
"""Name of the out-parameters that are places: 4 doubles, whatever axes the card has."""
_IN: Final = {
    "char": "c",
    "short": "h",
    "unsigned short": "H",
    "int": "i",
    "long": "l",
    "unsigned long": "L",
    "double": "d",
    "char*": "s",
    "TLookData*": "B",
    "CCommandHandle*": "K",
}
_OUT: Final = {
    "short*": "h",
    "unsigned short*": "H",
    "long*": "l",
    "unsigned long*": "L",
    "double*": "d",
    "TLookAheadMsg*": "M",
}


class Parameter(NamedTuple):
    """A parameter: its C type, with a star behind it where it is a pointer, and its name."""

    kind: str
    name: str

    @property
    def is_out(self) -> bool:
        """Whether the function fills it."""
        return self.kind in _OUT

    @property
    def letter(self) -> str:
        """How ``ges.c`` calls its type: small and large for signed and unsigned, ``P`` for a place, and so on."""
        if self.kind == "double*" and self.name == _PLACE:
            return "P"
        return _OUT[self.kind] if self.is_out else _IN[self.kind]

    @property
    def declared(self) -> str:
        """As a C declaration."""
        return f"{self.kind.removesuffix('*')} *{self.name}" if self.kind.endswith("*") else f"{self.kind} {self.name}"


class Prototype(NamedTuple):
    """A function: name, parameters in order, and the group of the vendor's header in which it stands."""

    name: str
    parameters: tuple[Parameter, ...]
    group: str

    @property
    def form(self) -> str:
        """Letters of the parameters that are given, then ``>`` and of those that are filled."""
        given = "".join(parameter.letter for parameter in self.parameters if not parameter.is_out)
        return f"{given}>{''.join(parameter.letter for parameter in self.parameters if parameter.is_out)}"

    @property
    def declared(self) -> str:
        """As a C declaration, without its semicolon."""
        return f"int {self.name}({', '.join(parameter.declared for parameter in self.parameters) or 'void'})"


@cache
def prototypes() -> tuple[Prototype, ...]:
    """All functions, in the order of the table."""
    with (FOLDER / "ge-functions.csv").open(encoding="utf-8", newline="") as file:
        return tuple(_prototype(row) for row in csv.DictReader(file))


def _prototype(row: dict[str, str]) -> Prototype:
    texts = [] if row["args"] == "void" else row["args"].split(",")
    return Prototype(row["function"], tuple(_parameter(text) for text in texts), row["group"])


def _parameter(text: str) -> Parameter:
    found = _PARAMETER.fullmatch(text)
    assert found is not None, text  # noqa: S101 - a slip in the table
    kind, star, name = found.groups()
    return Parameter(kind + star, name)


C: Final = FOLDER / "c"
HEADERS: Final = tuple(sorted(path.name for path in (C / "include").glob("*.h")))
"""Stand-ins for headers that programs for the card include."""


def header() -> str:
    """Text of ``ges.h``: types, then the functions by their groups."""
    return _text("ges.h").replace("/* functions */\n", "".join(_declarations()))


def _declarations() -> Iterator[str]:
    for group, functions in groupby(prototypes(), key=lambda prototype: prototype.group):
        yield f"\n/* {group} */\n"
        yield from (f"{function.declared};\n" for function in functions)


def source(places: Mapping[str, str | list[str]]) -> str:
    """Text of ``libges.c``.

    `places` has what is built in, by the names that ``ges.c`` has for it: a text, or many.
    """
    return f"{''.join(_built_in(*place) for place in places.items())}\n{_text('ges.c')}\n{''.join(_functions())}"


def _built_in(name: str, value: str | list[str]) -> str:
    return f"static const char *const {name}{'[]' if isinstance(value, list) else ''} = {_quoted(value)};\n"


def _functions() -> Iterator[str]:
    for index, prototype in enumerate(prototypes()):
        given = [parameter.name for parameter in prototype.parameters if not parameter.is_out]
        filled = [parameter.name for parameter in prototype.parameters if parameter.is_out]
        arguments = "".join(f", {name}" for name in (*given, *filled))
        yield f'DRYCUT {prototype.declared} {{ return drycut_call({index}, "{prototype.form}"{arguments}); }}\n'


def digest() -> str:
    """Of all that the library is made of, so that a library meets the Python that it was made for."""
    made_of = (_text("ges.c"), _text("ges.h"), *(prototype.declared for prototype in prototypes()))
    return hashlib.sha256("\n".join(made_of).encode()).hexdigest()[:16]


def _text(name: str) -> str:
    return Path(C / name).read_text("utf-8")


def _quoted(value: str | list[str]) -> str:
    """A C string, or an array of them with an end; what is not plain is written in octal."""
    if isinstance(value, list):
        return f"{{{', '.join((*map(_quoted, value), '0'))}}}"
    plain = set(range(0x20, 0x7F)) - set(b'"\\?')
    return '"' + "".join(chr(byte) if byte in plain else f"\\{byte:03o}" for byte in value.encode()) + '"'
