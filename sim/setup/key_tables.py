"""The tables of keys in ``docs/scenarios.md``, made from the keys and their words."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from sim.setup import scenario
from sim.setup.key_words import words, words_of
from sim.setup.machine import machine
from sim.setup.quiz import QUIZ
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Number, OneOf

DOCUMENT = Path("docs/scenarios.md")
_TABLE = re.compile(r"(<!-- keys: ([\w ]+); .*? -->\n).*?(\n<!-- end of keys -->)", re.DOTALL)


class KeyRow(NamedTuple):
    """Row of a key, in Markdown."""

    key: str
    type: str
    bounds: str
    default: str
    meaning: str


def renewed(document: str) -> str:
    """The document with the tables as the keys are now. KeyError where it asks for one that there is not."""
    return _TABLE.sub(lambda found: f"{found[1]}\n{_tables()[found[2]]}{found[3]}", document)


def _tables() -> dict[str, str]:
    of_machine = [(section, key) for section in machine.SECTIONS for key in section.keys]
    return {
        "scenario": _table(_scenario_rows()),
        "quiz": _table(_row(QUIZ, key) for key in QUIZ.keys),
        "machine": _table((_row(*of) for of in of_machine if _is_needed(*of)), left_out=("default",)),
        "machine that may be left out": _table(_row(*of) for of in of_machine if not _is_needed(*of)),
    }


def _scenario_rows() -> Iterator[KeyRow]:
    """Rows of the keys; sections that are lists, or have no keys of their own, begin with a row that says so."""
    for section in scenario.SECTIONS:
        if section.name in _words("sections"):
            yield KeyRow(f"`{section.header}`", **_words("sections")[section.name])
        if section is not QUIZ:
            yield from (_row(section, key) for key in section.keys)


def _table(rows: Iterable[KeyRow], left_out: tuple[str, ...] = ()) -> str:
    """Markdown of rows, without some columns."""
    columns = [column for column in KeyRow._fields if column not in left_out]
    heads = _words("document")
    lines = [[heads[column] for column in columns], *([getattr(row, column) for column in columns] for row in rows)]
    head, *body = (f"| {' | '.join(line)} |\n" for line in lines)
    return "".join([head, "|---" * len(columns) + "|\n", *body])


def _is_needed(section: Section, key: Key) -> bool:
    """Whether every file has it; of a key with words for a default, the section may be left out."""
    return key.is_required and not words_of(section, key).default


def _row(section: Section, key: Key) -> KeyRow:
    said, kind = words_of(section, key), _words("kinds")[key.kind.name]
    return KeyRow(
        key=f"`{f'{section.header} {key.name}'.strip()}`",
        type=(isinstance(key.kind, Number) and key.kind.unit) or kind["type"],
        bounds=said.bounds or _bounds(key, kind["bounds"]),
        default=said.default or _default(key.default, key.is_required),
        meaning=said.meaning,
    )


def _bounds(key: Key, template: str) -> str:
    low, high = key.kind.bound or (0.0, 0.0)
    listed = ", ".join(f"`{word}`" for word in key.kind.words) if isinstance(key.kind, OneOf) else ""
    return template.format(low=_number(low), high=_number(high), words=listed)


def _default(value: Any, is_required: bool) -> str:
    heads = _words("document")
    if is_required or value is None:
        return str(heads["none"])
    if isinstance(value, bool):
        return str(heads["true" if value else "false"])
    return f"`{value}`" if isinstance(value, str) else _number(value)


def _number(value: float) -> str:
    """A number for people, with a proper minus, and commas from five digits on."""
    if math.isinf(value):
        return str(_words("document")["unlimited"])
    text = f"{value:,f}".rstrip("0").rstrip(".")
    return (text if abs(value) >= 1e4 else text.replace(",", "")).replace("-", "−")


def _words(of: str) -> Mapping[str, Any]:
    found: Mapping[str, Any] = words()[of]
    return found


if __name__ == "__main__":
    DOCUMENT.write_text(renewed(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")
