"""What is made of the rows of keys: tables in ``docs/scenarios.md`` and its Chinese twin, and JSON schemas of files.

JSON schemas of scenario and machine files, for editors that complete and check TOML; made from the rows of keys.

They hold each key by itself. What two keys say together, such as ``[offset]`` with ``[[pass]]``, is found by a run.
"""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple

from parser.findings.catalogue import Bilingual, Language
from sim.setup import limits, scenario, shop, technology
from sim.setup.expectations import EXPECT
from sim.setup.key_words import setting_text, words, words_of
from sim.setup.machine import machine
from sim.setup.machine.guides import GUIDES
from sim.setup.making import PROGRAM
from sim.setup.quiz import QUIZ
from sim.setup.spark import EVENT, SPARK
from sim.setup.taper import TAPER
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Number, OneOf

DRAFT: Final = "https://json-schema.org/draft/2020-12/schema"
_ANY: Final = {"type": ["string", "number", "boolean", "array"]}
_RANGE: Final = {
    "type": "object",
    "additionalProperties": False,
    "minProperties": 1,
    "properties": {"min": {"type": "number"}, "max": {"type": "number"}},
}


def scenario_schema() -> dict[str, Any]:
    """JSON schema of ``scenario.toml``. Its program is the name of a file, or the table of how it is made."""
    top, *sections = scenario.SECTIONS
    schema = _file_schema("scenario.toml of drycut (docs/scenarios.md)", top, sections)
    properties = schema["properties"]
    name = key_schema(top, next(key for key in top.keys if key.name == PROGRAM.name))
    properties[PROGRAM.name] = {"anyOf": [name, section_schema(PROGRAM)]}
    properties[EXPECT.name] = {"type": "object", "additionalProperties": {"anyOf": [_ANY, _RANGE]}}
    properties[QUIZ.name]["items"]["required"] = ["block"]  # a question that is written out has more of its own
    return schema


def machine_schema() -> dict[str, Any]:
    """JSON schema of a machine file."""
    top, *sections = machine.SECTIONS
    schema = _file_schema("a machine file of drycut (docs/scenarios.md)", top, sections)
    needed = [section.name for section in sections if any(key.is_required for key in section.keys)]
    schema["required"] = [*schema.get("required", []), *(name for name in needed if name not in _MAY_BE_LEFT_OUT)]
    return schema


def shop_schema() -> dict[str, Any]:
    """JSON schema of a shop file."""
    return _file_schema("a shop file of drycut (docs/time.md)", Section("shop", (), form="top"), shop.SECTIONS)


def limits_schema() -> dict[str, Any]:
    """JSON schema of a file of limits."""
    return _file_schema("limits of a test piece for drycut (docs/accept.md)", limits.PIECE, [limits.FEATURE])


def technology_schema() -> dict[str, Any]:
    """JSON schema of a technology file."""
    top = Section("technology", (), form="top")
    schema = _file_schema("a technology file of drycut (docs/technology.md)", top, technology.SECTIONS)
    schema["required"] = [section.name for section in technology.SECTIONS]
    return schema


_OWN_TABLES: Final = (QUIZ, SPARK, EVENT, TAPER, GUIDES)
_MAY_BE_LEFT_OUT: Final = ("arm", "spark", "guides")


def section_schema(section: Section) -> dict[str, Any]:
    """JSON schema of one table of a section."""
    required = [key.name for key in section.keys if key.is_required]
    return {
        "type": "object",
        "additionalProperties": False,
        "properties": {key.name: key_schema(section, key) for key in section.keys},
        **({"required": required} if required else {}),
    }


def key_schema(section: Section, key: Key) -> dict[str, Any]:
    """JSON schema of a key, with its name and what it is for."""
    words = words_of(section, key)
    return {"title": words.name.en, "description": words.meaning.en, **key.schema}


def _file_schema(title: str, top: Section, sections: Iterable[Section]) -> dict[str, Any]:
    whole = section_schema(top)
    for section in sections:
        table = section_schema(section)
        whole["properties"][section.name] = {"type": "array", "items": table} if section.form == "list" else table
    return {"$schema": DRAFT, "title": title, **whole}


DOCUMENTS: tuple[tuple[Language, Path], ...] = (
    ("en", Path("docs/scenarios.md")),
    ("zh", Path("docs/scenarios.zh.md")),
    ("en", Path("docs/time.md")),
    ("zh", Path("docs/time.zh.md")),
    ("en", Path("docs/technology.md")),
    ("zh", Path("docs/technology.zh.md")),
    ("en", Path("docs/sparks.md")),
    ("zh", Path("docs/sparks.zh.md")),
    ("en", Path("docs/taper.md")),
    ("zh", Path("docs/taper.zh.md")),
    ("en", Path("docs/accept.md")),
    ("zh", Path("docs/accept.zh.md")),
)
_TABLE = re.compile(r"(<!-- keys: ([\w ]+); .*? -->\n).*?(\n<!-- end of keys -->)", re.DOTALL)


class KeyRow(NamedTuple):
    """Row of a key, in Markdown."""

    key: Bilingual
    type: Bilingual
    bounds: Bilingual
    default: Bilingual
    meaning: Bilingual


def renewed(document: str, language: Language) -> str:
    """The document with the tables as the keys are now. KeyError where it asks for one that there is not."""
    return _TABLE.sub(lambda found: f"{found[1]}\n{_tables(language)[found[2]]}{found[3]}", document)


def _tables(language: Language) -> dict[str, str]:
    sections = [section for section in machine.SECTIONS if section not in (SPARK, GUIDES)]
    of_machine = [(section, key) for section in sections for key in section.keys]
    return {
        "scenario": _table(_scenario_rows(), language),
        "quiz": _table((_row(QUIZ, key) for key in QUIZ.keys), language),
        "machine": _table((_row(*of) for of in of_machine if _is_needed(*of)), language, left_out=("default",)),
        "machine that may be left out": _table((_row(*of) for of in of_machine if not _is_needed(*of)), language),
        "limits": _table((_row(section, key) for section in limits.SECTIONS for key in section.keys), language),
        "technology": _table((_row(section, key) for section in technology.SECTIONS for key in section.keys), language),
        "sparks": _table((_row(SPARK, key) for key in SPARK.keys), language),
        "taper": _table((_row(TAPER, key) for key in TAPER.keys), language),
        "guides": _table((_row(GUIDES, key) for key in GUIDES.keys), language),
        "event": _table((_row(EVENT, key) for key in EVENT.keys), language),
        "shop": _table((_row(section, key) for section in shop.SECTIONS for key in section.keys), language),
    }


def _scenario_rows() -> Iterator[KeyRow]:
    """Rows of the keys; sections that are lists, or have no keys of their own, begin with a row that says so."""
    for section in scenario.SECTIONS:
        if section.name in _words("sections"):
            texts = {of: setting_text(text) for of, text in _words("sections")[section.name].items()}
            yield KeyRow(setting_text(f"`{section.header}`"), **texts)
        if section not in _OWN_TABLES:
            yield from (_row(section, key) for key in section.keys)


def _table(rows: Iterable[KeyRow], language: Language, left_out: tuple[str, ...] = ()) -> str:
    """Markdown of rows, without some columns."""
    columns = [column for column in KeyRow._fields if column not in left_out]
    heads = KeyRow(*(_head(column) for column in KeyRow._fields))
    lines = [[getattr(getattr(row, column), language) for column in columns] for row in (heads, *rows)]
    head, *body = (f"| {' | '.join(line)} |\n" for line in lines)
    return "".join([head, "|---" * len(columns) + "|\n", *body])


def _is_needed(section: Section, key: Key) -> bool:
    """Whether every file has it; of a key with words for a default, the section may be left out."""
    return key.is_required and not any(words_of(section, key).default)


def _row(section: Section, key: Key) -> KeyRow:
    told_words, kind = words_of(section, key), _words("kinds")[key.kind.name]
    unit = key.kind.unit if isinstance(key.kind, Number) else ""
    return KeyRow(
        key=setting_text(f"`{f'{section.header} {key.name}'.strip()}`"),
        type=setting_text(unit or kind["type"]),
        bounds=told_words.bounds if any(told_words.bounds) else _bounds(key, setting_text(kind["bounds"])),
        default=told_words.default if any(told_words.default) else _default(key.default, key.is_required),
        meaning=told_words.meaning,
    )


def _bounds(key: Key, template: Bilingual) -> Bilingual:
    low, high = key.kind.bound or (0.0, 0.0)
    listed = ", ".join(f"`{word}`" for word in key.kind.words) if isinstance(key.kind, OneOf) else ""
    return Bilingual(*(of.format(low=_number(low), high=_number(high), words=listed) for of in template))


def _default(value: Any, is_required: bool) -> Bilingual:
    if is_required or value is None:
        return _head("none")
    if isinstance(value, bool):
        return _head("true" if value else "false")
    if isinstance(value, float) and math.isinf(value):
        return _head("unlimited")
    return setting_text(f"`{value}`" if isinstance(value, str) else _number(value))


def _number(value: float) -> str:
    """A number for people, with a proper minus, and commas from five digits on."""
    text = f"{value:,f}".rstrip("0").rstrip(".")
    return (text if abs(value) >= 1e4 else text.replace(",", "")).replace("-", "−")


def _head(of: str) -> Bilingual:
    return setting_text(_words("document")[of])


def _words(of: str) -> Mapping[str, Any]:
    found: Mapping[str, Any] = words()[of]
    return found


if __name__ == "__main__":
    for language, path in DOCUMENTS:
        path.write_text(renewed(path.read_text(encoding="utf-8"), language), encoding="utf-8", newline="\n")
