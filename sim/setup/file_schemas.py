"""JSON schemas of scenario and machine files, for editors that complete and check TOML; made from the rows of keys.

They hold each key by itself. What two keys say together, such as ``[offset]`` with ``[[pass]]``, is found by a run.
"""

from collections.abc import Iterable
from typing import Any, Final

from sim.setup import scenario
from sim.setup.expectations import EXPECT
from sim.setup.key_words import words_of
from sim.setup.machine import machine
from sim.setup.program_section import PROGRAM
from sim.setup.quiz import QUIZ
from sim.setup.toml.keys import Key, Section

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


_MAY_BE_LEFT_OUT: Final = ("arm",)


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
