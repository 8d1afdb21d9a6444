"""The keys of a replay: what each does, and how the list of keys shows it."""

from collections.abc import Mapping
from typing import Final, NamedTuple


class Key(NamedTuple):
    """Some keys that belong together.

    Attributes
    ----------
    does
        Text ``keys.does_…`` that says what they do.
    names
        What is pressed, as it is written, or as a text ``keys.key_…``.
    actions
        For each action the keys that call it, as browsers name them; none of keys that act elsewhere.
    """

    does: str
    names: tuple[str, ...]
    actions: Mapping[str, tuple[str, ...]] = {}


OF_PAGE: Final = (
    Key("play", ("key_space",), {"toggle": (" ",)}),
    Key("step", ("←", "→"), {"stepBack": ("ArrowLeft",), "stepOn": ("ArrowRight",)}),
    Key("hundred_steps", ("PgUp", "PgDn"), {"hundredBack": ("PageUp",), "hundredOn": ("PageDown",)}),
    Key("block", ("↑", "↓"), {"blockBack": ("ArrowUp",), "blockOn": ("ArrowDown",)}),
    Key("ends", ("Home", "End"), {"toStart": ("Home",), "toEnd": ("End",)}),
    Key("speed", ("[", "]"), {"slower": ("[",), "faster": ("]",)}),
    Key("zoom", ("+", "−"), {"zoomIn": ("+", "="), "zoomOut": ("-",)}),
    Key("fit", ("0",), {"fit": ("0",)}),
    Key("follow", ("F",), {"follow": ("f",)}),
    Key("help", ("?",), {"help": ("?",)}),
    Key("fit_table", ("9",), {"fitTable": ("9",)}),
    Key("to_steps", ("Z",), {"toSteps": ("z",)}),
    Key("pan", ("Shift + ← ↑ → ↓",)),
    Key("loop_ends", ("A", "B"), {"loopFrom": ("a",), "loopTo": ("b",)}),
    Key("loop", ("L", "C"), {"loop": ("l",), "clearLoop": ("c",)}),
    Key("magnify", ("M",), {"magnify": ("m",)}),
    Key("link", ("K",), {"link": ("k",)}),
    Key("quiz", ("Q",), {"quiz": ("q",)}),
    Key("answer", ("1", "…", "9")),
    Key("language", ("G",), {"language": ("g",)}),
)


def actions_of(keys: tuple[Key, ...]) -> dict[str, str]:
    """The action that each key calls."""
    return {pressed: action for key in keys for action, names in key.actions.items() for pressed in names}
