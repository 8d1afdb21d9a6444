"""What people read about settings, from ``settings.toml``: names in English and Chinese, and what the document says."""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from sim.setup.quiz import Said
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
    meaning: str
    bounds: str = ""
    default: str = ""


def words_of(section: Section, key: Key) -> KeyWords:
    """Words of a key. KeyError where there are none."""
    found = dict(words()["keys"][section.name][key.name])
    return KeyWords(Said(found.pop("en"), found.pop("zh")), **found)


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
