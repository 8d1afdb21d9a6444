"""JSON schema of ``drycut.toml``, for editors that complete and check TOML."""

from typing import Any, Final

from parser.program import own_dialect_schema
from sim.check.settings.model import WIRE_LENGTHS
from sim.check.settings.read import FAIL_ON
from sim.setup.dialect import REGISTERS, UNIT
from sim.setup.file_schemas import DRAFT
from sim.setup.toml.kinds import pair_schema
from sim.setup.toml.reader import PLACE_MM

_TEXT: Final = {"type": "string", "minLength": 1}
_CODES: Final = {"type": "array", "items": {"type": "string"}}
_MARKS: Final = {"type": "array", "items": {"type": "string", "pattern": "^[A-Za-z]{0,4}$"}}


def settings_schema() -> dict[str, Any]:
    """JSON schema of ``drycut.toml``, which is that of ``[tool.drycut]`` in ``pyproject.toml``, too."""
    wire = _table({key.name: key.schema for key in WIRE_LENGTHS.values()})
    keys: dict[str, tuple[str, dict[str, Any]]] = {
        "root": ("the search for settings ends here", {"type": "boolean"}),
        "machine": ("name of a machine, or its .toml file", {"type": "string"}),
        "machines": ("folder of machine files, whose names count before those that come with drycut", _TEXT),
        "start_mm": ("place of the program's start on the table", pair_schema(PLACE_MM)),
        "open": ("contours may stay open", {"type": "boolean"}),
        "select": ("codes of findings that are shown, or their beginnings", _CODES),
        "ignore": ("codes of findings that are not shown, or their beginnings", _CODES),
        "fail_on": ("the mildest that fails: errors; also incomplete checks; also warnings", {"enum": list(FAIL_ON)}),
        "exclude": ("patterns of files that are left out where a folder is looked through", _list_of(_TEXT)),
        "include": ("patterns of files that are programs whatever their names end in", _list_of(_TEXT)),
        "baseline": ("file of known findings and incomplete checks", _TEXT),
        "dialect": ("dialect of ISO programs, also one of those below, or its .toml file", _TEXT),
        **{key.name: (f"{key.name} of ISO programs", key.schema) for key in (UNIT, REGISTERS)},
        "end_marks": ("more words for the end of a program", _MARKS),
        "pause_marks": ("more words for a pause in a program", _MARKS),
        "wire": (
            "wire that corners and offsets are held against",
            wire,
        ),
        "dialects": (
            "dialects of a shop's own by their names, or their files",
            {"type": "object", "additionalProperties": {"oneOf": [_TEXT, own_dialect_schema()]}},
        ),
        "per_file_ignores": (
            "codes that are not shown of the files of a pattern",
            {"type": "object", "additionalProperties": _CODES},
        ),
    }
    properties = {name: {"description": meaning, **schema} for name, (meaning, schema) in keys.items()}
    return {"$schema": DRAFT, "title": "drycut.toml (docs/check.md)", **_table(properties)}


def _table(properties: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "additionalProperties": False, "properties": properties}


def _list_of(entry: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": entry}
