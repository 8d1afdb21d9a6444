"""The report as text."""

import json
from typing import Any


def report_text(report: dict[str, Any]) -> str:
    """The report as JSON text, one line for each entry and for each member of a list of entries; no NaN.

    Compact lines keep to json's fast encoder; indenting a hundred thousand blocks takes ten times as long.
    """
    return "{\n" + ",\n".join(f"{_line(key)}: {_lines(value)}" for key, value in report.items()) + "\n}\n"


def _lines(value: Any) -> str:
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return "[\n" + ",\n".join(map(_line, value)) + "\n]"
    return _line(value)


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
