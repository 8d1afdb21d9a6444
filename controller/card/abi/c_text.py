"""C made of the table: the header ``ges.h``, and the source of the library with a line for each function."""

import hashlib
from collections.abc import Iterator, Mapping
from itertools import groupby
from pathlib import Path
from typing import Final

from controller.card.abi.table import FOLDER, prototypes

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
