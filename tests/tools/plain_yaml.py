"""The YAML of our own files and recipes: mappings, lists, texts, ``|`` and ``[a, b]``; a ValueError for all else."""

import re
from typing import Any

_ITEM = re.compile(r"- (\S.*)")
_PAIR = re.compile(r"([\w-]+):(?: (.*))?")
_UNKNOWN = re.compile(r"[&*!>{%@`]")  # what begins something else of YAML


def read_yaml(text: str) -> Any:
    """What a text says: dict, list or str; numbers and truth values stay texts."""
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    value, rest = _node(lines, 0)
    if rest:
        raise ValueError(f"not of the YAML that is read here: {rest[0]!r}")
    return value


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _node(lines: list[str], indent: int) -> tuple[Any, list[str]]:
    if lines and _ITEM.match(lines[0].strip()):
        return _list(lines, indent)
    return _mapping(lines, indent)


def _list(lines: list[str], indent: int) -> tuple[list[Any], list[str]]:
    found = []
    while lines and _indent(lines[0]) == indent and (item := _ITEM.match(lines[0].strip())):
        if _PAIR.fullmatch(_bare(item[1])):
            value, lines = _mapping([" " * (indent + 2) + item[1], *lines[1:]], indent + 2)
        else:
            value, lines = _scalar(item[1]), lines[1:]
        found.append(value)
    return found, lines


def _mapping(lines: list[str], indent: int) -> tuple[dict[str, Any], list[str]]:
    found: dict[str, Any] = {}
    while lines and _indent(lines[0]) == indent and (pair := _PAIR.fullmatch(_bare(lines[0].strip()))):
        key, value = pair[1], pair[2]
        if key in found:
            raise ValueError(f"{key} stands twice")
        lines = lines[1:]
        if value == "|":
            inner = []
            while lines and _indent(lines[0]) > indent:
                inner.append(lines.pop(0).strip())
            found[key] = "".join(f"{line}\n" for line in inner)
        elif value:
            found[key] = _scalar(value)
        else:
            found[key], lines = _node(lines, _indent(lines[0]))
    return found, lines


def _bare(text: str) -> str:
    """A line without the remark behind it."""
    return re.sub(r"\s#.*", "", text)


def _scalar(text: str) -> Any:
    text = _bare(text)
    if text.startswith("[") and text.endswith("]"):
        return [_scalar(part.strip()) for part in text[1:-1].split(",")]
    if text[:1] in {'"', "'"} and text[-1] == text[0]:
        return text[1:-1]
    if _UNKNOWN.match(text) or ": " in text:
        raise ValueError(f"not of the YAML that is read here: {text!r}")
    return text
