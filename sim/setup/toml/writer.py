"""Settings as TOML text."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from sim.setup.toml.keys import WrittenSection


def toml_text(sections: Sequence[WrittenSection]) -> str:
    """TOML of sections, the top of the file first; those that hold nothing are left out."""
    return "\n".join(_section(written.section.header, written.values) for written in sections if written.values)


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


def _section(header: str, values: Mapping[str, Any]) -> str:
    lines = [f"{_key(key)} = {toml_value(value)}\n" for key, value in values.items()]
    return "".join([f"{header}\n" if header else "", *lines])


def _key(key: str) -> str:
    """A key as it stands, or in quotes where it holds anything but letters, digits, ``_`` and ``-``."""
    bare = key.isascii() and key.replace("_", "a").replace("-", "a").isalnum()
    return key if bare else toml_value(key)
