"""Settings as TOML text: values as plain Python, sections by their header."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

Section = Mapping[str, Any]


def toml_text(sections: Sequence[tuple[str, Section]]) -> str:
    """TOML of sections by header, such as ``[wire]``; that of an empty header stands first, without one."""
    return "\n".join(_section(header, section) for header, section in sections if section)


def toml_value(value: Any) -> str:
    """A text, number, truth, list or inline table."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {toml_value(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    return str(value) if isinstance(value, int | float) else toml_value(str(value))


def _section(header: str, section: Section) -> str:
    lines = [f"{_key(key)} = {toml_value(value)}\n" for key, value in section.items()]
    return "".join([f"{header}\n" if header else "", *lines])


def _key(key: str) -> str:
    """A key as it stands, or in quotes where it holds anything but letters, digits, ``_`` and ``-``."""
    bare = key.isascii() and key.replace("_", "a").replace("-", "a").isalnum()
    return key if bare else toml_value(key)
