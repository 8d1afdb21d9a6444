"""Types that a page's scripts give to what Python hands over, held against what it does hand over."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

_TYPEDEF = re.compile(r"@typedef \{object\} (\w+)(.*?)\*/", re.DOTALL)
_PROPERTY = re.compile(r"@property \{(.+)\} (\w+)(?: .*)?$", re.MULTILINE)

Types = dict[str, dict[str, str]]
"""The properties of each type, with their types as they are written."""


def types_of(*modules: Path) -> Types:
    """Object types of modules."""
    text = "".join(module.read_text("utf-8") for module in modules)
    return {
        name: {key: written for written, key in _PROPERTY.findall(properties)}
        for name, properties in _TYPEDEF.findall(text)
    }


def unlike(types: Types, name: str, value: dict[str, Any], at: str = "") -> Iterator[str]:
    """Where an object is not of the type of a name: keys that one of the two lacks, and null where none may be."""
    wanted = types[name]
    for key in wanted.keys() ^ value.keys():
        yield f"{at}{key}: only in {'the types' if key in wanted else 'the document'}"
    for key in wanted.keys() & value.keys():
        yield from _unlike(types, wanted[key], value[key], f"{at}{key}")


def _unlike(types: Types, written: str, value: Any, at: str) -> Iterator[str]:
    named = re.match(r"\w+", written)
    if value is None and "null" not in written:
        yield f"{at}: null"
    if named is None or named[0] not in types or value is None:
        return
    for one in value if written.startswith(f"{named[0]}[]") else [value]:
        yield from unlike(types, named[0], one, f"{at}.")
