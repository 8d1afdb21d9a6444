"""Writes the types of what pages are handed into their scripts, from models: `make pages`."""

import textwrap
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints, is_typeddict

from parser.documents import Limits, Point, SaidEntry
from sim.show.replay.model import ReplayDocument

ROOT = Path(__file__).parents[2]
DOCUMENTS = {ROOT / "sim" / "show" / "replay" / "assets" / "document.js": ReplayDocument}
BEGIN, END = "/** Written by `make pages` from the model in Python. */\n", "/** Up to here. */\n"
NAMED = {str: "string", int: "number", float: "number", bool: "boolean", type(None): "null", Point: "Place"}
ELSEWHERE = (SaidEntry,)
"""Models whose types the script imports."""


def pages() -> Iterator[tuple[Path, str]]:
    """Each script with types of a model, and what it is to hold."""
    for path, model in DOCUMENTS.items():
        text = path.read_text("utf-8")
        before, _, rest = text.partition(BEGIN)
        yield path, before + BEGIN + "\n" + "\n".join(typedefs(model)) + "\n" + END + rest.partition(END)[2]


def typedefs(model: type) -> list[str]:
    """Types of a model and of its parts, the whole first."""
    return [typedef(each) for each in dict.fromkeys(models_of(model)) if each not in ELSEWHERE]


def models_of(of: Any) -> Iterator[type]:
    """Models that a type is or names, each before its parts."""
    if is_typeddict(of):
        yield of
    for part in get_type_hints(of).values() if is_typeddict(of) else get_args(of):
        yield from models_of(part)


def typedef(model: type) -> str:
    words = [f" * {line}" for line in textwrap.wrap(" ".join((model.__doc__ or "").split()), 116)]
    fields = get_type_hints(model, include_extras=True).items()
    return "\n".join(
        ["/**", *words, f" * @typedef {{object}} {name_of(model)}"]
        + [f" * @property {{{script_type(of)}}} {name}{note_of(of)}" for name, of in fields]
        + [" */\n"]
    )


def name_of(model: type) -> str:
    return model.__name__.removesuffix("Entry")


def note_of(of: Any) -> str:
    notes = [note for note in getattr(of, "__metadata__", ()) if isinstance(note, str)]
    return f" {notes[0]}" if notes else ""


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
    if origin is list:
        item = script_type(args[0])
        return f"({item})[]" if "|" in item else f"{item}[]"
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
