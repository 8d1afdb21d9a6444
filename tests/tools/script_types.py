"""Writes the types of what pages are handed into their scripts, from models: `make pages`."""

import re
import textwrap
import types
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import (
    Annotated,
    Any,
    Literal,
    NotRequired,
    Required,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

from parser.documents import Limits, Point
from sim.serve.page.model import ANSWERS
from sim.show.drill_page.page import DrillsEntry
from sim.show.html.packed import PackedEntry
from sim.show.html.walls import WallsEntry
from sim.show.index_page.model import IndexEntry
from sim.show.lesson_page.model import LessonEntry
from sim.show.operation_page.model import OperationEntry
from sim.show.panel_page.model import PanelEntry
from sim.show.replay.lean import LeanEntry
from sim.show.replay.model import ReplayDocument
from sim.show.replay.sparks import SparkTapeEntry
from sim.show.report_page.tables import TableDataEntry
from sim.teach.handins import HandInDocument

ROOT = Path(__file__).parents[2]
SHOW = ROOT / "sim" / "show"
DOCUMENTS: dict[Path, Sequence[type]] = {
    SHOW / "html" / "assets" / "packed.js": [PackedEntry],
    SHOW / "html" / "assets" / "walls.js": [WallsEntry],
    SHOW / "replay" / "assets" / "lean.js": [LeanEntry],
    SHOW / "replay" / "assets" / "document.js": [ReplayDocument],
    SHOW / "replay" / "assets" / "sparks.js": [SparkTapeEntry],
    SHOW / "report_page" / "assets" / "data.js": [TableDataEntry],
    SHOW / "index_page" / "assets" / "data.js": [IndexEntry],
    SHOW / "drill_page" / "assets" / "data.js": [DrillsEntry],
    SHOW / "lesson_page" / "assets" / "data.js": [LessonEntry, HandInDocument],
    SHOW / "operation_page" / "assets" / "data.js": [OperationEntry],
    SHOW / "panel_page" / "assets" / "data.js": [PanelEntry],
    SHOW / "open_page" / "assets" / "data.js": ANSWERS,
}
BEGIN, END = "/** Written by `make pages` from the model in Python. */\n", "/** Up to here. */\n"
NAMED = {str: "string", int: "number", float: "number", bool: "boolean", type(None): "null", Point: "Place"}


def pages() -> Iterator[tuple[Path, str]]:
    """Each script with types of models, and what it is to hold."""
    for path, models in DOCUMENTS.items():
        text = path.read_text("utf-8")
        before, _, rest = text.partition(BEGIN)
        typedefs = [typedef(model) for model in models_of(models, imported(before))]
        yield path, before + BEGIN + "\n" + "\n".join(typedefs) + "\n" + END + rest.partition(END)[2]


def imported(text: str) -> set[str]:
    """Names of types that a script takes from others."""
    return {name.strip() for names in re.findall(r"@import \{(.*?)\}", text) for name in names.split(",")}


def models_of(models: Sequence[type], elsewhere: set[str]) -> list[type]:
    """Models and those that they name, each once, before its parts; none of those by names `elsewhere`."""
    return list(dict.fromkeys(part for model in models for part in parts_of(model, elsewhere)))


def parts_of(of: Any, elsewhere: set[str]) -> Iterator[type]:
    """Models that a type is or names, each before its parts; of those by names `elsewhere` none, nor their parts."""
    if is_typeddict(of):
        if name_of(of) in elsewhere:
            return
        yield of
    for part in get_type_hints(of).values() if is_typeddict(of) else get_args(of):
        yield from parts_of(part, elsewhere)


def typedef(model: Any) -> str:
    words = [f" * {line}" for line in textwrap.wrap(" ".join((model.__doc__ or "").split()), 116)]
    fields = {name: always(of) for name, of in get_type_hints(model, include_extras=True).items()}
    names = {name: f"[{name}]" if name in model.__optional_keys__ else name for name in fields}
    return "\n".join(
        ["/**", *words, f" * @typedef {{object}} {name_of(model)}"]
        + [f" * @property {{{script_type(of)}}} {names[name]}{note_of(of)}" for name, of in fields.items()]
        + [" */\n"]
    )


def always(of: Any) -> Any:
    """The type of a field, whether it may be missing or not."""
    return get_args(of)[0] if get_origin(of) in (NotRequired, Required) else of


def name_of(model: type) -> str:
    return model.__name__.removesuffix("Entry")


def note_of(of: Any) -> str:
    notes = [note for note in getattr(of, "__metadata__", ()) if isinstance(note, str)]
    return f" {notes[-1]}" if notes else ""


def script_type(of: Any) -> str:
    """A type of a field as TypeScript has it."""
    if is_typeddict(of):
        return name_of(of)
    return NAMED[of] if of in NAMED else composed(of)


def composed(of: Any) -> str:
    origin, args = get_origin(of), get_args(of)
    if origin is Annotated:
        return limited(args[0], [note for note in args[1:] if isinstance(note, Limits)])
    if origin is Literal:
        return " | ".join(f'"{arg}"' if isinstance(arg, str) else str(arg) for arg in args)
    if origin in (Union, types.UnionType):
        return " | ".join(map(script_type, args))
    if origin in (list, Sequence):
        item = script_type(args[0])
        return f"({item})[]" if "|" in item else f"{item}[]"
    if origin is tuple:
        return f"[{', '.join(map(script_type, args))}]"
    if origin is dict:
        return f"Record<string, {script_type(args[1])}>"
    raise TypeError(of)


def limited(of: Any, limits: list[Limits]) -> str:
    keywords = dict(pair for limit in limits for pair in limit.keywords)
    if "enum" in keywords:
        return " | ".join(f'"{name}"' for name in keywords["enum"])
    if keywords.get("maxItems"):
        return f"[{', '.join([script_type(get_args(of)[0])] * keywords['maxItems'])}]"
    return script_type(of)


if __name__ == "__main__":
    for path, text in pages():
        path.write_text(text, "utf-8", newline="\n")
