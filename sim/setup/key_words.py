"""What people read about settings, from ``settings.toml``: names and what the document says, in English and Chinese."""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from parser.findings.catalogue import Bilingual
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

    name: Bilingual
    meaning: Bilingual
    bounds: Bilingual = Bilingual("", "")
    default: Bilingual = Bilingual("", "")


def words_of(section: Section, key: Key) -> KeyWords:
    """Words of a key. KeyError where there are none."""
    found = dict(words()["keys"][section.name][key.name])
    name = Bilingual(found.pop("en"), found.pop("zh"))
    return KeyWords(name, **{of: setting_text(text) for of, text in found.items()})


def setting_text(text: str | Mapping[str, str]) -> Bilingual:
    """A text of ``settings.toml``, which stands there once where it is the same in both languages."""
    return Bilingual(text, text) if isinstance(text, str) else Bilingual(**text)


def title_of(section: Section) -> Bilingual:
    """Title of a section. KeyError where there is none."""
    return Bilingual(**words()["titles"][section.name])


def value_word(value: str) -> Bilingual:
    """A value that is one of a few words. KeyError where there is none."""
    return Bilingual(**words()["values"][value])


@cache
def words() -> Mapping[str, Any]:
    """All of them, as the file holds them."""
    return tomllib.loads(_WORDS.read_text(encoding="utf-8"))
