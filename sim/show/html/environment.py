"""Templates of the pages: one self-contained file each, and whatever a program or a scenario says stands escaped."""

import json
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from parser import __version__
from sim.show.draw.paints import DARK, LIGHT, Theme
from sim.show.html.bundle import joined
from sim.show.words import said
from sim.show.words.words import texts

_SHARED = Path(__file__).with_name("assets")
_ESCAPED = {character: f"\\u{ord(character):04x}" for character in "<>&\u2028\u2029"}


def rendered(assets: Path, template: str, **values: Any) -> str:
    """Page of a template in the folder `assets`, which may extend ``base.html.j2`` and import ``words.html.j2``.

    In a template ``{{ inlined("page.css") }}`` is a style sheet of the folder as it stands, ``{{ joined("main.js") }}``
    its module with all that this imports (see `sim.show.html.bundle`), ``{{ value | script_json }}`` data for a script,
    ``{{ script_words("replay_scripts") | script_json }}`` a file of texts for scripts, which look for them in the
    element ``words``, and ``said("replay.quiz")`` a text in both languages; all else is escaped.
    """
    return _environment(assets).get_template(template).render(**values)


@cache
def _environment(assets: Path) -> Environment:
    """What templates of a folder are read by, each of them once in a process: a shop has thousands of pages."""
    environment = Environment(
        loader=FileSystemLoader([assets, _SHARED]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["script_json"] = script_json
    environment.globals |= {
        "drycut_version": __version__,
        "inlined": _Inlined(environment),
        "joined": lambda name: Markup(joined(assets / name)),  # noqa: S704 - as in _Inlined
        "said": said,
        "script_words": _script_words,
        "theme_css": theme_css,
    }
    return environment


class _Inlined:
    """Text of an asset, as it stands."""

    def __init__(self, environment: Environment) -> None:
        self._environment = environment

    def __call__(self, name: str) -> Markup:
        loader = self._environment.loader
        assert loader is not None  # noqa: S101 - given in `rendered`
        text, *_ = loader.get_source(self._environment, name)
        return Markup(text)  # noqa: S704 - a file of this package, never of a user


def _script_words(file: str) -> dict[str, dict[str, str]]:
    """Templates of a file by their names, each in both languages."""
    return {name: text._asdict() for name, text in texts(file).items()}


def script_json(value: Any) -> Markup:
    """JSON of a value for ``<script type="application/json">``: nothing in it ends the element or opens a comment.

    ``<``, ``>``, ``&`` and the line ends U+2028 and U+2029 occur in strings alone, where JSON knows them by number too.
    Raises ValueError on NaN and infinities, which JSON has not.
    """
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for character, escaped in _ESCAPED.items():  # ten times as fast as `str.translate`, over megabytes
        text = text.replace(character, escaped)
    return Markup(text)  # noqa: S704 - escaped just above


def theme_css() -> Markup:
    """Every paint as ``--name``: light, and dark on a screen that is set so."""
    dark = f"@media screen and (prefers-color-scheme: dark) {{ {_root(DARK)} }}"
    return Markup(f"{_root(LIGHT)}\n{dark}")  # noqa: S704 - names and numbers of this package


def _root(theme: Theme) -> str:
    paints = " ".join("--{}: #{:02x}{:02x}{:02x};".format(paint.value, *colour) for paint, colour in theme.items())
    return f":root {{ {paints} }}"
