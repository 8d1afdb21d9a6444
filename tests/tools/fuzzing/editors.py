"""Target `editor`: what the language server answers of any text, at any place in it."""

import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lsprotocol import converters, types

from fuzzing.iso_text import fuzzed_iso
from fuzzing.pmac_text import fuzzed_pmac
from fuzzing.program_text import fuzzed_program
from fuzzing.target import Input, Judged
from parser.findings.catalogue import LANGUAGES
from parser.findings.findings import edited
from parser.program import parse_program
from sim.check.file_check import as_typed
from sim.serve.editor.server import actions_of, diagnostics_of
from sim.serve.editor.shown import Places, Text, hover_of, layout_of, outline_of

_ENCODINGS = tuple(types.PositionEncodingKind)
_NAMES = ("part.3b", "part.iso", "part.pmc", "untitled")
_PLACES = 3
_CONVERTER = converters.get_converter()


def make(rng: random.Random) -> Input:
    """A text of any language."""
    return rng.choice((fuzzed_program, fuzzed_iso, fuzzed_pmac))(rng)


def judge(data: Input, number: int, _: Path) -> Judged:
    """Each question is answered, in places of the text; what is laid out stays so the second time."""
    assert isinstance(data, bytes)
    rng = random.Random(number)
    source = data.decode("utf-8" if number % 2 else "latin-1", "replace")
    made = as_typed(rng.choice(_NAMES), None, source)
    text = Text("file:///part", 1, made, Places(made.lines, rng.choice(_ENCODINGS)), rng.choice(LANGUAGES))
    asked = [_place(rng, text) for _ in range(_PLACES)]
    answers: list[Any] = [diagnostics_of(text), outline_of(text), *(hover_of(text, place) for place in asked)]
    answers.append(actions_of(text, types.Range(asked[0], asked[1]), []))
    answer = json.dumps(_CONVERTER.unstructure(answers), sort_keys=True)
    return Judged(answer, [*_beyond(text, json.loads(answer)), *_of_layout(made)], made.result.verdict)


def _place(rng: random.Random, text: Text) -> types.Position:
    """A place in the text, or beyond its end."""
    return types.Position(rng.randrange(text.places.count + 2), rng.choice((0, 1, 7, 40, 2**31 - 1)))


def _beyond(text: Text, node: Any) -> Iterator[str]:
    """Ranges that do not lie in the text."""
    if isinstance(node, list):
        for inner in node:
            yield from _beyond(text, inner)
    elif isinstance(node, dict):
        if {"start", "end"} <= node.keys():
            first, past = ((node[end]["line"], node[end]["character"]) for end in ("start", "end"))
            if not (0, 0) <= first <= past or past[0] >= text.places.count:
                yield f"a range beyond the text: {first} to {past}"
        for inner in node.values():
            yield from _beyond(text, inner)


def _of_layout(made: Any) -> Iterator[str]:
    program = made.program
    edits = layout_of(program) if program else ()
    if edits:
        again = parse_program(edited(program.text, edits), program.name, program.encoding, program.choices)
        if layout_of(again):
            yield "what is laid out is laid out anew"
