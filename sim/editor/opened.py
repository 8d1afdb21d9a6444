"""A text as an editor has it open."""

from typing import NamedTuple

from parser.findings.catalogue import Language
from sim.check.as_typed import AsTyped
from sim.editor.places import Places


class Text(NamedTuple):
    """A text as an editor has it: its name there, what was made of it, its places, and the language for people."""

    uri: str
    opened: AsTyped
    places: Places
    language: Language
