"""What people read about settings, from ``settings.toml``: names and what the document says, in English and Chinese."""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from parser.findings.catalogue import Said
from sim.setup.toml.keys import Key, Section

_WORDS = Path(__file__).with_name("settings.toml")


class KeyWords(NamedTuple):
    """Words of one key.

    Attributes
    ----------
    name
        What it is called.
    meaning
        What it is for, in the document.
    bounds, default
        What the document says in place of those of the key; nothing where it says those.
    """

    name: Said
    meaning: Said
    bounds: Said = Said("", "")
    default: Said = Said("", "")


def words_of(section: Section, key: Key) -> KeyWords:
    """Words of a key. KeyError where there are none."""
    found = dict(words()["keys"][section.name][key.name])
    name = Said(found.pop("en"), found.pop("zh"))
    return KeyWords(name, **{of: said(text) for of, text in found.items()})


def said(text: str | Mapping[str, str]) -> Said:
    """A text of ``settings.toml``, which stands there once where it is the same in both languages."""
    return Said(text, text) if isinstance(text, str) else Said(**text)


def title_of(section: Section) -> Said:
    """Title of a section. KeyError where there is none."""
    return Said(**words()["titles"][section.name])


def value_word(value: str) -> Said:
    """A value that is one of a few words. KeyError where there is none."""
    return Said(**words()["values"][value])


@cache
def words() -> Mapping[str, Any]:
    """All of them, as the file holds them."""
    return tomllib.loads(_WORDS.read_text(encoding="utf-8"))
